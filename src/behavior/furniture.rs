//! A piece of furniture as the robot believes in it: what all looks at it tell, and what the search made of it.

use crate::geometry::{Polygon, Vec2};
use crate::perception::Fused;
use crate::record::Detection;

/// So many looks in plain view without a piece are needed to take it to be not there.
const LOOKS_TO_REFUTE: u32 = 3;

/// A piece of furniture the robot has seen.
#[derive(Clone, Debug)]
pub struct Furniture {
    /// Tells it from others of its category.
    pub number: usize,
    /// What it is called in place of category and number, by those who know better than the robot.
    pub name: Option<String>,
    /// What all looks at it tell together.
    fused: Fused,
    /// Whether the object was looked for on it, in vain, in this round of the search.
    pub searched: bool,
    /// From where it was looked at for the object.
    pub looked_from: Vec<Vec2>,
    /// Whether something small was seen on it again and again.
    pub holds: bool,
    /// Whether it was gone to for no more than to see better what it is.
    pub studied: bool,
    /// Looks since the last one that showed it, in which it stood in plain view and was not seen.
    overlooked: u32,
    /// Whether its space is known to be empty.
    pub(super) is_empty: bool,
}

impl Furniture {
    pub(super) fn new(number: usize, fused: Fused) -> Self {
        Self {
            number,
            name: None,
            fused,
            searched: false,
            looked_from: Vec::new(),
            holds: false,
            studied: false,
            overlooked: 0,
            is_empty: false,
        }
    }

    /// The best look at it, under the category that most looks speak for.
    pub fn detection(&self) -> &Detection {
        self.fused.detection()
    }

    /// Its outline on the floor.
    pub fn footprint(&self) -> &Polygon {
        self.fused.footprint()
    }

    /// The middle of the footprint.
    pub fn centre(&self) -> Vec2 {
        self.fused.centre()
    }

    /// How far it may reach beyond its outline, metres, by how much the looks at it disagree.
    pub fn margin(&self) -> f64 {
        self.fused.margin()
    }

    /// What all looks at it tell together.
    pub(super) fn fused(&self) -> &Fused {
        &self.fused
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
        format!("{} {}", self.detection().category.replace('_', " "), self.number)
    }

    /// How sure the robot is that this is there and of a category for which `is` holds, 0 to 1, over all looks.
    pub fn belief(&self, is: impl Fn(&str) -> bool) -> f64 {
        if self.is_empty {
            return 0.0;
        }
        let looks = f64::from(self.fused.looks());
        let shown = looks / (looks + f64::from(self.overlooked));
        (shown * self.fused.chance(is)).min(1.0)
    }

    /// Whether more looks that should have shown it did not than did: most likely it is not there.
    pub fn is_refuted(&self) -> bool {
        self.overlooked >= LOOKS_TO_REFUTE && self.overlooked > self.fused.looks()
    }

    /// Whether it was seen once only, and may yet be refuted.
    pub fn is_unsure(&self) -> bool {
        self.fused.looks() < 2 && !self.is_refuted()
    }

    /// A look should have shown it and did not; true when it is now taken to be not there.
    pub(super) fn overlook(&mut self) -> bool {
        let before = self.is_refuted();
        self.overlooked += 1;
        self.is_refuted() && !before
    }

    /// Takes in another look; true when the piece is not where it was believed to be.
    pub(super) fn look_again(&mut self, detection: &Detection) -> bool {
        self.overlooked = 0;
        self.fused.look_again(detection)
    }
}
