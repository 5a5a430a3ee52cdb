//! From a group of cells to a piece of furniture: category by the height and size of its parts, and which way it faces.
//!
//! A first classifier by stated rules: top plate, seat, back, height and
//! extent decide, and are told in `why`.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

use super::floor_grid::{CELL_M, FloorGrid};
use super::rectangle::{Rectangle, least_rectangle};
use crate::geometry::{Polygon, Pose, Vec2, wrap_angle};
use crate::record::Detection;

/// Fewer cells than this are clutter: about 20 by 12 cm.
const LEAST_CELLS: usize = 40;
/// Lower than this is a rug or a shoe, metres.
const LEAST_HEIGHT_M: f64 = 0.25;

/// What was measured of a group of cells.
#[derive(Clone, Debug)]
struct Measures {
    rectangle: Rectangle,
    /// The 97th percentile of the cells' tops, metres.
    height: f64,
    /// The height at which most cells end, metres, and their share.
    plate: f64,
    plate_share: f64,
    /// Share of cells that rise well above the plate.
    back_share: f64,
    /// Where those lie, from the middle.
    back_at: Vec2,
    /// Share of the rectangle that is covered.
    filled: f64,
}

/// The furniture a group of cells is taken for; nothing for clutter.
pub fn classify(grid: &FloorGrid, cells: &[usize], camera: Vec2) -> Option<Detection> {
    if cells.len() < LEAST_CELLS {
        return None;
    }
    let measures = measure(grid, cells)?;
    // What is left of a wall is long and hardly deep.
    let sliver = measures.rectangle.short < 0.15 && measures.rectangle.long > 3.0 * measures.rectangle.short;
    if measures.height < LEAST_HEIGHT_M || sliver {
        return None;
    }
    let (category, confidence) = category(&measures);
    let measures = completed(measures, category, camera);
    let (pose, length, width) = oriented(&measures, category, camera);
    let footprint = Polygon::rectangle(pose, length, width).corners().iter().map(|c| [c.x, c.y]).collect();
    Some(Detection {
        category: category.to_string(),
        confidence,
        scores: BTreeMap::from([(category.to_string(), confidence)]),
        x: pose.x,
        y: pose.y,
        yaw: Some(pose.heading),
        length,
        width,
        height: measures.height,
        footprint,
        attributes: Vec::new(),
        why: why(&measures),
    })
}

fn measure(grid: &FloorGrid, cells: &[usize]) -> Option<Measures> {
    let points: Vec<Vec2> = cells.iter().map(|&cell| grid.centre(cell)).collect();
    let rectangle = least_rectangle(&points)?;
    let mut tops: Vec<f64> = cells.iter().map(|&cell| f64::from(grid.cells[cell].top)).collect();
    tops.sort_by(f64::total_cmp);
    let height = tops[(tops.len() * 97 / 100).min(tops.len() - 1)];
    let (plate, plate_share) = plate(&tops);
    let middle = rectangle.pose.position();
    let high = |cell: &&usize| f64::from(grid.cells[**cell].top) > plate + 0.2;
    let back: Vec<Vec2> = cells.iter().filter(high).map(|&cell| grid.centre(cell) - middle).collect();
    let back_at = back.iter().fold(Vec2::zeros(), |sum, at| sum + at) / back.len().max(1) as f64;
    let area = (rectangle.long + CELL_M) * (rectangle.short + CELL_M);
    Some(Measures {
        rectangle,
        height,
        plate,
        plate_share,
        back_share: back.len() as f64 / cells.len() as f64,
        back_at,
        filled: (cells.len() as f64 * CELL_M * CELL_M / area).min(1.0),
    })
}

/// The fullest band of 8 cm among the tops above 25 cm: its middle and its share.
fn plate(sorted: &[f64]) -> (f64, f64) {
    const BAND_M: f64 = 0.08;
    let from = sorted.partition_point(|top| *top < 0.25);
    let (mut best, mut past) = ((0, from), from);
    for first in from..sorted.len() {
        while past < sorted.len() && sorted[past] <= sorted[first] + BAND_M {
            past += 1;
        }
        if past - first > best.0 {
            best = (past - first, first);
        }
    }
    let middle = sorted.get(best.1 + best.0 / 2).copied().unwrap_or(0.0);
    (middle, best.0 as f64 / sorted.len() as f64)
}

