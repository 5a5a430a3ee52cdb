//! From a ROS that answers to a robot ready to drive: topics, the first odometry, and somebody who obeys.

use std::time::Duration;

use super::client::{BUMPER, Client, Ears, MOTORS, STOP_AGAIN, STOP_BUTTON};
use super::hearing::PLACED_WITHIN;
use super::{Kind, RosError};

/// What a ROS base needs is there within this.
const THERE_WITHIN: Duration = Duration::from_secs(8);

impl Client {
    fn lacks(&self, what: String) -> RosError {
        RosError::Lacks(self.transport.name(), what)
    }

    /// Joins the topics, and waits for what a robot cannot be driven without.
    pub(super) fn set_up(&mut self) -> Result<(), RosError> {
        let kind = if self.settings.stamped { Kind::TwistStamped } else { Kind::Twist };
        self.transport.advertise(&self.command, kind, false)?;
        let zero = self.velocity(0.0, 0.0);
        if let Some(program) = self.settings.program.clone() {
            self.transport.guard(&program, &self.command, &zero);
        }
        self.transport.subscribe(&self.odometry, Kind::Odometry)?;
        for topic in ["/tf", "/tf_static"] {
            self.transport.subscribe(&self.settings.names.of(topic), Kind::Transforms)?;
        }
        self.await_that(THERE_WITHIN, |client| client.report.sips > 1)?;
        if self.report.sips == 0 {
            return Err(self.lacks(format!("no odometry on {} ({})", self.odometry, self.others(Kind::Odometry)?)));
        }
        self.join_senses()?;
        self.await_that(THERE_WITHIN, |client| client.transport.listeners(&client.command) > 0)?;
        if self.transport.listeners(&self.command) == 0 {
            let what = "nobody listens to it: is the base up, and is this its topic (--remap /cmd_vel:=/its/topic)?";
            return Err(self.lacks(format!("{}: {what}", self.command)));
        }
        self.await_that(PLACED_WITHIN, |client| client.has_all())?;
        Ok(())
    }

    pub(super) fn has_all(&self) -> bool {
        !self.ears.is_empty() && self.ears.values().all(|ears| !ears.readings.is_empty())
    }

    /// Every topic that measures distances, and those that stop the robot.
    pub(super) fn join_senses(&mut self) -> Result<(), RosError> {
        let topics = self.transport.topics()?;
        let names = &self.settings.names;
        let (scan, sonar) = (names.of("/scan"), names.of("/sonar"));
        let home = names.of("");
        let senses = topics.iter().filter_map(|(topic, kind)| {
            let kind = Kind::of(kind)?;
            let is_ours = match kind {
                Kind::Scan => *topic == scan,
                Kind::Cloud => *topic == sonar,
                Kind::Range => topic.starts_with(&home),
                _ => false,
            };
            is_ours.then(|| (topic.clone(), kind))
        });
        let senses: Vec<(String, Kind)> = senses.collect();
        for (topic, kind) in senses {
            self.transport.subscribe(&topic, kind)?;
            self.ears.insert(topic, Ears { readings: Vec::new(), heard_at: self.now() });
        }
        for topic in [BUMPER, STOP_BUTTON, MOTORS] {
            let theirs = self.settings.names.of(topic);
            if topics.iter().any(|(name, kind)| *name == theirs && kind == Kind::Flag.name()) {
                self.transport.subscribe(&theirs, Kind::Flag)?;
                self.holds.insert(theirs, topic);
            }
        }
        Ok(())
    }

    /// Topics of this kind that there are.
    pub(super) fn others(&self, kind: Kind) -> Result<String, RosError> {
        let topics = self.transport.topics()?;
        let those: Vec<String> =
            topics.into_iter().filter(|(_, name)| name == kind.name()).map(|(topic, _)| topic).collect();
        Ok(if those.is_empty() {
            format!("there is no {}", kind.name())
        } else {
            format!("there is {}", those.join(", "))
        })
    }

    pub(super) fn await_that(&mut self, most: Duration, there: impl Fn(&Self) -> bool) -> Result<(), RosError> {
        let until = self.now() + most;
        while !there(self) && self.now() < until {
            self.listen(STOP_AGAIN);
            if let Some(why) = &self.lost {
                return Err(self.lacks(why.clone()));
            }
        }
        Ok(())
    }

    pub(super) fn preflight(&self) -> String {
        let body = &self.settings.body;
        let (linear, angular) = (body.speed_m_s, body.turn_rad_s);
        let heard: Vec<&str> = self.ears.keys().map(String::as_str).collect();
        let ears = if heard.is_empty() {
            "nothing that measures distances (no /scan, /sonar or Range): it stops only for what its camera has seen"
                .into()
        } else {
            format!("distances by {}", heard.join(", "))
        };
        let place = if self.map_from_odometry().is_some() { "place by /tf map → odom" } else { "place by odometry" };
        format!(
            "{}: driving on {}, odometry {} every {} ms, {ears}, {place}; at most {linear:.2} m/s and {angular:.2} rad/s, \
             stops {} ms after the last word",
            self.transport.name(),
            self.command,
            self.odometry,
            self.cycle.as_millis(),
            self.settings.deadline.as_millis(),
        )
    }
}
