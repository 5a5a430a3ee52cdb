//! Recordings as files hold them: one stream, or the several files into which one recording was split.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use mcap::Message;

use super::sorted_log::SortedLog;
use super::survey::Survey;
use super::{LogError, LogReader, Loss};

/// A file that begins within this of another's end goes on with it, nanoseconds.
const GAP_NS: u64 = 5_000_000_000;
/// Parts overlap by the messages that were still on their way, nanoseconds.
const OVERLAP_NS: u64 = 1_000_000_000;

/// The messages of one recording, in the order of their times where its files allow it.
pub struct Parts {
    waiting: VecDeque<PathBuf>,
    recover: bool,
    name: String,
    part: String,
    current: Option<Source>,
}

enum Source {
    Stream(Box<LogReader<Box<dyn Read + Send>>>),
    Sorted(Box<SortedLog>),
}

impl Parts {
    /// A recording that comes through a pipe.
    ///
    /// # Errors
    /// When it does not begin as an MCAP log.
    pub fn stream(source: Box<dyn Read + Send>, name: &str, recover: bool) -> Result<Self, LogError> {
        let log = LogReader::new(source, name, recover)?;
        let (name, part) = (name.to_string(), name.to_string());
        Ok(Self { waiting: VecDeque::new(), recover, name, part, current: Some(Source::Stream(Box::new(log))) })
    }

    /// The recording in these files, which are its parts in the order of their times.
    ///
    /// # Errors
    /// When the first of them cannot be read or is no MCAP log.
    pub fn files(paths: Vec<PathBuf>, recover: bool) -> Result<Self, LogError> {
        let name = paths.first().map(|path| path.display().to_string()).unwrap_or_default();
        let mut parts = Self { waiting: paths.into(), recover, part: name.clone(), name, current: None };
        parts.begin()?;
        Ok(parts)
    }

    /// What the recording is called: its first file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file that is being read.
    pub fn part(&self) -> &str {
        &self.part
    }

    /// Opens the next file; false when there is none.
    fn begin(&mut self) -> Result<bool, LogError> {
        self.current = None;
        let Some(path) = self.waiting.pop_front() else { return Ok(false) };
        self.part = path.display().to_string();
        self.current = Some(open(&path, &self.part, self.recover)?);
        Ok(true)
    }
}

fn open(path: &Path, name: &str, recover: bool) -> Result<Source, LogError> {
    let failed = |error| LogError::System(name.to_string(), error);
    let file = File::open(path).map_err(failed)?;
    let is_file = file.metadata().is_ok_and(|found| found.is_file());
    if is_file && begins_as_log(&file) {
        let survey = Survey::of(&file).map_err(failed)?;
        if !survey.is_in_order() {
            return Ok(Source::Sorted(Box::new(SortedLog::new(file, survey, recover).map_err(failed)?)));
        }
    }
    let mut file = file;
    if is_file {
        std::io::Seek::rewind(&mut file).map_err(failed)?;
    }
    let source: Box<dyn Read + Send> = Box::new(BufReader::new(file));
    Ok(Source::Stream(Box::new(LogReader::new(source, name, recover)?)))
}

fn begins_as_log(mut file: &File) -> bool {
    let mut magic = [0; 8];
    file.read_exact(&mut magic).is_ok() && magic == mcap::MAGIC
}

impl Iterator for Parts {
    type Item = Result<Message<'static>, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let item = match self.current.as_mut()? {
                Source::Stream(log) => log.next(),
                Source::Sorted(log) => log.next(),
            };
            if item.is_some() {
                return item;
            }
            match self.begin() {
                Ok(true) => {}
                Ok(false) => return None,
                Err(error) => return Some(Err(Loss(error.to_string()))),
            }
        }
    }
}

/// Groups files into recordings: those of which one begins where another ends are parts of one, in the order of their
/// times; the recordings come in the order in which their first parts were named.
pub fn recordings(paths: Vec<PathBuf>) -> Vec<Vec<PathBuf>> {
    if paths.len() < 2 {
        return paths.into_iter().map(|path| vec![path]).collect();
    }
    let span = |path: &PathBuf| {
        // Opening a pipe would take it from whoever writes to it.
        path.metadata().ok().filter(std::fs::Metadata::is_file)?;
        Survey::of(&File::open(path).ok()?).ok()?.span()
    };
    let spans: Vec<Option<(u64, u64)>> = paths.iter().map(span).collect();
    let groups = grouped(&spans);
    groups.into_iter().map(|group| group.into_iter().map(|i| paths[i].clone()).collect()).collect()
}

fn grouped(spans: &[Option<(u64, u64)>]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|i| spans[*i]);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for i in order {
        let before = groups.last().and_then(|group| spans[*group.last()?]);
        match (before, spans[i]) {
            (Some((_, end)), Some((begin, _))) if begin + OVERLAP_NS >= end && begin <= end.saturating_add(GAP_NS) => {
                if let Some(group) = groups.last_mut() {
                    group.push(i);
                }
            }
            _ => groups.push(vec![i]),
        }
    }
    groups.sort_by_key(|group| group.iter().copied().min());
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(spans: &[(u64, u64)]) -> Vec<Option<(u64, u64)>> {
        spans.iter().map(|(a, b)| Some((a * 1_000_000_000, b * 1_000_000_000))).collect()
    }

    #[test]
    fn files_that_go_on_with_each_other_are_one_recording_whatever_their_order() {
        assert_eq!(grouped(&seconds(&[(20, 30), (0, 10), (10, 20)])), [vec![1, 2, 0]]);
    }

    #[test]
    fn files_of_other_times_and_of_the_same_time_are_recordings_of_their_own() {
        assert_eq!(grouped(&seconds(&[(100, 110), (0, 10), (0, 12)])), [vec![0], vec![1], vec![2]]);
        assert_eq!(grouped(&[None, Some((1, 2))]), [vec![0], vec![1]]);
    }
}
