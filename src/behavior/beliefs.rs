//! What the robot has come to believe of the furniture and the objects.

use std::collections::BTreeMap;

use super::glimpses::Glimpses;
use crate::geometry::{Polygon, Vec2, vec2};
use crate::perception::{ObjectSighting, View};
use crate::record::Detection;

/// Two detections closer than this, or overlapping, are one piece of furniture, metres.
const SAME_PLACE_M: f64 = 0.35;
/// A look at least this sure, against the surest so far, moves what is believed of place and outline.
const AS_GOOD: f64 = 0.9;
/// How far such a look moves it at least, a share of the difference: the first looks are averaged, and what the robot
/// believes of its own place shifts slowly.
const LEAST_BLEND: f64 = 0.3;
/// Looks that disagree by less agree, and more than the second is never kept away from, metres.
const SAME_M: f64 = 0.03;
const MOST_MARGIN_M: f64 = 0.08;
/// What moved by less has not moved, metres.
const MOVED_M: f64 = 0.02;

/// Small things recognised nearer to each other than this are one, metres.
pub(super) const SAME_THING_M: f64 = 0.15;
/// What is less likely furniture than this may confirm a piece, but is not believed to be one.
const LEAST_FURNITURE: f64 = 0.5;
/// So many looks in plain view without a piece are needed to take it to be not there.
const LOOKS_TO_REFUTE: f64 = 3.0;

/// A piece of furniture the robot has seen.
#[derive(Clone, Debug)]
pub struct Furniture {
    /// Counted in the order first seen.
    pub number: usize,
    /// The best look at it, under the category that most looks speak for.
    pub detection: Detection,
    /// Its outline on the floor.
    pub footprint: Polygon,
    /// Whether the object was looked for on it, in vain, in this round of the search.
    pub searched: bool,
    /// From where it was looked at for the object.
    pub looked_from: Vec<Vec2>,
    /// Whether something small was seen on it again and again.
    pub holds: bool,
    /// Whether it was gone to for no more than to see better what it is.
    pub studied: bool,
    /// What all looks together say of its category: probabilities added up, the surer looks' counting more.
    votes: BTreeMap<String, f64>,
    /// What the looks count together.
    weight: f64,
    /// Squares of how far corners of later looks lay outside the outline believed before, added up, square metres.
    scatter: f64,
    looks: f64,
    /// Looks since the last one that showed it, in which it stood in plain view and was not seen.
    overlooked: f64,
}

impl Furniture {
    fn new(number: usize, detection: &Detection, footprint: Polygon) -> Self {
        let mut furniture = Self {
            number,
            detection: detection.clone(),
            footprint,
            searched: false,
            looked_from: Vec::new(),
            holds: false,
            studied: false,
            votes: BTreeMap::new(),
            weight: 0.0,
            scatter: 0.0,
            looks: 0.0,
            overlooked: 0.0,
        };
        furniture.count(detection);
        furniture
    }

    /// The middle of the footprint.
    pub fn centre(&self) -> Vec2 {
        vec2(self.detection.x, self.detection.y)
    }

    /// Category and number, for people: "coffee table 2".
    pub fn label(&self) -> String {
        format!("{} {}", self.detection.category.replace('_', " "), self.number)
    }

    /// How sure the robot is that this is there and of a category for which `is` holds, 0 to 1, over all looks.
    pub fn belief(&self, is: impl Fn(&str) -> bool) -> f64 {
        let votes: f64 = self.votes.iter().filter(|(category, _)| is(category)).map(|(_, votes)| votes).sum();
        let shown = self.looks / (self.looks + self.overlooked);
        (shown * votes / self.weight.max(1e-9)).min(1.0)
    }

    /// How far it may reach beyond its outline, metres, by how much the looks at it disagree.
    pub fn margin(&self) -> f64 {
        let spread = (self.scatter / (self.looks - 1.0).max(1.0)).sqrt();
        (spread - SAME_M).clamp(0.0, MOST_MARGIN_M)
    }

    /// Whether more looks that should have shown it did not than did: most likely it is not there.
    pub fn is_refuted(&self) -> bool {
        self.overlooked >= LOOKS_TO_REFUTE && self.overlooked > self.looks
    }

