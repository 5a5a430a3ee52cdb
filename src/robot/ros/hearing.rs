//! What a ROS base says: odometry, distances, transforms, and what stops it.

use std::sync::PoisonError;
use std::time::Duration;

use super::beams::{of_cloud, of_range, of_scan};
use super::client::{BUMPER, Client, SILENCE, STOP_BUTTON};
use super::{Incoming, Message, Odometry};
use crate::geometry::{Pose, wrap_angle};
use crate::robot::SonarReading;

/// Transforms are waited for so long.
pub(super) const PLACED_WITHIN: Duration = Duration::from_millis(1500);
/// From a velocity to the odometry that shows it, beside one cycle of it (measured on robots: 50 to 100 ms).
const BASE_ANSWERS: Duration = Duration::from_millis(60);
/// Stamps that go back, or run ahead of our clock, by more than this, seconds, are a clock that was set.
const CLOCK_JUMP_S: f64 = 1.0;

impl Client {
    /// Takes in what comes.
    pub(super) fn listen(&mut self, wait: Duration) {
        for incoming in self.transport.take(wait) {
            match incoming {
                Incoming::Message(topic, message) => self.hear(&topic, message),
                Incoming::Trouble(what) => self.note(what),
                Incoming::Lost(why) => self.lost = Some(why),
            }
        }
        self.report.at = self.now();
    }

    pub(super) fn hear(&mut self, topic: &str, message: Message) {
        match message {
            Message::Odometry(odometry) if topic == self.odometry => self.take_odometry(&odometry),
            Message::Transforms(all) => all.iter().for_each(|told| self.frames.take(told)),
            Message::Flag(flag) => self.take_flag(topic, flag),
            Message::Scan(scan) => {
                let place = self.place_of(&scan.header.frame);
                self.take_readings(topic, place.and_then(|place| of_scan(&scan, &place, &self.settings.body)));
            }
            Message::Range(header, values) => {
                let place = self.place_of(&header.frame);
                let reading = place.and_then(|place| of_range(values, &place, &self.settings.body));
                self.take_readings(topic, reading.map(|reading| vec![reading]));
            }
            Message::Cloud(header, points) => {
                let place = self.place_of(&header.frame);
                self.take_readings(topic, place.and_then(|place| of_cloud(&points, &place, &self.settings.body)));
            }
            _ => {}
        }
    }

    /// Where a sensor sits; at the base's middle when nobody has told for a while.
    pub(super) fn place_of(&mut self, frame: &str) -> Option<nalgebra::Isometry3<f64>> {
        let found = self.frames.within(&self.base_frame, frame);
        if found.is_none() && self.now() > PLACED_WITHIN {
            let what =
                format!("no transform tells where `{frame}` is on `{}`; it is taken for its middle", self.base_frame);
            if !self.remarks.contains_key("place") {
                self.remark("place", what);
            }
            return Some(nalgebra::Isometry3::identity());
        }
        found
    }

    pub(super) fn take_readings(&mut self, topic: &str, readings: Option<Vec<SonarReading>>) {
        let now = self.now();
        let Some(readings) = readings else {
            self.remark(
                "nonsense",
                format!("{topic}: nothing measured in this message, or no numbers; it is passed over"),
            );
            return;
        };
        if let Some(ears) = self.ears.get_mut(topic) {
            (ears.readings, ears.heard_at) = (readings, now);
        }
        self.report.sonar = self.ears.values().flat_map(|ears| ears.readings.iter().copied()).collect();
    }

    pub(super) fn take_flag(&mut self, topic: &str, flag: bool) {
        match self.holds.get(topic).copied() {
            Some(BUMPER) => {
                let backward = self.told.0 < 0.0;
                self.report.front_bumpers = u8::from(flag && !backward);
                self.report.rear_bumpers = u8::from(flag && backward);
                self.report.status.bumped = flag;
            }
            Some(STOP_BUTTON) => {
                self.report.emergency_stop = flag;
                self.hold(flag, "the STOP button is pressed");
            }
            Some(_) => self.hold(!flag, "the motors are switched off"),
            None => {}
        }
    }

    pub(super) fn hold(&mut self, held: bool, why: &str) {
        let was = self.report.held.is_some();
        self.report.held = held.then(|| why.to_string());
        if held != was {
            self.note(if held { why.to_string() } else { "nothing holds the robot any more".to_string() });
        }
        if held {
            self.ask = None;
        }
    }

    pub(super) fn take_odometry(&mut self, odometry: &Odometry) {
        let now = self.now();
        self.watch_clock(odometry.header.stamp_s, now);
        let before = self.report.heard_at;
        if !self.track.take(odometry, now) {
            self.remark(
                "jump",
                format!("{}: its pose jumps or is no number; going on from where the robot was", self.odometry),
            );
        }
        let (linear, angular) = odometry.velocity;
        if linear.is_finite() && angular.is_finite() {
            self.report.velocity = odometry.velocity;
        }
        if self.report.sips > 0 {
            // A smooth mean, of waits that are none of a stop.
            let wait = now.saturating_sub(before).min(SILENCE);
            self.cycle = (self.cycle * 7 + wait) / 8;
        }
        (self.base_frame, self.odometry_frame) =
            (odometry.child.trim_start_matches('/').into(), odometry.header.frame.clone());
        self.report.sips += 1;
        self.report.heard_at = now;
        self.report.dead_time = self.cycle + BASE_ANSWERS;
        self.report.distance_m = self.track.distance_m();
        self.report.pose = self.pose();
        self.tell_origin();
        if std::mem::take(&mut self.silent) {
            self.note(format!("{} is heard again", self.odometry));
        }
    }

    /// Only told: every deadline here is by our own clock, which does not jump.
    pub(super) fn watch_clock(&mut self, stamp_s: f64, now: Duration) {
        let ahead = now.as_secs_f64() - stamp_s;
        let jumped = self.clock.map(|before| before - ahead).filter(|jump| jump.abs() > CLOCK_JUMP_S);
        if let Some(jump) = jumped {
            self.remark("clock", format!("the robot's clock jumps by {jump:+.1} s; it is not driven by it"));
        }
        self.clock = Some(ahead);
    }

    pub(super) fn map_from_odometry(&self) -> Option<Pose> {
        let place = self.frames.within("map", &self.odometry_frame)?;
        let forward = place.rotation * nalgebra::Vector3::x();
        Some(Pose::new(place.translation.x, place.translation.y, forward.y.atan2(forward.x)))
    }

    /// From the start: by the robot's own localization when it has one, by odometry else.
    pub(super) fn pose(&self) -> Pose {
        let (Some(odometry), Some(own)) = (self.map_from_odometry(), self.track.own()) else {
            return self.track.pose();
        };
        let at = self.settings.start.to_local(odometry.to_world(own.position()));
        Pose::new(at.x, at.y, wrap_angle(odometry.heading + own.heading - self.settings.start.heading))
    }

    pub(super) fn tell_origin(&self) {
        let Some(own) = self.track.own() else { return };
        let at = self.settings.start.to_world(self.report.pose.position());
        let turned = wrap_angle(self.settings.start.heading + self.report.pose.heading - own.heading);
        let back = Pose::new(0.0, 0.0, turned).to_world(own.position());
        let origin = Pose::new(at.x - back.x, at.y - back.y, turned);
        *self.settings.origin.lock().unwrap_or_else(PoisonError::into_inner) = origin;
    }
}
