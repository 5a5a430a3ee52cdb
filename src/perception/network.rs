//! A network's boxes in the picture, made pieces by the depth and joined with what the forests found.
//!
//! The two err differently: a network knows a chair by its looks and no cupboards, the forests know measures. A piece
//! that both see is the surer for it, and its name is the one for which both speak.

use std::collections::BTreeMap;

use super::Detector;
use super::answer::{Answer, PictureBox};
use super::detector::{furniture_chance, overlap, rounded};
use crate::catalogue::{self, CATEGORIES, Category};
use crate::frame::RgbdFrame;
use crate::map::RoomMap;
use crate::record::Detection;

/// Two are one piece when so much of both together is common.
const SAME: f64 = 0.3;
/// What is nearer to the floor is floor, metres.
const FLOOR_M: f64 = 0.06;
/// A piece reaches from its nearest part at most so far back, metres; half as much to the front, for noise.
const DEEPEST_M: f64 = 1.2;
/// A forest's chance of a category that it does not name.
const UNNAMED: f64 = 0.01;
/// How well a category fits a network's word: the category itself, one of its class, any other.
const FITS: [f64; 3] = [1.0, 0.7, 0.05];

/// The category that a data set's name stands for.
fn category_called(name: &str) -> Option<&'static Category> {
    let plain = name.trim().to_lowercase().replace([' ', '-'], "_");
    let plain = plain.split("_(").next().unwrap_or_default();
    CATEGORIES.iter().find(|c| c.name == plain || c.noun == plain || c.also_called.contains(&plain))
}

/// What a detector of one's own answered, as pieces; joined with `own`, what the forests found, unless there is none.
pub(super) fn joined(
    detector: &Detector,
    (frame, map): (&RgbdFrame, Option<&RoomMap>),
    answer: Answer,
    own: Vec<Detection>,
) -> Vec<Detection> {
    let mut pieces: Vec<(Detection, bool)> = own.into_iter().map(|piece| (piece, false)).collect();
    for seen in answer.detections.unwrap_or_default() {
        let same = |piece: &Detection| overlap(piece, &seen);
        match best(&pieces, same) {
            Some(at) => confirm(&mut pieces[at], &seen.category, seen.confidence),
            None => pieces.push((seen, true)),
        }
    }
    let mut boxes = answer.boxes.unwrap_or_default();
    boxes.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    for seen in &boxes {
        let Some(category) = category_called(&seen.category) else { continue };
        let same = |piece: &Detection| in_picture(frame, piece).map_or(0.0, |shown| common(shown, seen.sides));
        match best(&pieces, same) {
            Some(at) => confirm(&mut pieces[at], category.name, seen.confidence),
            None => pieces.extend(lifted(detector, frame, map, seen, category).map(|piece| (piece, true))),
        }
    }
    pieces.into_iter().map(|(piece, _)| rounded(piece)).collect()
}

/// The piece that is most likely the one seen, of those that were not seen already.
fn best(pieces: &[(Detection, bool)], same: impl Fn(&Detection) -> f64) -> Option<usize> {
    let free = (0..pieces.len()).filter(|i| !pieces[*i].1).map(|i| (same(&pieces[i].0), i));
    free.filter(|(share, _)| *share > SAME).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i)
}

/// A second witness: the piece is there unless both err, and its name is the product of what both say.
fn confirm((piece, is_seen): &mut (Detection, bool), category: &str, confidence: f64) {
    *is_seen = true;
    let there = 1.0 - (1.0 - furniture_chance(piece).min(1.0)) * (1.0 - confidence);
    name(piece, category, confidence, there);
}

/// Names a piece by its scores and a network's word.
fn name(piece: &mut Detection, category: &str, confidence: f64, there: f64) {
    let class = catalogue::class_of(category);
    let names = CATEGORIES.iter().filter(|c| c.family || c.name == category);
    let chances = names.map(|c| {
        let fit = if c.name == category { FITS[0] } else { FITS[if Some(c.class) == class { 1 } else { 2 }] };
        let own = piece.scores.get(c.name).copied().unwrap_or(0.0).max(UNNAMED);
        (c.name.to_string(), own * (1.0 - confidence + confidence * fit))
    });
    let chances: BTreeMap<String, f64> = chances.collect();
    let sum: f64 = chances.values().sum();
    let most = chances.iter().fold(("", 0.0), |most, (name, p)| if *p > most.1 { (name, *p) } else { most });
    piece.category = most.0.to_string();
    piece.confidence = there * most.1 / sum;
    let separator = if piece.why.is_empty() { "" } else { "; " };
    piece.why = format!("{}{separator}the network says {category}, {:.0} %", piece.why, 100.0 * confidence);
    piece.scores = chances.into_iter().map(|(name, p)| (name, p / sum)).filter(|(_, p)| *p >= 0.02).collect();
}

/// The piece that a box or mask covers, by its depth.
fn lifted(
    detector: &Detector,
    frame: &RgbdFrame,
    map: Option<&RoomMap>,
    seen: &PictureBox,
    category: &Category,
) -> Option<Detection> {
    let item_of = covered(frame, seen)?;
    let pieces = detector.detect_items(frame, map, &item_of).furniture;
    let mut piece = pieces.into_iter().max_by(|a, b| (a.length * a.width).total_cmp(&(b.length * b.width)))?;
    name(&mut piece, category.name, seen.confidence, seen.confidence);
    Some(piece)
}

