//! Commands: a number, and an argument with its type.

use std::fmt;

use super::packet::{LONGEST_SENT, Packet};

/// Type byte of a non-negative integer.
const POSITIVE: u8 = 0x3B;
/// Type byte of a negative integer; its absolute value follows.
const NEGATIVE: u8 = 0x1B;
/// Type byte of a string.
const STRING: u8 = 0x2B;
/// Header, count, number, type, length and checksum around a string.
const STRING_FRAME: usize = 8;

/// Command numbers of the Operations Manual. 253 (reset) and 255 (maintenance) are left out: never sent.
#[allow(missing_docs)]
pub mod number {
    pub const PULSE: u8 = 0;
    pub const OPEN: u8 = 1;
    pub const CLOSE: u8 = 2;
    pub const POLLING: u8 = 3;
    pub const ENABLE: u8 = 4;
    pub const SETA: u8 = 5;
    pub const SETV: u8 = 6;
    pub const SETO: u8 = 7;
    pub const MOVE: u8 = 8;
    pub const ROTATE: u8 = 9;
    pub const SETRV: u8 = 10;
    pub const VEL: u8 = 11;
    pub const HEAD: u8 = 12;
    pub const DHEAD: u8 = 13;
    pub const CONFIG: u8 = 18;
    pub const ENCODER: u8 = 19;
    pub const RVEL: u8 = 21;
    pub const DCHEAD: u8 = 22;
    pub const SETRA: u8 = 23;
    pub const SONAR: u8 = 28;
    pub const STOP: u8 = 29;
    pub const DIGOUT: u8 = 30;
    pub const VEL2: u8 = 32;
    pub const IOREQUEST: u8 = 40;
    pub const BUMPSTALL: u8 = 44;
    pub const HOSTBAUD: u8 = 50;
    pub const E_STOP: u8 = 55;
    pub const QSTOP: u8 = 57;
    pub const GYRO: u8 = 58;
    pub const BATTERYINFO: u8 = 62;
    pub const REVCOUNT: u8 = 88;
    pub const DRIFTFACTOR: u8 = 89;
    pub const TICKSMM: u8 = 93;
    pub const SIM_STAT: u8 = 237;
    pub const BATTEST: u8 = 250;
}

/// What a command says beside its number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Nothing.
    None,
    /// A whole number within ±65535.
    Int(i32),
    /// Bytes.
    Text(Vec<u8>),
}

/// A command to the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Command {
    /// See [`number`].
    pub number: u8,
    /// Its argument.
    pub argument: Argument,
}

impl Command {
    /// A command without argument.
    pub fn bare(number: u8) -> Self {
        Self { number, argument: Argument::None }
    }

    /// A command with a number, held to what two bytes carry.
    pub fn int(number: u8, value: i32) -> Self {
        Self { number, argument: Argument::Int(value.clamp(-0xFFFF, 0xFFFF)) }
    }

    /// A command with a string, cut to what a packet of 200 bytes carries.
    pub fn text(number: u8, text: &[u8]) -> Self {
        let most = text.len().min(LONGEST_SENT - STRING_FRAME);
        Self { number, argument: Argument::Text(text[..most].to_vec()) }
    }

    /// The command as a packet.
    pub fn to_packet(&self) -> Packet {
        let data = match &self.argument {
            Argument::None => Vec::new(),
            Argument::Int(value) => {
                let kind = if *value < 0 { NEGATIVE } else { POSITIVE };
                let [low, high] = (value.unsigned_abs() as u16).to_le_bytes();
                vec![kind, low, high]
            }
            Argument::Text(text) => [&[STRING, text.len() as u8], text.as_slice()].concat(),
        };
        Packet::new(self.number, data)
    }

    /// Reads a command as the robot gets it.
    ///
    /// A string comes with its length before it (ARIA) or a NUL behind it
    /// (Soar). An argument of an unknown type counts as none.
    pub fn from_packet(packet: &Packet) -> Self {
        let argument = match packet.data.as_slice() {
            [POSITIVE, low, high, ..] => Argument::Int(i32::from(u16::from_le_bytes([*low, *high]))),
            [NEGATIVE, low, high, ..] => Argument::Int(-i32::from(u16::from_le_bytes([*low, *high]))),
            [STRING, length, text @ ..] if usize::from(*length) == text.len() => Argument::Text(text.to_vec()),
            [STRING, text @ ..] => Argument::Text(text.split(|byte| *byte == 0).next().unwrap_or_default().to_vec()),
            _ => Argument::None,
        };
        Self { number: packet.kind, argument }
    }

    /// The argument as a number, where it is one.
    pub fn value(&self) -> Option<i32> {
        match self.argument {
            Argument::Int(value) => Some(value),
            _ => None,
        }
    }
}

