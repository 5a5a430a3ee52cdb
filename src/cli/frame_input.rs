//! Frames of recorded logs through a stage that sees.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};

use super::filter::{Outcome, finish, refuse_rows, run_source};
use super::log_input::Bytes;
use super::{Common, Diagnostic, Exit, Failure, FromLog, Inputs, Line, Source};
use crate::perception::Told;
use crate::record::{Note, Record, Stage, StageError};
use crate::recording::{FrameOptions, FrameReader, LogError, Parts, TimedFrame, recordings};

/// Pictures are large: only as many at a time as keep the cores busy.
const BATCH_FRAMES: usize = 8;

/// What a seeing stage adds to the record of one frame.
pub type See<'a> = dyn Fn(&TimedFrame, &mut Record) -> Result<Note, StageError> + Sync + 'a;

/// What there is to read: records that name frames, or logs that hold them.
pub enum FrameInput {
    /// JSON lines.
    Lines(Inputs),
    /// MCAP logs.
    Logs(Box<FrameLogs>),
}

impl FrameInput {
    /// Looks at the first bytes: an MCAP log is read as one, wherever it comes from.
    /// `told` is what is known of the camera of frames whose log does not tell where it was; a log that cannot be read
    /// is told and passed over when it shall `keep_going`.
    ///
    /// # Errors
    /// When standard input begins as a log and goes on as none.
    pub fn open(files: &[PathBuf], options: &FromLog, told: Told, keep_going: bool) -> Result<Self, Failure> {
        let logs = |paths: Vec<PathBuf>| FrameLogs { keep_going, ..FrameLogs::new(paths, options.clone(), told) };
        match (&options.from, files) {
            (Some(path), _) => Ok(Self::Logs(Box::new(logs(vec![path.clone()])))),
            (None, [first, ..]) if first != Path::new("-") => {
                let is_log =
                    |path: &PathBuf| File::open(path).is_ok_and(|file| is_regular(&file) && begins_as_log(file).0);
                // One that is missing does not say what the others are.
                if is_log(first) || keep_going && !first.exists() && files.iter().any(is_log) {
                    Ok(Self::Logs(Box::new(logs(files.to_vec()))))
                } else {
                    Ok(Self::Lines(Inputs::new(files, keep_going)))
                }
            }
            _ => {
                let (is_log, begin) = begins_as_log(io::stdin());
                let stdin: Bytes = Box::new(Cursor::new(begin).chain(io::stdin()));
                if !is_log {
                    return Ok(Self::Lines(Inputs::of("<stdin>", stdin)));
                }
                let mut logs = logs(Vec::new());
                logs.begin_stream(stdin)?;
                Ok(Self::Logs(Box::new(logs)))
            }
        }
    }
}

fn is_regular(file: &File) -> bool {
    file.metadata().is_ok_and(|found| found.is_file())
}

/// Whether the source begins as an MCAP log, and the bytes taken to tell.
fn begins_as_log(mut source: impl Read) -> (bool, Vec<u8>) {
    let mut begin = Vec::new();
    // A source that cannot be read says so when it is read in earnest.
    let _ = source.by_ref().take(mcap::MAGIC.len() as u64).read_to_end(&mut begin);
    (begin == mcap::MAGIC, begin)
}

/// The frames of one log after another.
pub struct FrameLogs {
    waiting: VecDeque<Vec<PathBuf>>,
    options: FromLog,
    told: Told,
    /// Whether a log that cannot be read is told and passed over.
    keep_going: bool,
    current: Option<Current>,
    count: usize,
    lost: Vec<Diagnostic>,
}

struct Current {
    frames: FrameReader<Parts>,
    is_pipe: bool,
}

/// A frame and where it came from.
#[derive(Clone, Debug)]
pub struct FrameItem {
    /// The log's name.
    pub file: String,
    /// Counted over all logs, 1-based.
    pub ordinal: usize,
    /// The frame.
    pub timed: TimedFrame,
}

impl FrameItem {
    /// The log's name without folder and ending, and the frame's number: `kitchen_12`.
    pub fn name(&self) -> String {
        let stem = Path::new(&self.file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        format!("{}_{}", stem.unwrap_or_default().trim_matches(['<', '>']), self.ordinal)
    }

    /// Where it stands in its log, for messages.
    pub fn line(&self) -> Line {
        let (number, ordinal) = (self.ordinal, self.ordinal);
        Line { file: self.file.as_str().into(), number, ordinal, bytes: Vec::new(), terminated: true }
    }
}

impl FrameLogs {
    fn new(paths: Vec<PathBuf>, options: FromLog, told: Told) -> Self {
        let waiting = recordings(paths).into();
        Self { waiting, options, told, keep_going: false, current: None, count: 0, lost: Vec::new() }
    }

