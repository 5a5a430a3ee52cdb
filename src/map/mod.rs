//! The room map: rooms, walls, doors and the start – all that a robot may know of a home.
//!
//! Read from JSON, from the YAML and grid of a ROS `map_server` pair, or by
//! the name of a shipped home. Nothing here knows of furniture.

mod check;
pub(crate) mod checker;
pub(crate) mod error;
mod load;
mod map_server;
mod room_map;
mod shipped;

pub use error::WorldError;
pub use load::{load_map, map_of_scene, shipped_home};
pub use room_map::{Door, FORMAT_VERSION, Room, RoomMap};
pub use shipped::{SHIPPED_MAPS, ShippedMap};
