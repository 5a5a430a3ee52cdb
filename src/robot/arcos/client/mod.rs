//! Drives a robot over a line, and stops it whenever it is not told to go on.
//!
//! [`Client`] does everything on the thread that calls it, by its line's
//! clock. [`ArcosBase`] gives a client a thread of its own, so that the robot
//! is stopped in time even when the program that steers it hangs.

mod base;
mod connection;
mod ending;
mod handshake;
mod intake;
mod odometry;
mod settings;
mod setup;

use std::io;
use std::time::Duration;

pub use base::ArcosBase;
pub use connection::Client;
pub use handshake::{HandshakeError, Identity};
pub use odometry::{Odometry, Taken};
pub use settings::ArcosSettings;

/// Why no robot could be had at the end of a line.
#[derive(Debug, thiserror::Error)]
pub enum ConnectError {
    /// The line cannot be opened or used.
    #[error("{0}: {1}")]
    Line(String, io::Error),
    /// Nobody answers, or nobody that can be understood.
    #[error("{0}: {1}")]
    Handshake(String, HandshakeError),
    /// A robot whose scales are not known.
    #[error(
        "{0}: the robot calls itself `{1}`, of which no parameters are known; give --robot-model p3dx-sh or p3dx if it is like one of these"
    )]
    UnknownModel(String, String),
    /// It opened but reports nothing.
    #[error("{0}: the robot answers but sends no information packets within {1:?}; switch it off and on")]
    Silent(String, Duration),
}
