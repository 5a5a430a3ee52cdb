//! Messages into an MCAP log, on anything that takes bytes.

use std::collections::BTreeMap;
use std::io::Write;

use foxglove::Encode;
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Compression, WriteOptions, Writer};

use super::LogError;

/// Writes messages of any type to topics, each made known by its first message.
///
/// Nothing is sought back to, so the target may be a pipe, and what has been
/// flushed stays readable whatever happens next: a chunk goes out whole.
pub(super) struct LogWriter<W: Write> {
    writer: Writer<NoSeek<W>>,
    channels: BTreeMap<String, Channel>,
    buffer: Vec<u8>,
}

struct Channel {
    id: u16,
    sequence: u32,
}

impl<W: Write> LogWriter<W> {
    /// Begins a log. A file is best compressed; for a live stream that costs more than it saves.
    pub(super) fn new(target: W, compression: Option<Compression>) -> Result<Self, LogError> {
        let options = WriteOptions::new()
            .compression(compression)
            .compression_threads(0)
            .disable_seeking(true)
            .library(concat!("spatial-fetch/", env!("CARGO_PKG_VERSION")));
        let writer = options.create(NoSeek::new(target))?;
        Ok(Self { writer, channels: BTreeMap::new(), buffer: Vec::new() })
    }

    /// Writes a message of one of Foxglove's types.
    pub(super) fn message<T: Encode>(&mut self, topic: &str, time_ns: u64, message: &T) -> Result<(), LogError> {
        if !self.channels.contains_key(topic) {
            let unnamed = || LogError::Unwritable(format!("{topic}: a message without a schema"));
            let schema = T::get_schema().ok_or_else(unnamed)?;
            self.open(topic, &schema.name, &schema.encoding, &schema.data, &T::get_message_encoding())?;
        }
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        message.encode(&mut buffer).map_err(|error| LogError::Unwritable(error.to_string()))?;
        let written = self.put(topic, time_ns, &buffer);
        self.buffer = buffer;
        written
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
        if !self.channels.contains_key(topic) {
            self.open(topic, name, "jsonschema", schema.as_bytes(), "json")?;
        }
        self.put(topic, time_ns, line.as_bytes())
    }

    /// Writes a table of names and values about the log as a whole.
    pub(super) fn metadata(&mut self, name: &str, metadata: BTreeMap<String, String>) -> Result<(), LogError> {
        Ok(self.writer.write_metadata(&Metadata { name: name.to_string(), metadata })?)
    }

    fn open(&mut self, topic: &str, name: &str, encoding: &str, data: &[u8], message: &str) -> Result<(), LogError> {
        let schema = self.writer.add_schema(name, encoding, data)?;
        let id = self.writer.add_channel(schema, topic, message, &BTreeMap::new())?;
        self.channels.insert(topic.to_string(), Channel { id, sequence: 0 });
        Ok(())
    }

    fn put(&mut self, topic: &str, time_ns: u64, data: &[u8]) -> Result<(), LogError> {
        let Some(channel) = self.channels.get_mut(topic) else { return Ok(()) };
        channel.sequence = channel.sequence.wrapping_add(1);
        let header = MessageHeader {
            channel_id: channel.id,
            sequence: channel.sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        Ok(self.writer.write_to_known_channel(&header, data)?)
    }

    /// Hands everything so far to the target, readable as it is.
    pub(super) fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.writer.flush()?)
    }

    /// Ends the log with its index.
    pub(super) fn finish(mut self) -> Result<W, LogError> {
        self.writer.finish()?;
        Ok(self.writer.into_inner().into_inner())
    }
}
