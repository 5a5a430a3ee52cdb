//! Where the camera was, when nobody says: over the floor that the depth shows, looking along x.
//!
//! For single pictures without a pose, a lab's own or a data set's. The floor
//! is the lowest large plane that a camera held about upright sees below it;
//! which way is north no picture tells.

use nalgebra::{Matrix3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::frame::Intrinsics;

/// Points farther off are too coarse, metres.
const FARTHEST_M: f64 = 6.0;
/// Every so many-th pixel is read, along both sides.
const STRIDE: usize = 8;
/// Planes tried.
const TRIES: usize = 900;
/// A camera is held at most so much askew, cosine of 50° between the picture's up and the floor's.
const LEAST_UPRIGHT: f64 = 0.64;
/// Points nearer than this lie on a plane, metres, and farther below it are under it.
const ON_M: f64 = 0.025;
const UNDER_M: f64 = 0.1;
/// Fewer of the points on it make no floor.
const LEAST_SHARE: f64 = 0.03;

type Point = Vector3<f64>;

/// A plane in the camera's optical frame: the direction up from it, and how high above it the camera is, metres.
#[derive(Clone, Copy, Debug)]
struct Floor {
    up: Point,
    height: f64,
}

impl Floor {
    /// Metres above it.
    fn above(&self, point: &Point) -> f64 {
        self.up.dot(point) + self.height
    }

    /// How many points lie on it, less those under it: what is under a table's top is floor, under a floor is noise.
    fn support(&self, points: &[Point]) -> f64 {
        let mut support = 0.0;
        for above in points.iter().map(|point| self.above(point)) {
            support += if above.abs() < ON_M { 1.0 } else { 0.0 };
            support -= if above < -UNDER_M { 1.0 } else { 0.0 };
        }
        support
    }

    fn is_plausible(&self) -> bool {
        -self.up.y > LEAST_UPRIGHT && (0.15..3.0).contains(&self.height)
    }

    /// The plane through the points near this one.
    fn refined(&self, points: &[Point]) -> Option<Self> {
        let near: Vec<&Point> = points.iter().filter(|point| self.above(point).abs() < 1.5 * ON_M).collect();
        let middle = near.iter().copied().sum::<Point>() / near.len().max(1) as f64;
        let spread: Matrix3<f64> = near.iter().map(|point| (*point - middle) * (*point - middle).transpose()).sum();
        let eigen = spread.symmetric_eigen();
        let least = eigen.eigenvalues.imin();
        let normal = Point::from(eigen.eigenvectors.column(least));
        let up = if normal.y > 0.0 { -normal } else { normal };
        let refined = Self { up, height: -up.dot(&middle) };
        refined.is_plausible().then_some(refined)
    }
}

/// The camera's pose over the floor it sees, 4 × 4 by rows as `T_world_cam` has it: at x = y = 0, looking along x.
///
/// `depth` row by row in units of `unit_m` metres. Nothing when no floor shows.
pub fn camera_over_floor(depth: &[u16], width: usize, intrinsics: &Intrinsics, unit_m: f64) -> Option<[[f64; 4]; 4]> {
    let points = points(depth, width, intrinsics, unit_m);
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let tried = (0..TRIES).filter_map(|_| through_three(&points, &mut rng));
    let supported = tried.map(|floor| (floor.support(&points), floor));
    let (support, floor) = supported.max_by(|a, b| a.0.total_cmp(&b.0))?;
    if support < LEAST_SHARE * points.len() as f64 {
        return None;
    }
    let Floor { up, height } = floor.refined(&points).and_then(|floor| floor.refined(&points)).unwrap_or(floor);
    // x is where the optical axis points along the floor, y to its left.
    let x = (Point::z() - up * up.z).normalize();
    let y = up.cross(&x);
    let row = |axis: Point, at: f64| [axis.x, axis.y, axis.z, at];
    Some([row(x, 0.0), row(y, 0.0), row(up, height), [0.0, 0.0, 0.0, 1.0]])
}

/// Every so many-th point, in the camera's optical frame.
fn points(depth: &[u16], width: usize, k: &Intrinsics, unit_m: f64) -> Vec<Point> {
    let rows = (0..depth.len() / width.max(1)).step_by(STRIDE);
    let pixels = rows.flat_map(|row| (0..width).step_by(STRIDE).map(move |column| (column, row)));
    let point = |(column, row): (usize, usize)| {
        let z = f64::from(depth[row * width + column]) * unit_m;
        let (right, down) = ((column as f64 - k.cx) / k.fx, (row as f64 - k.cy) / k.fy);
        (z > 0.3 && z < FARTHEST_M).then(|| Point::new(right * z, down * z, z))
    };
    pixels.filter_map(point).collect()
}

/// A plausible floor through three random points.
fn through_three(points: &[Point], rng: &mut ChaCha8Rng) -> Option<Floor> {
    let mut any = || points.get((rng.next_u64() % points.len().max(1) as u64) as usize);
    let (a, b, c) = (any()?, any()?, any()?);
    let normal = (b - a).cross(&(c - a)).try_normalize(1e-3)?;
    let up = if normal.y > 0.0 { -normal } else { normal };
    let floor = Floor { up, height: -up.dot(a) };
    floor.is_plausible().then_some(floor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::camera::{Kinect, SolidScene};

    #[test]
    fn the_tower_s_height_and_tilt_are_read_off_the_floor() {
        let scene = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
        let pose = Pose::new(3.0, 2.0, 0.4);
        let (frame, _) = Kinect::default().capture(&scene, pose, &mut ChaCha8Rng::seed_from_u64(1));
        let found = camera_over_floor(&frame.depth, frame.width, &frame.intrinsics, frame.depth_unit_m);
        let (found, true_pose) = (found.expect("a floor"), frame.world_from_camera);
        assert!((found[2][3] - true_pose[2][3]).abs() < 0.03, "{} m", found[2][3]);
        for axis in 0..3 {
            assert!((found[2][axis] - true_pose[2][axis]).abs() < 0.02, "{:?}", found[2]);
        }
    }

    #[test]
    fn a_picture_of_nothing_but_a_wall_tells_no_pose() {
        let k = Intrinsics { fx: 525.0, fy: 525.0, cx: 319.5, cy: 239.5 };
        assert_eq!(camera_over_floor(&vec![2000; 640 * 480], 640, &k, 0.001), None);
        assert_eq!(camera_over_floor(&vec![0; 640 * 480], 640, &k, 0.001), None);
    }
}
