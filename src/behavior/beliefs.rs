//! What the robot has come to believe of the furniture and the objects.

use crate::geometry::{Polygon, Vec2, vec2};
use crate::perception::{ObjectSighting, View};
use crate::record::Detection;

/// Two detections closer than this, or overlapping, are one piece of furniture.
const SAME_PLACE_M: f64 = 0.35;

/// A piece of furniture the robot has seen.
#[derive(Clone, Debug)]
pub struct Furniture {
    /// Counted in the order first seen.
    pub number: usize,
    /// The best look at it.
    pub detection: Detection,
    /// Its outline on the floor.
    pub footprint: Polygon,
    /// Whether the object was looked for on it, in vain.
    pub searched: bool,
}

impl Furniture {
    /// The middle of the footprint.
    pub fn centre(&self) -> Vec2 {
        vec2(self.detection.x, self.detection.y)
    }

    /// Category and number, for people: "coffee table 2".
    pub fn label(&self) -> String {
        format!("{} {}", self.detection.category.replace('_', " "), self.number)
    }
}

/// Everything seen so far.
#[derive(Clone, Debug, Default)]
pub struct Beliefs {
    /// Furniture in the order first seen.
    pub furniture: Vec<Furniture>,
    /// The latest sighting of each object, recognisable ones only.
    pub objects: Vec<ObjectSighting>,
    /// Points at which the sonar met something the eyes had not reported.
    pub bumps: Vec<Vec2>,
}

impl Beliefs {
    /// Takes in what the eyes report; true when the furniture has changed.
    pub fn take_in(&mut self, view: &View) -> bool {
        for sighting in view.objects.iter().filter(|sighting| sighting.recognisable) {
            self.objects.retain(|known| known.name != sighting.name || far_apart(known, sighting));
            self.objects.push(sighting.clone());
        }
        let mut changed = false;
        for detection in &view.furniture {
            changed |= self.place(detection);
        }
        changed
    }

    fn place(&mut self, detection: &Detection) -> bool {
        if detection.footprint.len() < 3 {
            return false;
        }
        let footprint = Polygon::new(detection.footprint.iter().map(|&[x, y]| vec2(x, y)).collect());
        let centre = vec2(detection.x, detection.y);
        // Associated by place, never by category: a label that flickers must not make a second item.
        let same = |known: &&mut Furniture| {
            (known.centre() - centre).norm() < SAME_PLACE_M || known.footprint.contains(centre)
        };
        if let Some(known) = self.furniture.iter_mut().find(same) {
            let moved = (known.centre() - centre).norm() > 0.02;
            if detection.confidence >= known.detection.confidence {
                known.detection = detection.clone();
                known.footprint = footprint;
            }
            return moved;
        }
        let number = 1 + self.furniture.iter().filter(|f| f.detection.category == detection.category).count();
        self.furniture.push(Furniture { number, detection: detection.clone(), footprint, searched: false });
        true
    }

    /// Where an object of that name was last recognised; any object when none is named.
    pub fn sighting(&self, name: Option<&str>) -> Option<&ObjectSighting> {
        self.objects.iter().rev().find(|sighting| name.is_none_or(|name| sighting.name == name))
    }

    /// The furniture on which a point lies, or nearest to it within half a metre.
    pub fn under(&self, point: Vec2) -> Option<usize> {
        let near = |f: &Furniture| f.footprint.distance_to(point);
        let best =
            (0..self.furniture.len()).min_by(|&a, &b| near(&self.furniture[a]).total_cmp(&near(&self.furniture[b])))?;
        (near(&self.furniture[best]) < 0.5).then_some(best)
    }
}

fn far_apart(a: &ObjectSighting, b: &ObjectSighting) -> bool {
    (vec2(a.x, a.y) - vec2(b.x, b.y)).norm() > SAME_PLACE_M
}

#[cfg(test)]
mod tests {
    use super::*;

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
            beliefs.take_in(&View { furniture: vec![detection(category, 1.0, confidence)], objects: Vec::new() });
        }
        assert_eq!(beliefs.furniture.len(), 1);
        assert_eq!(beliefs.furniture[0].detection.category, "table");
    }

    #[test]
    fn a_point_on_the_top_belongs_to_that_table() {
        let mut beliefs = Beliefs::default();
        let furniture = vec![detection("table", 0.0, 1.0), detection("table", 3.0, 1.0)];
        beliefs.take_in(&View { furniture, objects: Vec::new() });
        assert_eq!(beliefs.under(vec2(3.1, 0.1)), Some(1));
        assert_eq!(beliefs.under(vec2(1.5, 2.0)), None);
    }
}
