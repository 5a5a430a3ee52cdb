//! In the place of `live` where the feature is off: there is no such server.

use std::io;

use super::LogError;
use super::sink::{Sink, Topic};

/// A WebSocket server that shows trials; this build has none.
#[derive(Debug)]
pub enum Live {}

impl Live {
    /// Always an error.
    ///
    /// # Errors
    /// Always: this build has no server.
    pub fn serve(_host: &str, _port: u16) -> io::Result<Self> {
        Err(io::ErrorKind::Unsupported.into())
    }

    /// Where it listens.
    pub fn port(&self) -> u16 {
        match *self {}
    }

    pub(super) fn begin(&self) -> LiveTrial {
        match *self {}
    }
}

pub(super) enum LiveTrial {}

impl Sink for LiveTrial {
    fn open(&mut self, _topic: &Topic) -> Result<(), LogError> {
        match *self {}
    }

    fn put(&mut self, _topic: &str, _time_ns: u64, _data: &[u8]) -> Result<(), LogError> {
        match *self {}
    }

    fn flush(&mut self) -> Result<(), LogError> {
        match *self {}
    }
}
