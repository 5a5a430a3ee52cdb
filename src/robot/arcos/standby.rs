//! A line to a Pioneer that a second process watches over: it stops the robot, switches its motors off and closes the
//! session when this process can no longer.

use std::ffi::OsStr;
use std::io;
use std::os::fd::OwnedFd;
use std::time::{Duration, Instant};

use super::codec::{Command, number};
use super::line::Line;
use crate::robot::standby::{ALIVE_EVERY, Second, Words};

/// A line that a second process watches over.
pub struct GuardedLine {
    line: Box<dyn Line + Send>,
    program: Box<OsStr>,
    second: Option<Second>,
}

/// Zero set-points; motors off and CLOSE.
fn words() -> Words {
    let bytes = |command: Command| command.to_packet().to_bytes();
    let ends = [Command::int(number::ENABLE, 0), Command::bare(number::CLOSE)];
    Words { zero: bytes(Command::int(number::VEL2, 0)), ends: ends.map(bytes).to_vec() }
}

impl GuardedLine {
    /// Guards `line` by a process of `program`, as [`Second::start`] wants it.
    ///
    /// # Errors
    /// When the line cannot be shared or the process not be started.
    pub fn new(line: Box<dyn Line + Send>, program: &OsStr) -> io::Result<Self> {
        let mut guarded = Self { line, program: program.into(), second: None };
        guarded.second = Some(guarded.start()?);
        Ok(guarded)
    }

    fn start(&self) -> io::Result<Second> {
        let shared: OwnedFd = self.line.share()?;
        Second::start(&self.program, shared, &words())
    }
}

impl Line for GuardedLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        self.second.iter_mut().for_each(Second::live);
        self.line.read(buffer, wait)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let written = self.line.write(bytes);
        let open = bytes != Command::bare(number::CLOSE).to_packet().to_bytes();
        self.second.iter_mut().for_each(|second| second.guards(open));
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

#[cfg(test)]
mod tests {
    use std::fs::File;
    use std::io::{Read, Write};
    use std::os::unix::net::UnixStream;

    use super::*;
    use crate::robot::arcos::codec::Decoder;
    use crate::robot::standby::watch;

    /// What a second process sends that hears `words`, of which the last is followed by the end of the pipe.
    fn sent_after(words: &[u8]) -> Vec<u8> {
        let [(pipe, mut first), (line, mut robot)] = [(); 2].map(|()| UnixStream::pair().expect("a pair"));
        first.write_all(words).expect("said");
        drop(first);
        watch(&File::from(OwnedFd::from(pipe)), &File::from(OwnedFd::from(line)), &super::words()).expect("watches");
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
