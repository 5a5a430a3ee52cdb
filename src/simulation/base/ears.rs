//! The sixteen sonars, fired one after another, with what they mishear.

use super::Obstacles;
use crate::geometry::{Pose, vec2};
use crate::robot::{SonarReading, p3dx};
use crate::simulation::Dice;
use crate::simulation::Noise;

/// Sonars of one array; the front one and the rear one fire by turns side by side.
const ARRAY: usize = 8;
/// Nearer than this a ping is not told from its own ringing, metres.
const RINGING_M: f64 = 0.1;

/// The sonars with their latest readings.
#[derive(Clone, Debug)]
pub(super) struct Ears {
    noise: Noise,
    next: usize,
    readings: Vec<SonarReading>,
}

impl Ears {
    /// Sonars that have all fired once.
    pub(super) fn new(noise: Noise, obstacles: &Obstacles, pose: Pose, dice: &mut Dice) -> Self {
        let silent = |(mount, bearing)| SonarReading { mount, bearing, range_m: p3dx::SONAR_RANGE_M };
        let mut ears = Self { noise, next: 0, readings: p3dx::sonars().map(silent).collect() };
        (0..ARRAY).for_each(|_| ears.fire(obstacles, pose, dice));
        ears
    }

    pub(super) fn readings(&self) -> &[SonarReading] {
        &self.readings
    }

    /// Fires the next sonar of each array.
    pub(super) fn fire(&mut self, obstacles: &Obstacles, pose: Pose, dice: &mut Dice) {
        for index in [self.next, ARRAY + self.next] {
            let reading = &mut self.readings[index];
            let heading = pose.heading + reading.bearing;
            let heard =
                obstacles.echo(pose.to_world(reading.mount), vec2(heading.cos(), heading.sin()), p3dx::SONAR_RANGE_M);
            reading.range_m = misheard(heard, &self.noise, dice);
        }
        self.next = (self.next + 1) % ARRAY;
    }
}

fn misheard(heard: Option<f64>, noise: &Noise, dice: &mut Dice) -> f64 {
    // Drawn whatever becomes of them, so that one reading does not shift the next one's luck.
    let (missed, crosstalk, shorter) = (dice.share(), dice.share(), dice.share());
    let error = dice.normal(0.0, 1.0);
    let heard = heard.filter(|_| missed >= noise.sonar_miss).unwrap_or(p3dx::SONAR_RANGE_M);
    if crosstalk < noise.sonar_crosstalk {
        return (heard * shorter).max(RINGING_M);
    }
    if heard >= p3dx::SONAR_RANGE_M {
        return p3dx::SONAR_RANGE_M;
    }
    let metres = heard + error * (noise.sonar_m + noise.sonar_share * heard);
    // Reported in whole millimetres.
    ((metres * 1000.0).round() / 1000.0).clamp(RINGING_M, p3dx::SONAR_RANGE_M)
}
