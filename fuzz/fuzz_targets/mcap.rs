//! Any bytes are read as a log of frames and of records without a panic, strictly and in recovery.
//!
//! The first byte chooses between a log as it is and the body of one message of a type that makes frames.
#![no_main]

use std::collections::BTreeMap;
use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use spatial_fetch::recording::{FrameOptions, FrameReader, LogReader, RecordReader, Window};

const TYPES: [(&str, &str, &str); 9] = [
    ("cdr", "ros2msg", "sensor_msgs/msg/Image"),
    ("cdr", "ros2msg", "sensor_msgs/msg/CompressedImage"),
    ("cdr", "ros2msg", "sensor_msgs/msg/CameraInfo"),
    ("cdr", "ros2msg", "tf2_msgs/msg/TFMessage"),
    ("ros1", "ros1msg", "nav_msgs/Odometry"),
    ("ros1", "ros1msg", "sensor_msgs/Image"),
    ("protobuf", "protobuf", "foxglove.RawImage"),
    ("protobuf", "protobuf", "foxglove.CameraCalibration"),
    ("protobuf", "protobuf", "foxglove.FrameTransforms"),
];

fn read(log: &[u8]) {
    for recover in [false, true] {
        if let Ok(frames) = FrameReader::new(log, "fuzz", FrameOptions { recover, ..FrameOptions::default() }) {
            frames.for_each(drop);
        }
        if let Ok(log) = LogReader::new(log, "fuzz", recover) {
            RecordReader::new(log, "/fetch/plan", Window::default()).for_each(drop);
        }
    }
}

/// A log whose messages are the pieces of `data`: type, length, body.
fn log_of(mut data: &[u8]) -> Option<Vec<u8>> {
    let mut writer = mcap::Writer::new(Cursor::new(Vec::new())).ok()?;
    let mut time = 0;
    while let [kind, length, rest @ ..] = data {
        let (message, encoding, name) = TYPES[usize::from(*kind) % TYPES.len()];
        let body = &rest[..rest.len().min(usize::from(*length) * 8)];
        data = &rest[body.len()..];
        let schema = writer.add_schema(name, encoding, b"").ok()?;
        let channel_id = writer.add_channel(schema, &format!("/{name}"), message, &BTreeMap::new()).ok()?;
        time += 1_000_000;
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, body).ok()?;
    }
    writer.finish().ok()?;
    Some(writer.into_inner().into_inner())
}

fuzz_target!(|data: &[u8]| {
    match data {
        [0, rest @ ..] => {
            let log = log_of(rest);
            read(log.as_deref().unwrap_or_default());
        }
        log => read(log),
    }
});
