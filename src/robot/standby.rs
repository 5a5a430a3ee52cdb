//! A second process that holds the line too, and stops the robot when the first one no longer can.
//!
//! A process that is killed, aborts because no memory is left, or is stopped
//! by a signal that nobody can catch says nothing to its robot, which drives
//! on until its own watchdog: up to 2.4 s and 0.65 m. The second process does
//! nothing but wait on a pipe. It hears that the first one lives ten times a
//! second; when that ceases it sends zero set-points, and when the pipe ends
//! without a good-bye it stops the robot and says what ends the session.
//!
//! It shares no memory with the first process, reads nothing from the robot,
//! and is in a process group of its own, so that what a terminal sends to the
//! first one does not reach it. What it says it was told when it was started.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::process::{Child, ChildStdin, Command as Process, Stdio};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, poll};
use rustix::time::Timespec;

/// The argument that makes a second process of the program; its words follow.
pub const ARGUMENT: &str = "--stand-by-for-a-robot";
/// The first process says so often that it lives.
pub const ALIVE_EVERY: Duration = Duration::from_millis(100);
/// A first process not heard for this long has been stopped.
const SILENT_AFTER: Duration = Duration::from_millis(400);
/// A robot that is told to stand stands within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);
/// A stop is repeated this often.
const STOP_AGAIN: Duration = Duration::from_millis(20);

const ALIVE: u8 = b'.';
const GOOD_BYE: u8 = b'q';

/// What the second process can say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    /// Stand.
    pub zero: Vec<u8>,
    /// After it stands, one after another.
    pub ends: Vec<Vec<u8>>,
}

impl Words {
    fn arguments(&self) -> impl Iterator<Item = String> {
        let words = [&self.zero].into_iter().chain(&self.ends);
        words.map(|word| word.iter().map(|byte| format!("{byte:02x}")).collect())
    }

    fn from_arguments(arguments: impl Iterator<Item = String>) -> Option<Self> {
        let byte = |digits: &[u8]| u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok();
        let word = |text: String| text.as_bytes().chunks(2).map(byte).collect::<Option<Vec<u8>>>();
        let mut words = arguments.map(word);
        Some(Self { zero: words.next()??, ends: words.collect::<Option<_>>()? })
    }
}

/// The second process, and what it hears us by.
pub struct Second {
    child: Child,
    pipe: Option<ChildStdin>,
    told_at: Option<Instant>,
    /// Whether the session with the robot is open, as far as we know.
    open: bool,
}

impl Second {
    /// Starts a process of `program`, which must call [`stand_by`] when its first argument is [`ARGUMENT`], on `line`.
    ///
    /// # Errors
    /// When it cannot be started.
    pub fn start(program: &OsStr, line: OwnedFd, words: &Words) -> io::Result<Self> {
        use std::os::unix::process::CommandExt;
        let mut process = Process::new(program);
        process.arg(ARGUMENT).args(words.arguments());
        process.process_group(0).stdin(Stdio::piped()).stdout(line).stderr(Stdio::null());
        let mut child = process.spawn()?;
        let pipe = child.stdin.take();
        let mut second = Self { child, pipe, told_at: None, open: true };
        second.say(ALIVE);
        Ok(second)
    }

    fn say(&mut self, word: u8) {
        self.told_at = Some(Instant::now());
        // A second process that is gone guards no more; the first one still stops the robot in every other case.
        let _ = self.pipe.as_mut().map(|pipe| pipe.write_all(&[word]));
    }

    /// Says, when it is time to, that we live.
    pub fn live(&mut self) {
        if self.open && self.told_at.is_none_or(|at| at.elapsed() >= ALIVE_EVERY) {
            self.say(ALIVE);
        }
    }

    /// Whether there is a session to guard.
    pub fn guards(&mut self, open: bool) {
        self.open = open;
        if !open {
            self.say(GOOD_BYE);
        }
    }
}

impl Drop for Second {
    /// Whoever drops it has closed the session, or has lost the line.
    fn drop(&mut self) {
        self.say(GOOD_BYE);
        self.pipe = None;
        // It ends at once, and takes no more memory than its place in a table if it does not.
        let _ = self.child.wait();
    }
}

/// The whole life of the second process: hears the first one on standard input; its standard output is the line.
///
/// # Errors
/// When either cannot be used.
pub fn stand_by() -> io::Result<()> {
    let words = Words::from_arguments(std::env::args().skip(2)).ok_or(io::ErrorKind::InvalidInput)?;
    let pipe = File::from(io::stdin().as_fd().try_clone_to_owned()?);
    let line = File::from(io::stdout().as_fd().try_clone_to_owned()?);
    watch(&pipe, &line, &words)
}

/// Hears the first process on `pipe`, and says what must be said on `line`.
///
/// # Errors
/// When the pipe cannot be read.
pub(super) fn watch(mut pipe: &File, line: &File, words: &Words) -> io::Result<()> {
    let mut open = false;
    let mut wait = SILENT_AFTER;
    loop {
        if !is_readable(pipe, wait)? {
            if open {
                send(line, &words.zero);
            }
            wait = ALIVE_EVERY;
            continue;
        }
        wait = SILENT_AFTER;
        let mut heard = [0; 64];
        match pipe.read(&mut heard)? {
            0 if open => {
                good_bye(line, words);
                return Ok(());
            }
            0 => return Ok(()),
            count => open = heard[count - 1] == ALIVE,
        }
    }
}

fn is_readable(pipe: &File, wait: Duration) -> io::Result<bool> {
    let wait = Timespec { tv_sec: wait.as_secs() as i64, tv_nsec: i64::from(wait.subsec_nanos()) as _ };
    let mut watched = [PollFd::from_borrowed_fd(pipe.as_fd(), PollFlags::IN)];
    match poll(&mut watched, Some(&wait)) {
        Err(rustix::io::Errno::INTR) => Ok(false),
        polled => Ok(polled? > 0),
    }
}

/// Stop, and the end of the session. What the robot answers nobody hears, so the stop is given its time.
fn good_bye(line: &File, words: &Words) {
    let until = Instant::now() + STANDS_WITHIN;
    while Instant::now() < until {
        send(line, &words.zero);
        std::thread::sleep(STOP_AGAIN);
    }
    for word in &words.ends {
        send(line, word);
        std::thread::sleep(STOP_AGAIN);
    }
}

fn send(mut line: &File, word: &[u8]) {
    // A line that fails leaves the robot to its watchdog.
    let _ = line.write_all(word);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_through_arguments_as_they_are() {
        let words = Words { zero: vec![0, 255, 16], ends: vec![vec![1], vec![]] };
        assert_eq!(Words::from_arguments(words.arguments()), Some(words));
        assert_eq!(Words::from_arguments(["zz".to_string()].into_iter()), None);
    }
}
