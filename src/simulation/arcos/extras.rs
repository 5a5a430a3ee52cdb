//! Packets a client asks for beside the SIP: which, and for how long.

use crate::robot::arcos::codec::{Gyro, number};

/// Gyro counts at rest, of ten bits.
const GYRO_AT_REST: f64 = 512.0;
/// Degrees a second a count: ARIA's GyroScaler for this robot.
const GYRO_DEG_S: f64 = 1.626;
const GYRO_CELSIUS: u8 = 25;

/// What a client has asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Extras {
    encoders: Asked,
    inputs: Asked,
    gyro: bool,
    /// rad/s at each step since the last gyro packet.
    turn_rates: Vec<f64>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Asked {
    #[default]
    No,
    Once,
    Always,
}

impl Asked {
    /// By the argument of the request: 0 stops, 1 is once, more is from now on.
    fn by(value: Option<i32>) -> Self {
        match value.unwrap_or(1) {
            0 => Self::No,
            1 => Self::Once,
            _ => Self::Always,
        }
    }

    fn is_due(&mut self) -> bool {
        let due = *self != Self::No;
        if *self == Self::Once {
            *self = Self::No;
        }
        due
    }
}

impl Extras {
    /// Takes a request; false for another command.
    pub fn ask(&mut self, command: u8, value: Option<i32>) -> bool {
        match command {
            number::ENCODER => self.encoders = Asked::by(value),
            number::IOREQUEST => self.inputs = Asked::by(value),
            number::GYRO => {
                self.gyro = value.unwrap_or(0) != 0;
                self.turn_rates.clear();
            }
            _ => return false,
        }
        true
    }

    /// The robot turned at this rate, rad/s, in the last step.
    pub fn turned(&mut self, rate: f64) {
        if self.gyro {
            self.turn_rates.push(rate);
        }
    }

    /// The gyro's samples since the last packet, where they are wanted.
    ///
    /// Which sign the real one has is not published: here more is counter-clockwise.
    pub fn gyro(&mut self) -> Option<Gyro> {
        let counts = |rate: f64| (GYRO_AT_REST + rate.to_degrees() / GYRO_DEG_S).round().clamp(0.0, 1023.0) as u16;
        let samples = std::mem::take(&mut self.turn_rates).into_iter().map(|rate| (counts(rate), GYRO_CELSIUS));
        self.gyro.then(|| Gyro { samples: samples.collect() })
    }

    /// Whether an encoder packet goes with this report.
    pub fn encoders_are_due(&mut self) -> bool {
        self.encoders.is_due()
    }

    /// Whether a packet of inputs and outputs goes with this report.
    pub fn inputs_are_due(&mut self) -> bool {
        self.inputs.is_due()
    }
}
