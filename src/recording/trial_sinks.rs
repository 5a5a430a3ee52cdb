//! Where the log of a trial goes: into a file, to people who look on, or both.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::BufWriter;
use std::path::Path;

use mcap::Compression;

use super::LogError;
use super::live::{Live, LiveTrial};
use super::mcap_sink::McapSink;
use super::sink::{Sink, Topic};

/// Where the log of a trial is to go.
#[derive(Clone, Copy, Default)]
pub struct Target<'a> {
    /// Into this file, pipe or device.
    pub file: Option<&'a Path>,
    /// A file that exists is replaced.
    pub force: bool,
    /// To those who look on.
    pub live: Option<&'a Live>,
}

/// The file fails for itself: those who look on see the trial to its end.
pub(super) struct TrialSinks {
    file: Option<McapSink<BufWriter<File>>>,
    live: Option<LiveTrial>,
}

impl TrialSinks {
    /// Begins the log; `about` says how the trial is run.
    pub(super) fn open(target: &Target, about: BTreeMap<String, String>) -> Result<Self, LogError> {
        let begin = |path| -> Result<_, LogError> {
            let mut file = McapSink::new(BufWriter::new(open(path, target.force)?), Some(Compression::Zstd))?;
            file.metadata("spatial_fetch", about)?;
            Ok(file)
        };
        Ok(Self { file: target.file.map(begin).transpose()?, live: target.live.map(Live::begin) })
    }

    fn each(&mut self, give: impl Fn(&mut dyn Sink) -> Result<(), LogError>) -> Result<(), LogError> {
        let shown = self.live.as_mut().map_or(Ok(()), |live| give(live));
        let written = self.file.as_mut().map_or(Ok(()), |file| give(file));
        if written.is_err() {
            self.file = None;
        }
        written.and(shown)
    }

    /// Ends the file. What is shown stays until the next trial begins.
    pub(super) fn finish(self) -> Result<(), LogError> {
        self.file.map_or(Ok(()), |file| file.finish().map(|_| ()))
    }
}

impl Sink for TrialSinks {
    fn open(&mut self, topic: &Topic) -> Result<(), LogError> {
        self.each(|sink| sink.open(topic))
    }

    fn put(&mut self, topic: &str, time_ns: u64, data: &[u8]) -> Result<(), LogError> {
        self.each(|sink| sink.put(topic, time_ns, data))
    }

    fn flush(&mut self) -> Result<(), LogError> {
        self.each(|sink| sink.flush())
    }
}

/// A pipe or a device is written to as it is; a file is new, or replaced when `force`.
fn open(path: &Path, force: bool) -> Result<File, LogError> {
    let name = || path.display().to_string();
    let special = path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir());
    let mut options = OpenOptions::new();
    match (special, force) {
        (true, _) => options.write(true),
        (false, true) => options.write(true).create(true).truncate(true),
        (false, false) => options.write(true).create_new(true),
    };
    options.open(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => LogError::Exists(name()),
        _ => LogError::System(name(), error),
    })
}
