//! Messages into an MCAP log, on anything that takes bytes.

use std::collections::BTreeMap;
use std::io::Write;

use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Compression, WriteOptions, Writer};

use super::LogError;
use super::sink::{Sink, Topic};

/// Writes an MCAP log.
///
/// Nothing is sought back to, so the target may be a pipe, and what has been
/// flushed stays readable whatever happens next: a chunk goes out whole.
pub(super) struct McapSink<W: Write> {
    writer: Writer<NoSeek<W>>,
    channels: BTreeMap<String, Channel>,
}

struct Channel {
    id: u16,
    sequence: u32,
}

impl<W: Write> McapSink<W> {
    /// Begins a log. A file is best compressed; for a live stream that costs more than it saves.
    pub(super) fn new(target: W, compression: Option<Compression>) -> Result<Self, LogError> {
        let options = WriteOptions::new()
            .compression(compression)
            .compression_threads(0)
            .disable_seeking(true)
            .library(concat!("spatial-fetch/", env!("CARGO_PKG_VERSION")));
        let writer = options.create(NoSeek::new(target))?;
        Ok(Self { writer, channels: BTreeMap::new() })
    }

    /// Writes a table of names and values about the log as a whole.
    pub(super) fn metadata(&mut self, name: &str, metadata: BTreeMap<String, String>) -> Result<(), LogError> {
        Ok(self.writer.write_metadata(&Metadata { name: name.to_string(), metadata })?)
    }

    /// Ends the log with its index.
    pub(super) fn finish(mut self) -> Result<W, LogError> {
        self.writer.finish()?;
        Ok(self.writer.into_inner().into_inner())
    }
}

impl<W: Write> Sink for McapSink<W> {
    fn open(&mut self, topic: &Topic) -> Result<(), LogError> {
        let schema = self.writer.add_schema(topic.schema, topic.schema_encoding, topic.schema_data)?;
        let id = self.writer.add_channel(schema, topic.name, topic.encoding, &BTreeMap::new())?;
        self.channels.insert(topic.name.to_string(), Channel { id, sequence: 0 });
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

    fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.writer.flush()?)
    }
}
