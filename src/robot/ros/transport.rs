//! What carries messages to a robot and from it.

use std::ffi::OsStr;
use std::io;
use std::time::Duration;

use super::{Kind, Message};

/// Why there is no robot at the other end.
#[derive(Debug, thiserror::Error)]
pub enum RosError {
    /// Nobody answers there.
    #[error("{0}: {1}")]
    Master(String, io::Error),
    /// It answers, and refuses.
    #[error("{0}: {1}")]
    Refused(String, String),
    /// A topic without which no robot can be driven is not there.
    #[error("{0}: {1}")]
    Lacks(String, String),
}

/// What came.
#[derive(Clone, Debug, PartialEq)]
pub enum Incoming {
    /// A message on a topic.
    Message(String, Message),
    /// Something is wrong with a topic, for people.
    Trouble(String),
    /// Nobody will hear or say anything any more.
    Lost(String),
}

/// One end of ROS. Dropping it says good-bye.
pub trait Transport: Send {
    /// What to call it in messages.
    fn name(&self) -> String;

    /// Topics that are published, and their types.
    ///
    /// # Errors
    /// When nobody answers.
    fn topics(&self) -> Result<Vec<(String, String)>, RosError>;

    /// Makes a topic known on which we shall publish; a `latched` one shows its last message to whoever comes later.
    ///
    /// # Errors
    /// When it is refused.
    fn advertise(&mut self, topic: &str, kind: Kind, latched: bool) -> Result<(), RosError>;

    /// Listens to a topic.
    ///
    /// # Errors
    /// When it is refused.
    fn subscribe(&mut self, topic: &str, kind: Kind) -> Result<(), RosError>;

    /// Says it to all who listen.
    fn publish(&mut self, topic: &str, message: &Message);

    /// How many listen.
    fn listeners(&self, topic: &str) -> usize;

    /// What has come, waiting at most `wait` for the first.
    fn take(&mut self, wait: Duration) -> Vec<Incoming>;

    /// Lets a second process of `program` say `zero` to each listener of `topic` when this one is killed or stopped.
    fn guard(&mut self, program: &OsStr, topic: &str, zero: &Message);

    /// Says good-bye, when it has not been said; nothing more is said or heard.
    fn leave(&mut self);
}
