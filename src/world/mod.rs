//! The room map (what a robot may know) and the scene (what is true), and
//! what sensors see of it.
//!
//! The wall between the two types is what keeps the executive honest: it can
//! hold a [`RoomMap`], never a [`Scene`].

pub mod camera;
mod check;
mod error;
pub mod families;
mod furniture;
mod map;
mod noise;
mod scene;
pub mod solid;
pub mod training;

pub use check::check;
pub use error::WorldError;
pub use furniture::{CATEGORIES, OBJECTS, Shape, Size, SmallObject, category, object};
pub use map::{Door, Room, RoomMap};
pub use noise::Noise;
pub use scene::{Item, PlacedObject, Scene};
pub use solid::{Color, Ray, Solid};
