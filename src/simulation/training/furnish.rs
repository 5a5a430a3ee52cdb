//! What stands in which room.

use super::clutter;
use super::room::FurnishedRoom;
use crate::catalogue;
use crate::catalogue::OBJECTS;
use crate::catalogue::Orientation;
use crate::geometry::Pose;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum, Texture};
use crate::simulation::families;
use crate::simulation::families::Piece;

/// What can stand at a wall in each kind of room, and the chance of each.
const AT_WALLS: [&[(&str, f64)]; 4] = [
    &[("wardrobe", 0.8), ("dresser", 0.6), ("bookshelf", 0.3), ("desk", 0.4), ("armchair", 0.2), ("shelf", 0.2)],
    &[("tv_stand", 0.8), ("bookshelf", 0.5), ("cabinet", 0.4), ("shelf", 0.3), ("armchair", 0.3), ("lamp", 0.4)],
    &[("cabinet", 0.6), ("shelf", 0.4), ("dresser", 0.3), ("tv_stand", 0.2), ("bookshelf", 0.3), ("lamp", 0.3)],
    &[("bookshelf", 0.7), ("shelf", 0.5), ("cabinet", 0.4), ("couch", 0.3), ("wardrobe", 0.2), ("lamp", 0.3)],
];

/// Tall for a small thing, metres.
const TALL_M: f64 = 0.2;

/// A room for sleeping, living, dining or working, with some pieces that belong and some that need not.
pub(super) fn furnished_room(dice: &mut Dice) -> FurnishedRoom {
    let mut furnisher = Furnisher::new(dice);
    let kind = furnisher.dice.whole(0, 3);
    match kind {
        0 => furnisher.sleeping(),
        1 => furnisher.living(),
        2 => furnisher.dining(),
        _ => furnisher.working(),
    }
    for (category, chance) in AT_WALLS[kind] {
        if furnisher.dice.chance(*chance) {
            furnisher.at_wall(category);
        }
    }
    for _ in 0..furnisher.dice.whole(0, 3) {
        let category = furnisher.dice.pick(&catalogue::FAMILIES);
        furnisher.in_the_open(category);
    }
    furnisher.set_clutter_on_floor();
    furnisher.set_things_on_tops();
    furnisher.set_clutter_on_furniture();
    furnisher.room
}

struct Furnisher<'r> {
    dice: &'r mut Dice,
    room: FurnishedRoom,
}

impl<'r> Furnisher<'r> {
    fn new(dice: &'r mut Dice) -> Self {
        let half = (dice.between(1.5, 3.6), dice.between(1.4, 3.0));
        let room = FurnishedRoom { half, height: dice.between(2.3, 3.0), placed: Vec::new() };
        Self { dice, room }
    }

    fn at_wall(&mut self, category: &str) -> Option<usize> {
        let piece = families::sample(category, self.dice)?;
        self.room.at_wall(piece, self.dice)
    }

    fn in_the_open(&mut self, category: &str) -> Option<usize> {
        let piece = families::sample(category, self.dice)?;
        self.room.in_the_open(piece, self.dice)
    }

    fn sleeping(&mut self) {
        let Some(bed) = self.at_wall("bed") else { return };
        for _ in 0..self.dice.whole(0, 2) {
            if let Some(piece) = families::sample("nightstand", self.dice) {
                self.room.beside(bed, piece, self.dice);
            }
        }
    }

    fn living(&mut self) {
        let at_wall = self.dice.chance(0.6);
        let Some(couch) = (if at_wall { self.at_wall("couch") } else { self.in_the_open("couch") }) else { return };
        let table = self.dice.pick(&["coffee_table", "coffee_table", "table"]);
        if self.dice.chance(0.75)
            && let Some(piece) = families::sample(table, self.dice)
        {
            self.room.before(couch, piece, self.dice);
        }
        for _ in 0..self.dice.whole(0, 2) {
            let seat = self.dice.pick(&["armchair", "armchair", "couch", "stool"]);
            self.in_the_open(seat);
        }
    }

    fn dining(&mut self) {
        if let Some(table) = self.in_the_open("table") {
            let kind = self.dice.pick(&["chair", "chair", "chair", "stool"]);
            let seats = self.dice.whole(1, 6);
            self.seat(table, kind, seats);
        }
    }

