//! A line whose bytes come late, each way, by so much and up to so much more.

use std::collections::VecDeque;
use std::io;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use spatial_fetch::robot::arcos::line::Line;

/// Bytes on their way, with when they arrive.
type OnTheirWay = VecDeque<(Duration, Vec<u8>)>;

pub struct LateLine<L: Line> {
    inner: L,
    rng: ChaCha8Rng,
    delay: Duration,
    jitter_ms: u64,
    to_client: OnTheirWay,
    to_robot: OnTheirWay,
}

impl<L: Line> LateLine<L> {
    pub fn new(inner: L, seed: u64, delay_ms: u64, jitter_ms: u64) -> Self {
        let rng = ChaCha8Rng::seed_from_u64(seed);
        let delay = Duration::from_millis(delay_ms);
        Self { inner, rng, delay, jitter_ms, to_client: VecDeque::new(), to_robot: VecDeque::new() }
    }

    /// When bytes sent now arrive: none overtakes another.
    fn due(&mut self, last: Option<Duration>) -> Duration {
        let jitter = if self.jitter_ms == 0 { 0 } else { self.rng.next_u64() % self.jitter_ms };
        (self.inner.now() + self.delay + Duration::from_millis(jitter)).max(last.unwrap_or_default())
    }

    fn deliver(&mut self) -> io::Result<()> {
        while let Some(bytes) = arrived(&mut self.to_robot, self.inner.now()) {
            self.inner.write(&bytes)?;
        }
        Ok(())
    }
}

/// The first bytes, when they have arrived.
fn arrived(on_their_way: &mut OnTheirWay, now: Duration) -> Option<Vec<u8>> {
    on_their_way.front().filter(|(due, _)| *due <= now)?;
    on_their_way.pop_front().map(|(_, bytes)| bytes)
}

impl<L: Line> Line for LateLine<L> {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        let until = self.now() + wait;
        loop {
            self.deliver()?;
            let mut fresh = [0; 512];
            let step = until.saturating_sub(self.now()).min(Duration::from_millis(20));
            let count = self.inner.read(&mut fresh, step)?;
            if count > 0 {
                let due = self.due(self.to_client.back().map(|(due, _)| *due));
                self.to_client.push_back((due, fresh[..count].to_vec()));
            }
            if let Some(bytes) = arrived(&mut self.to_client, self.inner.now()) {
                let count = bytes.len().min(buffer.len());
                buffer[..count].copy_from_slice(&bytes[..count]);
                if count < bytes.len() {
                    self.to_client.push_front((Duration::ZERO, bytes[count..].to_vec()));
                }
                return Ok(count);
            }
            if self.now() >= until {
                return Ok(0);
            }
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let due = self.due(self.to_robot.back().map(|(due, _)| *due));
        self.to_robot.push_back((due, bytes.to_vec()));
        self.deliver()
    }

    fn reopen(&mut self) -> io::Result<()> {
        self.inner.reopen()
    }

    fn now(&self) -> Duration {
        self.inner.now()
    }

    fn sleep(&mut self, time: Duration) {
        let until = self.now() + time;
        while self.now() < until {
            self.inner.sleep(Duration::from_millis(20).min(until - self.now()));
            // A line that fails says so when it is read.
            let _ = self.deliver();
        }
    }

    fn name(&self) -> String {
        self.inner.name()
    }
}
