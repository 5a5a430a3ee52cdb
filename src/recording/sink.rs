//! Who takes the messages of a log: a file, a pipe, people who look on.

use super::LogError;

/// A topic as it is made known.
pub(super) struct Topic<'a> {
    pub(super) name: &'a str,
    /// How its messages are encoded.
    pub(super) encoding: &'a str,
    pub(super) schema: &'a str,
    pub(super) schema_encoding: &'a str,
    pub(super) schema_data: &'a [u8],
}

/// Takes messages that are encoded already.
pub(super) trait Sink {
    /// Makes a topic known, before its first message.
    fn open(&mut self, topic: &Topic) -> Result<(), LogError>;

    /// Takes a message on a topic that was made known.
    fn put(&mut self, topic: &str, time_ns: u64, data: &[u8]) -> Result<(), LogError>;

    /// Hands on everything so far.
    fn flush(&mut self) -> Result<(), LogError>;
}
