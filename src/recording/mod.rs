//! MCAP in and out, and live over a WebSocket.
//!
//! Spatial data as Foxglove's protobuf schemas, our own records as JSON, one
//! line one message, byte for byte. Times are the trial's own seconds from
//! zero, so that the same trial gives the same file.
//!
//! Frames come out of logs of any robot: ROS 2, ROS 1 and Foxglove messages.
//! What is damaged, missing or not read is named, and everything else read.

mod assembly;
mod chunk;
mod error;
mod follow;
mod frame_reader;
mod frame_writer;
mod lens;
mod link;
#[cfg_attr(not(feature = "live"), path = "no_live.rs")]
mod live;
mod log_reader;
mod log_writer;
mod losses;
mod mcap_sink;
mod mount;
mod narrator;
pub(crate) mod outputs;
mod pace;
mod parts;
mod pictures;
mod place;
mod record_reader;
mod record_schema;
mod recorder;
mod roles;
mod rvl;
mod sensed;
mod shapes;
mod sink;
mod sorted_log;
mod spaces;
mod story;
mod survey;
mod time;
mod timed_frame;
mod transform_tree;
mod trial_log;
mod trial_sinks;
mod window;

pub use error::{LogError, Loss};
pub use follow::Follow;
pub use frame_reader::{FrameOptions, FrameReader, Messages};
pub use frame_writer::FrameWriter;
pub use live::Live;
pub use log_reader::LogReader;
pub use narrator::{Narration, Narrator};
pub use outputs::{Outputs, TruePiece, spoken};
pub use parts::{Parts, recordings};
pub use record_reader::{RecordReader, records};
pub use recorder::{About, OPTIONS_TOPIC, Recorder};
pub use shapes::ShownPiece;
pub use story::{BelievedPiece, Stories, Story, Told};
pub use time::nanoseconds;
pub use timed_frame::TimedFrame;
pub use trial_log::TrialLog;
pub use trial_sinks::Target;
pub use window::Window;