    fn working(&mut self) {
        let at_wall = self.dice.chance(0.7);
        if let Some(desk) = if at_wall { self.at_wall("desk") } else { self.in_the_open("desk") } {
            let seats = self.dice.whole(0, 2);
            self.seat(desk, "chair", seats);
        }
    }

    /// The same seat, so many times, around a table.
    fn seat(&mut self, table: usize, category: &str, seats: usize) {
        let Some(seat) = families::sample(category, self.dice) else { return };
        for _ in 0..seats {
            self.room.at_table(table, seat.clone(), self.dice);
        }
    }

    fn set_clutter_on_floor(&mut self) {
        if self.dice.chance(0.4) {
            for _ in 0..self.dice.whole(1, 2) {
                let thing = clutter::on_floor(self.dice);
                let at_wall = self.dice.chance(0.6);
                if at_wall {
                    self.room.at_wall(thing, self.dice)
                } else {
                    self.room.in_the_open(thing, self.dice)
                };
            }
        }
    }

    fn set_clutter_on_furniture(&mut self) {
        for holder in 0..self.room.placed.len() {
            let category = self.room.placed[holder].piece.category;
            let chance = catalogue::category(category).map_or(0.0, |row| row.clutter);
            if self.room.placed[holder].on.is_none() && self.dice.chance(chance) {
                for _ in 0..self.dice.whole(1, 3) {
                    let thing = clutter::on_furniture(self.dice);
                    self.room.on_top(holder, thing, false, self.dice);
                }
            }
        }
    }

    /// Televisions on their stands, lamps and small things on tables.
    fn set_things_on_tops(&mut self) {
        for holder in 0..self.room.placed.len() {
            let category = self.room.placed[holder].piece.category;
            if category == "tv_stand" && self.dice.chance(0.6) {
                let set = television(self.dice);
                self.room.on_top(holder, set, false, self.dice);
                continue;
            }
            let Some(lamps) = catalogue::category(category).map(|row| row.lamp).filter(|lamps| *lamps > 0.0) else {
                continue;
            };
            if self.dice.chance(lamps)
                && let Some(lamp) = families::sample("table_lamp", self.dice)
            {
                self.room.on_top(holder, lamp, false, self.dice);
                continue;
            }
            if self.dice.chance(0.45) {
                let thing = small_thing(self.dice);
                self.room.on_top(holder, thing, true, self.dice);
            }
        }
    }
}

fn television(dice: &mut Dice) -> Piece {
    let (wide, high) = (dice.between(0.6, 1.25), dice.between(0.4, 0.75));
    let finish = Finish::new([24, 24, 27], Texture::Plain);
    let bar = |x: f64, y: f64, z: (f64, f64)| {
        let outline = crate::geometry::Polygon::rectangle(Pose::default(), x, y).corners().to_vec();
        Frustum { bottom: outline.clone(), top: outline, low: z.0, high: z.1, finish }
    };
    let parts = vec![bar(0.2, 0.4 * wide, (0.0, 0.02)), bar(0.04, 0.1, (0.02, 0.1)), bar(0.05, wide, (0.08, high))];
    Piece::new("tv", Orientation::Facing, parts)
}

/// One of the small objects, as scenes have them.
fn small_thing(dice: &mut Dice) -> Piece {
    // Tall things more often: a monitor on a nightstand is easily taken for a chair's back.
    let least_height = if dice.chance(0.3) { TALL_M } else { 0.0 };
    let choices: Vec<_> = OBJECTS.iter().filter(|object| object.size.height >= least_height).collect();
    let object = dice.pick(&choices);
    let solids =
        crate::simulation::furniture::object_solids(object.name, Pose::default(), object.size, 0.0, object.color);
    let parts = solids.iter().map(|solid| {
        let outline = solid.footprint().corners().to_vec();
        let finish = Finish::new(solid.color(), Texture::Plain);
        Frustum { bottom: outline.clone(), top: outline, low: solid.bottom(), high: solid.top(), finish }
    });
    Piece::new(object.name, Orientation::None, parts.collect())
}
