//! A piece of furniture as the robot believes in it, from all its looks together.

use std::collections::BTreeMap;

use crate::geometry::{Polygon, Vec2, vec2};
use crate::record::Detection;

/// Two detections closer than this, or overlapping, are one piece of furniture, metres.
pub(super) const SAME_PLACE_M: f64 = 0.35;
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
/// So many looks in plain view without a piece are needed to take it to be not there.
const LOOKS_TO_REFUTE: f64 = 3.0;

/// A piece of furniture the robot has seen.
#[derive(Clone, Debug)]
pub struct Furniture {
    /// Tells it from others of its category.
    pub number: usize,
    /// What it is called in place of category and number, by those who know better than the robot.
    pub name: Option<String>,
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
    /// Whether its space is known to be empty.
    pub(super) is_empty: bool,
}

impl Furniture {
    pub(super) fn new(number: usize, detection: &Detection, footprint: Polygon) -> Self {
        let mut furniture = Self {
            number,
            name: None,
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
            is_empty: false,
        };
        furniture.count(detection);
        furniture
    }

    /// The middle of the footprint.
    pub fn centre(&self) -> Vec2 {
        vec2(self.detection.x, self.detection.y)
    }

    /// Category and number, for people: "coffee table 2"; or the name it was given.
    pub fn label(&self) -> String {
        let name = self.name.clone();
        name.unwrap_or_else(|| self.counted())
    }

    /// The same piece under that name.
    pub fn named(&self, name: String) -> Self {
        Self { name: Some(name), ..self.clone() }
    }

    fn counted(&self) -> String {
        format!("{} {}", self.detection.category.replace('_', " "), self.number)
    }

    /// How sure the robot is that this is there and of a category for which `is` holds, 0 to 1, over all looks.
    pub fn belief(&self, is: impl Fn(&str) -> bool) -> f64 {
        let votes: f64 = self.votes.iter().filter(|(category, _)| is(category)).map(|(_, votes)| votes).sum();
        if self.is_empty {
            return 0.0;
        }
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

    /// A look should have shown it and did not; true when it is now taken to be not there.
    pub(super) fn overlook(&mut self) -> bool {
        let before = self.is_refuted();
        self.overlooked += 1.0;
        self.is_refuted() && !before
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
    pub(super) fn look_again(&mut self, detection: &Detection, footprint: Polygon) -> bool {
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

    pub(super) fn is_at(&self, centre: Vec2, footprint: &Polygon) -> bool {
        (self.centre() - centre).norm() < SAME_PLACE_M
            || self.footprint.contains(centre)
            || footprint.contains(self.centre())
    }
}