/// 1 for the pixels of the piece, 0 for all others: what the mask covers, or what of the box stands before the rest.
fn covered(frame: &RgbdFrame, seen: &PictureBox) -> Option<Vec<u16>> {
    let mask = seen.mask.as_ref().map(|mask| mask.covered(frame.width, frame.height));
    let [left, top, right, bottom] = seen.sides.map(|v| v.max(0.0) as usize);
    let rows = (top..bottom.min(frame.height)).flat_map(|y| (left..right.min(frame.width)).map(move |x| (x, y)));
    let standing = rows.filter_map(|(column, row)| {
        let at = row * frame.width + column;
        let depth = frame.depth_at(column as f64, row as f64)?;
        let is_covered = mask.as_ref().is_none_or(|mask| mask[at]);
        (is_covered && frame.point(column, row, depth)[2] > FLOOR_M).then_some((at, depth))
    });
    let standing: Vec<(usize, f64)> = standing.collect();
    let mut depths: Vec<f64> = standing.iter().map(|(_, depth)| *depth).collect();
    depths.sort_by(f64::total_cmp);
    let near = *depths.get(depths.len() / 5)?;
    let of_piece = |depth: f64| mask.is_some() || (near - DEEPEST_M / 2.0..near + DEEPEST_M).contains(&depth);
    let mut item_of = vec![0; frame.depth.len()];
    standing.iter().filter(|(_, depth)| of_piece(*depth)).for_each(|(at, _)| item_of[*at] = 1);
    Some(item_of)
}

/// Left, top, right, bottom of a piece in the picture, pixels.
fn in_picture(frame: &RgbdFrame, piece: &Detection) -> Option<[f64; 4]> {
    let corners = piece.footprint.iter().flat_map(|&[x, y]| [[x, y, 0.0], [x, y, piece.height]]);
    let shown: Vec<(f64, f64, f64)> = corners.filter_map(|corner| frame.pixel(corner)).collect();
    let (width, height) = (frame.width as f64, frame.height as f64);
    let start = [width, height, 0.0, 0.0];
    let around = shown.iter().fold(start, |[left, top, right, bottom], (x, y, _)| {
        [left.min(*x), top.min(*y), right.max(*x), bottom.max(*y)]
    });
    let [left, top, right, bottom] = around;
    let within = [left.max(0.0), top.max(0.0), right.min(width), bottom.min(height)];
    (within[0] < within[2] && within[1] < within[3]).then_some(within)
}

/// Intersection over union of two boxes.
fn common(a: [f64; 4], b: [f64; 4]) -> f64 {
    let area = |[left, top, right, bottom]: [f64; 4]| (right - left).max(0.0) * (bottom - top).max(0.0);
    let both = area([a[0].max(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].min(b[3])]);
    both / (area(a) + area(b) - both).max(1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::camera::{Kinect, SolidScene};
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    fn seen() -> (Detector, RgbdFrame, Vec<Detection>) {
        let scene = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
        let pose = Pose::new(3.0, 2.0, 0.4);
        let (frame, _) = Kinect::default().capture(&scene, pose, &mut ChaCha8Rng::seed_from_u64(1));
        let detector = Detector::default();
        let own = detector.detect(&frame, None).furniture;
        (detector, frame, own)
    }

    fn answer(category: &str, sides: [f64; 4]) -> Answer {
        let seen = PictureBox { category: category.to_string(), confidence: 0.9, sides, mask: None };
        Answer { boxes: Some(vec![seen]), ..Answer::default() }
    }

    #[test]
    fn a_piece_that_both_see_is_surer_and_named_by_both() {
        let (detector, frame, own) = seen();
        let first = own[0].clone();
        let sides = in_picture(&frame, &first).expect("in the picture");
        let joined = joined(&detector, (&frame, None), answer(&first.category, sides), own.clone());
        assert_eq!((joined.len(), &joined[0].category), (own.len(), &first.category));
        assert!(joined[0].confidence >= first.confidence && joined[0].why.contains("the network says"));
    }

    #[test]
    fn a_box_alone_is_lifted_to_where_the_piece_stands() {
        let (detector, frame, own) = seen();
        let first = &own[0];
        let sides = in_picture(&frame, first).expect("in the picture");
        let alone = joined(&detector, (&frame, None), answer(&first.category, sides), Vec::new());
        assert_eq!(alone.len(), 1);
        let off = f64::hypot(alone[0].x - first.x, alone[0].y - first.y);
        assert!(off < 0.6, "{off} m from {} m, {} m", first.x, first.y);
        let none = joined(&detector, (&frame, None), answer("zebra", sides), Vec::new());
        assert_eq!(none, [], "what is no furniture is passed over");
    }

    #[test]
    fn names_of_other_data_sets_are_known() {
        for (name, category) in [
            ("dining table", "dinner_table"),
            ("chest_of_drawers_(furniture)", "dresser"),
            ("sofa", "couch"),
            ("bookcase", "bookshelf"),
        ] {
            assert_eq!(category_called(name).map(|c| c.name), Some(category), "{name}");
        }
    }
}
