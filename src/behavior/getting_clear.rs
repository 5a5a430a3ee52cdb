//! Getting clear: what the sonars hear close by, what was met or touched, and room for a turn.

use super::pilot::{Halt, Pilot, TICK_S};
use super::progress::PATIENCE_S;
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::robot::SonarReading;

/// The sonar's last word: nothing ahead nearer than this, metres from the sonar.
pub(super) const GUARD_M: f64 = 0.16;
/// Sonars within this of straight ahead watch the way, radians.
const GUARD_RAD: f64 = 0.7;
/// A sonar's range is this old at most, seconds: eight fire one after another.
const SONAR_AGE_S: f64 = 0.32;
/// How fast it moves where it sees nothing, metres a second.
const CREEP_M_S: f64 = 0.1;
/// How far the robot backs off from what it touched, metres.
const BACK_OFF_M: f64 = 0.25;
/// Getting nowhere for so long, it is held at that end, seconds.
const IN_VAIN_S: f64 = 1.5;
/// How far it creeps to make room for a turn: past a bed that stands abreast, metres.
const MAKE_ROOM_M: f64 = 1.5;
/// What is heard so little ahead or behind stands abreast, metres.
const ABREAST_M: f64 = 0.1;

/// Nor where what the eyes have seen would come nearer than this to its outline, metres, so far on.
const KEPT_M: f64 = 0.03;
const NEXT_M: f64 = 0.06;

/// The robot's two ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Front,
    Rear,
}

impl End {
    pub(super) fn other(self) -> Self {
        if self == Self::Front { Self::Rear } else { Self::Front }
    }
}

impl Pilot<'_> {
    /// Metres from the front sonars to what they hear, less what the robot has gone since they fired, and will have
    /// gone when the next command reaches it.
    pub(super) fn free_ahead(&self) -> f64 {
        let (there, (speed, _)) = self.ahead();
        let gone = self.pose().to_local(there.position()).x.max(0.0);
        self.nearest(|bearing| bearing <= GUARD_RAD) - speed.max(0.0) * SONAR_AGE_S - gone
    }

    /// Metres from the sonars at one end to what they hear.
    fn free(&self, end: End) -> f64 {
        match end {
            End::Front => self.free_ahead(),
            End::Rear => self.nearest(|bearing| bearing >= std::f64::consts::PI - GUARD_RAD),
        }
    }

    /// Whether moving on takes no room for a turn beside what the eyes have seen, which the sonars may not hear.
    fn keeps_room(&self, toward: End) -> bool {
        let here = self.pose();
        let there = here.to_world(vec2(if toward == End::Front { NEXT_M } else { -NEXT_M }, 0.0));
        self.outlines.iter().all(|outline| {
            let left = outline.distance_to(there);
            left >= self.clearances.heard || left >= outline.distance_to(here.position())
        })
    }

    /// Whether moving on keeps clear of what the eyes have seen: the top of a table is above the sonars.
    fn keeps_clear(&self, toward: End) -> bool {
        let here = self.pose();
        let there = here.to_world(vec2(if toward == End::Front { NEXT_M } else { -NEXT_M }, 0.0));
        let (now, then) = (self.body.outline(here), self.body.outline(Pose::new(there.x, there.y, here.heading)));
        let clear = |outline: &Polygon| {
            let left = outline.distance(&then);
            left >= KEPT_M || left >= outline.distance(&now)
        };
        self.outlines.iter().all(clear)
    }

    /// At which end there is more room.
    pub(super) fn freer_end(&self) -> End {
        if self.free(End::Front) > self.free(End::Rear) { End::Front } else { End::Rear }
    }

    /// What the sonars hear nearer than a turn in place allows, in the robot's frame, metres.
    pub(super) fn heard_within_swing(&self) -> impl Iterator<Item = Vec2> {
        let heard = self.clearances.heard;
        self.base.sonar().iter().map(SonarReading::echo).filter(move |point| point.norm() < heard)
    }

    fn creep(&mut self, toward: End) -> Result<(), Halt> {
        self.tick(if toward == End::Front { CREEP_M_S } else { -CREEP_M_S }, 0.0)
    }

    fn nearest(&self, watched: impl Fn(f64) -> bool) -> f64 {
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
            let point = self.pose().to_world(nearest.echo());
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
        let point = self.pose().to_world(vec2(self.body.front_m + 0.05, 0.0));
        self.because(format!("touched something at ({:.1}, {:.1}); backing off", point.x, point.y));
        self.beliefs.bumps.push(point);
        self.back_off(End::Rear)?;
        self.rebuild_grid();
        Ok(())
    }

    /// Creeps a little way back or ahead, as far as the sonars there allow.
    pub(super) fn back_off(&mut self, toward: End) -> Result<(), Halt> {
        let (from, began_s) = (self.pose(), self.base.time_s());
        for _ in 0..(2.0 * BACK_OFF_M / CREEP_M_S / TICK_S) as usize {
            let gone = self.pose().distance_to(from.position());
            let is_in_vain = self.base.time_s() - began_s > IN_VAIN_S && gone < KEPT_M;
            if is_in_vain
                || self.free(toward) < GUARD_M
                || !self.keeps_clear(toward)
                || self.pose().distance_to(from.position()) >= BACK_OFF_M
            {
                break;
            }
            self.creep(toward)?;
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
            heard.extend(self.heard_within_swing().map(|point| here.to_world(point)));
            let points = heard.iter().map(|&point| here.to_local(point));
            let Some(nearest) = points.min_by(|a, b| a.norm().total_cmp(&b.norm())) else { break };
            let lacks = self.clearances.heard - nearest.norm();
            let is_abreast = nearest.x.abs() < ABREAST_M;
            let away = if nearest.x < 0.0 { End::Front } else { End::Rear };
            let toward = if is_abreast { *past.get_or_insert(self.freer_end()) } else { away };
            if lacks <= 0.0 || self.free(toward) < GUARD_M + if is_abreast { ABREAST_M } else { lacks } {
                break;
            }
            if !self.keeps_room(toward) || self.is_held() {
                break;
            }
            self.creep(toward)?;
        }
        self.come_to_rest()
    }

    pub(super) fn come_to_rest(&mut self) -> Result<(), Halt> {
        let began_s = self.base.time_s();
        while !self.foresight.is_at_rest(self.base.velocity()) {
            self.tick(0.0, 0.0)?;
            if self.base.time_s() - began_s > PATIENCE_S {
                return Err(Halt::Stuck(format!("it does not come to rest within {PATIENCE_S} s")));
            }
        }
        Ok(())
    }
}
