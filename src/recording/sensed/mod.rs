//! What a message of a robot's log says, whatever wrote it: ROS 1, ROS 2 or Foxglove.

mod foxglove;
mod ros;
mod wire;

use mcap::{Channel, Message};
use nalgebra::Isometry3;

use crate::frame::Intrinsics;
use wire::Wire;

/// When and in which frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) stamp_ns: u64,
    pub(super) frame: String,
}

/// A picture, not yet decoded.
#[derive(Clone, Debug)]
pub(super) enum Image {
    Raw { header: Header, width: u32, height: u32, step: u32, encoding: String, big_endian: bool, data: Vec<u8> },
    Compressed { header: Header, format: String, data: Vec<u8> },
}

/// A camera's description; no intrinsics when its matrix is empty.
#[derive(Clone, Debug)]
pub(super) struct Info {
    pub(super) header: Header,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) intrinsics: Option<Intrinsics>,
    /// Pixels of the sensor that make one of the picture, across and down; 0 is 1.
    pub(super) binning: [u32; 2],
    /// The part of the sensor that was read: column, row, width, height; all of it when there is no width.
    pub(super) window: [u32; 4],
}

/// The name of a frame: ROS 1's leading slash says nothing.
fn frame_name(name: &str) -> String {
    name.trim_start_matches('/').to_string()
}

/// Where a frame is within another, metres.
#[derive(Clone, Debug)]
pub(super) struct Transform {
    pub(super) stamp_ns: u64,
    pub(super) parent: String,
    pub(super) child: String,
    pub(super) parent_from_child: Isometry3<f64>,
}

/// One message, understood.
#[derive(Clone, Debug)]
pub(super) enum Sensed {
    Image(Image),
    Info(Info),
    Transforms(Vec<Transform>),
    /// Odometry, or a pose of the robot: where its base is.
    Odometry(Transform),
    /// Nothing that makes a frame.
    Other,
}

/// How a channel's messages are to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// By this module.
    Known,
    /// They would make frames, were their encoding known.
    UnknownEncoding,
    /// They are of no use here.
    Useless,
}

/// The kinds of encoding: of the message, and the schema's.
pub(super) fn reading_of(channel: &Channel) -> Reading {
    let Some(schema) = &channel.schema else { return Reading::Useless };
    let name = ros_name(&schema.name);
    if !ros::knows(&name) && !foxglove::knows(&schema.name) {
        return Reading::Useless;
    }
    match (channel.message_encoding.as_str(), foxglove::knows(&schema.name)) {
        ("cdr" | "ros1", false) | ("protobuf", true) => Reading::Known,
        _ => Reading::UnknownEncoding,
    }
}

/// Decodes a message whose channel is [`Reading::Known`]; an error says what is wrong with its bytes.
pub(super) fn decode(message: &Message) -> Result<Sensed, String> {
    let Some(schema) = &message.channel.schema else { return Ok(Sensed::Other) };
    let wire = match message.channel.message_encoding.as_str() {
        "protobuf" => return foxglove::decode(&schema.name, &message.data, message.log_time),
        "cdr" => Wire::cdr(&message.data).map_err(|error| error.to_string())?,
        _ => Wire::ros1(&message.data),
    };
    ros::decode(&ros_name(&schema.name), wire).map_err(|error| error.to_string())
}

/// `sensor_msgs/msg/Image` and `sensor_msgs/Image` are one type.
fn ros_name(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}

impl Image {
    pub(super) fn header(&self) -> &Header {
        match self {
            Self::Raw { header, .. } | Self::Compressed { header, .. } => header,
        }
    }

    /// Gives it another stamp: some drivers leave it at zero.
    pub(super) fn restamp(&mut self, to_ns: u64) {
        match self {
            Self::Raw { header, .. } | Self::Compressed { header, .. } => header.stamp_ns = to_ns,
        }
    }

    /// Whether it may hold depth: 16 bits of grey may be infrared as well.
    pub(super) fn may_be_depth(&self) -> bool {
        let is_grey = |encoding: &str| encoding.to_ascii_lowercase().starts_with("mono16");
        self.is_depth()
            || match self {
                Self::Raw { encoding, .. } => is_grey(encoding),
                Self::Compressed { format, .. } => is_grey(format),
            }
    }

    /// Whether it holds depth rather than colour, by its encoding.
    pub(super) fn is_depth(&self) -> bool {
        match self {
            Self::Raw { encoding, .. } => {
                matches!(encoding.to_ascii_lowercase().as_str(), "16uc1" | "32fc1")
            }
            Self::Compressed { format, .. } => {
                let format = format.to_ascii_lowercase();
                format.contains("compresseddepth") || format.starts_with("16uc1") || format.starts_with("32fc1")
            }
        }
    }
}
