//! Whether what stands over a top goes on beyond it.
//!
//! An outline may reach too far: over the back of the bed beside a nightstand.
//! What is seen within it then ends where the outline does, and no thing does.

use std::collections::BTreeMap;

use crate::frame::RgbdFrame;
use crate::geometry::{Polygon, vec2};

/// No thing reaches so far beyond the top it stands on, metres.
const BEYOND_M: f64 = 0.1;
/// Steps in which a surface is followed there, and what its depth changes by at most from one to the next, metres.
const STEPS: usize = 5;
const JUMP_M: f64 = 0.05;
/// What is lower above the top is the top, and what is nearer to the outline is within it, metres.
const LEAST_M: f64 = 0.035;

/// Whether some pixels (column, row), of which each row is a stretch, end only because `outline` does: in most rows the
/// surface goes on to the same side, above the top at `top` metres.
pub fn goes_on_beyond(
    frame: &RgbdFrame,
    pixels: impl Iterator<Item = (usize, usize)>,
    outline: &Polygon,
    top: f64,
) -> bool {
    let mut ends: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    for (column, row) in pixels {
        let (left, right) = ends.entry(row).or_insert((column, column));
        (*left, *right) = ((*left).min(column), (*right).max(column));
    }
    let beyond = |column: usize, row: usize, side: f64| is_beyond(frame, (column, row), side, outline, top);
    let to_left = ends.iter().filter(|(row, (left, _))| beyond(*left, **row, -1.0)).count();
    let to_right = ends.iter().filter(|(row, (_, right))| beyond(*right, **row, 1.0)).count();
    2 * to_left.max(to_right) > ends.len()
}

fn is_beyond(frame: &RgbdFrame, (column, row): (usize, usize), side: f64, outline: &Polygon, top: f64) -> bool {
    let (column, row_at) = (column as f64, row as f64);
    let Some(mut depth) = frame.depth_at(column, row_at) else { return false };
    let step = side * BEYOND_M / STEPS as f64 * frame.intrinsics.fx / depth;
    let mut at = column;
    for i in 1..=STEPS {
        at = (column + step * i as f64).round();
        match frame.depth_at(at, row_at) {
            Some(next) if (next - depth).abs() < JUMP_M => depth = next,
            Some(_) => return false,
            // Lost pixels are passed over, but the last must be known.
            None if i == STEPS => return false,
            None => {}
        }
    }
    let [x, y, z] = frame.point(at as usize, row, depth);
    z > top + LEAST_M && outline.distance_to(vec2(x, y)) > LEAST_M
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::geometry::Pose;
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::camera::{Kinect, SolidScene};

    /// Whether what shows of the item or object `id` over `outline` goes on beyond that, seen from beside the nightstand.
    fn seen(id: &str, outline: &Polygon) -> bool {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let table = scene.item("round-table-2").expect("a nightstand");
        let pose = Pose::new(table.x - 0.7, table.y - 1.2, 0.7);
        let (frame, ids) =
            Kinect::default().capture(&SolidScene::new(&map, &scene), pose, &mut ChaCha8Rng::seed_from_u64(3));
        let item = scene.furniture.iter().position(|item| item.id == id);
        let object = || scene.objects.iter().position(|object| object.on == id);
        let number = if id == "bed-1" { item } else { object().map(|i| i + scene.furniture.len()) }.expect("there") + 1;
        let over = |at: &usize| {
            let (column, row) = (at % frame.width, at / frame.width);
            let depth = frame.depth_at(column as f64, row as f64).unwrap_or(0.0);
            let [x, y, z] = frame.point(column, row, depth);
            depth > 0.0 && usize::from(ids[*at]) == number && z > 0.65 && outline.contains(vec2(x, y))
        };
        let pixels: Vec<_> = (0..ids.len()).filter(over).map(|at| (at % frame.width, at / frame.width)).collect();
        assert!(pixels.len() > 300, "{id}: {} pixels", pixels.len());
        goes_on_beyond(&frame, pixels.into_iter(), outline, 0.6)
    }

    #[test]
    fn the_back_of_a_bed_goes_on_beyond_an_outline_that_reaches_over_it_and_a_statue_does_not() {
        let table = Scene::apartment().item("round-table-2").expect("a nightstand").pose();
        let outline = Polygon::rectangle(Pose::new(table.x, table.y, 0.0), 1.3, 1.3);
        assert!(seen("bed-1", &outline));
        assert!(!seen("round-table-2", &outline));
    }
}
