//! Finding the robot: synchronisation, stale sessions, and its baud rate.

use std::io;
use std::time::Duration;

use crate::robot::arcos::codec::{Command, Decoder, Packet, SIP_MOVING, SIP_STOPPED, number};
use crate::robot::arcos::line::{BAUD_RATES, Line};

/// An answer takes no longer than this while the robot's rate is looked for.
const ANSWER: Duration = Duration::from_millis(500);
/// And this where only the way is long: a radio bridge, a busy network.
const LATE_ANSWER: Duration = Duration::from_millis(1500);
/// A session that someone left open is heard within this: the robot reports every tenth of a second.
const OVERHEARD: Duration = Duration::from_millis(250);
/// Tries at one rate before the next.
const TRIES_A_RATE: u32 = 3;
/// Tries in all on a line without rates.
const TRIES: u32 = 8;
/// Zero set-points to a session that someone left open: enough that one comes through a bad line.
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
    #[error("a robot answers (packet type {0}) but does not synchronise; switch it off and on")]
    OutOfStep(u8),
}

/// What an attempt came to.
enum Step {
    Done(Identity),
    /// A packet of this type came: try again at this rate.
    Heard(u8),
    Silent,
}

/// One attempt after another to reach a robot.
pub struct Handshake<'a, L: Line> {
    line: &'a mut L,
    decoder: &'a mut Decoder,
    /// From a number to its answer, at least.
    round_trip: Duration,
}

impl<'a, L: Line> Handshake<'a, L> {
    /// On a line, with the decoder that will go on reading it.
    pub fn new(line: &'a mut L, decoder: &'a mut Decoder) -> Self {
        Self { line, decoder, round_trip: Duration::MAX }
    }

    /// From a number to its answer, the quickest of the three; zero before any.
    pub fn round_trip(&self) -> Duration {
        if self.round_trip == Duration::MAX { Duration::ZERO } else { self.round_trip }
    }

    /// Reaches the robot, at whatever rate it talks.
    ///
    /// # Errors
    /// When no robot answers at any rate, or not as the protocol says.
    pub fn run(&mut self) -> Result<Identity, HandshakeError> {
        let before = self.decoder.counters();
        let mut heard = None;
        for rate in self.rates() {
            if let Some(baud) = rate.filter(|baud| self.line.baud() != Some(*baud)) {
                self.line.set_baud(baud)?;
                self.decoder.clear();
            }
            let (mut silent, open) = (0, self.overhear()?);
            if let Some(kind) = open {
                self.end_session()?;
                heard = Some(kind);
            }
            for _ in 0..TRIES {
                match self.attempt()? {
                    Step::Done(identity) => return Ok(identity),
                    Step::Heard(kind) => heard = Some(kind),
                    Step::Silent => silent += 1,
                }
                if silent >= TRIES_A_RATE {
                    break;
                }
            }
        }
        let skipped = self.decoder.counters().since(&before).skipped;
        Err(heard.map_or_else(|| self.silence(skipped), HandshakeError::OutOfStep))
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

    /// Listens before a word is said: the type of a report from a session that someone left open.
    ///
    /// To such a session the first packet would be the sign to take up its old velocity again.
    fn overhear(&mut self) -> io::Result<Option<u8>> {
        let until = self.line.now() + OVERHEARD;
        while self.line.now() < until {
            self.read(until.saturating_sub(self.line.now()))?;
            while let Some(packet) = self.decoder.next(self.line.now()) {
                if matches!(packet.kind, SIP_STOPPED | SIP_MOVING) {
                    return Ok(Some(packet.kind));
                }
            }
        }
        Ok(None)
    }

    /// Ends a session that someone left open: zero set-points go first. A robot that synchronises gets none of them, as
    /// it may take them for the end of the handshake (AMRISim).
    fn end_session(&mut self) -> io::Result<()> {
        for _ in 0..ZEROS {
            self.write(&Command::int(number::VEL2, 0))?;
        }
        self.write(&Command::bare(number::CLOSE))?;
        self.drain()
    }

    /// The three numbers in a row.
    fn attempt(&mut self) -> Result<Step, HandshakeError> {
        let mut answer = None;
        for sync in 0..3 {
            let asked = self.line.now();
            self.write(&Command::bare(sync))?;
            match self.answer(sync)? {
                (Some(packet), _) if packet.kind == sync => {
                    self.round_trip = self.round_trip.min(self.line.now().saturating_sub(asked));
                    answer = Some(packet);
                }
                (Some(packet), _) if matches!(packet.kind, SIP_STOPPED | SIP_MOVING) => {
                    self.end_session()?;
                    return Ok(Step::Heard(packet.kind));
                }
                (Some(packet), _) => {
                    self.drain()?;
                    return Ok(Step::Heard(packet.kind));
                }
                (None, Some(other)) => return Ok(Step::Heard(other)),
                (None, None) if sync > 0 => return Ok(Step::Heard(sync - 1)),
                (None, None) => return Ok(Step::Silent),
            }
        }
        Ok(answer.map_or(Step::Silent, |packet| Step::Done(identity(&packet))))
    }

    fn write(&mut self, command: &Command) -> io::Result<()> {
        self.line.write(&command.to_packet().to_bytes())
    }

    /// The answer to a number: the same, a report of an open session, or a complaint. Late echoes are passed over; the
    /// type of the last other packet.
    fn answer(&mut self, sync: u8) -> io::Result<(Option<Packet>, Option<u8>)> {
        let is_sought = self.line.baud().is_some() && !self.line.baud_is_fixed();
        let until = self.line.now() + if is_sought { ANSWER } else { LATE_ANSWER };
        let mut other = None;
        loop {
            while let Some(packet) = self.decoder.next(self.line.now()) {
                if packet.kind == sync || matches!(packet.kind, SIP_STOPPED | SIP_MOVING | WRONG_COUNT) {
                    return Ok((Some(packet), other));
                }
                other = Some(packet.kind);
            }
            let left = until.saturating_sub(self.line.now());
            if left.is_zero() {
                return Ok((None, other));
            }
            self.read(left)?;
        }
    }

    /// Nothing for so long, and no more will come: longer than a robot's cycle when it has to hear of a good-bye first.
    fn quiet(&self) -> Duration {
        Duration::from_millis(60) + self.round_trip()
    }

    /// Reads until nothing more comes.
    fn drain(&mut self) -> io::Result<()> {
        let until = self.line.now() + ANSWER;
        while self.line.now() < until && self.read(self.quiet())? > 0 {}
        while self.decoder.next(self.line.now()).is_some() {}
        Ok(())
    }

    fn read(&mut self, wait: Duration) -> io::Result<usize> {
        let mut buffer = [0; 512];
        let count = self.line.read(&mut buffer, wait.min(Duration::from_millis(100)))?;
        self.decoder.push(&buffer[..count], self.line.now());
        Ok(count)
    }
}

fn identity(packet: &Packet) -> Identity {
    // A name is for people: what would steer their terminal is left out.
    let readable = |text: &[u8]| String::from_utf8_lossy(text).chars().filter(|c| !c.is_control()).collect();
    let mut texts = packet.data.split(|byte| *byte == 0).map(readable);
    let mut next = || texts.next().unwrap_or_default();
    Identity { name: next(), class: next(), subclass: next() }
}
