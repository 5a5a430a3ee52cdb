//! Finding the robot: synchronisation, stale sessions, and its baud rate.

use std::io;
use std::time::Duration;

use crate::robot::arcos::codec::{Command, Decoder, Packet, SIP_MOVING, SIP_STOPPED, number};
use crate::robot::arcos::line::{BAUD_RATES, Line};

/// An answer takes no longer than this.
const ANSWER: Duration = Duration::from_millis(500);
/// Tries at one rate before the next.
const TRIES_A_RATE: u32 = 3;
/// Tries in all on a line without rates.
const TRIES: u32 = 8;
/// Zero set-points before each try: enough that one comes through a bad line.
const ZEROS: u32 = 4;
/// "The numbers came out of order."
const WRONG_COUNT: u8 = 255;

/// Who answered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Identity {
    /// The name given to it.
    pub name: String,
    /// "Pioneer".
    pub class: String,
    /// "p3dx-sh".
    pub subclass: String,
}

/// Why nobody could be reached.
#[derive(Debug, thiserror::Error)]
pub enum HandshakeError {
    /// Reading or writing failed.
    #[error("{0}")]
    Line(#[from] io::Error),
    /// Not a byte came.
    #[error("no answer{0}; is the robot on, and the cable in its serial port?")]
    NoAnswer(String),
    /// Bytes came that are no packets.
    #[error("{bytes} bytes came that are no packets{at}; {mend}")]
    Unreadable {
        /// How many.
        bytes: u64,
        /// At which rate.
        at: String,
        /// What to do.
        mend: &'static str,
    },
    /// Packets came, but never the three in a row.
    #[error("a robot answers but does not synchronise; switch it off and on")]
    OutOfStep,
}

/// What an attempt came to.
enum Step {
    Done(Identity),
    /// Something understandable came: try again at this rate.
    Heard,
    Silent,
}

/// One attempt after another to reach a robot.
pub struct Handshake<'a, L: Line> {
    line: &'a mut L,
    decoder: &'a mut Decoder,
}

impl<'a, L: Line> Handshake<'a, L> {
    /// On a line, with the decoder that will go on reading it.
    pub fn new(line: &'a mut L, decoder: &'a mut Decoder) -> Self {
        Self { line, decoder }
    }

    /// Reaches the robot, at whatever rate it talks.
    ///
    /// # Errors
    /// When no robot answers at any rate, or not as the protocol says.
    pub fn run(&mut self) -> Result<Identity, HandshakeError> {
        let before = self.decoder.counters();
        let mut heard = false;
        for rate in self.rates() {
            if let Some(baud) = rate.filter(|baud| self.line.baud() != Some(*baud)) {
                self.line.set_baud(baud)?;
                self.decoder.clear();
            }
            let mut silent = 0;
            for _ in 0..TRIES {
                match self.attempt()? {
                    Step::Done(identity) => return Ok(identity),
                    Step::Heard => heard = true,
                    Step::Silent => silent += 1,
                }
                if silent >= TRIES_A_RATE {
                    break;
                }
            }
        }
        Err(if heard {
            HandshakeError::OutOfStep
        } else {
            self.silence(self.decoder.counters().since(&before).skipped)
        })
    }

    /// The rates to try: the user's own, or the present one and then all others.
    fn rates(&self) -> Vec<Option<u32>> {
        match self.line.baud().filter(|_| !self.line.baud_is_fixed()) {
            None => vec![None],
            Some(now) => {
                [now].into_iter().chain(BAUD_RATES.into_iter().filter(|baud| *baud != now)).map(Some).collect()
            }
        }
    }

    fn silence(&self, bytes: u64) -> HandshakeError {
        let fixed = self.line.baud().filter(|_| self.line.baud_is_fixed());
        let at = match (fixed, self.line.baud()) {
            (Some(baud), _) => format!(" at {baud} baud"),
            (None, Some(_)) => " at any of the robot's rates".to_string(),
            (None, None) => String::new(),
        };
        if bytes == 0 {
            return HandshakeError::NoAnswer(at);
        }
        let mend =
            if fixed.is_some() { "the rate may be wrong: leave it out to have all tried" } else { "is it a robot?" };
        HandshakeError::Unreadable { bytes, at, mend }
    }

    /// The three numbers in a row.
    ///
    /// Zero set-points go first: to a session that someone left open, the first
    /// packet would be the sign to take up its old velocity again.
    fn attempt(&mut self) -> Result<Step, HandshakeError> {
        for _ in 0..ZEROS {
            self.write(&Command::int(number::VEL2, 0))?;
        }
        let mut answer = None;
        for sync in 0..3 {
            self.write(&Command::bare(sync))?;
            match self.answer(sync)? {
                Some(packet) if packet.kind == sync => answer = Some(packet),
                Some(packet) if matches!(packet.kind, SIP_STOPPED | SIP_MOVING) => {
                    // A session that was left open.
                    self.write(&Command::bare(number::CLOSE))?;
                    self.drain()?;
                    return Ok(Step::Heard);
                }
                Some(_) => {
                    self.drain()?;
                    return Ok(Step::Heard);
                }
                None => return Ok(if sync == 0 { Step::Silent } else { Step::Heard }),
            }
        }
        Ok(answer.map_or(Step::Silent, |packet| Step::Done(identity(&packet))))
    }

    fn write(&mut self, command: &Command) -> io::Result<()> {
        self.line.write(&command.to_packet().to_bytes())
    }

    /// The answer to a number: the same, a report of an open session, or a complaint. Late echoes are passed over.
    fn answer(&mut self, sync: u8) -> io::Result<Option<Packet>> {
        let until = self.line.now() + ANSWER;
        loop {
            while let Some(packet) = self.decoder.next(self.line.now()) {
                if packet.kind == sync || matches!(packet.kind, SIP_STOPPED | SIP_MOVING | WRONG_COUNT) {
                    return Ok(Some(packet));
                }
            }
            let left = until.saturating_sub(self.line.now());
            if left.is_zero() {
                return Ok(None);
            }
            self.read(left)?;
        }
    }

    /// Reads until nothing more comes.
    fn drain(&mut self) -> io::Result<()> {
        let until = self.line.now() + ANSWER;
        while self.line.now() < until && self.read(Duration::from_millis(60))? > 0 {}
        while self.decoder.next(self.line.now()).is_some() {}
        Ok(())
    }

    fn read(&mut self, wait: Duration) -> io::Result<usize> {
        let mut buffer = [0; 512];
        let count = self.line.read(&mut buffer, wait.min(Duration::from_millis(50)))?;
        self.decoder.push(&buffer[..count], self.line.now());
        Ok(count)
    }
}

fn identity(packet: &Packet) -> Identity {
    let mut texts = packet.data.split(|byte| *byte == 0).map(|text| String::from_utf8_lossy(text).into_owned());
    let mut next = || texts.next().unwrap_or_default();
    Identity { name: next(), class: next(), subclass: next() }
}
