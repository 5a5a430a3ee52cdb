//! Small things that were seen again and again, if only from too far away to be told for sure.

use crate::geometry::Vec2;
use crate::perception::ObjectSighting;

/// Seen at one place from so many others, there is something.
const STEADY: u32 = 3;
/// Sightings of one name nearer to each other than this are of one thing, metres: from afar depth is coarse.
const SAME_PLACE_M: f64 = 0.25;

/// Looks from nearer to each other than this err alike, metres.
const SAME_VIEW_M: f64 = 0.2;

/// What may be there, by place and name.
#[derive(Clone, Debug, Default)]
pub struct Glimpses {
    seen: Vec<Glimpse>,
}

#[derive(Clone, Debug)]
struct Glimpse {
    name: String,
    at: Vec2,
    /// From how many places it was seen, and the last of them.
    count: u32,
    from: Vec2,
    /// Whether it was gone to.
    followed: bool,
}

impl Glimpses {
    /// Counts a sighting from `here`.
    pub fn add(&mut self, sighting: &ObjectSighting, here: Vec2) {
        let at = Vec2::new(sighting.x, sighting.y);
        match self.seen.iter_mut().find(|glimpse| glimpse.is_of(sighting)) {
            Some(glimpse) if (glimpse.from - here).norm() < SAME_VIEW_M => {}
            Some(glimpse) => {
                glimpse.count += 1;
                glimpse.from = here;
                glimpse.at += (at - glimpse.at) / f64::from(glimpse.count);
            }
            None => {
                let name = sighting.name.clone();
                self.seen.push(Glimpse { name, at, count: 1, from: here, followed: false });
            }
        }
    }

    /// Whether a thing of that name was seen nowhere else from more places.
    pub fn is_steadiest(&self, sighting: &ObjectSighting) -> bool {
        let own = self.seen.iter().find(|glimpse| glimpse.is_of(sighting)).map_or(0, |glimpse| glimpse.count);
        let namesakes = self.seen.iter().filter(|glimpse| glimpse.name == sighting.name);
        namesakes.max_by_key(|glimpse| glimpse.count).is_none_or(|most| most.count <= own.max(STEADY - 1))
    }

    /// The places at which some thing was seen again and again.
    pub fn steady(&self) -> impl Iterator<Item = Vec2> {
        self.seen.iter().filter(|glimpse| glimpse.count >= STEADY).map(|glimpse| glimpse.at)
    }

    /// Where something like the object was seen most often, each place once.
    pub fn follow(&mut self, name: &str) -> Option<Vec2> {
        let open = |g: &&mut Glimpse| g.name == name && g.count >= STEADY && !g.followed;
        let most = self.seen.iter_mut().filter(open).max_by_key(|glimpse| glimpse.count)?;
        most.followed = true;
        Some(most.at)
    }

    /// Forgets that any place was gone to.
    pub fn follow_anew(&mut self) {
        self.seen.iter_mut().for_each(|glimpse| glimpse.followed = false);
    }
}

impl Glimpse {
    fn is_of(&self, sighting: &ObjectSighting) -> bool {
        self.name == sighting.name && (self.at - Vec2::new(sighting.x, sighting.y)).norm() < SAME_PLACE_M
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sighting(x: f64) -> ObjectSighting {
        ObjectSighting { name: "mug".to_string(), x, y: 0.0, recognisable: false }
    }

    #[test]
    fn a_thing_seen_from_three_places_is_followed_once_and_one_seen_once_never() {
        let mut glimpses = Glimpses::default();
        [1.0, 1.1, 1.2, 4.0].iter().for_each(|&x| glimpses.add(&sighting(x), Vec2::new(0.0, 3.0 * x)));
        assert!(glimpses.is_steadiest(&sighting(1.0)) && !glimpses.is_steadiest(&sighting(4.0)));
        assert!((glimpses.follow("mug").expect("steady").x - 1.1).abs() < 1e-9);
        assert_eq!(glimpses.follow("mug"), None);
        assert_eq!(glimpses.steady().count(), 1);
    }

    #[test]
    fn many_pictures_from_one_place_are_one_view() {
        let mut glimpses = Glimpses::default();
        (0..9).for_each(|_| glimpses.add(&sighting(1.0), Vec2::new(0.0, 1.0)));
        assert_eq!(glimpses.steady().count(), 0);
    }
}
