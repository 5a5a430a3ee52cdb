//! Small things on table tops: by height where the depth can show it, by colour where it cannot.
//!
//! A phone is thinner than the depth noise from 1.5 m on; it shows by its
//! contrast to the top it lies on.

use super::points::{Points, STRIDE, above_noise};
use super::rectangle::{Rectangle, rectangle_at};
use super::segment::Segment;
use crate::frame::RgbdFrame;
use crate::geometry::{Polygon, Pose, Vec2, vec2};

/// Tops between these heights can hold something, metres.
const TOPS_M: std::ops::Range<f64> = 0.3..1.15;
/// Farther off nothing small can be told, metres.
const FARTHEST_M: f64 = 3.2;
/// Nothing portable is higher, metres.
const HIGHEST_M: f32 = 0.6;
/// Pixels nearer or farther than that space by this need no second look, metres.
const DEPTH_MARGIN_M: f64 = 0.2;
/// Smaller tops hold nothing, square metres.
const LEAST_TOP_M2: f64 = 0.05;
/// Fewer pixels are noise.
const LEAST_PIXELS: usize = 30;
/// So many pixels tell where a thing lies and how high it is.
const SAMPLE: usize = 160;
/// A colour that differs by less from the top's is the top's own shade, 0 to 1.
const LEAST_CONTRAST: f32 = 0.1;

/// Something that lies or stands on a top.
#[derive(Clone, Debug)]
pub struct Thing {
    /// Its middle, metres in the camera's frame.
    pub place: Vec2,
    /// Its pixels, as indices into the picture.
    pub pixels: Vec<u32>,
    /// In the classifier's order.
    pub features: Vec<f32>,
    /// Whether it lies below the top: the side of the top itself.
    pub is_flank: bool,
    /// Whether it could be told from this picture: whole, large and sharp enough.
    pub recognisable: bool,
}

/// The top of a piece: its height and where it lies.
struct Top {
    height: f32,
    pose: Pose,
    half: Vec2,
}

impl Top {
    /// The corners of the space in which things on it are looked for.
    fn corners(&self) -> impl Iterator<Item = [f32; 3]> {
        let sides = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let corners = sides.map(|(a, b)| self.pose.to_world(vec2(a * self.half.x, b * self.half.y)));
        let level = |up: f32| corners.map(|corner| [corner.x as f32, corner.y as f32, self.height + up]);
        [level(0.0), level(HIGHEST_M)].concat().into_iter()
    }
}

/// The things on one piece whose plate lies at `plate` metres.
pub fn things(frame: &RgbdFrame, points: &Points, segment: &Segment, plate: f64) -> Vec<Thing> {
    let range = segment.sums.middle().norm();
    let small = segment.sums.area() < LEAST_TOP_M2;
    if !TOPS_M.contains(&plate) || range > FARTHEST_M || small || frame.color.is_empty() {
        return Vec::new();
    }
    let Rectangle { pose, long, short } = segment.rectangle;
    let top = Top { height: plate as f32, pose, half: vec2(long / 2.0 - 0.015, short / 2.0 - 0.015) };
    let window = window(frame, segment, range);
    let patch = Patch::of(frame, points, &top, window);
    patch.groups().into_iter().filter_map(|pixels| patch.thing(frame, &top, pixels)).collect()
}

/// Columns and rows in which the piece and what stands on it can show.
fn window(frame: &RgbdFrame, segment: &Segment, range: f64) -> [usize; 4] {
    let [left, right, above, below] = segment.pixels.bounds.map(|bound| bound as usize * STRIDE);
    let up = (f64::from(HIGHEST_M) * frame.intrinsics.fy / range.max(0.5)) as usize;
    [left, (right + STRIDE).min(frame.width), above.saturating_sub(up), (below + STRIDE).min(frame.height)]
}

/// The pixels of a window that lie above a top.
struct Patch {
    window: [usize; 4],
    /// Place, and height above the top; nothing for pixels that are elsewhere.
    points: Vec<Option<[f32; 3]>>,
    /// Whether each is of some thing.
    is_thing: Vec<bool>,
    /// The top's own colour.
    color: [f32; 3],
}

