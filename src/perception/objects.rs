//! Small objects on table tops: by height where the depth shows it, by colour contrast where it cannot.
//!
//! A phone 9 mm thick lies under the Kinect's depth noise from 1.5 m on; its
//! colour against the plate's does not. What an object is, is told by holding
//! its size, height and colour against the usual ones of [`OBJECTS`].

use std::ops::{Range, RangeInclusive};

use super::ObjectSighting;
use super::beyond::goes_on_beyond;
use super::points::above_noise;
use crate::catalogue::{CATEGORIES, Holds, OBJECTS, SmallObject};
use crate::frame::RgbdFrame;
use crate::geometry::{Polygon, Vec2, vec2};
use crate::record::Detection;

/// What is this likely to be one of them is looked at: a statue on a small table passes for a chair's back.
const LIKELY: f64 = 0.08;
/// Plates lie between these heights, metres.
const PLATE_M: (f64, f64) = (0.25, 1.15);
/// Bins of the plate's height, metres.
const BIN_M: f64 = 0.01;
/// The rim of a plate is left out, metres: its pixels mix with what is behind.
const RIM_M: f64 = 0.035;
/// Nothing taller stands on a table, metres.
const TALLEST_M: f64 = 0.6;
/// Colours so far from the plate's, summed over the channels, are something on it.
const CONTRAST: i32 = 75;
/// Fewer pixels are noise.
const FEWEST_PIXELS: usize = 14;
/// What is told for sure: pixels, distance from the picture's edge, metres from the camera.
const RECOGNISABLE: (usize, usize, f64) = (45, 3, 1.9);
/// What fits no usual object better than this is not named for sure.
const WORST_FIT: f64 = 14.0;

/// The points of a row from one column on whose depths, in the sensor's units, lie in a range, with their columns and
/// depths in metres.
fn points_of_row(
    frame: &RgbdFrame,
    row: usize,
    columns: Range<usize>,
    depths: &RangeInclusive<u16>,
) -> impl Iterator<Item = (usize, [f64; 3], f64)> {
    let (eye, first) = (frame.eye(), frame.ray(columns.start, row));
    let step = [0, 1, 2].map(|k| frame.world_from_camera[k][0] / frame.intrinsics.fx);
    let line = &frame.depth[row * frame.width..][columns.clone()];
    columns.clone().zip(line).filter(|(_, depth)| depths.contains(depth)).map(move |(column, &depth)| {
        let (z, on) = (f64::from(depth) * frame.depth_unit_m, (column - columns.start) as f64);
        (column, [0, 1, 2].map(|k| eye[k] + (first[k] + on * step[k]) * z), z)
    })
}

/// Depths in the sensor's units between which all points over a footprint lie: most pixels are elsewhere.
fn depths_over(frame: &RgbdFrame, footprint: &Polygon, heights: Range<f64>) -> RangeInclusive<u16> {
    // Poses written with few decimals turn and stretch a little.
    const MARGIN_M: f64 = 0.1;
    let (m, eye) = (&frame.world_from_camera, frame.eye());
    let ahead = |x: f64, y: f64, z: f64| m[0][2] * (x - eye[0]) + m[1][2] * (y - eye[1]) + m[2][2] * (z - eye[2]);
    let corners = footprint.corners().iter().flat_map(|c| [heights.start, heights.end].map(|z| ahead(c.x, c.y, z)));
    frame.units_between(corners, MARGIN_M)
}

/// One pixel that shows something on a plate.
#[derive(Clone, Copy)]
struct Spot {
    column: usize,
    row: usize,
    at: Vec2,
    /// Above the plate, metres; 0 where only the colour tells.
    height: f64,
}

/// The objects on the tops of `furniture` in a frame with colour.
pub fn sightings(frame: &RgbdFrame, furniture: &[Detection]) -> Vec<ObjectSighting> {
    if frame.color.len() != frame.depth.len() {
        return Vec::new();
    }
    let mut found: Vec<ObjectSighting> = Vec::new();
    for detection in furniture.iter().filter(|detection| may_hold_things(detection)) {
        for sighting in on_top(frame, detection) {
            let near = |other: &ObjectSighting| (vec2(other.x, other.y) - vec2(sighting.x, sighting.y)).norm() < 0.1;
            if !found.iter().any(near) {
                found.push(sighting);
            }
        }
    }
    found
}

/// Whether it may be a table or a chest: on beds and seats cushions would pass for things.
fn may_hold_things(detection: &Detection) -> bool {
    let share = |name: &str| detection.scores.get(name).copied().unwrap_or(0.0);
    let holders = CATEGORIES.iter().filter(|row| row.name == row.noun && row.holds != Holds::Never);
    may_hold(&detection.category) || holders.map(|row| share(row.name)).sum::<f64>() > LIKELY
}

