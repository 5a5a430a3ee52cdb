//! Several looks at one room made into one: what stands where, as all of them together tell.
//!
//! The one fusion there is: `perceive --fuse` writes it, and what a robot
//! believes of furniture is made of it. Looks are associated by place, never
//! by label: gating on a label that flickers would double the furniture.
//! The category is voted for; the best looks tell where it stands.

use std::collections::BTreeMap;

use super::detector::{furniture_chance, rounded};
use crate::geometry::{Polygon, Vec2, vec2};
use crate::record::Detection;

/// Two detections closer than this, or overlapping, are one piece of furniture, metres.
pub const SAME_PLACE_M: f64 = 0.35;
/// What is less likely furniture than this may confirm a piece, but is not believed to be one.
const LEAST_FURNITURE: f64 = 0.5;
/// A look at least this sure, against the surest so far, moves what is believed of place and outline.
const AS_GOOD: f64 = 0.9;
/// How far such a look moves it at least, a share of the difference: the first looks are averaged, and what the robot
/// believes of its own place shifts slowly.
const LEAST_BLEND: f64 = 0.3;
/// Looks that disagree by less agree, and more than the second is never kept away from, metres.
const SAME_M: f64 = 0.03;
const MOST_MARGIN_M: f64 = 0.08;
/// Things of more different height are not one, metres.
const MOST_HEIGHT_M: f64 = 0.6;
/// What stands on a thing covers less of the floor than this share of it.
const ON_SHARE: f64 = 0.4;
/// What moved by less has not moved, metres.
const MOVED_M: f64 = 0.02;
/// Less likely categories are not told.
const LEAST_TOLD: f64 = 0.02;

/// One piece of furniture, from all looks at it together.
#[derive(Clone, Debug)]
pub struct Fused {
    detection: Detection,
    footprint: Polygon,
    /// What all looks together say of its category: probabilities added up, the surer looks' counting more.
    votes: BTreeMap<String, f64>,
    /// What the looks count together.
    weight: f64,
    /// Squares of how far corners of later looks lay outside the outline believed before, added up, square metres.
    scatter: f64,
    looks: u32,
}

impl Fused {
    /// The first look; none for what has no outline, or is hardly furniture.
    pub fn begun_by(detection: &Detection) -> Option<Self> {
        let footprint = outline(detection)?;
        (furniture_chance(detection) >= LEAST_FURNITURE).then(|| {
            let detection = detection.clone();
            let votes = BTreeMap::new();
            let mut fused = Self { footprint, votes, weight: 0.0, scatter: 0.0, looks: 0, detection };
            fused.count(&fused.detection.clone());
            fused
        })
    }

    /// The best look at it, under the category that most looks speak for.
    pub fn detection(&self) -> &Detection {
        &self.detection
    }

    /// Its outline on the floor.
    pub fn footprint(&self) -> &Polygon {
        &self.footprint
    }

    /// The middle of the footprint.
    pub fn centre(&self) -> Vec2 {
        vec2(self.detection.x, self.detection.y)
    }

    /// How many looks showed it.
    pub fn looks(&self) -> u32 {
        self.looks
    }

    /// How likely it is of a category for which `is` holds, 0 to 1, by all looks.
    pub fn chance(&self, is: impl Fn(&str) -> bool) -> f64 {
        let votes: f64 = self.votes.iter().filter(|(category, _)| is(category)).map(|(_, votes)| votes).sum();
        votes / self.weight.max(1e-9)
    }

    /// How far it may reach beyond its outline, metres, by how much the looks at it disagree.
    pub fn margin(&self) -> f64 {
        let spread = (self.scatter / (f64::from(self.looks) - 1.0).max(1.0)).sqrt();
        (spread - SAME_M).clamp(0.0, MOST_MARGIN_M)
    }

    /// Whether a look may be one at this: it stands there, and is not of another height altogether.
    fn may_be(&self, detection: &Detection, outline: &Polygon) -> bool {
        let centre = vec2(detection.x, detection.y);
        let is_there = (self.centre() - centre).norm() < SAME_PLACE_M
            || self.footprint.contains(centre)
            || outline.contains(self.centre());
        is_there && (self.detection.height - detection.height).abs() < MOST_HEIGHT_M
    }

