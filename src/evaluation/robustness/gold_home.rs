//! A home in which a given gold grounding is true.
//!
//! Two rooms off a hallway. The motions of the instruction are followed as
//! `behavior::motion` defines them; from where they lead, the target is put
//! where the words say, its landmarks where the relations say, and other
//! furniture where they do not. The object lies on the target alone.

use super::category::{Body, body_of};
use super::fits::{Told, in_place, related};
use crate::behavior::motion::{Landmark, RoomFrame, Step, step_for};
use crate::geometry::Pose;
use crate::language::Lexicon;
use crate::map::RoomMap;
use crate::planning::Planner;
use crate::record::{Action, Amount, Direction, Grounding, Pair, Plan, Reference};
use crate::simulation::Dice;
use crate::simulation::Home;
use crate::simulation::Item;
use crate::simulation::arrange::access::everything_is_accessible;
use crate::simulation::arrange::{Furnisher, RoomPlan, Spot, home_of_rooms};

/// How often a home in which not everything found its place is made anew.
const ATTEMPTS: usize = 80;
/// From where the robot arrives to the target, metres, and how far off its heading it may stand, radians.
const AHEAD_M: (f64, f64) = (1.0, 4.0);
const AHEAD_RAD: f64 = 0.7;
/// What other tables look like.
const OTHERS: [&str; 4] = ["round_table", "end_table", "coffee_table", "table"];

/// A home made for one gold grounding.
#[derive(Clone, Debug)]
pub struct GoldHome {
    /// The home.
    pub home: Home,
    /// Id of the furniture that is meant.
    pub target: String,
}

/// A home in which `grounding` is true; nothing when none was found.
pub fn home_for(grounding: &Grounding, lexicon: &Lexicon, dice: &mut Dice) -> Option<GoldHome> {
    (0..ATTEMPTS).find_map(|_| {
        let (map, room) = rooms_for(grounding, lexicon, dice);
        let plan = Planner::new(map.clone()).plan(grounding);
        let builder = Builder::new(&map, &room, lexicon, dice)?;
        let (scene, target) = builder.build(&plan, grounding)?;
        let sound = crate::simulation::check(&scene, &map, "the gold home").is_ok();
        let accessible = sound && everything_is_accessible(&map, &scene);
        accessible.then_some(GoldHome { home: Home::new(map, scene), target })
    })
}

/// The rooms to both sides of a hallway, and which of them is meant.
fn rooms_for(grounding: &Grounding, lexicon: &Lexicon, dice: &mut Dice) -> (RoomMap, String) {
    let said = grounding.room.clone().unwrap_or_default();
    let spoken = said.name.as_deref().map(|name| name.replace('_', " "));
    let canonical = spoken.as_deref().and_then(|name| lexicon.canonical(name)).map(str::to_string);
    let side = match (said.side, canonical.as_deref()) {
        (Some(Direction::Left), _) | (None, Some("bedroom")) => Direction::Left,
        _ => Direction::Right,
    };
    let usual = |side| if side == Direction::Left { "bedroom" } else { "living_room" };
    let name = canonical.unwrap_or_else(|| usual(side).to_string());
    let across = side.mirrored();
    let other = if name == usual(across) { usual(side) } else { usual(across) };
    // "Sitting room" is a name of the living room.
    let synonyms = said.name.into_iter().filter(|spoken| *spoken != name && spoken != other).collect();
    let meant = RoomPlan { name: name.clone(), synonyms, side };
    let beside = RoomPlan { name: other.to_string(), synonyms: Vec::new(), side: across };
    (home_of_rooms("gold", &[meant, beside], dice), name)
}

/// Furnishes the rooms step by step.
struct Builder<'a> {
    map: &'a RoomMap,
    room: &'a str,
    frame: RoomFrame,
    lexicon: &'a Lexicon,
    furnisher: Furnisher<'a>,
}

