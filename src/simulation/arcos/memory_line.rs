//! A served robot at the other end of nothing: in this process, on a virtual clock.

use std::cell::RefCell;
use std::io;
use std::rc::Rc;
use std::time::Duration;

use super::Server;
use crate::robot::arcos::line::Line;

/// The clock goes in steps of the simulated base.
const STEP: Duration = Duration::from_millis(20);

/// A line to a server in this process; whoever waits on it lets the simulation run.
pub struct MemoryLine {
    server: Rc<RefCell<Server>>,
    waiting: Vec<u8>,
    now: Duration,
}

impl MemoryLine {
    /// A line to `server`.
    pub fn new(server: Rc<RefCell<Server>>) -> Self {
        Self { server, waiting: Vec::new(), now: Duration::ZERO }
    }

    fn step(&mut self) {
        self.now += STEP;
        let mut server = self.server.borrow_mut();
        server.advance_to(self.now);
        self.waiting.extend(server.take_output());
    }
}

impl Line for MemoryLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        self.waiting.extend(self.server.borrow_mut().take_output());
        let until = self.now + wait;
        while self.waiting.is_empty() && self.now < until {
            self.step();
        }
        let count = self.waiting.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.waiting[..count]);
        self.waiting.drain(..count);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.server.borrow_mut().receive(bytes);
        Ok(())
    }

    fn reopen(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn now(&self) -> Duration {
        self.now
    }

    fn sleep(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.step();
        }
    }

    fn name(&self) -> String {
        "memory".to_string()
    }
}