/// The name of a command in the manual.
fn name_of(command: u8) -> Option<&'static str> {
    use number as n;
    const NAMES: [(u8, &str); 34] = [
        (n::PULSE, "PULSE"),
        (n::OPEN, "OPEN"),
        (n::CLOSE, "CLOSE"),
        (n::POLLING, "POLLING"),
        (n::ENABLE, "ENABLE"),
        (n::SETA, "SETA"),
        (n::SETV, "SETV"),
        (n::SETO, "SETO"),
        (n::MOVE, "MOVE"),
        (n::ROTATE, "ROTATE"),
        (n::SETRV, "SETRV"),
        (n::VEL, "VEL"),
        (n::HEAD, "HEAD"),
        (n::DHEAD, "DHEAD"),
        (n::CONFIG, "CONFIG"),
        (n::ENCODER, "ENCODER"),
        (n::RVEL, "RVEL"),
        (n::DCHEAD, "DCHEAD"),
        (n::SETRA, "SETRA"),
        (n::SONAR, "SONAR"),
        (n::STOP, "STOP"),
        (n::DIGOUT, "DIGOUT"),
        (n::VEL2, "VEL2"),
        (n::IOREQUEST, "IOREQUEST"),
        (n::BUMPSTALL, "BUMPSTALL"),
        (n::HOSTBAUD, "HOSTBAUD"),
        (n::E_STOP, "E_STOP"),
        (n::QSTOP, "QSTOP"),
        (n::GYRO, "GYRO"),
        (n::BATTERYINFO, "BATTERYINFO"),
        (n::REVCOUNT, "REVCOUNT"),
        (n::DRIFTFACTOR, "DRIFTFACTOR"),
        (n::TICKSMM, "TICKSMM"),
        (n::BATTEST, "BATTEST"),
    ];
    NAMES.iter().find(|(number, _)| *number == command).map(|(_, name)| *name)
}

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match name_of(self.number) {
            Some(name) => write!(f, "{name}")?,
            None => write!(f, "command {}", self.number)?,
        }
        match &self.argument {
            Argument::None => Ok(()),
            Argument::Int(value) => write!(f, " {value}"),
            Argument::Text(text) => write!(f, " {:?}", String::from_utf8_lossy(text)),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_published_byte_vectors_are_what_is_written() {
        let vectors: [(Command, &[u8]); 11] = [
            (Command::bare(0), &[0xFA, 0xFB, 3, 0, 0, 0]),
            (Command::bare(1), &[0xFA, 0xFB, 3, 1, 0, 1]),
            (Command::bare(number::E_STOP), &[0xFA, 0xFB, 3, 0x37, 0, 0x37]),
            (Command::int(number::VEL, 300), &[0xFA, 0xFB, 6, 0x0B, 0x3B, 0x2C, 1, 0x37, 0x3C]),
            (Command::int(number::VEL, 0), &[0xFA, 0xFB, 6, 0x0B, 0x3B, 0, 0, 0x0B, 0x3B]),
            (Command::int(number::ENABLE, 1), &[0xFA, 0xFB, 6, 4, 0x3B, 1, 0, 5, 0x3B]),
            (Command::int(number::ENABLE, 0), &[0xFA, 0xFB, 6, 4, 0x3B, 0, 0, 4, 0x3B]),
            (Command::int(number::RVEL, 30), &[0xFA, 0xFB, 6, 0x15, 0x3B, 0x1E, 0, 0x33, 0x3B]),
            (Command::int(number::MOVE, 500), &[0xFA, 0xFB, 6, 8, 0x3B, 0xF4, 1, 0xFC, 0x3C]),
            (Command::int(number::DHEAD, 90), &[0xFA, 0xFB, 6, 0x0D, 0x3B, 0x5A, 0, 0x67, 0x3B]),
            (Command::int(number::VEL, 400), &[0xFA, 0xFB, 6, 0x0B, 0x3B, 0x90, 1, 0x9B, 0x3C]),
        ];
        for (command, bytes) in vectors {
            assert_eq!(command.to_packet().to_bytes(), bytes, "{command}");
        }
    }

    #[test]
    fn a_negative_number_goes_as_its_absolute_value() {
        assert_eq!(Command::int(number::VEL, -300).to_packet().data, [NEGATIVE, 0x2C, 1]);
    }

    #[test]
    fn a_string_with_a_nul_instead_of_a_length_is_understood() {
        let packet = Packet::new(number::POLLING, b"\x2Bab\0".to_vec());
        assert_eq!(Command::from_packet(&packet).argument, Argument::Text(b"ab".to_vec()));
    }

    #[test]
    fn a_string_too_long_for_a_packet_is_cut() {
        let bytes = Command::text(number::POLLING, &[7; 300]).to_packet().to_bytes();
        assert_eq!(bytes.len(), LONGEST_SENT);
    }

    proptest! {
        #[test]
        fn what_is_commanded_is_understood(number: u8, value in -0xFFFF..=0xFFFF, text in prop::collection::vec(any::<u8>(), 0..192)) {
            for command in [Command::int(number, value), Command::text(number, &text), Command::bare(number)] {
                prop_assert_eq!(Command::from_packet(&command.to_packet()), command);
            }
        }
    }
}