impl<'a> Builder<'a> {
    fn new(map: &'a RoomMap, room: &'a str, lexicon: &'a Lexicon, dice: &'a mut Dice) -> Option<Self> {
        let frame = RoomFrame { outline: map.room(room)?.polygon(), entry: map.entry_pose(room)? };
        Some(Self { map, room, frame, lexicon, furnisher: Furnisher::new(map, "gold", dice) })
    }

    fn build(mut self, plan: &Plan, grounding: &Grounding) -> Option<(crate::simulation::Scene, String)> {
        let mut pose = self.frame.entry;
        let mut steps = 0;
        for action in &plan.actions {
            match action {
                Action::Move { .. } | Action::Go { .. } => {
                    pose = self.follow(action, pose)?;
                    steps += 1;
                }
                _ => {}
            }
        }
        let (noun, pairs) = wanted(plan);
        let frame = self.frame.clone();
        let told = Told { map: self.map, room: self.room, frame: &frame, arrived: pose };
        let target = self.put_target(noun, &pairs, told, steps > 0)?;
        let on_it = self.put_landmarks(target, &pairs, told)?;
        self.put_others(target, &pairs, told, grounding.object.is_some());
        self.furnish_other_room(grounding.object.is_some());
        let object = grounding.object.as_ref().map_or("book", |object| object.name.as_str());
        self.furnisher.lay(object, target, 0.0, if on_it.is_empty() { 0.0 } else { -0.13 });
        for (i, landmark) in on_it.iter().enumerate().filter(|(_, landmark)| **landmark != object) {
            self.furnisher.lay(landmark, target, 0.1 * i as f64, 0.13);
        }
        let id = self.furnisher.scene().furniture[target].id.clone();
        Some((self.furnisher.into_scene(), id))
    }

    /// Where one step of the instruction leads; furniture it names is put ahead first.
    fn follow(&mut self, action: &Action, pose: Pose) -> Option<Pose> {
        let noun = match action {
            Action::Go { reference, .. } => reference.thing(),
            Action::Move { amount: Some(Amount::Until(what)), .. } => what.thing(),
            _ => None,
        };
        let mut footprint = None;
        if let Some(Body::Furniture(category)) = noun.map(|noun| body_of(noun, self.lexicon)) {
            let spot = Spot::From {
                point: pose.position(),
                distance: (1.2, 3.0),
                direction: (pose.heading, 0.6),
                heading: None,
            };
            let piece = self.furnisher.piece(category);
            let index = self.furnisher.place(piece, self.room, spot, |_| true)?;
            footprint = Some(self.furnisher.scene().furniture[index].footprint());
        }
        let landmark = footprint.as_ref().map(|footprint| Landmark { footprint, towards: None });
        Some(match step_for(action, pose, &self.frame, landmark.as_ref()) {
            Some(Step::Turn(heading)) => Pose { heading, ..pose },
            Some(Step::Drive(to)) if self.frame.outline.contains(to.position()) => to,
            Some(Step::Drive(_)) | None => pose,
        })
    }

    fn put_target(&mut self, noun: &str, pairs: &[Pair], told: Told, ahead: bool) -> Option<usize> {
        let category = match body_of(noun, self.lexicon) {
            Body::Furniture(category) => category,
            Body::Object | Body::Nothing => "table",
        };
        let by_robot = pairs.iter().any(|pair| pair.reference == Reference::Robot);
        let by_wall = matches!(category, "nightstand" | "desk" | "counter")
            || pairs.iter().any(|p| p.reference == Reference::Wall);
        let spot = if ahead && !by_robot {
            let direction = (told.arrived.heading, AHEAD_RAD);
            Spot::From { point: told.arrived.position(), distance: AHEAD_M, direction, heading: None }
        } else if by_wall {
            Spot::AtWall
        } else {
            Spot::Anywhere
        };
        let piece = self.furnisher.piece(category);
        let room = self.room;
        let fits = |item: &Item| pairs.iter().all(|pair| in_place(item, pair, told));
        self.furnisher.place(piece.clone(), room, spot, fits).or_else(|| {
            // Where the way leads to is not where the words say: the words that name a place decide.
            self.furnisher.place(piece, room, if by_wall { Spot::AtWall } else { Spot::Anywhere }, fits)
        })
    }

