//! The real robot: its trial, its camera and the frames that stream from it.
//!
//! What is true is not known here, and nothing here can name it: the driver
//! holds a room map, a base and eyes.

mod driver;
mod frame_stream;
#[cfg(feature = "kinect")]
mod kinect;
mod ros_camera;
mod stream_eyes;

pub use driver::{Interrupter, RealDriver};
pub use frame_stream::Tell;
pub use ros_camera::RosCamera;
pub use stream_eyes::{NoEyes, StreamEyes};
