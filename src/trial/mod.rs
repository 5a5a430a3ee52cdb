//! One trial: a plan run on the simulated robot in a scene, and judged by the truth.
//!
//! The only room that holds both what the robot knows and what is true. The
//! executive gets the room map, the base and the eyes; the judge gets the
//! scene.

mod eyes;
mod frame_stream;
mod home;
mod judge;
#[cfg(feature = "kinect")]
mod kinect;
mod outputs;
mod pace;
mod placing;
mod real;
mod recorder;
mod run;
mod served;
mod settings;
mod stage;
mod stream_eyes;

pub use frame_stream::{Carrier, Tell};
pub use home::Home;
pub use judge::ideal_detection;
pub use outputs::Outputs;
pub use real::{Interrupter, RealDriver};
pub use recorder::OPTIONS_TOPIC;
pub use run::{Run, run};
pub use served::{Served, ServingStop, served_until_interrupted};
pub use settings::{NoiseLevel, Perception, Settings, stream_of};
pub use stage::Driver;
pub use stream_eyes::{NoEyes, StreamEyes};
