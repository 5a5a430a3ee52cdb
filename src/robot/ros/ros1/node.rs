//! A node: known to the master, called by other nodes, with all its topics.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

use super::codec::{decode, encode, sum};
use super::master::Master;
use super::publishing::Publications;
use super::subscribing::{Heard, Raw, Subscriptions};
use super::xml_rpc::{Value, connect, serve};
use crate::robot::ros::{Incoming, Kind, Message, RosError, Transport};
use crate::robot::standby::Words;

/// Messages that wait to be taken.
const WAITING: usize = 256;
/// The master is asked whether it lives this often, and is gone after so many tries.
const ASK_AGAIN: Duration = Duration::from_millis(500);
const TRIES: u32 = 3;
/// Nonsense on a topic is said so many times.
const SAID: u32 = 3;

/// A ROS 1 node.
pub struct Ros1 {
    master: Master,
    publications: Arc<Publications>,
    subscriptions: Arc<Subscriptions>,
    heard: Receiver<Heard>,
    kinds: BTreeMap<String, Kind>,
    nonsense: BTreeMap<String, u32>,
    lost: Arc<AtomicBool>,
    closed: Arc<AtomicBool>,
}

impl Ros1 {
    /// Joins the ROS whose master is at `place` (`HOST:PORT`), under a name that begins with `name`.
    ///
    /// `ROS_IP` or `ROS_HOSTNAME` say where others reach us; without them, the address by which we reach the master.
    ///
    /// # Errors
    /// When no master answers there.
    pub fn join(place: &str, name: &str) -> Result<Self, RosError> {
        let failed = |error: io::Error| RosError::Master(format!("ros1:{place}"), error);
        let own = connect(place).and_then(|stream| stream.local_addr()).map_err(failed)?.ip();
        let named = ["ROS_HOSTNAME", "ROS_IP"].into_iter().filter_map(|name| std::env::var(name).ok());
        let host = named.into_iter().find(|name| !name.is_empty()).unwrap_or_else(|| own.to_string());
        // A robot of this machine alone is no business of the network's.
        let is_local = own.is_loopback() && matches!(host.as_str(), "localhost" | "127.0.0.1");
        let bound = if is_local { Ipv4Addr::LOCALHOST } else { Ipv4Addr::UNSPECIFIED };
        let calls = TcpListener::bind((bound, 0)).map_err(failed)?;
        let lines = TcpListener::bind((bound, 0)).map_err(failed)?;
        let port = |listener: &TcpListener| listener.local_addr().map_or(0, |address| address.port());
        let caller = format!("/{name}_{}_{}", std::process::id(), port(&calls));
        let uri = format!("http://{host}:{}/", port(&calls));
        let master = Master { place: place.to_string(), caller: caller.clone(), uri };
        let (sender, heard) = sync_channel(WAITING);
        let node = Self {
            master,
            publications: Arc::default(),
            subscriptions: Arc::new(Subscriptions::new(&caller, sender)),
            heard,
            kinds: BTreeMap::new(),
            nonsense: BTreeMap::new(),
            lost: Arc::default(),
            closed: Arc::default(),
        };
        if !node.master.is_alive() {
            let what = io::Error::new(io::ErrorKind::InvalidData, "what answers there is no ROS master");
            return Err(failed(what));
        }
        let place = Value::List(vec![Value::text("TCPROS"), Value::Text(host), Value::Int(i32::from(port(&lines)))]);
        node.answer_calls(calls, place).and_then(|()| node.welcome(lines)).map_err(failed)?;
        node.watch_master().map_err(failed)?;
        Ok(node)
    }

    /// Other nodes and the master call.
    fn answer_calls(&self, calls: TcpListener, place: Value) -> io::Result<()> {
        let (publications, subscriptions) = (Arc::clone(&self.publications), Arc::clone(&self.subscriptions));
        let (closed, uri) = (Arc::clone(&self.closed), self.master.uri.clone());
        spawn("calls", move || {
            for stream in calls.incoming().flatten() {
                if closed.load(Ordering::Relaxed) {
                    return;
                }
                let answer = |method: &str, values: &[Value]| {
                    let topic = values.get(1).and_then(Value::as_text).unwrap_or_default();
                    let (code, value) = match method {
                        "requestTopic" if publications.has(topic) => (1, place.clone()),
                        "requestTopic" => (0, Value::Int(0)),
                        "publisherUpdate" => {
                            let listed = values.get(2).map(Value::as_list).unwrap_or_default();
                            let uris = listed.iter().filter_map(|uri| uri.as_text().map(str::to_string));
                            subscriptions.update(topic, uris.collect());
                            (1, Value::Int(0))
                        }
                        "getPid" => (1, Value::Int(std::process::id() as i32)),
                        "getMasterUri" => (1, Value::text(&uri)),
                        "getBusInfo" | "getBusStats" | "getPublications" | "getSubscriptions" => {
                            (1, Value::List(Vec::new()))
                        }
                        _ => (0, Value::Int(0)),
                    };
                    Value::List(vec![Value::Int(code), Value::text(""), value])
                };
                // Who calls nonsense hears nothing.
                let _ = serve(&stream, answer);
            }
        })
    }