fn category(m: &Measures) -> (&'static str, f64) {
    let (long, short) = (m.rectangle.long, m.rectangle.short);
    let area = long * short;
    let seat_high = (0.3..0.6).contains(&m.plate);
    let backed = m.back_share > 0.08 && m.height > m.plate + 0.22;
    match () {
        () if m.height > 1.0 && long < 0.6 && m.filled < 0.75 => ("lamp", 0.5),
        () if long > 1.5 && short > 0.85 && (0.25..0.8).contains(&m.plate) && m.plate_share > 0.3 => ("bed", 0.6),
        () if m.height > 1.45 => (if short < 0.45 { "bookshelf" } else { "wardrobe" }, 0.5),
        () if long > 1.15 && seat_high && backed => ("couch", 0.6),
        () if seat_high && backed && long < 1.15 => (if area > 0.42 { "armchair" } else { "chair" }, 0.6),
        () if m.height < 0.6 && long < 0.55 => ("nightstand", 0.4),
        () if m.height < 0.55 && long > 0.55 && m.plate_share > 0.45 => ("coffee_table", 0.5),
        () if m.height < 0.58 && long > 1.2 => ("tv_stand", 0.4),
        () if m.height > 0.8 && m.height <= 1.45 && m.plate_share < 0.75 && !seat_high => ("dresser", 0.4),
        () if m.height > 0.85 && long < 0.7 => ("chair", 0.4),
        () if m.height > 0.6 => (if long > 1.0 && short > 0.5 && m.plate_share > 0.5 { "desk" } else { "table" }, 0.5),
        () => ("stool", 0.3),
    }
}

/// Storage shows the camera its front only: what is hidden behind it is added.
fn completed(mut m: Measures, category: &str, camera: Vec2) -> Measures {
    let least = match category {
        "wardrobe" | "dresser" | "tv_stand" => 0.45,
        "bookshelf" => 0.3,
        "couch" => 0.8,
        _ => return m,
    };
    let missing = least - m.rectangle.short;
    if missing > 0.0 {
        let across = m.rectangle.pose.heading + FRAC_PI_2;
        let away = m.rectangle.pose.position() - camera;
        let sign = if away.x * across.cos() + away.y * across.sin() > 0.0 { 1.0 } else { -1.0 };
        m.rectangle.pose.x += sign * across.cos() * missing / 2.0;
        m.rectangle.pose.y += sign * across.sin() * missing / 2.0;
        m.rectangle.short = least;
    }
    m
}

/// The pose with the front's heading, the length along it and the width across it.
fn oriented(m: &Measures, category: &str, camera: Vec2) -> (Pose, f64, f64) {
    let Rectangle { pose, long, short } = m.rectangle;
    let across = [pose.heading + FRAC_PI_2, pose.heading - FRAC_PI_2];
    let every = [pose.heading, pose.heading + PI, across[0], across[1]];
    let along = |heading: f64, v: Vec2| v.x * heading.cos() + v.y * heading.sin();
    let best = |headings: &[f64], toward: Vec2| {
        headings
            .iter()
            .copied()
            .fold(headings[0], |best, h| if along(h, toward) > along(best, toward) { h } else { best })
    };
    let to_camera = camera - pose.position();
    let front = match category {
        // Away from the back.
        "couch" => best(&across, -m.back_at),
        "chair" | "armchair" => best(&every, -m.back_at),
        "bed" => best(&[pose.heading, pose.heading + PI], -m.back_at),
        // Storage turns its front into the room, where the camera is.
        "wardrobe" | "dresser" | "bookshelf" | "tv_stand" | "nightstand" => best(&across, to_camera),
        // Tables by the short edge.
        _ => pose.heading,
    };
    let lengthwise = ((front - pose.heading) / FRAC_PI_2).round() as i64 % 2 == 0;
    let (length, width) = if lengthwise { (long, short) } else { (short, long) };
    (Pose { heading: wrap_angle(front), ..pose }, length, width)
}

fn why(m: &Measures) -> String {
    let back = if m.back_share > 0.08 {
        format!("a back over {:.0} % of it", 100.0 * m.back_share)
    } else {
        "no back".to_string()
    };
    let (long, short) = (m.rectangle.long, m.rectangle.short);
    format!(
        "plate {:.2} m high over {:.0} % of it, {long:.2} × {short:.2} m, {:.2} m high, {back}",
        m.plate,
        100.0 * m.plate_share,
        m.height
    )
}
