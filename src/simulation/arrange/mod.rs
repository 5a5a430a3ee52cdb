//! Seeded scenes: furniture re-placed so that its spatial relations stay as they are, or break, and whole new homes.
//!
//! Every scene made here passes [`super::check`] and leaves the robot a way to
//! look at each piece that holds something ([`access::everything_is_accessible`]).
//! The same seed makes the same scene.

pub mod access;
mod furnish;
mod new_home;
mod rearrange;
pub mod relations;
mod standing_room;
mod stock;

pub use furnish::{Furnisher, Spot};
pub use new_home::{RoomPlan, home_of_rooms, new_home};
pub use rearrange::{Relations, rearranged};
