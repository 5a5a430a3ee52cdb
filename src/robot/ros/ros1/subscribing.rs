//! Topics that we listen to: one connection for each node that publishes them.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::tcpros::{LONGEST, read_block, read_head, send_head};
use super::xml_rpc::{Value, call, connect};

/// One wait for bytes.
const WAIT: Duration = Duration::from_millis(200);
/// A publisher that cannot be reached, or says nonsense, is tried again after this.
const AGAIN: Duration = Duration::from_secs(1);

/// A message as it came.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raw {
    /// On which topic.
    pub topic: String,
    /// ROS's name of its type.
    pub kind: String,
    /// The type's text, by its publisher.
    pub definition: Arc<str>,
    /// What was said.
    pub bytes: Vec<u8>,
}

/// What comes out of a connection.
#[derive(Clone, Debug)]
pub enum Heard {
    /// A message.
    Message(Raw),
    /// Something is wrong, for people.
    Trouble(String),
}

/// The topics.
pub struct Subscriptions {
    caller: String,
    topics: Mutex<BTreeMap<String, Subscription>>,
    heard: SyncSender<Heard>,
    closed: AtomicBool,
}

struct Subscription {
    kind: String,
    sum: String,
    /// Who publishes, by the master.
    wanted: BTreeSet<String>,
    /// Who has a thread.
    connected: BTreeSet<String>,
}

impl Subscriptions {
    pub fn new(caller: &str, heard: SyncSender<Heard>) -> Self {
        Self { caller: caller.to_string(), topics: Mutex::default(), heard, closed: AtomicBool::new(false) }
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Subscription>> {
        self.topics.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn add(&self, topic: &str, kind: &str, sum: &str) {
        let (kind, sum) = (kind.to_string(), sum.to_string());
        let subscription = Subscription { kind, sum, wanted: BTreeSet::new(), connected: BTreeSet::new() };
        self.lock().insert(topic.to_string(), subscription);
    }

    pub fn topics(&self) -> Vec<String> {
        self.lock().keys().cloned().collect()
    }

    pub fn close(&self) {
        self.closed.store(true, Ordering::Relaxed);
    }

    fn is_open(&self) -> bool {
        !self.closed.load(Ordering::Relaxed)
    }

    /// These nodes publish it now.
    pub fn update(self: &Arc<Self>, topic: &str, publishers: Vec<String>) {
        let mut topics = self.lock();
        let Some(subscription) = topics.get_mut(topic) else { return };
        subscription.wanted = publishers.into_iter().collect();
        for uri in subscription.wanted.clone() {
            if subscription.connected.insert(uri.clone()) {
                let (all, topic) = (Arc::clone(self), topic.to_string());
                // Without a thread the topic stays silent, which the base says.
                let _ = std::thread::Builder::new().name("topic".into()).spawn(move || all.follow(&topic, &uri));
            }
        }
    }

    fn is_wanted(&self, topic: &str, uri: &str) -> bool {
        self.is_open() && self.lock().get(topic).is_some_and(|subscription| subscription.wanted.contains(uri))
    }

    /// Hears one publisher for as long as it publishes.
    fn follow(&self, topic: &str, uri: &str) {
        let mut said = false;
        while self.is_wanted(topic, uri) {
            let Err(error) = self.listen(topic, uri) else { break };
            if !self.is_wanted(topic, uri) {
                break;
            }
            if !said && error.kind() != io::ErrorKind::UnexpectedEof {
                said = true;
                let _ = self.heard.send(Heard::Trouble(format!("{topic} from {uri}: {error}")));
            }
            std::thread::sleep(AGAIN);
        }
        if let Some(subscription) = self.lock().get_mut(topic) {
            subscription.connected.remove(uri);
        }
    }

    fn listen(&self, topic: &str, uri: &str) -> io::Result<()> {
        let (kind, sum) = {
            let topics = self.lock();
            let Some(subscription) = topics.get(topic) else { return Ok(()) };
            (subscription.kind.clone(), subscription.sum.clone())
        };
        let place = place_of(&request(uri, &self.caller, topic)?)?;
        let stream = connect(&place)?;
        stream.set_nodelay(true)?;
        let fields = [("callerid", self.caller.as_str()), ("topic", topic), ("type", &kind), ("md5sum", &sum)];
        send_head(&stream, &[fields.as_slice(), &[("tcp_nodelay", "1")]].concat())?;
        let head = read_head(&stream)?;
        if let Some(error) = head.get("error") {
            return Err(io::Error::other(format!("refused: {error}")));
        }
        let definition: Arc<str> = head.get("message_definition").map_or("", String::as_str).into();
        stream.set_read_timeout(Some(WAIT))?;
        loop {
            let bytes = read_block(&stream, LONGEST, || self.is_wanted(topic, uri))?;
            let raw = Raw { topic: topic.into(), kind: kind.clone(), definition: Arc::clone(&definition), bytes };
            if self.heard.send(Heard::Message(raw)).is_err() {
                return Ok(());
            }
        }
    }
}

/// Asks a node where it publishes.
fn request(uri: &str, caller: &str, topic: &str) -> io::Result<Value> {
    let place = uri.trim_start_matches("http://").trim_end_matches('/');
    let protocols = Value::List(vec![Value::List(vec![Value::text("TCPROS")])]);
    call(place, "requestTopic", &[Value::text(caller), Value::text(topic), protocols])
}

fn place_of(answer: &Value) -> io::Result<String> {
    if let [_, _, place] = answer.as_list()
        && let [_, host, port] = place.as_list()
        && let (Some(host), Some(port)) = (host.as_text(), port.as_int())
    {
        return Ok(format!("{host}:{port}"));
    }
    Err(io::Error::new(io::ErrorKind::InvalidData, "it does not say where it publishes"))
}