impl Patch {
    fn of(frame: &RgbdFrame, points: &Points, top: &Top, window: [usize; 4]) -> Self {
        let [left, right, above, below] = window;
        let (sin, cos) = (top.pose.heading.sin() as f32, top.pose.heading.cos() as f32);
        let (px, py) = (top.pose.x as f32, top.pose.y as f32);
        let half = [top.half.x as f32, top.half.y as f32];
        let mut places = Vec::with_capacity((right - left) * (below - above));
        let depths =
            frame.units_between(top.corners().map(|corner| f64::from(points.rays.depth(corner))), DEPTH_MARGIN_M);
        for row in above..below {
            let line = &frame.depth[row * frame.width..][left..right];
            places.extend(line.iter().zip(left..).map(|(depth, column)| {
                if !depths.contains(depth) {
                    return None;
                }
                let over = points.rays.point(frame, column, row).filter(|[x, y, z]| {
                    let (dx, dy, up) = (x - px, y - py, z - top.height);
                    (cos * dx + sin * dy).abs() < half[0]
                        && (cos * dy - sin * dx).abs() < half[1]
                        && up > -0.04
                        && up < HIGHEST_M
                });
                over.map(|[x, y, z]| [x, y, z - top.height])
            }));
        }
        let mut patch = Self { window, is_thing: vec![false; places.len()], points: places, color: [0.0; 3] };
        patch.tell_apart(frame);
        patch
    }

    fn color_at(&self, frame: &RgbdFrame, at: usize) -> [f32; 3] {
        let width = self.window[1] - self.window[0];
        let pixel = (self.window[2] + at / width) * frame.width + self.window[0] + at % width;
        frame.color[pixel].map(|c| f32::from(c) / 255.0)
    }

    /// What rises above the top, or lies in it with another colour than most of it.
    fn tell_apart(&mut self, frame: &RgbdFrame) {
        let level = |up: f32| up.abs() < 0.03;
        let flat: Vec<[f32; 3]> = (0..self.points.len())
            .step_by(1 + self.points.len() / 3000)
            .filter(|at| self.points[*at].is_some_and(|[_, _, up]| level(up)))
            .map(|at| self.color_at(frame, at))
            .collect();
        if flat.len() < 20 {
            return;
        }
        let middle = |mut values: Vec<f32>| {
            values.sort_by(f32::total_cmp);
            values[values.len() / 2]
        };
        self.color = [0, 1, 2].map(|c| middle(flat.iter().map(|color| color[c]).collect()));
        let usual = middle(flat.iter().map(|color| contrast(*color, self.color)).collect());
        let least = LEAST_CONTRAST.max(3.5 * usual);
        let [left, right, above, below] = self.window;
        let lines = (above..below).map(|row| &frame.color[row * frame.width..][left..right]);
        for ((point, is_thing), color) in self.points.iter().zip(&mut self.is_thing).zip(lines.flatten()) {
            let Some([x, y, up]) = point else { continue };
            let noise = above_noise(x * x + y * y);
            *is_thing = *up > noise || contrast(color.map(|c| f32::from(c) / 255.0), self.color) > least;
        }
    }

    /// Connected pixels of things.
    fn groups(&self) -> Vec<Vec<usize>> {
        let width = self.window[1] - self.window[0];
        let mut open = self.is_thing.clone();
        let mut groups = Vec::new();
        for start in 0..open.len() {
            if !open[start] {
                continue;
            }
            open[start] = false;
            let mut group = vec![start];
            let mut next = 0;
            while next < group.len() {
                let at = group[next];
                next += 1;
                let column = at % width;
                let beside = [at.wrapping_sub(width), at + width];
                let aside = [(column > 0).then(|| at - 1), (column + 1 < width).then(|| at + 1)];
                for other in beside.into_iter().chain(aside.into_iter().flatten()) {
                    if open.get(other) == Some(&true) {
                        open[other] = false;
                        group.push(other);
                    }
                }
            }
            if group.len() >= LEAST_PIXELS {
                groups.push(group);
            }
        }
        groups
    }

