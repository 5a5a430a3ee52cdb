//! Depth as small pieces of surface: points of a coarse raster, each with the way it faces where it is flat.

use nalgebra::Vector3;

use crate::frame::Intrinsics;

/// A point or direction in the camera's optical frame (x right, y down, z ahead), metres.
pub(super) type Point = Vector3<f64>;

/// Points nearer or farther are too coarse, metres.
const NEAREST_M: f64 = 0.25;
const FARTHEST_M: f64 = 7.0;
/// The raster is about so many points wide: 80 of 640 pixels.
const COLUMNS: usize = 80;
/// A point's normal is told from its neighbours so many raster points away.
const APART: i64 = 2;

/// A depth picture with its camera.
#[derive(Clone, Copy, Debug)]
pub struct Depths<'a> {
    /// Row by row, in units of `unit_m`; 0 where nothing came back.
    pub pixels: &'a [u16],
    /// Pixels across.
    pub width: usize,
    /// The camera.
    pub intrinsics: Intrinsics,
    /// Metres a unit.
    pub unit_m: f64,
}

/// A piece of surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub(super) at: Point,
    /// Towards the camera; none where the surface is bent, broken or seen in part.
    pub(super) normal: Option<Point>,
}

impl Surface {
    /// How much it faces a direction: 1 towards it, 0 across it; none where it faces no way.
    pub(super) fn faces(&self, direction: &Point) -> Option<f64> {
        self.normal.map(|normal| normal.dot(direction))
    }
}

/// The picture's surfaces, row by row, without the places where nothing came back.
pub(super) fn surfaces(depths: &Depths) -> Vec<Surface> {
    let step = (depths.width / COLUMNS).max(1) as i64;
    let height = depths.pixels.len() / depths.width.max(1);
    let (columns, rows) = ((depths.width as i64).div_euclid(step), (height as i64).div_euclid(step));
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column * step, row * step)));
    places.filter_map(|place| surface(depths, place, APART * step)).collect()
}

fn surface(depths: &Depths, (column, row): (i64, i64), apart: i64) -> Option<Surface> {
    let at = point(depths, column, row)?;
    let normal = || {
        let beside = [(-apart, 0), (apart, 0), (0, -apart), (0, apart)];
        let [left, right, above, below] = beside.map(|(x, y)| point(depths, column + x, row + y));
        let neighbours = [left?, right?, above?, below?];
        let [left, right, above, below] = neighbours;
        let normal = (right - left).cross(&(below - above)).try_normalize(1e-9)?;
        let bend = neighbours.iter().map(|near| (near - at).dot(&normal).abs()).fold(0.0, f64::max);
        // An edge bends the surface far beyond what the depth's noise does.
        let flat = bend < 0.03 + 0.006 * at.z * at.z;
        flat.then(|| if normal.dot(&at) > 0.0 { -normal } else { normal })
    };
    Some(Surface { at, normal: normal() })
}

fn point(depths: &Depths, column: i64, row: i64) -> Option<Point> {
    let (x, y) = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
    if x >= depths.width {
        return None;
    }
    let z = f64::from(*depths.pixels.get(y * depths.width + x)?) * depths.unit_m;
    let k = depths.intrinsics;
    let (right, down) = ((column as f64 - k.cx) / k.fx, (row as f64 - k.cy) / k.fy);
    (NEAREST_M..FARTHEST_M).contains(&z).then(|| Point::new(right * z, down * z, z))
}
