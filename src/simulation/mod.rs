//! The truth, and the robot simulated in it.
//!
//! A [`Scene`] is what truly stands in a home; cameras and sonars see it as the
//! real ones would, the simulated base moves in it, ideal eyes look straight at
//! it, homes and training rooms are made at random, and the judge tells what a
//! trial was worth. Code that steers a robot stands below this room and cannot
//! name it: it holds a [`crate::map::RoomMap`], a base and eyes, whose
//! simulated kinds are handed to it from here.

pub mod arcos;
pub mod arrange;
pub mod base;
pub mod camera;
mod check;
mod dice;
mod driver;
pub mod eyes;
pub mod families;
mod furniture;
mod home;
mod inventory;
mod judge;
mod load;
pub mod mesh;
mod missing;
mod naming;
mod noise;
mod run;
mod scene;
mod served;
mod served_ros;
mod settings;
mod shipped;
pub mod solid;
pub mod training;
mod ways;

pub use check::check;
pub use dice::Dice;
pub use driver::Driver;
pub use home::Home;
pub use inventory::{Inventory, drawn};
pub use load::{load_world, world_json};
pub use noise::Noise;
pub use run::run;
pub use scene::{Item, PlacedObject, Scene};
pub use served::{Served, ServingStop, served_until_interrupted};
pub use served_ros::ServedRos;
pub use settings::{NoiseLevel, Perception, TrialSettings, stream_of};
pub use shipped::{SHIPPED_HOMES, ShippedHome};
pub use solid::{Ray, Solid};
pub use ways::ideal_detection;
