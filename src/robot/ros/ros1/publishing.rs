//! Topics that we publish: who listens, each on a thread that never holds up the one who speaks.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::{self, Write};
use std::net::TcpStream;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::codec::sum;
use super::tcpros::{Head, read_head, send_head};
use crate::robot::ros::Kind;
use crate::robot::standby::{Second, Words};

/// Messages that wait for a slow listener; what comes then is not said to it.
const WAITING: usize = 8;
/// A listener that takes nothing for this long is none.
const TAKES_WITHIN: Duration = Duration::from_secs(2);

/// The topics.
#[derive(Default)]
pub struct Publications(Mutex<BTreeMap<String, Publication>>);

struct Publication {
    kind: Kind,
    /// The last message, for who comes later.
    latched: Option<Option<Arc<Vec<u8>>>>,
    listeners: Vec<Listener>,
    guard: Option<(OsString, Words)>,
}

struct Listener {
    queue: SyncSender<Arc<Vec<u8>>>,
    second: Option<Second>,
}

impl Publications {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Publication>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn add(&self, topic: &str, kind: Kind, latched: bool) {
        let publication = Publication { kind, latched: latched.then_some(None), listeners: Vec::new(), guard: None };
        self.lock().insert(topic.to_string(), publication);
    }

    pub fn topics(&self) -> Vec<String> {
        self.lock().keys().cloned().collect()
    }

    pub fn has(&self, topic: &str) -> bool {
        self.lock().contains_key(topic)
    }

    pub fn listeners(&self, topic: &str) -> usize {
        self.lock().get(topic).map_or(0, |publication| publication.listeners.len())
    }

    /// From now on a second process speaks to who listens to `topic` when this one cannot.
    pub fn guard(&self, topic: &str, program: OsString, words: Words) {
        if let Some(publication) = self.lock().get_mut(topic) {
            publication.guard = Some((program, words));
        }
    }

    /// The second processes hear that this one lives.
    pub fn live(&self) {
        let mut topics = self.lock();
        let listeners = topics.values_mut().flat_map(|publication| &mut publication.listeners);
        listeners.filter_map(|listener| listener.second.as_mut()).for_each(Second::live);
    }

    /// Says it to all who listen: a message with its length.
    pub fn say(&self, topic: &str, message: &[u8]) {
        let mut topics = self.lock();
        let Some(publication) = topics.get_mut(topic) else { return };
        let framed = Arc::new([(message.len() as u32).to_le_bytes().as_slice(), message].concat());
        if let Some(last) = &mut publication.latched {
            *last = Some(Arc::clone(&framed));
        }
        publication.listeners.retain(|listener| {
            !matches!(listener.queue.try_send(Arc::clone(&framed)), Err(TrySendError::Disconnected(_)))
        });
    }

    /// Takes in a node that has connected to listen.
    ///
    /// # Errors
    /// When it does not say to what, wants another type, or is gone.
    pub fn welcome(&self, stream: TcpStream, caller: &str) -> io::Result<()> {
        stream.set_read_timeout(Some(TAKES_WITHIN))?;
        stream.set_write_timeout(Some(TAKES_WITHIN))?;
        stream.set_nodelay(true)?;
        let head = read_head(&stream)?;
        let mut topics = self.lock();
        let found = head.get("topic").and_then(|topic| topics.get_mut(topic));
        let Some(publication) = found.filter(|publication| fits(&head, publication.kind)) else {
            drop(topics);
            let what = "this topic is not published here, or is of another type";
            send_head(&stream, &[("error", what)])?;
            return Err(io::Error::new(io::ErrorKind::InvalidData, what));
        };
        let (kind, is_latched) = (publication.kind, publication.latched.is_some());
        let latching = if is_latched { "1" } else { "0" };
        let fields = [("callerid", caller), ("md5sum", sum(kind)), ("type", kind.name()), ("latching", latching)];
        send_head(&stream, &[fields.as_slice(), &[("message_definition", "")]].concat())?;
        let guard = publication.guard.as_ref();
        let second =
            guard.and_then(|(program, words)| Second::start(program, stream.try_clone().ok()?.into(), words).ok());
        let (queue, messages) = sync_channel::<Arc<Vec<u8>>>(WAITING);
        if let Some(Some(last)) = &publication.latched {
            let _ = queue.try_send(Arc::clone(last));
        }
        std::thread::Builder::new().name("listener".to_string()).spawn(move || {
            let mut stream = stream;
            for message in messages {
                if stream.write_all(&message).is_err() {
                    return;
                }
            }
        })?;
        publication.listeners.push(Listener { queue, second });
        Ok(())
    }

    /// Nobody is spoken to any more.
    pub fn close(&self) {
        self.lock().clear();
    }
}

fn fits(head: &Head, kind: Kind) -> bool {
    head.get("md5sum").is_some_and(|md5| md5 == "*" || md5 == sum(kind))
}
