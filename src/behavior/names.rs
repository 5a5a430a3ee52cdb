//! What each small thing was recognised as, and how often.

use std::collections::BTreeMap;

use crate::geometry::{Vec2, vec2};
use crate::perception::ObjectSighting;

/// Small things recognised nearer to each other than this are one, metres.
pub const SAME_THING_M: f64 = 0.15;

/// How often each name was recognised at each place.
#[derive(Clone, Debug, Default)]
pub struct Names {
    told: Vec<(Vec2, BTreeMap<String, u32>)>,
}

impl Names {
    /// Counts a sighting.
    pub fn tell(&mut self, sighting: &ObjectSighting) {
        let place = vec2(sighting.x, sighting.y);
        let index = self.told.iter().position(|(at, _)| (at - place).norm() < SAME_THING_M).unwrap_or_else(|| {
            self.told.push((place, BTreeMap::new()));
            self.told.len() - 1
        });
        *self.told[index].1.entry(sighting.name.clone()).or_default() += 1;
    }

    /// Whether what lies at a sighting's place was recognised more often under another name.
    pub fn outvote(&self, sighting: &ObjectSighting) -> bool {
        let place = vec2(sighting.x, sighting.y);
        let there = self.told.iter().find(|(at, _)| (at - place).norm() < SAME_THING_M);
        let own = there.and_then(|(_, names)| names.get(&sighting.name)).copied().unwrap_or(0);
        there.is_some_and(|(_, names)| names.values().any(|&count| count > own))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thing_is_what_it_was_recognised_as_most_often() {
        let mut names = Names::default();
        let seen = |name: &str| ObjectSighting { name: name.to_string(), x: 1.0, y: 1.0, recognisable: true };
        names.tell(&seen("monitor"));
        assert!(!names.outvote(&seen("monitor")));
        (0..2).for_each(|_| names.tell(&seen("statue")));
        assert!(names.outvote(&seen("monitor")) && !names.outvote(&seen("statue")));
    }
}
