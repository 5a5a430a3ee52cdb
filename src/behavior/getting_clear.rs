//! Getting clear: what the sonars hear close by, what was met or touched, and room for a turn.

use super::driving::CREEP_M_S;
use super::pilot::{Halt, Pilot, TICK_S};
use crate::geometry::{Vec2, vec2};
use crate::robot::{SonarReading, p3dx};

/// The sonar's last word: nothing ahead nearer than this, metres from the sonar.
pub(super) const GUARD_M: f64 = 0.16;
/// Sonars within this of straight ahead watch the way, radians.
const GUARD_RAD: f64 = 0.7;
/// A sonar's range is this old at most, seconds: eight fire one after another.
const SONAR_AGE_S: f64 = 0.32;
/// A turn in place needs this much round the wheels' middle, metres.
pub(super) const TURNING_M: f64 = p3dx::SWING_M + 0.03;
/// How far the robot backs off from what it touched, metres.
const BACK_OFF_M: f64 = 0.25;
/// How far it creeps to make room for a turn, metres.
const MAKE_ROOM_M: f64 = 0.6;
/// What is heard so little ahead or behind stands abreast, metres.
const ABREAST_M: f64 = 0.1;

impl Pilot<'_> {
    /// Metres from the front sonars to what they hear, less what the robot has gone since they fired.
    pub(super) fn free_ahead(&self) -> f64 {
        self.nearest(|bearing| bearing <= GUARD_RAD) - self.base.velocity().0.max(0.0) * SONAR_AGE_S
    }

    pub(super) fn free_behind(&self) -> f64 {
        self.nearest(|bearing| bearing >= std::f64::consts::PI - GUARD_RAD)
    }

    pub(super) fn nearest(&self, watched: impl Fn(f64) -> bool) -> f64 {
        let ranges = self.base.sonar().iter().filter(|r| watched(r.bearing.abs())).map(|r| r.range_m);
        ranges.fold(f64::INFINITY, f64::min)
    }

    /// Stands still until every sonar has fired again: one ping may be another sonar's.
    pub(super) fn something_is_ahead(&mut self) -> Result<bool, Halt> {
        self.come_to_rest()?;
        for _ in 0..(SONAR_AGE_S / TICK_S).ceil() as usize {
            self.tick(0.0, 0.0)?;
        }
        Ok(self.free_ahead() - GUARD_M <= 0.0)
    }

    /// The sonar found something the eyes had not: remember it, and plan anew.
    pub(super) fn met_something(&mut self) -> Result<bool, Halt> {
        let ahead = self.base.sonar().iter().filter(|reading| reading.bearing.abs() <= GUARD_RAD);
        if let Some(nearest) = ahead.min_by(|a, b| a.range_m.total_cmp(&b.range_m)) {
            let point = self.pose().to_world(heard_at(nearest));
            self.beliefs.bumps.push(point);
            self.because(format!("the sonar met something at ({:.1}, {:.1}); going round", point.x, point.y));
        }
        self.rebuild_grid();
        Ok(false)
    }

    pub(super) fn is_held(&self) -> bool {
        let status = self.base.status();
        status.stalled || status.bumped
    }

    /// Something neither eyes nor sonars had reported stopped the robot: back off, remember it, plan anew.
    pub(super) fn touched(&mut self) -> Result<(), Halt> {
        let point = self.pose().to_world(vec2(p3dx::FRONT_M + 0.05, 0.0));
        self.because(format!("touched something at ({:.1}, {:.1}); backing off", point.x, point.y));
        self.beliefs.bumps.push(point);
        self.back_off(false)?;
        self.rebuild_grid();
        Ok(())
    }

    /// Creeps a little way back or ahead, as far as the sonars there allow.
    pub(super) fn back_off(&mut self, ahead: bool) -> Result<(), Halt> {
        let from = self.pose();
        let speed = if ahead { CREEP_M_S } else { -CREEP_M_S };
        for _ in 0..(2.0 * BACK_OFF_M / CREEP_M_S / TICK_S) as usize {
            let free = if ahead { self.free_ahead() } else { self.free_behind() };
            if free < GUARD_M || self.pose().distance_to(from.position()) >= BACK_OFF_M {
                break;
            }
            self.tick(speed, 0.0)?;
        }
        self.come_to_rest()
    }

    /// Before a turn in place: away from what the sonars hear within the swing, as far as the other side allows; past
    /// what stands abreast, whichever way is freer.
    pub(super) fn make_room(&mut self) -> Result<(), Halt> {
        // The sonars hear only along their axes: what one of them heard is still there when it hears it no more.
        let (mut past, mut heard) = (None, Vec::new());
        for _ in 0..(MAKE_ROOM_M / CREEP_M_S / TICK_S) as usize {
            let here = self.pose();
            let within = self.base.sonar().iter().map(heard_at).filter(|point| point.norm() < TURNING_M);
            heard.extend(within.map(|point| here.to_world(point)));
            let points = heard.iter().map(|&point| here.to_local(point));
            let Some(nearest) = points.min_by(|a, b| a.norm().total_cmp(&b.norm())) else { break };
            let lacks = TURNING_M - nearest.norm();
            let is_abreast = nearest.x.abs() < ABREAST_M;
            let freer = self.free_ahead() > self.free_behind();
            let ahead = if is_abreast { *past.get_or_insert(freer) } else { nearest.x < 0.0 };
            let free = if ahead { self.free_ahead() } else { self.free_behind() };
            if lacks <= 0.0 || free < GUARD_M + if is_abreast { ABREAST_M } else { lacks } {
                break;
            }
            self.tick(if ahead { CREEP_M_S } else { -CREEP_M_S }, 0.0)?;
        }
        self.come_to_rest()
    }

    pub(super) fn come_to_rest(&mut self) -> Result<(), Halt> {
        loop {
            let (linear, angular) = self.base.velocity();
            if linear.abs() < 0.01 && angular.abs() < 0.02 {
                return Ok(());
            }
            self.tick(0.0, 0.0)?;
        }
    }
}

/// Where a reading's echo is, in the robot's frame, metres.
pub(super) fn heard_at(reading: &SonarReading) -> Vec2 {
    reading.mount + vec2(reading.bearing.cos(), reading.bearing.sin()) * reading.range_m
}
