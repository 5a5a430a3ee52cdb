//! Parametric furniture families: any number of plausible pieces of each category.
//!
//! Sizes are spread over the ranges that furniture catalogues offer (for
//! instance dining tables 0.72–0.77 m high, seats 0.42–0.48 m, wardrobes
//! 1.7–2.4 m); styles – legs, pedestals, panels, drawers, arms, backs – and
//! finishes are drawn independently. They were written for this project as
//! training data, and resemble no one maker's models.
//!
//! ```
//! use spatial_fetch::simulation::{Dice, families};
//!
//! let couch = families::sample("couch", &mut Dice::new(1, 0)).expect("a family");
//! assert!(couch.size.width > couch.size.length);
//! ```

mod beds;
mod chairs;
mod desks;
mod drawers;
mod finishes;
mod lamps;
mod parts;
mod sofas;
mod storage;
mod tables;
mod vanity;

pub(super) use finishes::gaudy;
pub(super) use parts::sided;

use super::Dice;
use super::camera::Frustum;
use crate::catalogue::{Orientation, Size};
use crate::geometry::{Polygon, Vec2, vec2};

/// A piece of furniture in its own frame: front along +x, its bounding box centred on the origin, floor at 0.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Its category.
    pub category: &'static str,
    /// What of its orientation can be told.
    pub orientation: Orientation,
    /// Its bounding box.
    pub size: Size,
    /// What it is composed of.
    pub parts: Vec<Frustum>,
}

impl Piece {
    /// A piece of these parts, moved so that its bounding box is centred.
    pub fn new(category: &'static str, orientation: Orientation, mut parts: Vec<Frustum>) -> Self {
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let corners = parts.iter().flat_map(|part| part.bottom.iter().chain(&part.top));
        let (low, high) = corners.fold(start, |(low, high), c| (low.inf(c), high.sup(c)));
        let height = parts.iter().map(|part| part.high).fold(0.0, f64::max);
        let middle = (low + high) / 2.0;
        for part in &mut parts {
            part.bottom.iter_mut().chain(&mut part.top).for_each(|corner| *corner -= middle);
        }
        let span = high - low;
        Self { category, orientation, size: Size { length: span.x, width: span.y, height }, parts }
    }

    /// How high it reaches at a place of its own frame, metres: what is put there lies on that.
    pub fn surface_at(&self, place: Vec2) -> f64 {
        let there = |part: &&Frustum| Polygon::new(part.top.clone()).contains(place);
        self.parts.iter().filter(there).map(|part| part.high).fold(0.0, f64::max)
    }

    /// Half its length and half its width.
    pub fn half(&self) -> Vec2 {
        vec2(self.size.length / 2.0, self.size.width / 2.0)
    }
}

/// A random piece of a category that has a family; nothing for any other name.
pub fn sample(category: &str, dice: &mut Dice) -> Option<Piece> {
    let facing = |name, parts| Some(Piece::new(name, Orientation::Facing, parts));
    match category {
        "table" => Some(Piece::new("table", Orientation::ShortEdge, tables::table(dice))),
        "coffee_table" => Some(Piece::new("coffee_table", Orientation::ShortEdge, tables::coffee_table(dice))),
        "desk" => Some(Piece::new("desk", Orientation::ShortEdge, desks::desk(dice))),
        "nightstand" => facing("nightstand", storage::nightstand(dice)),
        "chair" => facing("chair", chairs::chair(dice)),
        "armchair" => facing("armchair", sofas::armchair(dice)),
        "stool" => Some(Piece::new("stool", Orientation::None, chairs::stool(dice))),
        "couch" => facing("couch", sofas::couch(dice)),
        "bed" => facing("bed", beds::bed(dice)),
        "wardrobe" => facing("wardrobe", storage::wardrobe(dice)),
        "dresser" => facing("dresser", storage::dresser(dice)),
        "bookshelf" => facing("bookshelf", storage::bookshelf(dice)),
        "shelf" => facing("shelf", storage::shelf(dice)),
        "cabinet" => facing("cabinet", storage::cabinet(dice)),
        "tv_stand" => facing("tv_stand", storage::tv_stand(dice)),
        "lamp" => Some(Piece::new("lamp", Orientation::None, lamps::floor_lamp(dice))),
        "table_lamp" => Some(Piece::new("lamp", Orientation::None, lamps::table_lamp(dice))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::FAMILIES;

    #[test]
    fn every_family_makes_pieces_of_a_size_that_fits_a_home() {
        let mut dice = Dice::new(7, 0);
        for category in FAMILIES {
            for _ in 0..200 {
                let piece = sample(category, &mut dice).expect(category);
                let Size { length, width, height } = piece.size;
                assert!((0.15..3.2).contains(&length), "{category} {length} long");
                assert!((0.15..3.6).contains(&width), "{category} {width} wide");
                assert!((0.2..2.5).contains(&height), "{category} {height} high");
                assert!(piece.parts.iter().all(|part| part.low >= -1e-9 && part.high > part.low), "{category}");
            }
        }
    }

    #[test]
    fn no_two_pieces_of_a_family_are_the_same() {
        let mut dice = Dice::new(7, 0);
        let mut widths: Vec<f64> =
            (0..50).filter_map(|_| sample("table", &mut dice)).map(|piece| piece.size.width).collect();
        widths.sort_by(f64::total_cmp);
        widths.dedup();
        assert!(widths.len() > 40, "{}", widths.len());
    }

    #[test]
    fn a_chair_has_its_back_behind_its_seat() {
        let mut dice = Dice::new(3, 0);
        for _ in 0..50 {
            let chair = sample("chair", &mut dice).expect("a family");
            let highest = chair.parts.iter().max_by(|a, b| a.high.total_cmp(&b.high)).expect("parts");
            assert!(highest.top.iter().all(|corner| corner.x < 0.0));
        }
    }

    #[test]
    fn what_has_no_family_is_not_made_up() {
        assert!(sample("piano", &mut Dice::new(1, 0)).is_none());
    }
}