    /// How well a look agrees with it in outline and height.
    fn likeness(&self, detection: &Detection, outline: &Polygon) -> f64 {
        let higher = (self.detection.height - detection.height).abs() / MOST_HEIGHT_M;
        self.footprint.overlap(outline) + 0.5 * (1.0 - higher)
    }

    /// Takes in another look; true when the piece is not where it was believed to be.
    pub fn look_again(&mut self, detection: &Detection) -> bool {
        let Some(footprint) = outline(detection) else { return false };
        let from = self.centre();
        let off = footprint.corners().iter().map(|&corner| self.footprint.distance_to(corner)).fold(0.0, f64::max);
        self.scatter += off * off;
        if detection.confidence >= AS_GOOD * self.detection.confidence {
            let blend = (1.0 / (f64::from(self.looks) + 1.0)).max(LEAST_BLEND);
            let shift = (from - vec2(detection.x, detection.y)) * (1.0 - blend);
            self.footprint = Polygon::new(footprint.corners().iter().map(|corner| corner + shift).collect());
            let yaw = detection.yaw.or(self.detection.yaw);
            let confidence = detection.confidence.max(self.detection.confidence);
            self.detection = Detection { yaw, confidence, ..detection.clone() };
            self.detection.x += shift.x;
            self.detection.y += shift.y;
        }
        self.count(detection);
        (self.centre() - from).norm() > MOVED_M
    }

    /// Adds a look's word on the category; the likeliest by all looks is what the piece is called.
    fn count(&mut self, detection: &Detection) {
        self.looks += 1;
        let weight = detection.confidence.powi(2).max(1e-6);
        self.weight += weight;
        if detection.scores.is_empty() {
            *self.votes.entry(detection.category.clone()).or_default() += weight * detection.confidence;
        }
        for (category, score) in &detection.scores {
            *self.votes.entry(category.clone()).or_default() += weight * score;
        }
        // The first of equals in the alphabet, so that the same looks give the same name.
        let best = self.votes.iter().fold(None, |best: Option<(&String, f64)>, (category, &votes)| match best {
            Some((_, most)) if most >= votes => best,
            _ => Some((category, votes)),
        });
        if let Some((category, _)) = best {
            self.detection.category.clone_from(category);
        }
    }

    /// All looks as one detection.
    fn told(&self) -> Detection {
        let share = |votes: f64| votes / self.weight.max(1e-9);
        let scores = self.votes.iter().map(|(category, &votes)| (category.clone(), share(votes)));
        let why = &self.detection.why;
        rounded(Detection {
            confidence: self.chance(|category| category == self.detection.category),
            scores: scores.filter(|(_, score)| *score >= LEAST_TOLD).collect(),
            footprint: self.footprint.corners().iter().map(|corner| [corner.x, corner.y]).collect(),
            why: if self.looks > 1 { format!("{} views; {why}", self.looks) } else { why.clone() },
            ..self.detection.clone()
        })
    }
}