/// Whether things are looked for on furniture of that category.
pub fn may_hold(category: &str) -> bool {
    CATEGORIES.iter().any(|row| row.noun == category && row.holds != Holds::Never)
}

fn on_top(frame: &RgbdFrame, detection: &Detection) -> Vec<ObjectSighting> {
    let footprint = Polygon::new(detection.footprint.iter().map(|&[x, y]| vec2(x, y)).collect());
    let Some(window) = window(frame, &footprint) else { return Vec::new() };
    let points = points_over(frame, &footprint, window);
    let Some(plate) = plate_height(&points) else { return Vec::new() };
    let blobs = blobs(&spots(frame, &points, plate), window);
    let is_whole =
        |blob: &&Vec<Spot>| !goes_on_beyond(frame, blob.iter().map(|spot| (spot.column, spot.row)), &footprint, plate);
    blobs.iter().filter(is_whole).filter_map(|blob| sighting(frame, blob)).collect()
}

/// Columns and rows in which a footprint can show, from the floor to the tallest object.
fn window(frame: &RgbdFrame, footprint: &Polygon) -> Option<[usize; 4]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for corner in footprint.corners() {
        for z in [PLATE_M.0, PLATE_M.1 + TALLEST_M] {
            let (column, row, _) = frame.pixel([corner.x, corner.y, z])?;
            low = [low[0].min(column), low[1].min(row)];
            high = [high[0].max(column), high[1].max(row)];
        }
    }
    let (width, height) = (frame.width as f64, frame.height as f64);
    let clamped = [low[0].max(0.0), low[1].max(0.0), (high[0] + 1.0).min(width), (high[1] + 1.0).min(height)];
    (footprint.corners().len() > 2 && clamped[0] < clamped[2] && clamped[1] < clamped[3])
        .then(|| clamped.map(|v| v as usize))
}

/// The points in the window that lie over the footprint less its rim, with their pixels and depths.
fn points_over(
    frame: &RgbdFrame,
    footprint: &Polygon,
    [left, top, right, low]: [usize; 4],
) -> Vec<(usize, usize, [f64; 3], f64)> {
    let heights = PLATE_M.0..PLATE_M.1 + TALLEST_M;
    let (inside, depths) = (Inside::of(footprint), depths_over(frame, footprint, heights.clone()));
    let over = |(_, point, _): &(usize, [f64; 3], f64)| heights.contains(&point[2]) && inside.has(point[0], point[1]);
    let mut points = Vec::new();
    for row in top..low {
        let seen = points_of_row(frame, row, left..right, &depths).filter(over);
        points.extend(seen.map(|(column, point, depth)| (column, row, point, depth)));
    }
    points
}

/// Where a point is within a convex outline by more than the rim: of each edge the direction inward and the distance.
struct Inside(Vec<(Vec2, f64)>);

impl Inside {
    fn of(footprint: &Polygon) -> Self {
        let edge = |(a, b): (Vec2, Vec2)| {
            let along = (b - a).normalize();
            let inward = vec2(-along.y, along.x);
            (inward, inward.dot(&a) + RIM_M)
        };
        Self(footprint.edges().map(edge).collect())
    }

    fn has(&self, x: f64, y: f64) -> bool {
        self.0.iter().all(|(inward, least)| inward.x * x + inward.y * y > *least)
    }
}

