//! What `drive` adds: `trial`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Destination, Rounded};
use crate::geometry::Pose;

/// What became of a plan on a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Trial {
    /// How it ended.
    pub outcome: Outcome,
    /// One sentence that says why it ended so.
    pub why: String,
    /// Where the object was found, as a person would say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Where the robot ended.
    pub final_pose: Pose,
    /// The furniture at which the object was found, by the scene's id where the truth is known.
    pub target_id: Option<String>,
    /// The furniture approached, in order, by the scene's ids where the truth is known.
    pub approached: Vec<String>,
    /// Whether the first furniture approached holds the object; null where the truth is not known.
    pub right_first: Option<bool>,
    /// The file of the last picture, when one was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
    /// Seconds of the robot's time.
    pub duration_s: Rounded,
    /// Metres driven.
    pub distance_m: Rounded,
    /// Success weighted by path length, 0 to 1; null where the truth is not known.
    pub spl: Option<Rounded>,
    /// How often the robot touched something.
    pub collisions: u32,
    /// The least distance between the robot's outline and anything solid.
    pub min_clearance_m: Option<Rounded>,
    /// What was brought where, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub delivered: Vec<Delivery>,
    /// What was done, and why.
    pub actions: Vec<ActionReport>,
    /// Where the robot was: seconds, x, y, heading.
    pub path: Vec<PathPoint>,
}

/// Objects that were brought somewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Delivery {
    /// Nouns of the objects.
    pub objects: Vec<String>,
    /// Where they should go.
    pub to: Destination,
    /// Where the robot was when it had brought them.
    pub pose: Pose,
}

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The object is recognisable in the last picture.
    Found,
    /// The plan is done, and nothing identifiable was asked for.
    Arrived,
    /// Every place that could hold the object was looked at in vain.
    NotFound,
    /// No safe way on.
    Blocked,
    /// What was asked of the robot did not come about: it turned, drove or came to rest nowhere.
    Stuck,
    /// The time allowed was used up.
    Timeout,
    /// Stopped by a person or a signal.
    Stopped,
    /// The robot stopped answering.
    LinkLost,
}

impl Outcome {
    /// The name as it stands in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::Arrived => "arrived",
            Self::NotFound => "not_found",
            Self::Blocked => "blocked",
            Self::Stuck => "stuck",
            Self::Timeout => "timeout",
            Self::Stopped => "stopped",
            Self::LinkLost => "link_lost",
        }
    }

    /// The name in words.
    pub fn phrase(self) -> String {
        self.name().replace('_', " ")
    }
}

/// One action as it went.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ActionReport {
    /// The action's name in the plan: `enter`, `move`, `go`, `search`, `find`, `deliver`.
    #[serde(rename = "do")]
    pub action: String,
    /// How it ended.
    pub result: String,
    /// The decision behind it, with the runner-up.
    pub why: String,
    /// Seconds since the trial began.
    pub start_s: Rounded,
    /// Seconds since the trial began.
    pub end_s: Rounded,
}

/// A moment of the path: seconds since the trial began, x, y (metres), heading (radians).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PathPoint(pub Rounded, pub Rounded, pub Rounded, pub Rounded);

impl PathPoint {
    /// The pose at `time_s` seconds.
    pub fn new(time_s: f64, pose: Pose) -> Self {
        Self(time_s.into(), pose.x.into(), pose.y.into(), pose.heading.into())
    }

    /// The pose alone.
    pub fn pose(self) -> Pose {
        Pose::new(self.1.0, self.2.0, self.3.0)
    }
}
