//! What `plan` adds: `plan`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Amount, Destination, Direction, Frame, Motion, Pair, Reference};

/// A queue of actions for the three subtasks: enter the room, navigate inside it, find the object.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Plan {
    /// Name of the room map it was made for.
    pub map: String,
    /// The room to enter; null when nothing said picks one.
    pub room: Option<String>,
    /// The actions, in order.
    pub actions: Vec<Action>,
    /// What is missing or does not fit the map, and what would.
    pub problems: Vec<String>,
}

/// One step of the robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Action {
    /// Drive through the door into a room.
    Enter {
        /// The room; null to try the candidates in order.
        room: Option<String>,
        /// Rooms to try in order, when none was said.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        candidates: Vec<String>,
    },
    /// Go straight, or turn to one of the room's axes.
    Move {
        /// Front goes; left, right and back turn.
        #[serde(rename = "direction")]
        motion: Motion,
        /// How far, or until what.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        amount: Option<Amount>,
    },
    /// Go to a part of the room, a wall, a door or past a landmark.
    Go {
        /// `room`, `wall`, `door`, or a noun.
        reference: Reference,
        /// Which part or side of it.
        direction: Direction,
        /// The axes in which the direction is read.
        frame: Frame,
        /// The frames to try after it when the reference is furniture.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        frames: Vec<Frame>,
    },
    /// Find the target furniture by its reference–direction pairs, in order.
    Search {
        /// Noun of the target furniture; null when none was said.
        target: Option<String>,
        /// Colour, size and shape, as said.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        attributes: Vec<String>,
        /// "The second table": counted from 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ordinal: Option<u32>,
        /// References and directions in the order spoken.
        pairs: Vec<SearchPair>,
        /// Furniture that is not looked at: what was ruled out, and where the object shall be put.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        not: Vec<String>,
    },
    /// Look for the object where the search led.
    Find {
        /// Noun of the object; null for any portable object on the target.
        object: Option<String>,
    },
    /// Bring what was found somewhere.
    Deliver {
        /// Nouns of the objects.
        objects: Vec<String>,
        /// Where to: back to the speaker, who is where the robot started, to a room of the map, to furniture.
        to: Destination,
    },
}

/// A pair of a search with the other frames to try.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchPair {
    /// The pair as grounded.
    #[serde(flatten)]
    pub pair: Pair,
    /// Frames to try, likeliest first; empty where only one makes sense.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<Frame>,
}
