//! Foxglove's protobuf messages that make a frame.

use foxglove::Decode;
use foxglove::messages as fox;
use nalgebra::Isometry3;

use super::ros::{intrinsics, isometry};
use super::{Header, Image, Info, Sensed, Transform, frame_name};
use crate::recording::time;

/// Decodes a message of the named type.
pub(super) fn decode(name: &str, data: &[u8], log_ns: u64) -> Result<Sensed, String> {
    let header = |stamp, frame: String| Header {
        stamp_ns: time::of_timestamp(stamp).unwrap_or(log_ns),
        frame: frame_name(&frame),
    };
    Ok(match name {
        "foxglove.RawImage" => {
            let m = parse::<fox::RawImage>(data)?;
            let (header, data) = (header(m.timestamp, m.frame_id), m.data.to_vec());
            let (width, height, step, encoding) = (m.width, m.height, m.step, m.encoding);
            Sensed::Image(Image::Raw { header, width, height, step, encoding, big_endian: false, data })
        }
        "foxglove.CompressedImage" => {
            let m = parse::<fox::CompressedImage>(data)?;
            let header = header(m.timestamp, m.frame_id);
            Sensed::Image(Image::Compressed { header, format: m.format, data: m.data.to_vec() })
        }
        "foxglove.CameraCalibration" => {
            let m = parse::<fox::CameraCalibration>(data)?;
            let (header, intrinsics) = (header(m.timestamp, m.frame_id), intrinsics(&m.k));
            let (width, height) = (m.width, m.height);
            Sensed::Info(Info { header, width, height, intrinsics, binning: [1; 2], window: [0; 4] })
        }
        "foxglove.FrameTransform" => Sensed::Transforms(vec![transform(parse(data)?, log_ns)]),
        "foxglove.FrameTransforms" => {
            let all = parse::<fox::FrameTransforms>(data)?.transforms;
            Sensed::Transforms(all.into_iter().map(|one| transform(one, log_ns)).collect())
        }
        "foxglove.PoseInFrame" => {
            let m = parse::<fox::PoseInFrame>(data)?;
            let Header { stamp_ns, frame: parent } = header(m.timestamp, m.frame_id);
            let pose = m.pose.unwrap_or_default();
            let parent_from_child = placed(pose.position, pose.orientation);
            Sensed::Odometry(Transform { stamp_ns, parent, child: "base_link".to_string(), parent_from_child })
        }
        _ => Sensed::Other,
    })
}

/// Whether [`decode`] knows the type.
pub(super) fn knows(name: &str) -> bool {
    matches!(
        name.strip_prefix("foxglove."),
        Some(
            "RawImage" | "CompressedImage" | "CameraCalibration" | "FrameTransform" | "FrameTransforms" | "PoseInFrame"
        )
    )
}

fn parse<T: Decode>(data: &[u8]) -> Result<T, String> {
    T::decode(data).map_err(|error| error.to_string())
}

fn transform(one: fox::FrameTransform, log_ns: u64) -> Transform {
    Transform {
        stamp_ns: time::of_timestamp(one.timestamp).unwrap_or(log_ns),
        parent: frame_name(&one.parent_frame_id),
        child: frame_name(&one.child_frame_id),
        parent_from_child: placed(one.translation, one.rotation),
    }
}

fn placed(position: Option<fox::Vector3>, rotation: Option<fox::Quaternion>) -> Isometry3<f64> {
    let p = position.unwrap_or_default();
    let q = rotation.unwrap_or(fox::Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 });
    isometry([p.x, p.y, p.z], [q.x, q.y, q.z, q.w])
}
