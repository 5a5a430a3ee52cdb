//! What the robot has come to believe of the furniture and the objects.

use super::free_space::FreeSpace;
use super::furniture::Furniture;
use super::glimpses::Glimpses;
use super::names::Names;
use crate::frame::RgbdFrame;
use crate::geometry::{Vec2, vec2};
use crate::perception::{Fused, ObjectSighting, SAME_PLACE_M, View, associated, outline};
use crate::record::Detection;

/// Everything seen so far.
#[derive(Clone, Debug, Default)]
pub struct Beliefs {
    /// Furniture in the order first seen.
    pub furniture: Vec<Furniture>,
    /// The latest sighting of each object, recognisable ones only.
    pub objects: Vec<ObjectSighting>,
    /// Everything small that was seen, recognisable or not.
    pub glimpses: Glimpses,
    names: Names,
    /// What is known to be empty.
    pub free_space: FreeSpace,
    /// Where a person said that it is not, metres.
    pub passed_over: Vec<Vec2>,
    /// Points at which the sonar met something the eyes had not reported.
    pub bumps: Vec<Vec2>,
}

impl Beliefs {
    /// What a robot far off believes of pieces seen without fault.
    pub fn of(furniture: Vec<Detection>) -> Self {
        let mut beliefs = Self::default();
        beliefs.take_in(&View { furniture, objects: Vec::new() }, Vec2::repeat(f64::MAX));
        beliefs
    }

    /// Takes in what the eyes of a robot that stands at `here` report; true when the furniture has changed.
    pub fn take_in(&mut self, view: &View, here: Vec2) -> bool {
        let heeded = view.objects.iter().filter(|sighting| !self.is_passed_over_at(vec2(sighting.x, sighting.y)));
        let heeded: Vec<&ObjectSighting> = heeded.collect();
        for &sighting in heeded.iter().filter(|sighting| sighting.recognisable) {
            self.objects.retain(|known| known.name != sighting.name || far_apart(known, sighting));
            self.objects.push(sighting.clone());
            self.names.tell(sighting);
        }
        heeded.iter().for_each(|sighting| self.glimpses.add(sighting, here));
        let mut changed = false;
        let known = associated(self.furniture.iter().map(Furniture::fused), &view.furniture);
        for (detection, known) in view.furniture.iter().zip(known) {
            changed |= self.place(detection, known, here);
        }
        for furniture in self.furniture.iter_mut().filter(|furniture| !furniture.holds) {
            furniture.holds = self.glimpses.steady().any(|at| furniture.footprint().contains(at));
        }
        changed
    }

    /// Whether a person said that it is not on this piece.
    pub fn is_passed_over(&self, piece: &Furniture) -> bool {
        self.passed_over.iter().any(|&at| piece.footprint().contains(at))
    }

    fn is_passed_over_at(&self, at: Vec2) -> bool {
        self.passed_over.iter().any(|passed| (passed - at).norm() < SAME_PLACE_M)
    }

    /// Takes in what a frame shows to be empty; true when it changes what stands where.
    pub fn clear(&mut self, frame: &RgbdFrame) -> bool {
        let outlines = self.furniture.iter().map(|furniture| (furniture.footprint(), furniture.margin()));
        let changed = self.free_space.take_in(frame, outlines);
        for furniture in &mut self.furniture {
            furniture.is_empty = self.free_space.refutes(furniture.footprint());
        }
        changed
    }

    /// Forgets that anything was looked at in vain: a look may have missed what was there.
    pub fn search_anew(&mut self) {
        self.furniture.iter_mut().for_each(|furniture| furniture.searched = false);
        self.glimpses.follow_anew();
    }

    /// Doubts what stands in plain view and is not in `view`; true when a piece is now taken to be not there.
    pub fn doubt(&mut self, view: &View, in_plain_view: impl Fn(&Furniture) -> bool) -> bool {
        let mut refuted = false;
        for known in &mut self.furniture {
            let shown = view.furniture.iter().any(|seen| {
                let centre = vec2(seen.x, seen.y);
                (known.centre() - centre).norm() < SAME_PLACE_M || known.footprint().contains(centre)
            });
            if !shown && in_plain_view(known) {
                refuted |= known.overlook();
            }
        }
        refuted
    }

