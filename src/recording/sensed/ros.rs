//! The messages of ROS that make a frame: sensor_msgs, tf2_msgs, nav_msgs, of ROS 1 and ROS 2.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::wire::{Wire, WireError};
use super::{Header, Image, Info, Sensed, Transform, frame_name};
use crate::frame::Intrinsics;
use crate::recording::time;

/// Decodes a message of the named type, `sensor_msgs/Image` for both `sensor_msgs/Image` and `sensor_msgs/msg/Image`.
pub(super) fn decode(name: &str, mut wire: Wire) -> Result<Sensed, WireError> {
    match name {
        "sensor_msgs/Image" => image(&mut wire),
        "sensor_msgs/CompressedImage" => compressed(&mut wire),
        "sensor_msgs/CameraInfo" => info(&mut wire),
        "nav_msgs/Odometry" => odometry(&mut wire),
        "tf2_msgs/TFMessage" | "tf/tfMessage" => transforms(&mut wire),
        _ => Ok(Sensed::Other),
    }
}

/// Whether [`decode`] knows the type.
pub(super) fn knows(name: &str) -> bool {
    matches!(
        name,
        "sensor_msgs/Image"
            | "sensor_msgs/CompressedImage"
            | "sensor_msgs/CameraInfo"
            | "nav_msgs/Odometry"
            | "tf2_msgs/TFMessage"
            | "tf/tfMessage"
    )
}

fn header(wire: &mut Wire) -> Result<Header, WireError> {
    if wire.is_ros1() {
        wire.u32()?;
    }
    let stamp_ns = time::of_parts(wire.u32()?, wire.u32()?);
    Ok(Header { stamp_ns, frame: frame_name(&wire.string()?) })
}

fn image(wire: &mut Wire) -> Result<Sensed, WireError> {
    let header = header(wire)?;
    let (height, width) = (wire.u32()?, wire.u32()?);
    let encoding = wire.string()?;
    let big_endian = wire.u8()? != 0;
    let step = wire.u32()?;
    let data = wire.bytes()?.to_vec();
    Ok(Sensed::Image(Image::Raw { header, width, height, step, encoding, big_endian, data }))
}

fn compressed(wire: &mut Wire) -> Result<Sensed, WireError> {
    let header = header(wire)?;
    let format = wire.string()?;
    Ok(Sensed::Image(Image::Compressed { header, format, data: wire.bytes()?.to_vec() }))
}

fn info(wire: &mut Wire) -> Result<Sensed, WireError> {
    let header = header(wire)?;
    let (height, width) = (wire.u32()?, wire.u32()?);
    wire.string()?;
    for _ in 0..wire.u32()? {
        wire.f64()?;
    }
    let k = wire.f64s::<9>()?;
    // Rectification and projection, which depth needs no more.
    wire.f64s::<21>()?;
    let binning = [wire.u32()?, wire.u32()?];
    let [column, row, window_height, window_width] = [wire.u32()?, wire.u32()?, wire.u32()?, wire.u32()?];
    let window = [column, row, window_width, window_height];
    Ok(Sensed::Info(Info { header, width, height, intrinsics: intrinsics(&k), binning, window }))
}

/// The camera of a row-major 3 × 3 matrix; nothing when it was left empty.
pub(super) fn intrinsics(k: &[f64]) -> Option<Intrinsics> {
    let &[fx, _, cx, _, fy, cy, ..] = k else { return None };
    let sound = fx > 1.0 && fy > 1.0 && [fx, fy, cx, cy].iter().all(|v| v.is_finite());
    sound.then_some(Intrinsics { fx, fy, cx, cy })
}

fn pose(wire: &mut Wire) -> Result<Isometry3<f64>, WireError> {
    let [x, y, z, i, j, k, w] = wire.f64s::<7>()?;
    Ok(isometry([x, y, z], [i, j, k, w]))
}

/// A pose from a position and a quaternion x, y, z, w; an empty quaternion is no turn.
pub(super) fn isometry([x, y, z]: [f64; 3], [i, j, k, w]: [f64; 4]) -> Isometry3<f64> {
    let rotation = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 1e-9).unwrap_or_default();
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

fn odometry(wire: &mut Wire) -> Result<Sensed, WireError> {
    let Header { stamp_ns, frame: parent } = header(wire)?;
    let child = frame_name(&wire.string()?);
    let child = if child.is_empty() { "base_link".to_string() } else { child };
    let parent_from_child = pose(wire)?;
    Ok(Sensed::Odometry(Transform { stamp_ns, parent, child, parent_from_child }))
}

fn transforms(wire: &mut Wire) -> Result<Sensed, WireError> {
    let mut all = Vec::new();
    for _ in 0..wire.u32()? {
        let Header { stamp_ns, frame: parent } = header(wire)?;
        let child = frame_name(&wire.string()?);
        all.push(Transform { stamp_ns, parent, child, parent_from_child: pose(wire)? });
    }
    Ok(Sensed::Transforms(all))
}
