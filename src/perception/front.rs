//! Which of the four sides of a piece is its front, and which sides are hidden.

use super::floor_grid::{CELL_M, FloorGrid};
use super::measures::{Measured, wall_distances};
use super::patches::NONE;
use super::segment::{Segment, Segments};
use super::walls::Wall;
use crate::geometry::{Pose, vec2};

/// Share of each side – ahead, left, behind, right in the frame of the rectangle – beyond which nothing was seen.
pub type Hidden = [f64; 4];

/// How much of each side of a rectangle is hidden: no floor, no wall and no other piece shows beyond it.
pub fn hidden_sides(
    grid: &FloorGrid,
    segments: &Segments,
    number: u32,
    walls: &[Wall],
    pose: Pose,
    length: f64,
    width: f64,
) -> Hidden {
    const PLACES: usize = 9;
    const BEYOND_M: f64 = 0.09;
    let (l, w) = (length / 2.0 + BEYOND_M, width / 2.0 + BEYOND_M);
    let sides = [
        (vec2(l, 0.0), vec2(0.0, w)),
        (vec2(0.0, w), vec2(l, 0.0)),
        (vec2(-l, 0.0), vec2(0.0, w)),
        (vec2(0.0, -w), vec2(l, 0.0)),
    ];
    sides.map(|(middle, along)| {
        let unseen = (0..PLACES).filter(|i| {
            let share = (*i as f64 / (PLACES - 1) as f64 - 0.5) * 1.6;
            let place = pose.to_world(middle + along * share);
            let other = grid.index(place).map(|at| segments.piece_of[at]).is_some_and(|p| p != NONE && p != number);
            !other && !grid.shows_floor(place) && !walls.iter().any(|wall| wall.distance(place) < 0.12)
        });
        unseen.count() as f64 / PLACES as f64
    })
}

/// What tells whether a piece's front lies along `heading` (in the camera's frame).
pub struct Facing {
    /// The heading.
    pub pose: Pose,
    /// Metres along it.
    pub length: f64,
    /// Metres across it.
    pub width: f64,
    /// In the classifier's order.
    pub features: Vec<f32>,
}

/// The four ways in which a piece may face.
pub fn facings(
    grid: &FloorGrid,
    walls: &[Wall],
    segment: &Segment,
    measured: &Measured,
    hidden: Hidden,
    classes: &[f32],
) -> [Facing; 4] {
    let r = &segment.rectangle;
    [0, 1, 2, 3].map(|quarter| {
        let pose = Pose { heading: r.pose.heading + f64::from(quarter) * std::f64::consts::FRAC_PI_2, ..r.pose };
        let (length, width) = if quarter % 2 == 0 { (r.long, r.short) } else { (r.short, r.long) };
        let (length, width) = (length + CELL_M, width + CELL_M);
        let h = |side: usize| hidden[(side + quarter as usize) % 4];
        let wall = wall_distances(walls, pose, length, width);
        let to_camera = pose.bearing_to(vec2(0.0, 0.0));
        let mut features = vec![
            length,
            width,
            length / width,
            measured.measures.height,
            measured.measures.plate,
            wall[0],
            wall[1].min(wall[3]),
            wall[2],
            to_camera.cos(),
            to_camera.sin().abs(),
            h(0),
            h(1).max(h(3)),
            h(2),
        ];
        features.extend(profile(grid, segment, pose, length, width, measured.measures.plate));
        let mut features: Vec<f32> = features.into_iter().map(|value| value as f32).collect();
        features.extend(classes);
        Facing { pose, length, width, features }
    })
}

/// Tops of the thirds from rear to front and from side to side, and where what rises above the plate lies.
fn profile(grid: &FloorGrid, segment: &Segment, pose: Pose, length: f64, width: f64, plate: f64) -> Vec<f64> {
    let (mut along, mut across) = ([(0.0, 0.0); 3], [(0.0, 0.0); 3]);
    let (mut high, mut count) = ([0.0_f64; 5], 0.0);
    for &index in &segment.cells {
        let local = pose.to_local(grid.centre(index as usize));
        let top = f64::from(grid.cells[index as usize].top);
        let third = |share: f64| ((share + 0.5) * 3.0).clamp(0.0, 2.99) as usize;
        let (i, j) = (third(local.x / length), third(local.y / width));
        along[i] = (along[i].0 + top, along[i].1 + 1.0);
        across[j] = (across[j].0 + top, across[j].1 + 1.0);
        high[i] = high[i].max(top);
        if top > plate + 0.14 {
            high[3] += local.x / length;
            high[4] += 1.0;
        }
        count += 1.0;
    }
    let mean = |(sum, n): (f64, f64)| if n > 0.0 { sum / n } else { 0.0 };
    let [rear, middle, front] = along.map(mean);
    let [left, _, right] = across.map(mean);
    let above = if high[4] > 0.0 { high[3] / high[4] } else { 0.0 };
    vec![
        rear,
        middle,
        front,
        front - rear,
        middle - rear,
        front - middle,
        (left - right).abs(),
        left.min(right) - middle,
        high[0],
        high[2],
        high[2] - high[0],
        above,
        above * high[4] / count,
        along[0].1 / count,
        along[2].1 / count,
    ]
}
