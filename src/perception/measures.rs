//! What is measured of a piece: shape, size, height, colour, and how it stands to the walls and the picture.

use super::floor_grid::{CELL_M, FloorGrid};
use super::rectangle::{convex_hull, rectangle_at};
use super::segment::Segment;
use super::walls::Wall;
use crate::geometry::{Polygon, Pose, Vec2, vec2};

/// Upper ends of the bands of height into which the tops are counted, metres.
const BANDS_M: [f32; 9] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.3, 1.7];
/// Cells this much above the plate are a back, arms, or a thing on it, metres.
pub const ABOVE_PLATE_M: f32 = 0.14;
/// A wall farther off than this is as far as any, metres.
const FAR_WALL_M: f64 = 2.0;

/// The measures that people are told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Long side of what is seen, metres.
    pub long: f64,
    /// Short side, metres.
    pub short: f64,
    /// Above the floor, metres.
    pub height: f64,
    /// The height at which most cells end, metres.
    pub plate: f64,
    /// The share of the cells that do.
    pub plate_share: f64,
    /// Share of the cells well above it.
    pub above_share: f64,
    /// How much of the body below the tops is seen filled, 0 to 1.
    pub filled: f64,
    /// Convex hull's share of the rectangle.
    pub rectangularity: f64,
    /// Metres from the nearest wall, at most two.
    pub wall: f64,
    /// Share of its pixels at the picture's edge.
    pub cut: f64,
    /// Red, green, blue, 0 to 1.
    pub color: [f64; 3],
}

/// Everything that is measured of one piece.
#[derive(Clone, Debug)]
pub struct Measured {
    /// In words.
    pub measures: Measures,
    /// In the classifier's order.
    pub features: Vec<f32>,
}

/// Measures a piece.
pub fn measure(grid: &FloorGrid, walls: &[Wall], segment: &Segment) -> Measured {
    let r = &segment.rectangle;
    let (plate, plate_share) = plate(&segment.tops, None);
    let (second, second_share) = self::plate(&segment.tops, Some(plate));
    let body = Body::of(grid, segment, plate);
    let sides = wall_distances(walls, r.pose, r.long, r.short);
    let pixels = &segment.pixels;
    let share = |i: usize| f64::from(pixels.at_edge[i]) / f64::from(pixels.count.max(1));
    let color = segment.sums.color();
    let measures = Measures {
        long: r.long + CELL_M,
        short: r.short + CELL_M,
        height: segment.height(),
        plate,
        plate_share,
        above_share: body.above_share,
        filled: segment.sums.filled[0] / segment.sums.filled[1].max(1.0),
        rectangularity: hull_area(&segment.outline) / ((r.long + CELL_M) * (r.short + CELL_M)),
        wall: sides.iter().copied().fold(FAR_WALL_M, f64::min),
        cut: share(0) + share(1) + share(3),
        color,
    };
    let m = &measures;
    let area = segment.sums.area();
    let [least, most] = [color.iter().copied().fold(1.0, f64::min), color.iter().copied().fold(0.0, f64::max)];
    let [left, right, above, below] = pixels.bounds.map(f64::from);
    let mut features = vec![
        m.long,
        m.short,
        m.height,
        area,
        area / (m.long * m.short),
        m.rectangularity,
        segment.sums.middle().norm(),
        plate,
        plate_share,
        second,
        second_share,
        segment.sums.top().1,
        m.wall,
        sides[0].min(sides[2]),
        sides[1].min(sides[3]),
        share(0) + share(1),
        share(2),
        share(3),
        f64::from(pixels.count.max(1)).ln(),
        most,
        most - least,
        color[0] - color[2],
        (below - above + 1.0) / (right - left + 1.0),
        m.filled,
    ];
    features.extend([0.05, 0.25, 0.5, 0.75, 0.9, 1.0].map(|share| segment.top_at(share)));
    features.extend(bands(&segment.tops));
    features.extend(body.features());
    Measured { measures, features: features.into_iter().map(|value| value as f32).collect() }
}

/// The fullest band of 6 cm among the tops above 22 cm, at least 12 cm from another: its middle and its share.
fn plate(sorted: &[f32], besides: Option<f64>) -> (f64, f64) {
    const BAND_M: f32 = 0.06;
    let from = sorted.partition_point(|top| *top < 0.22);
    let allowed = |top: f32| besides.is_none_or(|other| (f64::from(top + BAND_M / 2.0) - other).abs() > 0.12);
    let (mut best, mut past) = ((0, from), from);
    for first in from..sorted.len() {
        while past < sorted.len() && sorted[past] <= sorted[first] + BAND_M {
            past += 1;
        }
        if past - first > best.0 && allowed(sorted[first]) {
            best = (past - first, first);
        }
    }
    let middle = sorted.get(best.1 + best.0 / 2).copied().filter(|_| best.0 > 0).unwrap_or(0.0);
    (f64::from(middle), best.0 as f64 / sorted.len() as f64)
}

