//! The contract between the stages: one JSON object on one line, growing.
//!
//! Each stage adds its own key, keeps every key it does not know byte for
//! byte, and never changes another's. The types here are that contract; their
//! JSON Schemas stand in `docs/schema/`. Nothing here computes anything.
//!
//! Offsets are bytes into `text`. Lengths are metres and angles radians,
//! counter-clockwise, unless a name ends in `_deg`.

mod camera;
mod chunk;
mod detection;
mod direction;
mod grounding;
mod hof;
mod line;
mod part;
mod plan;
mod precision;
mod reference;
mod row;
mod stage;
mod trial;

pub use camera::{CameraPose, PoseSource};
pub use chunk::{Chunk, Tag, Token};
pub use detection::Detection;
pub use direction::{Direction, Frame, Motion};
pub use grounding::{
    Amount, Destination, Grounding, Node, ObjectSlot, Pair, Reading, RoomSlot, RuledOut, TextSpan, Why, doubts_of,
};
pub use hof::{DegreeOfTruth, Hof, HofForce};
pub use line::{FieldError, Record, message_without_position};
pub use part::Part;
pub use plan::{Action, Plan, SearchPair};
pub use precision::Rounded;
pub use reference::Reference;
pub use row::{Row, csv_line};
pub use stage::{Note, Shade, Stage, StageError};
pub use trial::{ActionReport, Delivery, Outcome, PathPoint, Trial};
