//! Messages of any type, encoded for whoever takes them.

use std::collections::BTreeSet;

use foxglove::Encode;

use super::LogError;
use super::sink::{Sink, Topic};

/// Writes messages of any type to topics, each made known by its first message.
pub(super) struct LogWriter<S: Sink> {
    sink: S,
    known: BTreeSet<String>,
    buffer: Vec<u8>,
}

impl<S: Sink> LogWriter<S> {
    pub(super) fn new(sink: S) -> Self {
        Self { sink, known: BTreeSet::new(), buffer: Vec::new() }
    }

    /// Writes a message of one of Foxglove's types.
    pub(super) fn message<T: Encode>(&mut self, topic: &str, time_ns: u64, message: &T) -> Result<(), LogError> {
        if !self.known.contains(topic) {
            let unnamed = || LogError::Unwritable(format!("{topic}: a message without a schema"));
            let schema = T::get_schema().ok_or_else(unnamed)?;
            self.open(&Topic {
                name: topic,
                encoding: &T::get_message_encoding(),
                schema: &schema.name,
                schema_encoding: &schema.encoding,
                schema_data: &schema.data,
            })?;
        }
        self.buffer.clear();
        message.encode(&mut self.buffer).map_err(|error| LogError::Unwritable(error.to_string()))?;
        self.sink.put(topic, time_ns, &self.buffer)
    }

    /// Writes one JSON line as one message, byte for byte.
    pub(super) fn json(
        &mut self,
        topic: &str,
        name: &str,
        schema: &str,
        time_ns: u64,
        line: &str,
    ) -> Result<(), LogError> {
        if !self.known.contains(topic) {
            self.open(&Topic {
                name: topic,
                encoding: "json",
                schema: name,
                schema_encoding: "jsonschema",
                schema_data: schema.as_bytes(),
            })?;
        }
        self.sink.put(topic, time_ns, line.as_bytes())
    }

    fn open(&mut self, topic: &Topic) -> Result<(), LogError> {
        self.known.insert(topic.name.to_string());
        self.sink.open(topic)
    }

    /// Hands on everything so far.
    pub(super) fn flush(&mut self) -> Result<(), LogError> {
        self.sink.flush()
    }

    pub(super) fn into_sink(self) -> S {
        self.sink
    }
}