    fn thing(&self, frame: &RgbdFrame, top: &Top, group: Vec<usize>) -> Option<Thing> {
        const LARGEST_M2: f64 = 0.3;
        let width = self.window[1] - self.window[0];
        let points: Vec<[f32; 3]> = group.iter().filter_map(|at| self.points[*at]).collect();
        let sample = points.iter().step_by(1 + points.len() / SAMPLE);
        let places: Vec<Vec2> = sample.map(|[x, y, _]| vec2(f64::from(*x), f64::from(*y))).collect();
        let outline = Polygon::hull(places);
        let hull = outline.corners();
        if hull.len() < 3 {
            return None;
        }
        let boxes = (0..12).map(|i| rectangle_at(hull, f64::from(i) * std::f64::consts::FRAC_PI_2 / 12.0));
        let r = boxes.min_by(|a, b| (a.long * a.short).total_cmp(&(b.long * b.short)))?;
        let pixels: Vec<u32> = group
            .iter()
            .map(|at| ((self.window[2] + at / width) * frame.width + self.window[0] + at % width) as u32)
            .collect();
        if r.long * r.short > LARGEST_M2 {
            return None;
        }
        let look = Look::of(frame, &pixels);
        let mut ups: Vec<f32> = points.iter().step_by(1 + points.len() / SAMPLE).map(|point| point[2]).collect();
        ups.sort_by(f32::total_cmp);
        let up = |share: f32| ups[((ups.len() - 1) as f32 * share) as usize];
        let range = r.pose.position().norm();
        let focal = frame.intrinsics.fx;
        let area = group.len() as f64 * (range / focal).powi(2);
        let features =
            [r.long, r.short, f64::from(up(0.97)), f64::from(up(0.5)), area, area / (r.long * r.short).max(1e-4)];
        let mut features: Vec<f32> = features.map(|value| value as f32).to_vec();
        let bright = look.color.iter().copied().fold(0.0, f32::max);
        let dull = look.color.iter().copied().fold(1.0, f32::min);
        features.extend(look.color);
        features.extend([0, 1, 2].map(|c| look.color[c] - self.color[c]));
        features.extend([bright, bright - dull, look.color[0] - look.color[2], contrast(look.color, self.color)]);
        features.extend([look.spread, look.tall, range as f32, (group.len() as f32).ln(), top.height, look.edge]);
        let recognisable = look.whole && group.len() >= 110 && range < 2.3 && look.edge > 0.05;
        Some(Thing { place: r.pose.position(), pixels, features, is_flank: up(0.5) < -0.013, recognisable })
    }
}

fn contrast(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f32>().sqrt()
}

/// How a thing looks in the picture.
struct Look {
    color: [f32; 3],
    /// Deviation of its brightness.
    spread: f32,
    /// Rows over columns.
    tall: f32,
    /// Whether it keeps off the picture's edge.
    whole: bool,
    /// Mean step of brightness from one of its pixels to the next below: blurred things have none.
    edge: f32,
}

impl Look {
    fn of(frame: &RgbdFrame, pixels: &[u32]) -> Self {
        let bright = |at: usize| frame.color[at].iter().map(|c| f32::from(*c)).sum::<f32>() / 765.0;
        let (mut color, mut sums, mut bounds, mut steepest) =
            ([0.0; 3], [0.0_f32; 2], [usize::MAX, 0, usize::MAX, 0], 0.0_f32);
        for at in pixels.iter().map(|pixel| *pixel as usize) {
            let (column, row) = (at % frame.width, at / frame.width);
            bounds = [bounds[0].min(column), bounds[1].max(column), bounds[2].min(row), bounds[3].max(row)];
            (0..3).for_each(|c| color[c] += f32::from(frame.color[at][c]) / 255.0);
            let b = bright(at);
            sums = [sums[0] + b, sums[1] + b * b];
            let beside = [at.saturating_sub(2), (at + 2).min(frame.color.len() - 1)];
            steepest = beside.iter().fold(steepest, |most, other| most.max((bright(*other) - b).abs()));
        }
        let n = pixels.len() as f32;
        let [left, right, above, below] = bounds;
        let whole = left > 2 && above > 2 && right + 3 < frame.width && below + 3 < frame.height;
        let mean = sums[0] / n;
        Self {
            color: color.map(|c| c / n),
            spread: (sums[1] / n - mean * mean).max(0.0).sqrt(),
            tall: (below - above + 1) as f32 / (right - left + 1) as f32,
            whole,
            edge: steepest,
        }
    }
}