/// The height at which most points lie.
fn plate_height(points: &[(usize, usize, [f64; 3], f64)]) -> Option<f64> {
    let bins = ((PLATE_M.1 - PLATE_M.0) / BIN_M) as usize;
    let mut counts = vec![0_usize; bins + 2];
    for (_, _, point, _) in points {
        let bin = ((point[2] - PLATE_M.0) / BIN_M) as usize;
        if bin < bins {
            counts[bin] += 1;
        }
    }
    let best = (1..=bins).max_by_key(|&i| counts[i - 1] + counts[i] + counts[i + 1])?;
    let near = |z: f64| (z - PLATE_M.0 - (best as f64 + 0.5) * BIN_M).abs() < 1.5 * BIN_M;
    let mut heights: Vec<f64> = points.iter().map(|p| p.2[2]).filter(|&z| near(z)).collect();
    if heights.len() < 60 {
        return None;
    }
    let middle = heights.len() / 2;
    Some(*heights.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The pixels that stand above the plate, or differ from it in colour.
fn spots(frame: &RgbdFrame, points: &[(usize, usize, [f64; 3], f64)], plate: f64) -> Vec<Spot> {
    let tolerance = |depth: f64| f64::from(above_noise((depth * depth) as f32));
    let flat = points.iter().filter(|p| (p.2[2] - plate).abs() < tolerance(p.3));
    let color_at = |column: usize, row: usize| frame.color[row * frame.width + column];
    let Some(usual) = median_color(flat.map(|p| color_at(p.0, p.1))) else { return Vec::new() };
    let spot = |&(column, row, point, depth): &(usize, usize, [f64; 3], f64)| {
        let (above, at) = (point[2] - plate, vec2(point[0], point[1]));
        let color = color_at(column, row);
        let contrast: i32 = (0..3).map(|c| (i32::from(color[c]) - i32::from(usual[c])).abs()).sum();
        let tall = above > tolerance(depth) && above < TALLEST_M;
        let marked = above.abs() <= tolerance(depth) && contrast > CONTRAST;
        (tall || marked).then_some(Spot { column, row, at, height: if tall { above } else { 0.0 } })
    };
    points.iter().filter_map(spot).collect()
}

/// The median of each channel, by counting: there are only 256 values.
fn median_color(colors: impl Iterator<Item = [u8; 3]>) -> Option<[u8; 3]> {
    let (mut counts, mut all) = ([[0_usize; 256]; 3], 0);
    for color in colors {
        (0..3).for_each(|channel| counts[channel][usize::from(color[channel])] += 1);
        all += 1;
    }
    let median = |counts: &[usize; 256]| {
        let mut left = all / 2;
        counts.iter().position(|&count| {
            let within = left < count;
            left = left.saturating_sub(count);
            within
        })
    };
    let [red, green, blue] = counts.each_ref().map(median);
    Some([red? as u8, green? as u8, blue? as u8])
}

/// Groups of spots that touch in the picture, over gaps of three pixels.
fn blobs(spots: &[Spot], [left, top, right, low]: [usize; 4]) -> Vec<Vec<Spot>> {
    let width = right - left;
    let mut free = Free { width, spot_at: vec![NO_SPOT; width * (low - top)], corner: (left, top) };
    for (number, spot) in (0_u32..).zip(spots) {
        free.spot_at[(spot.row - top) * width + spot.column - left] = number;
    }
    let blobs = spots.iter().map(|start| free.blob_of(start, spots));
    blobs.filter(|blob| blob.len() >= FEWEST_PIXELS).collect()
}

/// A pixel without a spot that is free.
const NO_SPOT: u32 = u32::MAX;

/// The spots of a window that belong to no blob yet.
struct Free {
    width: usize,
    /// The number of the spot at each pixel of the window.
    spot_at: Vec<u32>,
    /// Column and row of the window's first pixel.
    corner: (usize, usize),
}

impl Free {
    /// Takes out a spot and all that touch it, directly or through others.
    fn blob_of(&mut self, start: &Spot, spots: &[Spot]) -> Vec<Spot> {
        const GAP: usize = 3;
        let (left, top) = self.corner;
        let rows = self.spot_at.len() / self.width;
        let mut blob = Vec::new();
        let mut waiting = Vec::new();
        let take = |at: &mut [u32], waiting: &mut Vec<u32>| {
            for number in at.iter_mut().filter(|number| **number != NO_SPOT) {
                waiting.push(std::mem::replace(number, NO_SPOT));
            }
        };
        let first = (start.row - top) * self.width + start.column - left;
        take(&mut self.spot_at[first..=first], &mut waiting);
        while let Some(spot) = waiting.pop().map(|number| spots[number as usize]) {
            blob.push(spot);
            let (column, row) = (spot.column - left, spot.row - top);
            let columns = column.saturating_sub(GAP)..(column + GAP + 1).min(self.width);
            for row in row.saturating_sub(GAP)..=(row + GAP).min(rows - 1) {
                take(&mut self.spot_at[row * self.width..][columns.clone()], &mut waiting);
            }
        }
        blob
    }
}

/// What a blob looks like.
struct Looks {
    /// Longest and shortest extent in plan, metres.
    extent: (f64, f64),
    height: f64,
    color: [u8; 3],
}

fn sighting(frame: &RgbdFrame, blob: &[Spot]) -> Option<ObjectSighting> {
    let color = median_color(blob.iter().map(|s| frame.color[s.row * frame.width + s.column]))?;
    let mut heights: Vec<f64> = blob.iter().map(|s| s.height).collect();
    heights.sort_by(f64::total_cmp);
    let height = heights[heights.len() * 19 / 20].max(0.012);
    let looks = Looks { extent: extent(blob), height, color };
    let (object, cost) = OBJECTS.iter().map(|o| (o, misfit(o, &looks))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let middle = blob.iter().map(|s| s.at).sum::<Vec2>() / blob.len() as f64;
    let eye = frame.eye();
    let (pixels, border, range) = RECOGNISABLE;
    let within = |s: &Spot| {
        s.column >= border && s.row >= border && s.column + border < frame.width && s.row + border < frame.height
    };
    let recognisable = blob.len() >= pixels
        && blob.iter().all(within)
        && (middle - vec2(eye[0], eye[1])).norm() <= range
        && cost < WORST_FIT;
    Some(ObjectSighting { name: object.name.to_string(), x: middle.x, y: middle.y, recognisable })
}

/// The spread of a blob along and across its principal axis, metres.
fn extent(blob: &[Spot]) -> (f64, f64) {
    let n = blob.len() as f64;
    let middle = blob.iter().map(|s| s.at).sum::<Vec2>() / n;
    let sum = |f: fn(Vec2) -> f64| blob.iter().map(|s| f(s.at - middle)).sum::<f64>() / n;
    let (xx, yy, xy) = (sum(|d| d.x * d.x), sum(|d| d.y * d.y), sum(|d| d.x * d.y));
    let half = ((xx - yy).powi(2) / 4.0 + xy * xy).sqrt();
    let (large, small) = ((xx + yy) / 2.0 + half, ((xx + yy) / 2.0 - half).max(0.0));
    // An even bar of length L has variance L²/12.
    ((12.0 * large).sqrt(), (12.0 * small).sqrt())
}

/// How badly an object of this kind would look like that; 0 is a perfect match.
fn misfit(object: &SmallObject, looks: &Looks) -> f64 {
    let (long, short) = (object.size.length.max(object.size.width), object.size.length.min(object.size.width));
    // The far side is hidden: less than the usual depth is no surprise, more is.
    let ratio = |seen: f64, usual: f64| ((seen + 0.015) / (usual + 0.015)).ln();
    let short_ratio = ratio(looks.extent.1, short);
    let size =
        (ratio(looks.extent.0, long) / 0.3).powi(2) + (short_ratio / if short_ratio < 0.0 { 0.9 } else { 0.5 }).powi(2);
    let height = ((looks.height - object.size.height) / (0.018 + 0.12 * object.size.height)).powi(2);
    size + height + color_misfit(object.color, looks.color)
}

/// Light changes brightness more than hue.
fn color_misfit(usual: [u8; 3], seen: [u8; 3]) -> f64 {
    let brightness = |c: [u8; 3]| c.iter().map(|&v| f64::from(v)).sum::<f64>() + 15.0;
    let (u, s) = (brightness(usual), brightness(seen));
    let hue: f64 = (0..3).map(|i| (f64::from(usual[i]) / u - f64::from(seen[i]) / s).powi(2)).sum();
    hue / 0.07_f64.powi(2) + ((s / u).ln() / 0.6).powi(2)
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::frame::Camera;
    use crate::geometry::Pose;
    use crate::map::RoomMap;
    use crate::perception::Eyes;
    use crate::simulation::Scene;
    use crate::simulation::base::Truth;
    use crate::simulation::camera::{Kinect, SolidScene};
    use crate::simulation::eyes::truth::TruthEyes;

    /// What is recognised on the furniture `on`, seen from 1.3 m to its east.
    fn recognised(on: &str) -> Vec<String> {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let item = scene.item(on).expect("in the scene");
        let pose = Pose::new(item.x + 1.3, item.y, std::f64::consts::PI);
        let solids = SolidScene::new(&map, &scene);
        let (frame, _) = Kinect::default().capture(&solids, pose, &mut ChaCha8Rng::seed_from_u64(3));
        let truth = Rc::new(RefCell::new(Truth { pose, ..Truth::default() }));
        let mut furniture = TruthEyes::new(&map, Rc::new(scene.clone()), Camera::kinect(), truth).look(pose).furniture;
        furniture.retain(|piece| (vec2(piece.x, piece.y) - item.pose().position()).norm() < 1e-6);
        let seen = sightings(&frame, &furniture);
        seen.into_iter().filter(|s| s.recognisable).map(|s| s.name).collect()
    }

    #[test]
    fn a_mug_shows_by_its_height_and_a_fork_by_its_colour() {
        assert_eq!(recognised("hexagon-table-1"), ["mug"]);
        assert_eq!(recognised("round-table-1"), ["fork"]);
    }

    #[test]
    fn nothing_is_seen_on_a_bed() {
        assert!(recognised("bed-1").is_empty());
    }

    #[test]
    fn the_median_that_is_counted_is_the_one_that_is_sorted() {
        for count in 1..40_u32 {
            let colors =
                (0..count).map(|i| [1, 3, 7].map(|k| (i.wrapping_mul(0x9E37_79B1).wrapping_mul(k) >> 24) as u8));
            let sorted = [0, 1, 2].map(|channel| {
                let mut values: Vec<u8> = colors.clone().map(|color| color[channel]).collect();
                values.sort_unstable();
                values[values.len() / 2]
            });
            assert_eq!(median_color(colors), Some(sorted));
        }
        assert_eq!(median_color(std::iter::empty()), None);
    }
}
