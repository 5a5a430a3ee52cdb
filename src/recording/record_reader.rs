//! Records back out of a log, to be run through a stage again.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use super::{LogError, LogReader, Loss, Window};
use crate::limits::LINE_BYTES;

/// The JSON records of one topic, in order, byte for byte, and everything that was lost on the way.
pub struct RecordReader<R> {
    log: LogReader<R>,
    topic: String,
    window: Window,
    found: usize,
    others: Vec<String>,
    ended: bool,
}

impl<R: Read> RecordReader<R> {
    /// The records that `log` has on `topic` within `window`.
    pub fn new(log: LogReader<R>, topic: &str, window: Window) -> Self {
        Self { log, topic: topic.to_string(), window, found: 0, others: Vec::new(), ended: false }
    }

    fn take(&mut self, message: &mcap::Message) -> Option<Result<Vec<u8>, Loss>> {
        let channel = &message.channel;
        let in_window = self.window.holds(message.log_time);
        if channel.topic != self.topic {
            if channel.message_encoding == "json" && !self.others.contains(&channel.topic) {
                self.others.push(channel.topic.clone());
            }
            return None;
        }
        self.found += 1;
        if channel.message_encoding != "json" {
            let (topic, encoding) = (&channel.topic, &channel.message_encoding);
            let schema = channel.schema.as_ref().map_or("no schema", |schema| schema.name.as_str());
            return Some(Err(Loss(format!("{topic} holds no records: its encoding is `{encoding}` ({schema})"))));
        }
        if let Err(damage) = LINE_BYTES.check(message.data.len()) {
            return Some(Err(Loss(format!("{}: {damage}", self.topic))));
        }
        in_window.then(|| Ok(message.data.to_vec()))
    }
}

impl<R: Read> Iterator for RecordReader<R> {
    type Item = Result<Vec<u8>, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.ended {
            match self.log.next() {
                Some(Err(loss)) => return Some(Err(loss)),
                Some(Ok(message)) => {
                    if let Some(item) = self.take(&message) {
                        return Some(item);
                    }
                }
                None => {
                    self.ended = true;
                    if self.found == 0 {
                        let (topic, others) = (&self.topic, self.others.join(", "));
                        let others = if others.is_empty() { "none".to_string() } else { others };
                        return Some(Err(Loss(format!("no record on {topic}; topics with records: {others}"))));
                    }
                }
            }
        }
        None
    }
}

/// The records of a whole and undamaged log on one topic.
///
/// # Errors
/// When it cannot be read, is no MCAP log or is damaged, or a record is not UTF-8.
pub fn records(path: &Path, topic: &str) -> Result<Vec<String>, LogError> {
    let file = path.display().to_string();
    let unreadable = |what: String| LogError::System(file.clone(), std::io::Error::other(what));
    let opened = File::open(path).map_err(|error| LogError::System(file.clone(), error))?;
    let log = LogReader::new(BufReader::new(opened), &file, false)?;
    let lines = RecordReader::new(log, topic, Window::default());
    lines
        .map(|line| {
            let line = line.map_err(|loss| unreadable(loss.to_string()))?;
            String::from_utf8(line).map_err(|_| unreadable("a record that is not UTF-8".to_string()))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_log_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("no.mcap");
        std::fs::write(&path, "hello").expect("written");
        let error = records(&path, "/fetch/drive").expect_err("no log").to_string();
        assert!(error.contains("no.mcap: not an MCAP log"), "{error}");
    }
}