    /// The furniture landmarks beside the target; the others, which lie on it, are handed back.
    fn put_landmarks<'p>(&mut self, target: usize, pairs: &'p [Pair], told: Told) -> Option<Vec<&'p str>> {
        let mut on_it = Vec::new();
        for (pair, noun) in pairs.iter().filter_map(|pair| Some((pair, pair.reference.thing()?))) {
            let Body::Furniture(category) = body_of(noun, self.lexicon) else {
                on_it.push(noun);
                continue;
            };
            if pair.direction == Direction::Between {
                self.put_both_sides(target, category)?;
            } else if !self.is_there(target, category, pair, told) {
                self.put_landmark(target, category, pair, told)?;
            }
        }
        Some(on_it)
    }

    /// Whether such a landmark, named before, already stands as the pair says.
    fn is_there(&self, target: usize, category: &str, pair: &Pair, told: Told) -> bool {
        let furniture = &self.furnisher.scene().furniture;
        let like = furniture.iter().enumerate().filter(|(i, item)| *i != target && item.category == category);
        like.into_iter().any(|(_, item)| related(&furniture[target], item, pair, told))
    }

    fn put_landmark(&mut self, target: usize, category: &str, pair: &Pair, told: Told) -> Option<usize> {
        let item = self.furnisher.scene().furniture[target].clone();
        let piece = self.furnisher.piece(category);
        let spot = Spot::From {
            point: item.pose().position(),
            distance: (0.4, 2.6),
            direction: (0.0, std::f64::consts::PI),
            heading: None,
        };
        self.furnisher.place(piece, self.room, spot, |landmark| related(&item, landmark, pair, told))
    }

    fn put_both_sides(&mut self, target: usize, category: &str) -> Option<()> {
        let item = self.furnisher.scene().furniture[target].clone();
        let first = self.furnisher.dice().between(0.0, std::f64::consts::TAU);
        for direction in [first, first + std::f64::consts::PI] {
            let piece = self.furnisher.piece(category);
            let spot = Spot::From {
                point: item.pose().position(),
                distance: (0.4, 1.6),
                direction: (direction, 0.3),
                heading: None,
            };
            let near = |other: &Item| other.footprint().distance(&item.footprint()) < 0.6;
            self.furnisher.place(piece, self.room, spot, near)?;
        }
        Some(())
    }

    /// Other tables in the room, where the words do not fit, and other furniture.
    fn put_others(&mut self, target: usize, pairs: &[Pair], told: Told, object_named: bool) {
        let item = self.furnisher.scene().furniture[target].clone();
        let named: Vec<Body> = pairs.iter().map(|pair| body_of(pair.reference.name(), self.lexicon)).collect();
        let says_where = pairs.iter().any(|pair| pair.reference != Reference::Move);
        let count = if says_where { 1 + self.furnisher.dice().below(2) } else { usize::from(object_named) };
        for _ in 0..count {
            let category = OTHERS[self.furnisher.dice().below(OTHERS.len())];
            let piece = self.furnisher.piece(category);
            let furniture = self.furnisher.scene().furniture.clone();
            let elsewhere = |other: &Item| {
                let apart = (other.pose().position() - item.pose().position()).norm() > 1.3;
                apart && !(says_where && pairs.iter().all(|pair| fits(other, pair, &furniture, &item, told)))
            };
            if let Some(index) = self.furnisher.place(piece, self.room, Spot::Anywhere, elsewhere)
                && object_named
            {
                self.furnisher.lay("cup", index, 0.0, 0.0);
            }
        }
        for category in ["shelf", "dresser", "armchair"] {
            if !named.contains(&Body::Furniture(category)) && self.furnisher.dice().chance(0.4) {
                let piece = self.furnisher.piece(category);
                self.furnisher.place(piece, self.room, Spot::AtWall, |_| true);
            }
        }
    }

    fn furnish_other_room(&mut self, object_named: bool) {
        let Some(room) = self.map.rooms.iter().find(|room| !room.passage && room.name != self.room) else { return };
        for (category, spot) in [("couch", Spot::Anywhere), ("table", Spot::Anywhere), ("cabinet", Spot::AtWall)] {
            let piece = self.furnisher.piece(category);
            let placed = self.furnisher.place(piece, &room.name, spot, |_| true);
            if let Some(index) = placed.filter(|_| object_named && category == "table") {
                self.furnisher.lay("vase", index, 0.0, 0.0);
            }
        }
    }
}

