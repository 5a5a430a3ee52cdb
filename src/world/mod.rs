//! The room map (what a robot may know) and the scene (what is true), and
//! what sensors see of it.
//!
//! The wall between the two types is what keeps the executive honest: it can
//! hold a [`RoomMap`], never a [`Scene`].

pub mod arrange;
pub mod camera;
mod check;
mod error;
pub mod families;
mod furniture;
mod load;
mod map;
mod map_server;
pub mod mesh;
mod mount;
mod noise;
mod scene;
mod shipped;
pub mod solid;
pub mod training;

pub use check::check;
pub use error::WorldError;
pub use furniture::{CATEGORIES, OBJECTS, Shape, Size, SmallObject, category, object};
pub use load::{load_map, load_world, world_json};
pub use map::{Door, Room, RoomMap, VERSION as FORMAT_VERSION};
pub use mount::CameraMount;
pub use noise::Noise;
pub use scene::{Item, PlacedObject, Scene};
pub use shipped::{SHIPPED_HOMES, ShippedHome};
pub use solid::{Color, Ray, Solid};
