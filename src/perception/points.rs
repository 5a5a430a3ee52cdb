//! Depth pixels as points over the floor, seen from the camera's place on it.

use super::floor::FloorPlane;
use crate::frame::{Intrinsics, RgbdFrame};
use crate::geometry::Pose;

/// Every so many-th pixel is read, along both sides: at 5 m still two a cell.
pub const STRIDE: usize = 2;
/// Beyond this the sensor's depth steps are coarser than furniture, metres.
pub const FARTHEST_M: f32 = 6.6;

/// How far above a top a point at that range may seem to be by noise and the steps of depth, which grow with its square,
/// metres.
pub fn above_noise(squared_range: f32) -> f32 {
    0.014 + 0.0045 * squared_range
}

/// The points of one frame: x ahead, y to the left, z up, metres; the origin is the floor below the camera.
#[derive(Clone, Debug)]
pub struct Points {
    /// Sampled pixels across.
    pub columns: usize,
    /// Sampled pixels down.
    pub rows: usize,
    /// Row by row; x is 0 where nothing came back.
    pub xyz: Vec<[f32; 3]>,
    /// Where that origin and heading lie in the world.
    pub camera: Pose,
    /// The camera above the floor, metres.
    pub camera_height: f32,
    /// How many metres the uppermost row climbs for each metre ahead.
    pub climb: f32,
    /// The widest row's half width for each metre ahead.
    pub spread: f32,
    /// How pixels become points.
    pub rays: Rays,
}

/// Where each pixel looks, in the frame of the points.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// What is ahead, to the left and up of one metre to the right, down and along the optical axis.
    turn: [[f32; 3]; 3],
    /// Principal point, and metres aside and down for each pixel from it at one metre.
    centre: [f32; 2],
    step: [f32; 2],
    unit: f32,
    height: f32,
    floor: FloorPlane,
}

impl Rays {
    fn of(frame: &RgbdFrame, heading: f64) -> Self {
        let m = &frame.world_from_camera;
        let (sin, cos) = heading.sin_cos();
        // Rows of the rotation from the camera to the frame with x ahead and y to the left.
        let row = |a: usize, b: usize, s: f64, c: f64| [0, 1, 2].map(|k| (c * m[a][k] + s * m[b][k]) as f32);
        let turn = [row(0, 1, sin, cos), row(1, 0, -sin, cos), [0, 1, 2].map(|k| m[2][k] as f32)];
        let Intrinsics { fx, fy, cx, cy } = frame.intrinsics;
        let (centre, step) = ([cx as f32, cy as f32], [(1.0 / fx) as f32, (1.0 / fy) as f32]);
        let (unit, height) = (frame.depth_unit_m as f32, m[2][3] as f32);
        Self { turn, centre, step, unit, height, floor: FloorPlane::default() }
    }

    /// The depth of a point along the optical axis, metres.
    pub fn depth(&self, [x, y, z]: [f32; 3]) -> f32 {
        let [ahead, left, up] = self.turn.map(|row| row[2]);
        ahead * x + left * y + up * (z - self.height)
    }

    /// The point of one pixel; nothing where no depth came back.
    pub fn point(&self, frame: &RgbdFrame, column: usize, row: usize) -> Option<[f32; 3]> {
        let z = f32::from(frame.depth[row * frame.width + column]) * self.unit;
        let right = (column as f32 - self.centre[0]) * self.step[0];
        let down = (row as f32 - self.centre[1]) * self.step[1];
        let axis = |v: &[f32; 3]| (v[0] * right + v[1] * down + v[2]) * z;
        let [x, y, up] = [axis(&self.turn[0]), axis(&self.turn[1]), axis(&self.turn[2]) + self.height];
        (z > 0.0).then(|| [x, y, up - self.floor.at(x, y)])
    }
}

/// The points of a frame, with the floor turned to z = 0.
pub fn points(frame: &RgbdFrame) -> Points {
    let mut points = unproject(frame);
    if let Some(plane) = FloorPlane::fit(&points.xyz) {
        plane.level(&mut points.xyz);
        points.rays.floor = plane;
    }
    points
}

fn unproject(frame: &RgbdFrame) -> Points {
    let m = &frame.world_from_camera;
    let heading = m[1][2].atan2(m[0][2]);
    let rays = Rays::of(frame, heading);
    let [ahead, left, up] = rays.turn;
    let k = frame.intrinsics;
    let across: Vec<f32> =
        (0..frame.width).step_by(STRIDE).map(|column| ((column as f64 - k.cx) / k.fx) as f32).collect();
    let (columns, rows) = (across.len(), frame.height.div_ceil(STRIDE));
    let (unit, height) = (frame.depth_unit_m as f32, m[2][3] as f32);
    let mut xyz = Vec::with_capacity(columns * rows);
    for line in 0..rows {
        let down = ((((line * STRIDE) as f64) - k.cy) / k.fy) as f32;
        let base = |v: &[f32; 3]| v[1] * down + v[2];
        let (bx, by, bz) = (base(&ahead), base(&left), base(&up));
        let depths = frame.depth[line * STRIDE * frame.width..].iter().step_by(STRIDE);
        xyz.extend(across.iter().zip(depths).map(|(&right, &depth)| {
            let z = f32::from(depth) * unit;
            if z > FARTHEST_M {
                return [0.0; 3];
            }
            [
                (ahead[0] * right + bx) * z,
                (left[0] * right + by) * z,
                (up[0] * right + bz) * z + if z > 0.0 { height } else { 0.0 },
            ]
        }));
    }
    let top = ((0.0 - k.cy) / k.fy) as f32;
    let (up_top, ahead_top) = (up[1] * top + up[2], ahead[1] * top + ahead[2]);
    let spread =
        across.iter().fold(0.0_f32, |widest, right| widest.max(right.abs())) / ahead_top.min(ahead[2]).max(0.3);
    Points {
        columns,
        rows,
        xyz,
        camera: Pose::new(m[0][3], m[1][3], heading),
        camera_height: height,
        climb: up_top / ahead_top.max(0.2),
        spread,
        rays,
    }
}