    /// Other nodes come to listen.
    fn welcome(&self, lines: TcpListener) -> io::Result<()> {
        let (publications, closed) = (Arc::clone(&self.publications), Arc::clone(&self.closed));
        let caller = self.master.caller.clone();
        spawn("lines", move || {
            for stream in lines.incoming().flatten() {
                if closed.load(Ordering::Relaxed) {
                    return;
                }
                let _ = publications.welcome(stream, &caller);
            }
        })
    }

    fn watch_master(&self) -> io::Result<()> {
        let (master, lost, closed) = (self.master.clone(), Arc::clone(&self.lost), Arc::clone(&self.closed));
        spawn("master", move || {
            let mut silent = 0;
            while !closed.load(Ordering::Relaxed) && silent < TRIES {
                std::thread::sleep(ASK_AGAIN);
                silent = if master.is_alive() { 0 } else { silent + 1 };
            }
            lost.store(silent >= TRIES, Ordering::Relaxed);
        })
    }

    /// Listens to a topic of any type, whose name is `kind`, for [`Self::take_raw`].
    ///
    /// # Errors
    /// When the master refuses.
    pub fn subscribe_raw(&mut self, topic: &str, kind: &str) -> Result<(), RosError> {
        self.listen(topic, kind, "*")
    }

    fn listen(&self, topic: &str, kind: &str, sum: &str) -> Result<(), RosError> {
        self.subscriptions.add(topic, kind, sum);
        let publishers = self.master.subscribe(topic, kind)?;
        self.subscriptions.update(topic, publishers);
        Ok(())
    }

    /// The next message as it came, or nothing within `wait`; an error when there will be none.
    ///
    /// # Errors
    /// When the master is gone; and what is wrong with a topic.
    pub fn take_raw(&mut self, wait: Duration) -> Result<Option<Raw>, String> {
        match self.heard.recv_timeout(wait) {
            Ok(Heard::Message(raw)) => Ok(Some(raw)),
            Ok(Heard::Trouble(what)) => Err(what),
            Err(RecvTimeoutError::Timeout) if !self.lost.load(Ordering::Relaxed) => Ok(None),
            Err(_) => Err(self.gone()),
        }
    }

    /// Whether the master no longer answers.
    pub fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Relaxed)
    }

    fn gone(&self) -> String {
        format!("{}: the master no longer answers", self.master.name())
    }

    fn understood(&mut self, heard: Heard) -> Option<Incoming> {
        let raw = match heard {
            Heard::Trouble(what) => return Some(Incoming::Trouble(what)),
            Heard::Message(raw) => raw,
        };
        let kind = *self.kinds.get(&raw.topic)?;
        match decode(kind, &raw.bytes) {
            Ok(message) => Some(Incoming::Message(raw.topic, message)),
            Err(error) => {
                let times = self.nonsense.entry(raw.topic.clone()).or_default();
                *times += 1;
                let what = format!("{}: a message is no {}, and is passed over: {error}", raw.topic, kind.name());
                (*times <= SAID).then_some(Incoming::Trouble(what))
            }
        }
    }
}

fn spawn(name: &str, run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name(name.to_string()).spawn(run).map(drop)
}

impl Transport for Ros1 {
    fn name(&self) -> String {
        self.master.name()
    }

    fn topics(&self) -> Result<Vec<(String, String)>, RosError> {
        self.master.topics()
    }

    fn advertise(&mut self, topic: &str, kind: Kind, latched: bool) -> Result<(), RosError> {
        self.publications.add(topic, kind, latched);
        self.master.publish(topic, kind.name())
    }

    fn subscribe(&mut self, topic: &str, kind: Kind) -> Result<(), RosError> {
        self.kinds.insert(topic.to_string(), kind);
        self.listen(topic, kind.name(), sum(kind))
    }

    fn publish(&mut self, topic: &str, message: &Message) {
        self.publications.say(topic, &encode(message));
    }

    fn listeners(&self, topic: &str) -> usize {
        self.publications.listeners(topic)
    }

    fn take(&mut self, wait: Duration) -> Vec<Incoming> {
        self.publications.live();
        let first = self.heard.recv_timeout(wait).ok();
        let more: Vec<Heard> = first.into_iter().chain(self.heard.try_iter()).collect();
        let mut taken: Vec<Incoming> = more.into_iter().filter_map(|heard| self.understood(heard)).collect();
        if self.is_lost() {
            taken.push(Incoming::Lost(self.gone()));
        }
        taken
    }

    fn guard(&mut self, program: &OsStr, topic: &str, zero: &Message) {
        let zero = encode(zero);
        let framed = [(zero.len() as u32).to_le_bytes().as_slice(), &zero].concat();
        self.publications.guard(topic, program.to_os_string(), Words { zero: framed, ends: Vec::new() });
    }

    fn leave(&mut self) {
        if self.closed.swap(true, Ordering::Relaxed) {
            return;
        }
        self.subscriptions.close();
        if !self.is_lost() {
            self.master.leave(&self.publications.topics(), &self.subscriptions.topics());
        }
        self.publications.close();
    }
}

impl Drop for Ros1 {
    fn drop(&mut self) {
        self.leave();
    }
}
