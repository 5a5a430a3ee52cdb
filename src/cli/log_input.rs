//! Input from a recorded log: `--from FILE.mcap`.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Common, Diagnostic, Failure, Inputs, Line, Source};
use crate::recording::{LogReader, RecordReader, Window};

/// A log as bytes: a file or a pipe.
pub(super) type Bytes = Box<dyn Read + Send>;

/// Options of the binaries that can take their input from a log.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Input from a recording")]
pub struct FromLog {
    /// Take the input from this MCAP log; `-` is standard input
    #[arg(long, value_name = "FILE.mcap", visible_alias = "replay", conflicts_with = "files")]
    pub from: Option<PathBuf>,

    /// Topic to read [default: by stage, or by type for pictures]; may be given several times for pictures
    #[arg(long, value_name = "TOPIC")]
    pub topic: Vec<String>,

    /// Leave out what was logged earlier, seconds since the log's first message
    #[arg(long, value_name = "SECONDS")]
    pub start: Option<f64>,

    /// Leave out what was logged later, seconds since the log's first message
    #[arg(long, value_name = "SECONDS")]
    pub end: Option<f64>,

    /// Salvage what can be unpacked of damaged and cut chunks, though no checksum vouches for it
    #[arg(long)]
    pub recover: bool,
}

impl FromLog {
    /// The lines of a filter: those of the files, or the records the log has on the topic asked for, else on `topic`.
    ///
    /// # Errors
    /// When a file or log cannot be opened, or the log is no MCAP.
    pub fn lines(&self, common: &Common, topic: &str) -> Result<Box<dyn Source<Line>>, Failure> {
        let Some(path) = &self.from else {
            self.expect_unused()?;
            return Ok(Box::new(Inputs::new(&common.files, common.keep_going)));
        };
        let topic = match self.topic.as_slice() {
            [] => topic,
            [one] => one,
            _ => return Err(Failure::Usage("records are read from one --topic".to_string())),
        };
        Ok(Box::new(LogLines::open(path, topic, self)?))
    }

    /// The part of the log that is wanted.
    pub(super) fn window(&self) -> Window {
        Window::new(self.start, self.end)
    }

    fn expect_unused(&self) -> Result<(), Failure> {
        let used = !self.topic.is_empty() || self.start.is_some() || self.end.is_some() || self.recover;
        if !used {
            return Ok(());
        }
        Err(Failure::Usage("--topic, --start, --end and --recover read a log: name it by --from FILE.mcap".to_string()))
    }
}

/// Opens a log; true when it is a pipe, on which one must not wait for more than there is.
pub(super) fn open_log(path: &Path) -> Result<(Bytes, String, bool), Failure> {
    if path == Path::new("-") {
        return Ok((Box::new(io::stdin()), "<stdin>".to_string(), true));
    }
    let name = path.display().to_string();
    let file = File::open(path).map_err(|error| Failure::Failed(format!("{name}: {error}")))?;
    let is_pipe = file.metadata().is_ok_and(|found| !found.is_file());
    Ok((Box::new(BufReader::new(file)), name, is_pipe))
}

/// The records of a log as lines.
struct LogLines {
    records: RecordReader<Bytes>,
    name: Arc<str>,
    is_pipe: bool,
    count: usize,
    lost: Vec<Diagnostic>,
}

impl LogLines {
    fn open(path: &Path, topic: &str, options: &FromLog) -> Result<Self, Failure> {
        let (bytes, name, is_pipe) = open_log(path)?;
        let log = LogReader::new(bytes, &name, options.recover).map_err(|error| Failure::Failed(error.to_string()))?;
        let records = RecordReader::new(log, topic, options.window());
        Ok(Self { records, name: format!("{name}:{topic}").into(), is_pipe, count: 0, lost: Vec::new() })
    }
}

impl Source<Line> for LogLines {
    fn next_batch(&mut self, limit: usize) -> Result<Vec<Line>, Failure> {
        let limit = if self.is_pipe { 1 } else { limit };
        let mut batch = Vec::new();
        while batch.len() < limit {
            match self.records.next() {
                None => break,
                Some(Err(loss)) => {
                    self.lost.push(Diagnostic { place: self.name.to_string(), id: None, message: loss.to_string() });
                }
                Some(Ok(bytes)) => {
                    self.count += 1;
                    let (file, count) = (self.name.clone(), self.count);
                    batch.push(Line { file, number: count, ordinal: count, bytes, terminated: true });
                }
            }
        }
        Ok(batch)
    }

    fn lost(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.lost)
    }
}
