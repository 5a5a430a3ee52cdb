//! A line that fails, from a seed, in every way lines do.

use std::io;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use spatial_fetch::robot::arcos::line::Line;

/// What a line can do to bytes. It can also be late, stall, and die.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    Drop,
    Duplicate,
    Corrupt,
    Garbage,
    Truncate,
}

/// How often, of 10,000: bytes for the first four, exchanges for the others.
#[derive(Clone, Copy, Debug)]
pub struct Rates {
    pub byte: u64,
    pub exchange: u64,
    pub death: u64,
}

/// A line between a client and its robot.
pub struct FaultyLine<L: Line> {
    inner: L,
    rng: ChaCha8Rng,
    rates: Rates,
    /// No faults while connecting for the first time.
    pub armed: bool,
    waiting: Vec<u8>,
    held_until: Duration,
    dead_until: Duration,
    /// What was done to bytes for the client, and for the robot.
    pub to_client: Vec<Fault>,
    pub to_robot: Vec<Fault>,
    pub stalls: u32,
    pub deaths: u32,
}

impl<L: Line> FaultyLine<L> {
    pub fn new(inner: L, seed: u64, rates: Rates) -> Self {
        let rng = ChaCha8Rng::seed_from_u64(seed);
        let (waiting, zero) = (Vec::new(), Duration::ZERO);
        Self {
            inner,
            rng,
            rates,
            armed: false,
            waiting,
            held_until: zero,
            dead_until: zero,
            to_client: Vec::new(),
            to_robot: Vec::new(),
            stalls: 0,
            deaths: 0,
        }
    }

    fn below(&mut self, n: u64) -> u64 {
        self.rng.next_u64() % n
    }

    fn happens(&mut self, of_ten_thousand: u64) -> bool {
        self.armed && self.below(10_000) < of_ten_thousand
    }

    /// The bytes as they come out at the other end.
    fn spoilt(&mut self, bytes: &[u8]) -> (Vec<u8>, Vec<Fault>) {
        let (mut out, mut faults) = (Vec::new(), Vec::new());
        for &byte in bytes {
            if !self.happens(self.rates.byte) {
                out.push(byte);
                continue;
            }
            match self.below(4) {
                0 => faults.push(Fault::Drop),
                1 => {
                    out.extend([byte, byte]);
                    faults.push(Fault::Duplicate);
                }
                2 => {
                    out.push(byte ^ (1 << self.below(8)));
                    faults.push(Fault::Corrupt);
                }
                _ => {
                    let count = 1 + self.below(40);
                    for _ in 0..count {
                        let wild = if self.below(4) == 0 {
                            [0xFA, 0xFB][self.below(2) as usize]
                        } else {
                            self.below(256) as u8
                        };
                        out.push(wild);
                    }
                    out.push(byte);
                    faults.push(Fault::Garbage);
                }
            }
        }
        if out.len() > 4 && self.happens(self.rates.exchange) {
            let left = 1 + self.below(out.len() as u64 - 1) as usize;
            out.truncate(left);
            faults.push(Fault::Truncate);
        }
        (out, faults)
    }

    /// Begins a stall or the death of the line, now and then.
    fn age(&mut self) -> io::Result<()> {
        let now = self.inner.now();
        if now < self.dead_until {
            return Err(io::Error::new(io::ErrorKind::BrokenPipe, "the line is dead"));
        }
        if self.happens(self.rates.death) {
            self.dead_until = now + Duration::from_millis(200 + self.below(4000));
            self.waiting.clear();
            self.deaths += 1;
            return Err(io::Error::new(io::ErrorKind::BrokenPipe, "the line has died"));
        }
        if self.happens(self.rates.exchange / 4) {
            self.held_until = now + Duration::from_millis(300 + self.below(1200));
            self.stalls += 1;
        } else if self.happens(self.rates.exchange) {
            self.held_until = self.held_until.max(now + Duration::from_millis(10 + self.below(70)));
        }
        Ok(())
    }
}

impl<L: Line> Line for FaultyLine<L> {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        self.age()?;
        let mut fresh = [0; 512];
        let count = self.inner.read(&mut fresh, wait)?;
        let (bytes, faults) = self.spoilt(&fresh[..count]);
        self.to_client.extend(faults);
        self.waiting.extend(bytes);
        if self.inner.now() < self.held_until {
            return Ok(0);
        }
        let count = self.waiting.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.waiting[..count]);
        self.waiting.drain(..count);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.inner.now() < self.dead_until {
            return Err(io::Error::new(io::ErrorKind::BrokenPipe, "the line is dead"));
        }
        // A line that stalls swallows what it is given.
        if self.inner.now() < self.held_until {
            return Ok(());
        }
        let (bytes, faults) = self.spoilt(bytes);
        self.to_robot.extend(faults);
        self.inner.write(&bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        if self.inner.now() < self.dead_until {
            return Err(io::Error::new(io::ErrorKind::NotConnected, "the line is still dead"));
        }
        self.inner.reopen()
    }

    fn now(&self) -> Duration {
        self.inner.now()
    }

    fn sleep(&mut self, time: Duration) {
        self.inner.sleep(time);
    }

    fn baud(&self) -> Option<u32> {
        self.inner.baud()
    }

    fn set_baud(&mut self, baud: u32) -> io::Result<()> {
        self.inner.set_baud(baud)
    }

    fn baud_is_fixed(&self) -> bool {
        self.inner.baud_is_fixed()
    }

    fn name(&self) -> String {
        self.inner.name()
    }
}