/// Whether a pair holds of `other` as well as of the target: by its place, or by a landmark that stands there.
fn fits(other: &Item, pair: &Pair, furniture: &[Item], target: &Item, told: Told) -> bool {
    if pair.reference.thing().is_none() {
        return in_place(other, pair, told);
    }
    furniture.iter().any(|landmark| landmark.id != target.id && related(other, landmark, pair, told))
}

/// The noun of the target and the pairs of the search.
fn wanted(plan: &Plan) -> (&str, Vec<Pair>) {
    let search = plan.actions.iter().find_map(|action| match action {
        Action::Search { target, pairs, .. } => {
            Some((target.as_deref(), pairs.iter().map(|pair| pair.pair.clone()).collect()))
        }
        _ => None,
    });
    let (target, pairs) = search.unwrap_or_default();
    (target.unwrap_or("table"), pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grounding::usual_pair;
    use crate::record::{Node, ObjectSlot, RoomSlot};

    fn grounding(side: Direction, target: &str, pairs: &[(&str, Direction)]) -> Grounding {
        let pairs = pairs.iter().map(|(reference, direction)| usual_pair(reference, *direction)).collect();
        Grounding {
            room: Some(RoomSlot { side: Some(side), ..RoomSlot::default() }),
            object: Some(ObjectSlot { name: "mug".to_string(), ..ObjectSlot::default() }),
            nodes: vec![Node { target: Some(target.to_string()), pairs, ..Node::default() }],
            ..Grounding::default()
        }
    }

    #[test]
    fn the_object_lies_on_the_target_alone_in_the_room_on_that_side_and_the_relation_holds() {
        let grounding = grounding(Direction::Left, "nightstand", &[("bed", Direction::Right)]);
        let made = home_for(&grounding, Lexicon::embedded(), &mut Dice::new(1, 0)).expect("a home");
        let (scene, map) = (&made.home.scene, &made.home.map);
        let holders: Vec<&str> = scene.holders_of("mug").iter().map(|item| item.id.as_str()).collect();
        assert_eq!(holders, [made.target.as_str()]);
        let target = scene.item(&made.target).expect("there");
        let room = map.room_at(target.pose().position()).expect("a room");
        assert_eq!((map.side_of(&room.name), target.category.as_str()), (Some(Direction::Left), "nightstand"));
        let entry = map.entry_pose(&room.name).expect("a door");
        let bed = scene.furniture.iter().find(|item| item.category == "bed").expect("a bed");
        assert_eq!(crate::simulation::arrange::relations::standing(target, bed, entry).viewer, Direction::Right);
    }

    #[test]
    fn what_a_landmark_of_unknown_kind_needs_is_laid_on_the_target() {
        let grounding = grounding(Direction::Right, "table", &[("flower_vase", Direction::Side)]);
        let made = home_for(&grounding, Lexicon::embedded(), &mut Dice::new(2, 0)).expect("a home");
        assert_eq!(made.home.scene.holders_of("flower_vase")[0].id, made.target);
    }

    #[test]
    fn the_same_seed_makes_the_same_home() {
        let grounding = grounding(Direction::Right, "table", &[("room", Direction::Back), ("wall", Direction::Side)]);
        let make = || home_for(&grounding, Lexicon::embedded(), &mut Dice::new(5, 7)).expect("a home");
        assert_eq!(make().home.scene, make().home.scene);
    }
}