    fn begin_stream(&mut self, bytes: Bytes) -> Result<(), Failure> {
        self.begin(Parts::stream(bytes, "<stdin>", self.options.recover).map_err(failed)?, true);
        Ok(())
    }

    fn begin(&mut self, parts: Parts, is_pipe: bool) {
        let (topics, window, recover) = (self.options.topic.clone(), self.options.window(), self.options.recover);
        let frames = FrameReader::of(parts, FrameOptions { topics, window, recover, told: self.told });
        self.current = Some(Current { frames, is_pipe });
    }

    /// Begins the next recording; false when there is none.
    fn begin_next(&mut self) -> Result<bool, Failure> {
        let Some(paths) = self.waiting.pop_front() else { return Ok(false) };
        match (self.open_next(&paths), paths.first()) {
            (Err(Failure::Failed(what)), Some(path)) if self.keep_going => {
                let place = path.display().to_string();
                let what = what.strip_prefix(&format!("{place}: ")).unwrap_or(&what);
                let message = format!("{what}; its frames are left out");
                self.lost.push(Diagnostic { place, id: None, message });
            }
            (begun, _) => begun?,
        }
        Ok(true)
    }

    fn open_next(&mut self, paths: &[PathBuf]) -> Result<(), Failure> {
        match paths {
            [path] if path == Path::new("-") => self.begin_stream(Box::new(io::stdin()))?,
            _ => {
                let is_pipe = paths.iter().any(|path| !path.metadata().is_ok_and(|found| found.is_file()));
                self.begin(Parts::files(paths.to_vec(), self.options.recover).map_err(failed)?, is_pipe);
            }
        }
        Ok(())
    }

    fn next_frame(&mut self) -> Result<Option<FrameItem>, Failure> {
        loop {
            let Some(current) = &mut self.current else {
                if self.begin_next()? {
                    continue;
                }
                return Ok(None);
            };
            match current.frames.next() {
                None => self.current = None,
                Some(Err(loss)) => {
                    let place = current.frames.messages().part().to_string();
                    self.lost.push(Diagnostic { place, id: None, message: loss.to_string() });
                }
                Some(Ok(timed)) => {
                    self.count += 1;
                    let file = current.frames.messages().name().to_string();
                    return Ok(Some(FrameItem { file, ordinal: self.count, timed }));
                }
            }
        }
    }
}

fn failed(error: LogError) -> Failure {
    Failure::Failed(error.to_string())
}

impl Source<FrameItem> for FrameLogs {
    fn next_batch(&mut self, limit: usize) -> Result<Vec<FrameItem>, Failure> {
        let mut batch = Vec::new();
        while batch.len() < limit.min(BATCH_FRAMES) {
            if !batch.is_empty() && self.current.as_ref().is_some_and(|current| current.is_pipe) {
                break;
            }
            match self.next_frame()? {
                Some(item) => batch.push(item),
                None => break,
            }
        }
        Ok(batch)
    }

    fn lost(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.lost)
    }
}

/// Runs a seeing stage over all frames of the logs: one record a frame, with its times and the robot's pose.
///
/// # Errors
/// When a log cannot be read, the output cannot be written, or a frame cannot be processed and no one said to go on.
pub fn run_frames(
    program: &'static str,
    common: &Common,
    logs: &mut FrameLogs,
    stage: &dyn Stage,
    see: &See,
) -> Result<Exit, Failure> {
    refuse_rows(program, common, stage)?;
    let style = common.style();
    run_source(program, common, logs, &|item: &FrameItem| {
        let mut record = Record::default();
        record.set("id", &item.ordinal.to_string());
        record.set("frame", &item.name());
        record.set("stamp_ns", &item.timed.stamp_ns);
        record.set("log_ns", &item.timed.log_ns);
        record.set("robot_pose", &item.timed.robot);
        let mut outcome = Outcome::default();
        finish(&item.line(), record, style, stage, &|record| see(&item.timed, record), &mut outcome);
        outcome
    })
}
