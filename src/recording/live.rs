//! The log of a trial while it goes on, for anyone who opens Foxglove at an address.
//!
//! Messages go out with the trial's own times, and so does the clock. Each
//! trial is a session of its own: its topics are made known anew, so that
//! nothing of the trial before is left standing.
//!
//! Who comes late gets, on each topic subscribed to, all that was told at time
//! zero (walls, grid, truth, records) and the newest message: sending on
//! subscription costs nothing while nobody comes, and leaves the messages of a
//! topic those of the log.

use std::collections::BTreeMap;
use std::future::pending;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak, mpsc};
use std::time::{Duration, Instant};

use foxglove::websocket::{Capability, ChannelView, Client, ServerListener};
use foxglove::{Context, FoxgloveError, PartialMetadata, RawChannel, Schema, WebSocketServer, WebSocketServerHandle};
use tokio::runtime::{Builder, Handle};

use super::LogError;
use super::sink::{Sink, Topic};

/// What waits to be sent when the program ends gets this long.
const LAST_WORDS: Duration = Duration::from_millis(500);
/// The clock is told no more often.
const CLOCK_EVERY: Duration = Duration::from_millis(50);

/// A WebSocket server that shows the trials of this program, one after another.
///
/// Each viewer has a queue of its own that loses its oldest messages when it is full: nobody holds the robot up.
#[derive(Debug)]
pub struct Live(Arc<Server>);

#[derive(Debug)]
struct Server {
    context: Arc<Context>,
    /// Of the one thread on which all of the server runs.
    runtime: Handle,
    shown: Mutex<Shown>,
    /// Set as soon as it listens.
    listening: OnceLock<WebSocketServerHandle>,
}

/// The trial that is shown.
#[derive(Debug, Default)]
struct Shown {
    topics: BTreeMap<String, ShownTopic>,
    now_ns: u64,
    told: Option<Instant>,
}

#[derive(Debug)]
struct ShownTopic {
    channel: Arc<RawChannel>,
    at_zero: Vec<Vec<u8>>,
    newest: Option<(u64, Vec<u8>)>,
}

impl Live {
    /// Listens at `host` (a name or number; IPv6 in brackets) and `port`; 0 takes any that is free.
    ///
    /// # Errors
    /// When the address cannot be listened at.
    pub fn serve(host: &str, port: u16) -> io::Result<Self> {
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let (context, handle) = (Context::new(), runtime.handle().clone());
        let server = Server { context, runtime: handle, shown: Mutex::default(), listening: OnceLock::new() };
        let server = Arc::new(server);
        let listening = WebSocketServer::new()
            .name("spatial-fetch drive")
            .bind(host, port)
            .context(&server.context)
            .capabilities([Capability::Time])
            .listener(Arc::new(Latecomers(Arc::downgrade(&server))))
            .start();
        let listening = runtime.block_on(listening).map_err(|error| match error {
            FoxgloveError::Bind(error) => error,
            error => io::Error::other(error),
        })?;
        // Set once, here.
        let _ = server.listening.set(listening);
        // It ends with the program.
        std::thread::Builder::new().name("live".to_string()).spawn(move || runtime.block_on(pending::<()>()))?;
        Ok(Self(server))
    }

    /// Where it listens.
    pub fn port(&self) -> u16 {
        self.0.listening.get().map_or(0, WebSocketServerHandle::port)
    }

    /// Shows another trial, in place of the one before.
    pub(super) fn begin(&self) -> LiveTrial {
        let mut shown = self.0.shown();
        for topic in shown.topics.values() {
            topic.channel.close();
        }
        if let (Some(server), false) = (self.0.listening.get(), shown.topics.is_empty()) {
            server.clear_session(None);
        }
        *shown = Shown::default();
        LiveTrial(Arc::clone(&self.0))
    }
}

impl Server {
    /// Makes a topic known.
    ///
    /// The library tells viewers of a channel a moment before it takes subscriptions to it, so a quick one would be
    /// turned away: it is made on the thread that also has to read the subscription.
    fn channel(&self, topic: &Topic) -> Result<Arc<RawChannel>, LogError> {
        let schema = Schema::new(topic.schema, topic.schema_encoding, topic.schema_data.to_vec());
        let builder = self.context.channel_builder(topic.name).message_encoding(topic.encoding).schema(schema);
        let (made, channel) = mpsc::channel();
        self.runtime.spawn(async move { made.send(builder.build_raw()) });
        let failed = |error: &dyn std::fmt::Display| LogError::Unwritable(error.to_string());
        channel.recv().map_err(|error| failed(&error))?.map_err(|error| failed(&error))
    }

    fn shown(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell_time(&self, now_ns: u64) {
        if let Some(server) = self.listening.get() {
            server.broadcast_time(now_ns);
        }
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        // The server has no word for an empty queue.
        if self.0.listening.get().is_some_and(|server| server.client_count() > 0) {
            std::thread::sleep(LAST_WORDS);
        }
    }
}

/// One trial, shown while it goes on.
pub(super) struct LiveTrial(Arc<Server>);

impl Sink for LiveTrial {
    fn open(&mut self, topic: &Topic) -> Result<(), LogError> {
        // Not while the thread that makes it may wait for what is shown.
        let channel = self.0.channel(topic)?;
        let shown = ShownTopic { channel, at_zero: Vec::new(), newest: None };
        self.0.shown().topics.insert(topic.name.to_string(), shown);
        Ok(())
    }

    fn put(&mut self, topic: &str, time_ns: u64, data: &[u8]) -> Result<(), LogError> {
        let mut shown = self.0.shown();
        let Some(topic) = shown.topics.get_mut(topic) else { return Ok(()) };
        topic.channel.log_with_meta(data, PartialMetadata::with_log_time(time_ns));
        topic.keep(time_ns, data);
        shown.now_ns = shown.now_ns.max(time_ns);
        if shown.told.is_none_or(|told| told.elapsed() >= CLOCK_EVERY) {
            shown.told = Some(Instant::now());
            self.0.tell_time(shown.now_ns);
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), LogError> {
        Ok(())
    }
}

impl ShownTopic {
    fn keep(&mut self, time_ns: u64, data: &[u8]) {
        if time_ns == 0 {
            self.at_zero.push(data.to_vec());
            return;
        }
        let (newest_ns, newest) = self.newest.get_or_insert_default();
        *newest_ns = time_ns;
        newest.clear();
        newest.extend_from_slice(data);
    }

    fn send_kept(&self, client: &Client) {
        let newest = self.newest.iter().map(|(time_ns, data)| (*time_ns, data));
        for (time_ns, data) in self.at_zero.iter().map(|data| (0, data)).chain(newest) {
            let time = PartialMetadata::with_log_time(time_ns);
            self.channel.log_with_meta_to_sink(data, time, client.sink_id());
        }
    }
}

/// Gives those who subscribe what they have missed.
struct Latecomers(Weak<Server>);

impl ServerListener for Latecomers {
    fn on_subscribe(&self, client: Client, channel: ChannelView) {
        let Some(server) = self.0.upgrade() else { return };
        let shown = server.shown();
        if let Some(topic) = shown.topics.get(channel.topic()).filter(|topic| topic.channel.id() == channel.id()) {
            topic.send_kept(&client);
            server.tell_time(shown.now_ns);
        }
    }
}
