//! The camera of a robot that runs ROS 1: colour, depth, camera descriptions and transforms, as they are said.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use mcap::{Channel, Message, Schema};

use super::frame_stream::Take;
use crate::frame::placed;
use crate::geometry::{Pose, wrap_angle};
use crate::recording::{FrameOptions, FrameReader, Loss, TimedFrame};
use crate::robot::ros::ros1::{Raw, Ros1};
use crate::robot::ros::{Names, Transport};

/// One wait for a message.
const WAIT: Duration = Duration::from_millis(100);
/// Words in a topic's name that make it the better one, best first.
const DEPTH: [&str; 3] = ["depth_registered", "aligned_depth", "depth"];
const COLOR: [&str; 3] = ["rgb", "color", "image"];

/// Which camera.
#[derive(Clone, Debug)]
pub struct RosCamera {
    /// The master, `HOST:PORT`.
    pub master: String,
    /// Names of topics.
    pub names: Names,
    /// Where the robot's odometry begins in the map.
    pub origin: Arc<Mutex<Pose>>,
}

/// The topics of depth and colour: the first whose name says so, raw before anything else.
fn pictures(topics: &[(String, String)]) -> Vec<String> {
    let raw = || topics.iter().filter(|(_, kind)| kind == "sensor_msgs/Image").map(|(topic, _)| topic);
    let depth = DEPTH.iter().find_map(|word| raw().find(|topic| topic.contains(word)));
    let mut other = COLOR.iter().flat_map(|word| raw().filter(move |topic| topic.contains(word)));
    let color = other.find(|topic| !DEPTH.iter().any(|word| topic.contains(word)) && !topic.contains("/ir"));
    depth.into_iter().chain(color).cloned().collect()
}

/// Messages of a node as those of a log that never ends.
struct Live<'a, 'b> {
    node: Ros1,
    take: &'a RefCell<&'b mut Take<'b>>,
    channels: BTreeMap<String, Arc<Channel<'static>>>,
    sequence: u32,
}

impl Live<'_, '_> {
    fn message(&mut self, raw: Raw) -> Message<'static> {
        let id = self.channels.len() as u16 + 1;
        let channel = self.channels.entry(raw.topic.clone()).or_insert_with(|| {
            let data = Cow::Owned(raw.definition.as_bytes().to_vec());
            let schema = Schema { id, name: raw.kind.clone(), encoding: "ros1msg".into(), data };
            let (topic, schema) = (raw.topic.clone(), Some(Arc::new(schema)));
            let message_encoding = "ros1".into();
            Arc::new(Channel { id, topic, schema, message_encoding, metadata: BTreeMap::new() })
        });
        self.sequence += 1;
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_nanos() as u64;
        let (channel, data) = (Arc::clone(channel), Cow::Owned(raw.bytes));
        Message { channel, sequence: self.sequence, log_time: now, publish_time: now, data }
    }
}

impl Iterator for Live<'_, '_> {
    type Item = Result<Message<'static>, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.node.take_raw(WAIT) {
                Ok(Some(raw)) => return Some(Ok(self.message(raw))),
                Err(_) if self.node.is_lost() => return None,
                Err(what) => return Some(Err(Loss(what))),
                Ok(None) => {}
            }
            if !(self.take.borrow_mut())(None) {
                return None;
            }
        }
    }
}

impl RosCamera {
    /// Hands over frames for as long as they are wanted.
    pub(super) fn stream(&self, take: &mut Take) -> Result<(), String> {
        let mut node = Ros1::join(&self.master, "fetch_camera").map_err(|error| error.to_string())?;
        let topics = node.topics().map_err(|error| error.to_string())?;
        let chosen = pictures(&topics);
        if chosen.is_empty() {
            return Err(format!("{}: no sensor_msgs/Image is published whose name says depth or colour", node.name()));
        }
        let odometry = self.names.of("/odom");
        for (topic, kind) in &topics {
            let wanted = match kind.as_str() {
                "sensor_msgs/Image" => chosen.contains(topic),
                "sensor_msgs/CameraInfo" | "tf2_msgs/TFMessage" => true,
                "nav_msgs/Odometry" => *topic == odometry,
                _ => false,
            };
            if wanted {
                node.subscribe_raw(topic, kind).map_err(|error| error.to_string())?;
            }
        }
        let taker: RefCell<&mut Take> = RefCell::new(take);
        let live = Live { node, take: &taker, channels: BTreeMap::new(), sequence: 0 };
        let options = FrameOptions { topics: chosen, ..FrameOptions::default() };
        for frame in FrameReader::of(live, options).flatten() {
            if !(taker.borrow_mut())(Some(self.in_map(frame))) {
                break;
            }
        }
        Ok(())
    }

    /// The frame of a robot that knows where it is by its own odometry.
    fn in_map(&self, timed: TimedFrame) -> TimedFrame {
        let Some(own) = timed.robot else { return timed };
        let origin = *self.origin.lock().unwrap_or_else(PoisonError::into_inner);
        let at = origin.to_world(own.position());
        let robot = Pose::new(at.x, at.y, wrap_angle(origin.heading + own.heading));
        let mut frame = timed.frame;
        frame.world_from_camera = placed(&frame.world_from_camera, origin);
        TimedFrame { robot: Some(robot), frame, ..timed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_that_lies_on_colour_is_taken_before_depth_alone_and_infrared_never() {
        let topics = [
            "/camera/ir/image_raw",
            "/camera/depth/image_raw",
            "/camera/depth_registered/image_raw",
            "/camera/rgb/image_raw",
        ];
        let topics = topics.map(|topic| (topic.to_string(), "sensor_msgs/Image".to_string()));
        assert_eq!(pictures(&topics), ["/camera/depth_registered/image_raw", "/camera/rgb/image_raw"]);
    }
}
