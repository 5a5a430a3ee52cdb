//! A robot that runs ROS: `/cmd_vel` out, `/odom` and what measures distances in.
//!
//! [`Transport`] carries messages in our own plain types; the base above it
//! knows no ROS version. Nothing of ROS need be installed. ROS 1 is spoken
//! here ([`ros1`]): the crates that speak it bring OpenSSL.

mod address;
mod base;
mod beams;
mod body_file;
mod client;
mod hearing;
mod joining;
mod message;
mod names;
mod settings;
mod track;
mod transport;

pub mod ros1;

pub use address::master_of;
pub use base::RosBase;
pub use body_file::{BodyFile, shipped_bodies};
pub use message::{Header, Kind, Message, Odometry, Picture, Scan, Transform};
pub use names::{Names, remapping};
pub use settings::RosSettings;
pub use transport::{Incoming, RosError, Transport};
