//! Where the robot is: its odometry from where it was first heard, through jumps, and by `map → odom` when told.

use std::time::Duration;

use super::Odometry;
use crate::geometry::{Pose, wrap_angle};

/// Faster than this nothing drives that is driven from here: a step that would need it is a jump, m/s and rad/s.
const FASTEST_M_S: f64 = 3.0;
const FASTEST_RAD_S: f64 = 8.0;
/// Steps smaller than this are no jumps, metres and radians.
const TOLERANCE_M: f64 = 0.05;
const TOLERANCE_RAD: f64 = 0.1;
/// Messages that come all at once were made so far apart.
const CYCLE: Duration = Duration::from_millis(100);

/// Follows odometry.
#[derive(Clone, Debug, Default)]
pub struct Track {
    last: Option<(Pose, Duration)>,
    /// From where it was first heard.
    pose: Pose,
    distance_m: f64,
}

impl Track {
    /// Where the robot is, from where it was first heard.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// By its own odometry, as it was last heard.
    pub fn own(&self) -> Option<Pose> {
        self.last.map(|(pose, _)| pose)
    }

    /// Metres driven.
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// Takes in what came at `now`; false when its pose cannot follow from the one before, or is no number.
    ///
    /// After a jump – the odometry was reset – the way goes on from where it was, by the velocity reported.
    pub fn take(&mut self, odometry: &Odometry, now: Duration) -> bool {
        let new = odometry.pose;
        if ![new.x, new.y, new.heading].iter().all(|value| value.is_finite()) {
            return false;
        }
        let Some((last, at)) = self.last.replace((new, now)) else { return true };
        let passed = now.saturating_sub(at).max(CYCLE).as_secs_f64();
        let moved = last.to_local(new.position());
        let turned = wrap_angle(new.heading - last.heading);
        let follows = moved.norm() <= FASTEST_M_S * passed + TOLERANCE_M
            && turned.abs() <= FASTEST_RAD_S * passed + TOLERANCE_RAD;
        if follows {
            let at = self.pose.to_world(moved);
            self.pose = Pose::new(at.x, at.y, wrap_angle(self.pose.heading + turned));
            self.distance_m += moved.norm();
        } else {
            let way = odometry.velocity.0 * now.saturating_sub(at).as_secs_f64().min(0.5);
            let way = if way.is_finite() { way } else { 0.0 };
            let ahead = self.pose.forward() * way;
            (self.pose.x, self.pose.y) = (self.pose.x + ahead.x, self.pose.y + ahead.y);
            self.distance_m += way.abs();
        }
        follows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn odometry(x: f64, y: f64, heading: f64) -> Odometry {
        Odometry { pose: Pose::new(x, y, heading), velocity: (0.3, 0.0), ..Odometry::default() }
    }

    #[test]
    fn odometry_that_is_reset_neither_jumps_nor_loses_the_way_in_between() {
        let mut track = Track::default();
        for i in 0..=50 {
            assert!(track.take(&odometry(5.0, f64::from(i) * 0.03, std::f64::consts::FRAC_PI_2), CYCLE * i));
        }
        assert!(!track.take(&odometry(0.0, 0.0, 0.0), CYCLE * 51));
        assert!(track.take(&odometry(0.03, 0.0, 0.0), CYCLE * 52));
        assert!((track.pose().x - 1.56).abs() < 1e-9 && track.pose().y.abs() < 1e-9, "{:?}", track.pose());
        assert!(!track.take(&odometry(f64::NAN, 0.0, 0.0), CYCLE * 53));
    }
}
