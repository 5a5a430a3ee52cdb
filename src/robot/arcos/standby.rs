//! A second process that holds the line too, and stops the robot when the first one no longer can.
//!
//! A process that is killed, aborts because no memory is left, or is stopped
//! by a signal that nobody can catch says nothing to its robot, which drives
//! on until its own watchdog: up to 2.4 s and 0.65 m. The second process does
//! nothing but wait on a pipe. It hears that the first one lives ten times a
//! second; when that ceases it sends zero set-points, and when the pipe ends
//! without a good-bye it stops the robot, switches its motors off and closes
//! the session.
//!
//! It shares no memory with the first process, reads nothing from the robot,
//! and is in a process group of its own, so that what a terminal sends to the
//! first one does not reach it.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::AsFd;
use std::process::{Child, ChildStdin, Command as Process, Stdio};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, poll};
use rustix::time::Timespec;

use super::codec::{Command, number};
use super::line::Line;

/// The argument that makes a second process of the program.
pub const ARGUMENT: &str = "--stand-by-for-a-robot";
/// The first process says so often that it lives.
const ALIVE_EVERY: Duration = Duration::from_millis(100);
/// A first process not heard for this long has been stopped.
const SILENT_AFTER: Duration = Duration::from_millis(400);
/// A robot that is told to stand stands within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);
/// A stop is repeated this often.
const STOP_AGAIN: Duration = Duration::from_millis(20);

const ALIVE: u8 = b'.';
const GOOD_BYE: u8 = b'q';

/// A line that a second process watches over.
pub struct GuardedLine {
    line: Box<dyn Line + Send>,
    program: Box<OsStr>,
    second: Option<Second>,
}

/// The second process, and what it hears us by.
struct Second {
    child: Child,
    pipe: Option<ChildStdin>,
    told_at: Option<Instant>,
    /// Whether the session with the robot is open, as far as we know.
    open: bool,
}

impl GuardedLine {
    /// Guards `line` by a process of `program`, which must call [`stand_by`] when its first argument is [`ARGUMENT`].
    ///
    /// # Errors
    /// When the line cannot be shared or the process not be started.
    pub fn new(line: Box<dyn Line + Send>, program: &OsStr) -> io::Result<Self> {
        let mut guarded = Self { line, program: program.into(), second: None };
        guarded.second = Some(guarded.start()?);
        Ok(guarded)
    }

    fn start(&self) -> io::Result<Second> {
        use std::os::unix::process::CommandExt;
        let shared = self.line.share()?;
        let mut process = Process::new(&self.program);
        process.arg(ARGUMENT).process_group(0).stdin(Stdio::piped()).stdout(shared).stderr(Stdio::null());
        let mut child = process.spawn()?;
        let pipe = child.stdin.take();
        let mut second = Second { child, pipe, told_at: None, open: true };
        second.say(ALIVE);
        Ok(second)
    }
}

impl Second {
    fn say(&mut self, word: u8) {
        self.told_at = Some(Instant::now());
        // A second process that is gone guards no more; the first one still stops the robot in every other case.
        let _ = self.pipe.as_mut().map(|pipe| pipe.write_all(&[word]));
    }

    fn live(&mut self) {
        if self.open && self.told_at.is_none_or(|at| at.elapsed() >= ALIVE_EVERY) {
            self.say(ALIVE);
        }
    }

