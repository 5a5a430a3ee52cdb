//! Furniture, walls, grids and echoes as Foxglove's messages.

use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{
    Color, Grid, LinePrimitive, PackedElementField, Point3, PointCloud, Pose as Pose3, Quaternion, SceneEntity,
    SceneUpdate, TextPrimitive, TriangleListPrimitive, Vector2, Vector3, line_primitive,
};

use super::time::timestamp;
use crate::geometry::{ClearanceGrid, Pose, Vec2};

/// A piece of furniture to be shown.
#[derive(Clone, Debug)]
pub struct ShownPiece<'a> {
    /// Its name.
    pub label: String,
    /// Corners on the floor, counter-clockwise, metres.
    pub corners: &'a [Vec2],
    /// Metres.
    pub height: f64,
}

pub(super) fn pose3(pose: Pose) -> Pose3 {
    let (sin, cos) = (pose.heading / 2.0).sin_cos();
    Pose3 {
        position: Some(Vector3 { x: pose.x, y: pose.y, z: 0.0 }),
        orientation: Some(Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }),
    }
}

fn point(p: Vec2, z: f64) -> Point3 {
    Point3 { x: p.x, y: p.y, z }
}

fn entity(id: &str, time_ns: u64) -> SceneEntity {
    SceneEntity {
        timestamp: Some(timestamp(time_ns)),
        frame_id: "map".to_string(),
        id: id.to_string(),
        ..SceneEntity::default()
    }
}

/// The walls of a room map.
pub(super) fn walls(walls: &[(Vec2, Vec2)], height: f64) -> SceneUpdate {
    let points = walls.iter().flat_map(|(a, b)| [point(*a, height / 2.0), point(*b, height / 2.0)]).collect();
    let line = LinePrimitive {
        r#type: line_primitive::Type::LineList as i32,
        pose: Some(pose3(Pose::default())),
        thickness: 0.05,
        points,
        color: Some(Color { r: 0.3, g: 0.3, b: 0.35, a: 1.0 }),
        ..LinePrimitive::default()
    };
    let entity = SceneEntity { lines: vec![line], ..entity("walls", 0) };
    SceneUpdate { deletions: Vec::new(), entities: vec![entity] }
}

/// Furniture as prisms with their names.
pub(super) fn furniture(layer: &str, time_ns: u64, pieces: &[ShownPiece], color: Color) -> SceneUpdate {
    let entities = pieces.iter().map(|piece| SceneEntity {
        triangles: vec![prism(piece, color)],
        texts: vec![label(piece)],
        ..entity(&format!("{layer}/{}", piece.label), time_ns)
    });
    SceneUpdate { deletions: Vec::new(), entities: entities.collect() }
}

/// Top and sides of a prism as triangles.
fn prism(piece: &ShownPiece, color: Color) -> TriangleListPrimitive {
    let corners = piece.corners;
    let mut points = Vec::new();
    for i in 0..corners.len() {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let h = piece.height;
        points.extend([point(a, 0.0), point(b, 0.0), point(b, h), point(a, 0.0), point(b, h), point(a, h)]);
        if i + 1 < corners.len() && i > 0 {
            points.extend([point(corners[0], h), point(a, h), point(b, h)]);
        }
    }
    TriangleListPrimitive {
        pose: Some(pose3(Pose::default())),
        points,
        color: Some(color),
        ..TriangleListPrimitive::default()
    }
}

fn label(piece: &ShownPiece) -> TextPrimitive {
    let sum = piece.corners.iter().fold(Vec2::zeros(), |sum, corner| sum + corner);
    let middle = sum / piece.corners.len().max(1) as f64;
    let mut pose = pose3(Pose::new(middle.x, middle.y, 0.0));
    pose.position = Some(Vector3 { x: middle.x, y: middle.y, z: piece.height + 0.1 });
    TextPrimitive {
        pose: Some(pose),
        billboard: true,
        font_size: 0.15,
        color: Some(Color { r: 0.1, g: 0.1, b: 0.1, a: 1.0 }),
        text: piece.label.clone(),
        ..TextPrimitive::default()
    }
}

/// The clearance of each cell, metres, as one float a cell.
pub(super) fn grid(time_ns: u64, clearance: &ClearanceGrid) -> Grid {
    let (width, height) = clearance.size();
    let half = clearance.cell_m() / 2.0;
    let corner = clearance.centre((0, 0)) - Vec2::repeat(half);
    let cells = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y)));
    let data: Vec<u8> = cells.flat_map(|cell| (clearance.clearance(cell) as f32).to_le_bytes()).collect();
    Grid {
        timestamp: Some(timestamp(time_ns)),
        frame_id: "map".to_string(),
        pose: Some(pose3(Pose::new(corner.x, corner.y, 0.0))),
        column_count: width as u32,
        cell_size: Some(Vector2 { x: clearance.cell_m(), y: clearance.cell_m() }),
        row_stride: 4 * width as u32,
        cell_stride: 4,
        fields: vec![float_field("clearance_m", 0)],
        data: data.into(),
    }
}

/// Echoes about the robot, metres from its centre, at the height of its sonars.
pub(super) fn echoes(time_ns: u64, points: &[Vec2]) -> PointCloud {
    const SONAR_HEIGHT_M: f32 = 0.2;
    let floats = points.iter().flat_map(|p| [p.x as f32, p.y as f32, SONAR_HEIGHT_M]);
    let data: Vec<u8> = floats.flat_map(f32::to_le_bytes).collect();
    PointCloud {
        timestamp: Some(timestamp(time_ns)),
        frame_id: "base_link".to_string(),
        pose: Some(pose3(Pose::default())),
        point_stride: 12,
        fields: ["x", "y", "z"].iter().zip([0, 4, 8]).map(|(name, offset)| float_field(name, offset)).collect(),
        data: data.into(),
    }
}

fn float_field(name: &str, offset: u32) -> PackedElementField {
    PackedElementField { name: name.to_string(), offset, r#type: NumericType::Float32 as i32 }
}
