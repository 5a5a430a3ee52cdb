//! Directions, the axes in which they are read, and the motions that they can ask for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The paper's seven directions, and three beyond them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// In front, ahead, nearer the door.
    Front,
    /// Behind, at the far end.
    Back,
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// In the middle.
    Central,
    /// Next to, by, with, against.
    Side,
    /// Between two references.
    Between,
    /// Over it.
    Above,
    /// Below it.
    Under,
    /// Of several, the one farthest from it.
    Far,
}

impl Direction {
    /// The name as it stands in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Central => "central",
            Self::Side => "side",
            Self::Between => "between",
            Self::Above => "above",
            Self::Under => "under",
            Self::Far => "far",
        }
    }

    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Front,
        Self::Back,
        Self::Left,
        Self::Right,
        Self::Central,
        Self::Side,
        Self::Between,
        Self::Above,
        Self::Under,
        Self::Far,
    ];

    /// The direction of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|direction| direction.name() == name)
    }

    /// Left for right and right for left; the others as they are.
    pub const fn mirrored(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
            other => other,
        }
    }
}

/// The axes in which a direction is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// The robot's pose when the words are reached.
    Robot,
    /// The heading at which the room is entered, wherever the robot stands: front is nearer the door.
    Viewer,
    /// The item's own front, left and right.
    Intrinsic,
    /// Seen by someone who stands before the item's front and looks at it: left and right mirrored.
    Facing,
}

impl Frame {
    /// The name as it stands in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Robot => "robot",
            Self::Viewer => "viewer",
            Self::Intrinsic => "intrinsic",
            Self::Facing => "facing",
        }
    }
}

/// A motion inside the room: one that goes, and three that turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Motion {
    /// Go straight ahead.
    #[serde(rename = "front")]
    Ahead,
    /// Turn a quarter to the left.
    #[serde(rename = "left")]
    TurnLeft,
    /// Turn a quarter to the right.
    #[serde(rename = "right")]
    TurnRight,
    /// Turn round.
    #[serde(rename = "back")]
    TurnRound,
}

impl Motion {
    /// The motion that a direction of a move asks for; nothing for one that is no motion.
    pub const fn from_direction(direction: Direction) -> Option<Self> {
        match direction {
            Direction::Front => Some(Self::Ahead),
            Direction::Left => Some(Self::TurnLeft),
            Direction::Right => Some(Self::TurnRight),
            Direction::Back => Some(Self::TurnRound),
            _ => None,
        }
    }
}