/// Shares of the cells whose tops lie in each band of height.
fn bands(sorted: &[f32]) -> impl Iterator<Item = f64> {
    let ends: Vec<usize> =
        BANDS_M.iter().map(|end| sorted.partition_point(|top| top < end)).chain([sorted.len()]).collect();
    let count = sorted.len() as f64;
    (0..ends.len()).map(move |i| (ends[i] - if i > 0 { ends[i - 1] } else { 0 }) as f64 / count)
}

fn hull_area(outline: &[Vec2]) -> f64 {
    let hull = convex_hull(outline);
    if hull.len() < 3 { 0.0 } else { Polygon::new(hull).area() }
}

/// Metres from the middle of each side to the nearest wall: ahead, left, behind and right in the frame of `pose`.
pub fn wall_distances(walls: &[Wall], pose: Pose, length: f64, width: f64) -> [f64; 4] {
    let (l, w) = (length / 2.0, width / 2.0);
    [vec2(l, 0.0), vec2(0.0, w), vec2(-l, 0.0), vec2(0.0, -w)].map(|side| {
        let place = pose.to_world(side);
        walls.iter().map(|wall| wall.distance(place)).fold(FAR_WALL_M, f64::min)
    })
}

/// What stands on the plate and what is below it.
#[derive(Clone, Copy, Debug, Default)]
struct Body {
    above_share: f64,
    /// Sides, and offset from the middle along and across, of what rises above the plate.
    above: [f64; 4],
    above_top: f64,
    /// Sides of the plate, and how much of their rectangle it fills.
    plate: [f64; 3],
    plate_filled: f64,
    tall_share: f64,
    /// Shares of cells filled in the lowest, the second and the third decimetre.
    low: [f64; 3],
    lowest: f64,
}

impl Body {
    fn of(grid: &FloorGrid, segment: &Segment, plate: f64) -> Self {
        let (mut above, mut level) = (Vec::new(), Vec::new());
        let mut body = Self::default();
        let (mut filled, mut possible) = (0.0, 0.0);
        for &index in &segment.cells {
            let cell = &grid.cells[index as usize];
            let place = grid.centre(index as usize);
            if cell.top > plate as f32 + ABOVE_PLATE_M {
                above.push(place);
                body.above_top += f64::from(cell.top);
            } else if cell.top > plate as f32 - 0.05 && cell.top < plate as f32 + 0.05 {
                level.push(place);
                filled += f64::from(cell.slices.count_ones());
                possible += f64::from((cell.top * 10.0).ceil());
            }
            body.tall_share += f64::from(u8::from(cell.slices.count_ones() >= 4));
            (0..3).for_each(|i| body.low[i] += f64::from(cell.slices >> i & 1));
            body.lowest += f64::from(cell.slices.trailing_zeros().min(24));
        }
        let count = segment.cells.len() as f64;
        body.above_share = above.len() as f64 / count;
        body.above_top = if above.is_empty() { 0.0 } else { body.above_top / above.len() as f64 - plate };
        body.plate_filled = filled / f64::max(possible, 1.0);
        body.tall_share /= count;
        body.low = body.low.map(|low| low / count);
        body.lowest /= count;
        body.shapes(segment, &above, &level);
        body
    }

    fn shapes(&mut self, segment: &Segment, above: &[Vec2], level: &[Vec2]) {
        let r = &segment.rectangle;
        if above.len() > 3 {
            let b = rectangle_at(above, r.pose.heading);
            let middle = r.pose.to_local(above.iter().sum::<Vec2>() / above.len() as f64);
            let offset = [2.0 * middle.x.abs() / (r.long + CELL_M), 2.0 * middle.y.abs() / (r.short + CELL_M)];
            self.above = [b.long, b.short, offset[0], offset[1]];
        }
        if level.len() > 3 {
            let p = rectangle_at(level, r.pose.heading);
            let fill = level.len() as f64 * CELL_M * CELL_M / ((p.long + CELL_M) * (p.short + CELL_M));
            self.plate = [p.long, p.short, fill];
        }
    }

    fn features(&self) -> Vec<f64> {
        let rest = [self.above_share, self.above_top, self.plate_filled, self.tall_share, self.lowest];
        [&rest[..], &self.above, &self.plate, &self.low].concat()
    }
}
