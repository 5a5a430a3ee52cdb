//! What is known of things in general: one row a furniture category, one a small object.
//!
//! Scenes, families, the detector, the ideal eyes and the words all ask these
//! rows; whoever adds a category adds a row here, and a family in
//! `simulation::families` if the detector shall learn it. Nothing of any one
//! home stands here, and nothing here computes.

mod furniture;
mod objects;
mod usual_rooms;

pub use furniture::{
    CATEGORIES, Category, FAMILIES, FurnitureClass, FurnitureShape, Holds, Looks, Orientation, category, class_of,
};
pub use objects::{OBJECTS, SmallObject, object};
pub use usual_rooms::usual_rooms;

/// Red, green, blue.
pub type Color = [u8; 3];

/// Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Along the front's heading.
    pub length: f64,
    /// Across it.
    pub width: f64,
    /// Above the floor.
    pub height: f64,
}

const fn size(length: f64, width: f64, height: f64) -> Size {
    Size { length, width, height }
}