/// For each detection of one look the piece that it is another look at: among those that stand where it was seen, the
/// one most like it. Two detections of one look are two things where one stands on the other, as a lamp on its table;
/// else an eye has divided one.
pub fn associated<'f>(pieces: impl Iterator<Item = &'f Fused>, seen: &[Detection]) -> Vec<Option<usize>> {
    let pieces: Vec<&Fused> = pieces.collect();
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (detection, i) in seen.iter().zip(0..) {
        let Some(outline) = outline(detection) else { continue };
        let there = pieces.iter().zip(0..).filter(|(piece, _)| piece.may_be(detection, &outline));
        pairs.extend(there.map(|(piece, j)| (piece.likeness(detection, &outline), i, j)));
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut found: Vec<Option<usize>> = vec![None; seen.len()];
    for &(_, i, j) in &pairs {
        let taken = found.iter().zip(seen).find(|(known, _)| **known == Some(j)).map(|(_, by)| by);
        if found[i].is_none() && taken.is_none_or(|by| !is_on(&seen[i], by)) {
            found[i] = Some(j);
        }
    }
    found
}

/// Whether one may stand on the other: it is much smaller.
fn is_on(a: &Detection, b: &Detection) -> bool {
    let (a, b) = (a.length * a.width, b.length * b.width);
    a.min(b) < ON_SHARE * a.max(b)
}

/// The footprint as a polygon; none where fewer than three corners tell it.
pub fn outline(detection: &Detection) -> Option<Polygon> {
    let corners = || detection.footprint.iter().map(|&[x, y]| vec2(x, y)).collect();
    (detection.footprint.len() >= 3).then(|| Polygon::new(corners()))
}

/// The furniture of a room as many views show it.
#[derive(Clone, Debug, Default)]
pub struct FurnitureMap {
    pieces: Vec<Fused>,
}

impl FurnitureMap {
    /// Adds what one frame shows; all detections must be in the same world.
    pub fn add(&mut self, furniture: &[Detection]) {
        let known = associated(self.pieces.iter(), furniture);
        for (detection, known) in furniture.iter().zip(known) {
            match known {
                Some(index) => {
                    self.pieces[index].look_again(detection);
                }
                None => self.pieces.extend(Fused::begun_by(detection)),
            }
        }
    }

    /// What stands in the room, the surest first.
    pub fn furniture(&self) -> Vec<Detection> {
        let mut furniture: Vec<Detection> = self.pieces.iter().map(Fused::told).collect();
        furniture.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
        furniture
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;

    fn seen(category: &str, confidence: f64, other: &str, x: f64) -> Detection {
        let pose = Pose::new(x, 1.0, 0.0);
        Detection {
            category: category.to_string(),
            confidence,
            scores: BTreeMap::from([(category.to_string(), confidence), (other.to_string(), 1.0 - confidence)]),
            x,
            y: 1.0,
            yaw: Some(0.0),
            length: 0.8,
            width: 1.2,
            height: 0.74,
            footprint: Polygon::rectangle(pose, 0.8, 1.2).corners().iter().map(|c| [c.x, c.y]).collect(),
            attributes: Vec::new(),
            why: String::new(),
        }
    }

    #[test]
    fn a_label_that_flickers_makes_no_second_piece() {
        let mut map = FurnitureMap::default();
        for view in
            [seen("table", 0.6, "desk", 2.0), seen("desk", 0.55, "table", 2.05), seen("table", 0.7, "desk", 1.95)]
        {
            map.add(&[view]);
        }
        let furniture = map.furniture();
        assert_eq!(furniture.len(), 1);
        assert_eq!(furniture[0].category, "table");
        assert!((furniture[0].x - 2.0).abs() < 0.03 && furniture[0].why.starts_with("3 views"));
    }

    #[test]
    fn pieces_beside_each_other_stay_two() {
        let mut map = FurnitureMap::default();
        map.add(&[seen("table", 0.8, "desk", 0.0), seen("table", 0.8, "desk", 0.9)]);
        map.add(&[seen("table", 0.8, "desk", 0.05), seen("table", 0.8, "desk", 0.95)]);
        assert_eq!(map.furniture().len(), 2);
    }

    #[test]
    fn a_lamp_stays_apart_from_the_nightstand_it_stands_on() {
        let lamp = |x: f64| Detection { height: 1.1, ..small(seen("lamp", 0.7, "chair", x), 0.2) };
        let stand = |x: f64| small(seen("nightstand", 0.8, "stool", x), 0.5);
        let mut map = FurnitureMap::default();
        map.add(&[stand(0.0), lamp(0.05)]);
        map.add(&[lamp(0.04), stand(0.02)]);
        let categories: Vec<String> = map.furniture().into_iter().map(|piece| piece.category).collect();
        assert_eq!(categories, ["nightstand", "lamp"]);
    }

    fn small(detection: Detection, side: f64) -> Detection {
        let pose = Pose::new(detection.x, detection.y, 0.0);
        let footprint = Polygon::rectangle(pose, side, side).corners().iter().map(|c| [c.x, c.y]).collect();
        Detection { length: side, width: side, footprint, ..detection }
    }
}