    fn wrote(&mut self, bytes: &[u8]) {
        self.open = bytes != Command::bare(number::CLOSE).to_packet().to_bytes();
        if !self.open {
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

impl Line for GuardedLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        self.second.iter_mut().for_each(Second::live);
        self.line.read(buffer, wait)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let written = self.line.write(bytes);
        self.second.iter_mut().for_each(|second| second.wrote(bytes));
        written
    }

    fn reopen(&mut self) -> io::Result<()> {
        // It holds the old line, which would be in the way of the new one.
        self.second = None;
        self.line.reopen()?;
        self.second = self.start().ok();
        Ok(())
    }

    fn now(&self) -> Duration {
        self.line.now()
    }

    fn sleep(&mut self, time: Duration) {
        let until = Instant::now() + time;
        while Instant::now() < until {
            self.second.iter_mut().for_each(Second::live);
            self.line.sleep(ALIVE_EVERY.min(until.saturating_duration_since(Instant::now())));
        }
    }

    fn baud(&self) -> Option<u32> {
        self.line.baud()
    }

    fn set_baud(&mut self, baud: u32) -> io::Result<()> {
        self.line.set_baud(baud)
    }

    fn baud_is_fixed(&self) -> bool {
        self.line.baud_is_fixed()
    }

    fn name(&self) -> String {
        self.line.name()
    }
}

/// The whole life of the second process: hears the first one on standard input; its standard output is the line.
///
/// # Errors
/// When either cannot be used.
pub fn stand_by() -> io::Result<()> {
    let pipe = File::from(io::stdin().as_fd().try_clone_to_owned()?);
    let line = File::from(io::stdout().as_fd().try_clone_to_owned()?);
    watch(&pipe, &line)
}

fn watch(mut pipe: &File, line: &File) -> io::Result<()> {
    let mut open = false;
    let mut wait = SILENT_AFTER;
    loop {
        if !is_readable(pipe, wait)? {
            if open {
                send(line, &Command::int(number::VEL2, 0));
            }
            wait = ALIVE_EVERY;
            continue;
        }
        wait = SILENT_AFTER;
        let mut words = [0; 64];
        match pipe.read(&mut words)? {
            0 if open => {
                good_bye(line);
                return Ok(());
            }
            0 => return Ok(()),
            count => open = words[count - 1] == ALIVE,
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

/// Stop, motors off, CLOSE. What the robot answers nobody hears, so the stop is given its time.
fn good_bye(line: &File) {
    let until = Instant::now() + STANDS_WITHIN;
    while Instant::now() < until {
        send(line, &Command::int(number::VEL2, 0));
        std::thread::sleep(STOP_AGAIN);
    }
    for command in [Command::int(number::ENABLE, 0), Command::bare(number::CLOSE)] {
        send(line, &command);
        std::thread::sleep(STOP_AGAIN);
    }
}

fn send(mut line: &File, command: &Command) {
    // A line that fails leaves the robot to its watchdog.
    let _ = line.write_all(&command.to_packet().to_bytes());
}

#[cfg(test)]
mod tests {
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixStream;

    use super::*;
    use crate::robot::arcos::codec::Decoder;

    /// What a second process sends that hears `words`, of which the last is followed by the end of the pipe.
    fn sent_after(words: &[u8]) -> Vec<u8> {
        let [(pipe, mut first), (line, mut robot)] = [(); 2].map(|()| UnixStream::pair().expect("a pair"));
        first.write_all(words).expect("said");
        drop(first);
        watch(&File::from(OwnedFd::from(pipe)), &File::from(OwnedFd::from(line))).expect("watches");
        let mut bytes = Vec::new();
        robot.read_to_end(&mut bytes).expect("readable");
        let mut decoder = Decoder::default();
        decoder.push(&bytes, Duration::ZERO);
        std::iter::from_fn(|| decoder.next(Duration::ZERO)).map(|packet| packet.kind).collect()
    }

    #[test]
    fn a_first_process_that_ends_without_a_good_bye_leaves_a_robot_that_is_stopped_switched_off_and_closed() {
        let sent = sent_after(b"...");
        assert!(sent.len() > 3 && sent.iter().filter(|kind| **kind == number::VEL2).count() == sent.len() - 2);
        assert_eq!(sent[sent.len() - 2..], [number::ENABLE, number::CLOSE]);
    }

    #[test]
    fn after_a_good_bye_nothing_is_sent() {
        assert!(sent_after(b"..q").is_empty());
        assert!(sent_after(b"").is_empty());
    }
}