    /// Takes in one detection: another look at the piece `known`, or a new one.
    fn place(&mut self, detection: &Detection, known: Option<usize>, here: Vec2) -> bool {
        // Where the robot stands, nothing else does.
        if outline(detection).is_none_or(|outline| outline.contains(here)) {
            return false;
        }
        if let Some(index) = known {
            return self.look_again(index, detection);
        }
        let Some(fused) = Fused::begun_by(detection) else { return false };
        self.furniture.push(Furniture::new(self.unused_number(&detection.category, None), fused));
        true
    }

    /// Takes in another look at a piece; it gets another number when it is now called something else.
    fn look_again(&mut self, index: usize, detection: &Detection) -> bool {
        let category = self.furniture[index].detection().category.clone();
        let moved = self.furniture[index].look_again(detection);
        if self.furniture[index].detection().category != category {
            self.furniture[index].number = self.unused_number(&self.furniture[index].detection().category, Some(index));
        }
        moved
    }

    /// The first number from 1 that no piece of a category has, but for one.
    fn unused_number(&self, category: &str, but: Option<usize>) -> usize {
        let others =
            self.furniture.iter().enumerate().filter(|(i, f)| f.detection().category == category && Some(*i) != but);
        let used: Vec<usize> = others.map(|(_, furniture)| furniture.number).collect();
        (1..).find(|number| !used.contains(number)).unwrap_or_default()
    }

    /// Where an object of that name was last recognised; any object when none is named. What was more often taken for
    /// something else does not count.
    pub fn sighting(&self, name: Option<&str>) -> Option<&ObjectSighting> {
        let named = |sighting: &&ObjectSighting| name.is_none_or(|name| sighting.name == name);
        self.objects.iter().rev().filter(named).find(|sighting| !self.names.outvote(sighting))
    }

    /// The furniture on which a point lies, or nearest to it within half a metre.
    pub fn under(&self, point: Vec2) -> Option<usize> {
        let near = |f: &Furniture| f.footprint().distance_to(point);
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
        assert_eq!(beliefs.furniture[0].detection().category, "table");
    }

    #[test]
    fn the_category_is_what_most_looks_say_and_the_others_are_not_forgotten() {
        let mut beliefs = Beliefs::default();
        for (category, confidence) in [("chair", 0.8), ("table", 0.7), ("table", 0.7)] {
            beliefs
                .take_in(&View { furniture: vec![detection(category, 1.0, confidence)], objects: Vec::new() }, FAR_OFF);
        }
        let piece = &beliefs.furniture[0];
        assert_eq!(piece.detection().category, "table");
        assert!(piece.belief(|category| category == "table") > piece.belief(|category| category == "chair"));
        assert!(piece.belief(|category| category == "chair") > 0.2);
    }

    #[test]
    fn no_two_pieces_have_the_same_label_though_one_was_called_something_else_before() {
        let mut beliefs = Beliefs::default();
        let looks = [("table", 1.0, 0.6), ("chair", 3.0, 0.6), ("table", 3.0, 0.9), ("chair", 5.0, 0.9)];
        for (category, x, confidence) in looks {
            let furniture = vec![detection(category, x, confidence)];
            beliefs.take_in(&View { furniture, objects: Vec::new() }, FAR_OFF);
        }
        let labels: Vec<String> = beliefs.furniture.iter().map(Furniture::label).collect();
        assert_eq!(labels, ["table 1", "table 2", "chair 1"]);
    }

    #[test]
    fn a_piece_seen_a_little_elsewhere_moves_and_stays_one() {
        let mut beliefs = Beliefs::default();
        for x in [1.0, 1.1] {
            beliefs.take_in(&View { furniture: vec![detection("table", x, 1.0)], objects: Vec::new() }, FAR_OFF);
        }
        assert_eq!(beliefs.furniture.len(), 1);
        assert!((beliefs.furniture[0].centre().x - 1.05).abs() < 1e-9);
        assert!((beliefs.furniture[0].footprint().centroid().x - 1.05).abs() < 1e-9);
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
    fn what_is_hidden_is_not_doubted() {
        let mut beliefs = Beliefs::default();
        beliefs.take_in(&View { furniture: vec![detection("table", 2.0, 0.5)], objects: Vec::new() }, FAR_OFF);
        (0..9).for_each(|_| assert!(!beliefs.doubt(&View::default(), |_| false)));
    }
}
