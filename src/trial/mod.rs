//! One trial: a plan run on the simulated robot in a scene, and judged by the truth.
//!
//! The only room that holds both what the robot knows and what is true. The
//! executive gets the room map, the base and the eyes; the judge gets the
//! scene.

mod eyes;
mod home;
mod judge;
mod outputs;
mod recorder;
mod run;
mod settings;
mod stage;

pub use home::Home;
pub use judge::ideal_detection;
pub use outputs::Outputs;
pub use run::{Run, run};
pub use settings::{NoiseLevel, Perception, Settings, stream_of};
pub use stage::Driver;