    /// Whether it was seen once only, and may yet be refuted.
    pub fn is_unsure(&self) -> bool {
        self.looks < 2.0 && !self.is_refuted()
    }

    /// Adds a look's word on the category; the likeliest by all looks is what the piece is called.
    fn count(&mut self, detection: &Detection) {
        self.looks += 1.0;
        self.overlooked = 0.0;
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

    /// Takes in another look; true when the piece is not where it was believed to be.
    fn look_again(&mut self, detection: &Detection, footprint: Polygon) -> bool {
        let from = self.centre();
        let off = footprint.corners().iter().map(|&corner| self.footprint.distance_to(corner)).fold(0.0, f64::max);
        self.scatter += off * off;
        if detection.confidence >= AS_GOOD * self.detection.confidence {
            let blend = (1.0 / (self.looks + 1.0)).max(LEAST_BLEND);
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

    fn is_at(&self, centre: Vec2, footprint: &Polygon) -> bool {
        (self.centre() - centre).norm() < SAME_PLACE_M
            || self.footprint.contains(centre)
            || footprint.contains(self.centre())
    }
}

/// Everything seen so far.
#[derive(Clone, Debug, Default)]
pub struct Beliefs {
    /// Furniture in the order first seen.
    pub furniture: Vec<Furniture>,
    /// The latest sighting of each object, recognisable ones only.
    pub objects: Vec<ObjectSighting>,
    /// Everything small that was seen, recognisable or not.
    pub glimpses: Glimpses,
    /// How often each name was recognised at each place.
    told: Vec<(Vec2, BTreeMap<String, u32>)>,
    /// Points at which the sonar met something the eyes had not reported.
    pub bumps: Vec<Vec2>,
}

impl Beliefs {
    /// Takes in what the eyes of a robot that stands at `here` report; true when the furniture has changed.
    pub fn take_in(&mut self, view: &View, here: Vec2) -> bool {
        for sighting in view.objects.iter().filter(|sighting| sighting.recognisable) {
            self.objects.retain(|known| known.name != sighting.name || far_apart(known, sighting));
            self.objects.push(sighting.clone());
            self.tell(sighting);
        }
        view.objects.iter().for_each(|sighting| self.glimpses.add(sighting, here));
        let mut changed = false;
        for detection in &view.furniture {
            changed |= self.place(detection, here);
        }
        for furniture in self.furniture.iter_mut().filter(|furniture| !furniture.holds) {
            furniture.holds = self.glimpses.steady().any(|at| furniture.footprint.contains(at));
        }
        changed
    }

    /// Forgets that anything was looked at in vain: a look may have missed what was there.
    pub fn search_anew(&mut self) {
        self.furniture.iter_mut().for_each(|furniture| furniture.searched = false);
    }

    /// Doubts what stands in plain view and is not in `view`; true when a piece is now taken to be not there.
    pub fn doubt(&mut self, view: &View, in_plain_view: impl Fn(&Furniture) -> bool) -> bool {
        let mut refuted = false;
        for known in &mut self.furniture {
            let shown = view.furniture.iter().any(|seen| {
                let centre = vec2(seen.x, seen.y);
                (known.centre() - centre).norm() < SAME_PLACE_M || known.footprint.contains(centre)
            });
            if !shown && in_plain_view(known) {
                let before = known.is_refuted();
                known.overlooked += 1.0;
                refuted |= known.is_refuted() && !before;
            }
        }
        refuted
    }

    fn place(&mut self, detection: &Detection, here: Vec2) -> bool {
        if detection.footprint.len() < 3 {
            return false;
        }
        let footprint = Polygon::new(detection.footprint.iter().map(|&[x, y]| vec2(x, y)).collect());
        // Where the robot stands, nothing else does.
        if footprint.contains(here) {
            return false;
        }
        let centre = vec2(detection.x, detection.y);
        // Associated by place, never by category: a label that flickers must not make a second item.
        let distance = |known: &Furniture| (known.centre() - centre).norm();
        let near = self.furniture.iter_mut().filter(|known| known.is_at(centre, &footprint));
        if let Some(known) = near.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            return known.look_again(detection, footprint);
        }
        if furniture_chance(detection) < LEAST_FURNITURE {
            return false;
        }
        let number = 1 + self.furniture.iter().filter(|f| f.detection.category == detection.category).count();
        self.furniture.push(Furniture::new(number, detection, footprint));
        true
    }

    /// Where an object of that name was last recognised; any object when none is named. What was more often taken for
    /// something else does not count.
    pub fn sighting(&self, name: Option<&str>) -> Option<&ObjectSighting> {
        let named = |sighting: &&ObjectSighting| name.is_none_or(|name| sighting.name == name);
        self.objects.iter().rev().filter(named).find(|sighting| !self.is_outvoted(sighting))
    }

    fn tell(&mut self, sighting: &ObjectSighting) {
        let place = vec2(sighting.x, sighting.y);
        let index = self.told.iter().position(|(at, _)| (at - place).norm() < SAME_THING_M).unwrap_or_else(|| {
            self.told.push((place, BTreeMap::new()));
            self.told.len() - 1
        });
        *self.told[index].1.entry(sighting.name.clone()).or_default() += 1;
    }

    /// Whether what lies at a sighting's place was recognised more often under another name.
    fn is_outvoted(&self, sighting: &ObjectSighting) -> bool {
        let place = vec2(sighting.x, sighting.y);
        let there = self.told.iter().find(|(at, _)| (at - place).norm() < SAME_THING_M);
        let own = there.and_then(|(_, names)| names.get(&sighting.name)).copied().unwrap_or(0);
        there.is_some_and(|(_, names)| names.values().any(|&count| count > own))
    }

    /// The furniture on which a point lies, or nearest to it within half a metre.
    pub fn under(&self, point: Vec2) -> Option<usize> {
        let near = |f: &Furniture| f.footprint.distance_to(point);
        let best =
            (0..self.furniture.len()).min_by(|&a, &b| near(&self.furniture[a]).total_cmp(&near(&self.furniture[b])))?;
        (near(&self.furniture[best]) < 0.5).then_some(best)
    }
}

/// How sure the eyes are that it is furniture at all: the category's chance among all over that among furniture.
fn furniture_chance(detection: &Detection) -> f64 {
    detection.scores.get(&detection.category).map_or(1.0, |score| detection.confidence / score.max(1e-9))
}

fn far_apart(a: &ObjectSighting, b: &ObjectSighting) -> bool {
    (vec2(a.x, a.y) - vec2(b.x, b.y)).norm() > SAME_PLACE_M
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The robot, where nothing else is.
    const FAR_OFF: Vec2 = Vec2::new(-9.0, -9.0);

    fn detection(category: &str, x: f64, confidence: f64) -> Detection {
        let square = [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]];
        Detection {
            category: category.to_string(),
            confidence,
            scores: Default::default(),
            x,
            y: 0.0,
            yaw: None,
            length: 0.6,
            width: 0.6,
            height: 0.5,
            footprint: square.map(|[dx, dy]| [x + dx, dy]).to_vec(),
            attributes: Vec::new(),
            why: String::new(),
        }
    }

    #[test]
    fn a_label_that_flickers_makes_no_second_item_and_the_surer_look_stays() {
        let mut beliefs = Beliefs::default();
        for (category, confidence) in [("table", 0.9), ("bed", 0.4)] {
            beliefs
                .take_in(&View { furniture: vec![detection(category, 1.0, confidence)], objects: Vec::new() }, FAR_OFF);
        }
        assert_eq!(beliefs.furniture.len(), 1);
        assert_eq!(beliefs.furniture[0].detection.category, "table");
    }

    #[test]
    fn the_category_is_what_most_looks_say_and_the_others_are_not_forgotten() {
        let mut beliefs = Beliefs::default();
        for (category, confidence) in [("chair", 0.8), ("table", 0.7), ("table", 0.7)] {
            beliefs
                .take_in(&View { furniture: vec![detection(category, 1.0, confidence)], objects: Vec::new() }, FAR_OFF);
        }
        let piece = &beliefs.furniture[0];
        assert_eq!(piece.detection.category, "table");
        assert!(piece.belief(|category| category == "table") > piece.belief(|category| category == "chair"));
        assert!(piece.belief(|category| category == "chair") > 0.2);
    }

    #[test]
    fn a_piece_seen_a_little_elsewhere_moves_and_stays_one() {
        let mut beliefs = Beliefs::default();
        for x in [1.0, 1.1] {
            beliefs.take_in(&View { furniture: vec![detection("table", x, 1.0)], objects: Vec::new() }, FAR_OFF);
        }
        assert_eq!(beliefs.furniture.len(), 1);
        assert!((beliefs.furniture[0].centre().x - 1.05).abs() < 1e-9);
        assert!((beliefs.furniture[0].footprint.centroid().x - 1.05).abs() < 1e-9);
    }

    #[test]
    fn looks_that_disagree_leave_a_margin_and_looks_that_agree_leave_none() {
        let margin = |places: [f64; 3]| {
            let mut beliefs = Beliefs::default();
            for x in places {
                beliefs.take_in(&View { furniture: vec![detection("table", x, 1.0)], objects: Vec::new() }, FAR_OFF);
            }
            beliefs.furniture[0].margin()
        };
        assert_eq!(margin([1.0, 1.01, 1.0]), 0.0);
        assert!(margin([1.0, 1.2, 0.9]) > 0.05);
    }

    #[test]
    fn a_point_on_the_top_belongs_to_that_table() {
        let mut beliefs = Beliefs::default();
        let furniture = vec![detection("table", 0.0, 1.0), detection("table", 3.0, 1.0)];
        beliefs.take_in(&View { furniture, objects: Vec::new() }, FAR_OFF);
        assert_eq!(beliefs.under(vec2(3.1, 0.1)), Some(1));
        assert_eq!(beliefs.under(vec2(1.5, 2.0)), None);
    }

    #[test]
    fn what_was_seen_once_and_then_never_where_it_should_show_is_taken_to_be_not_there() {
        let mut beliefs = Beliefs::default();
        beliefs.take_in(&View { furniture: vec![detection("table", 2.0, 0.5)], objects: Vec::new() }, FAR_OFF);
        assert!(beliefs.furniture[0].is_unsure());
        let refuted: Vec<bool> = (0..4).map(|_| beliefs.doubt(&View::default(), |_| true)).collect();
        assert_eq!(refuted, [false, false, true, false]);
        assert!(beliefs.furniture[0].is_refuted());
        beliefs.take_in(&View { furniture: vec![detection("table", 2.0, 0.5)], objects: Vec::new() }, FAR_OFF);
        assert!(!beliefs.furniture[0].is_refuted());
    }

    #[test]
    fn where_the_robot_stands_nothing_else_is_believed_to_stand() {
        let mut beliefs = Beliefs::default();
        let view = View { furniture: vec![detection("table", 2.0, 0.9)], objects: Vec::new() };
        assert!(!beliefs.take_in(&view, vec2(2.2, 0.1)) && beliefs.furniture.is_empty());
        assert!(beliefs.take_in(&view, vec2(1.2, 0.1)));
    }

    #[test]
    fn a_thing_is_what_it_was_recognised_as_most_often() {
        let mut beliefs = Beliefs::default();
        let seen = |name: &str| ObjectSighting { name: name.to_string(), x: 1.0, y: 1.0, recognisable: true };
        beliefs.take_in(&View { furniture: Vec::new(), objects: vec![seen("monitor")] }, FAR_OFF);
        assert!(beliefs.sighting(Some("monitor")).is_some());
        (0..2).for_each(|_| {
            beliefs.take_in(&View { furniture: Vec::new(), objects: vec![seen("statue")] }, FAR_OFF);
        });
        assert!(beliefs.sighting(Some("monitor")).is_none() && beliefs.sighting(Some("statue")).is_some());
    }

    #[test]
    fn what_is_hidden_is_not_doubted() {
        let mut beliefs = Beliefs::default();
        beliefs.take_in(&View { furniture: vec![detection("table", 2.0, 0.5)], objects: Vec::new() }, FAR_OFF);
        (0..9).for_each(|_| assert!(!beliefs.doubt(&View::default(), |_| false)));
    }
}
