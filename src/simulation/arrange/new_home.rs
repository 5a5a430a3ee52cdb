//! Whole new homes: a hallway with furnished rooms to both sides.

use std::f64::consts::PI;

use super::access::everything_is_accessible;
use super::stock::{Group, PORTABLE, ROOMS};
use super::{Furnisher, Spot};
use crate::catalogue::Holds;
use crate::geometry::Pose;
use crate::map::{Door, FORMAT_VERSION, Room, RoomMap};
use crate::record::Direction;
use crate::simulation::Dice;
use crate::simulation::{Item, Scene};

/// How often a home that leaves the robot no way is made anew.
const ATTEMPTS: usize = 60;
const HALLWAY_M: f64 = 2.6;
const DOOR_M: f64 = 1.2;

/// A room to be built: its name, other names, and the side of the hallway on which it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct RoomPlan {
    /// Name in lower_snake.
    pub name: String,
    /// Other names.
    pub synonyms: Vec<String>,
    /// Left or right as the robot goes down the hallway.
    pub side: Direction,
}

/// A new furnished home. Nothing when none was found that leaves the robot a way to everything.
pub fn new_home(name: &str, dice: &mut Dice) -> Option<(RoomMap, Scene)> {
    (0..ATTEMPTS).find_map(|_| {
        let count = 2 + dice.below(3);
        let kinds = dice.shuffled((0..ROOMS.len()).collect());
        let side = |i: usize| if i.is_multiple_of(2) { Direction::Right } else { Direction::Left };
        let plans: Vec<RoomPlan> = kinds[..count]
            .iter()
            .enumerate()
            .map(|(i, &kind)| RoomPlan { name: ROOMS[kind].0.to_string(), synonyms: Vec::new(), side: side(i) })
            .collect();
        let map = home_of_rooms(name, &plans, dice);
        let scene = furnished(&map, name, dice)?;
        let sound = super::super::check(&scene, &map, name).is_ok();
        (sound && everything_is_accessible(&map, &scene)).then_some((map, scene))
    })
}

/// A hallway along which the robot goes west, with the given rooms to both sides in the order it passes them.
pub fn home_of_rooms(name: &str, plans: &[RoomPlan], dice: &mut Dice) -> RoomMap {
    let half = HALLWAY_M / 2.0;
    let mut rooms = Vec::new();
    let mut doors = Vec::new();
    // How far west each side is built up; the right of someone who goes west is the north.
    let mut built = [0.0_f64, 0.0];
    for plan in plans {
        let north = plan.side == Direction::Right;
        let (width, depth) = (dice.between(5.0, 6.8), dice.between(5.0, 6.8));
        let east = built[usize::from(north)];
        let (west, sign) = (east - tenths(width), if north { 1.0 } else { -1.0 });
        let (near, far) = (sign * half, sign * (half + tenths(depth)));
        built[usize::from(north)] = west - 0.1;
        let outline = vec![[west, near], [east, near], [east, far], [west, far]];
        let door = tenths(dice.between(west + 1.2, east - 1.2));
        let id = format!("{}_door", plan.name);
        doors.push(Door { id, between: ["hallway".to_string(), plan.name.clone()], at: [door, near], width: DOOR_M });
        rooms.push(Room { name: plan.name.clone(), synonyms: plan.synonyms.clone(), passage: false, outline });
    }
    let west = built[0].min(built[1]);
    let hallway = vec![[west, -half], [1.5, -half], [1.5, half], [west, half]];
    let synonyms = vec!["hall".to_string(), "corridor".to_string()];
    rooms.insert(0, Room { name: "hallway".to_string(), synonyms, passage: true, outline: hallway });
    let start = Pose::new(0.8, 0.0, PI);
    RoomMap {
        version: FORMAT_VERSION,
        name: name.to_string(),
        wall_height: 2.5,
        start,
        rooms,
        doors,
        inner_walls: Vec::new(),
    }
}

fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

fn furnished(map: &RoomMap, name: &str, dice: &mut Dice) -> Option<Scene> {
    let mut furnisher = Furnisher::new(map, name, dice);
    for (room, groups) in ROOMS.iter().filter(|(room, _)| map.room(room).is_some()) {
        for (i, group) in groups.iter().enumerate() {
            // The two most typical groups stand in every room of the kind.
            if i < 2 || furnisher.dice().chance(0.6) {
                put_group(&mut furnisher, room, group);
            }
        }
    }
    lay_objects(&mut furnisher);
    (furnisher.scene().objects.len() >= 3).then(|| furnisher.into_scene())
}

/// Puts a group's main piece and what finds a place beside it.
fn put_group(furnisher: &mut Furnisher, room: &str, group: &Group) -> Option<()> {
    let spot = if group.at_wall { Spot::AtWall } else { Spot::Anywhere };
    let piece = furnisher.piece(group.main);
    let index = furnisher.place(piece, room, spot, |_| true)?;
    let main = furnisher.scene().furniture[index].clone();
    for &(category, angle, gap, turn) in group.with {
        let piece = furnisher.piece(category);
        let spot = beside(&main, &piece, angle, gap, turn);
        furnisher.place(piece, room, spot, |_| true);
    }
    Some(())
}

/// Beside a piece: in a direction from its front (degrees) with a gap (metres), turned against it (degrees).
fn beside(main: &Item, piece: &Item, angle: f64, gap: f64, turn: f64) -> Spot {
    let direction = main.pose().heading + angle.to_radians();
    let half = |item: &Item, along: f64| {
        let size = item.size();
        size.length / 2.0 * along.cos().abs() + size.width / 2.0 * along.sin().abs()
    };
    // Toward a corner of the main piece, the nearer of its two edges decides.
    let to_edge = half(main, angle.to_radians());
    let distance = to_edge + half(piece, (angle - turn).to_radians()) + gap;
    Spot::From {
        point: main.pose().position(),
        distance: (distance, distance + 0.3),
        direction: (direction, 0.15),
        heading: Some(main.pose().heading + turn.to_radians()),
    }
}

/// Something different on each piece that can hold it.
fn lay_objects(furnisher: &mut Furnisher) {
    let names = furnisher.dice().shuffled(PORTABLE.to_vec());
    let holders: Vec<usize> = (0..furnisher.scene().furniture.len())
        .filter(|&i| furnisher.scene().furniture[i].kind().holds == Holds::Usually)
        .collect();
    for (on, name) in holders.into_iter().zip(names) {
        furnisher.lay(name, on, 0.0, 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_homes_are_sound_differ_and_leave_a_way_to_everything() {
        let make = |seed| new_home("new", &mut Dice::new(seed, 0)).expect("a home");
        for seed in 0..4 {
            let (map, scene) = make(seed);
            super::super::super::check(&scene, &map, "new").expect("sound");
            assert!(everything_is_accessible(&map, &scene));
            assert!(scene.furniture.len() >= 6 && scene.objects.len() >= 3);
        }
        assert_ne!(make(0).1.furniture, make(1).1.furniture);
        assert_eq!(make(2), make(2));
    }

    #[test]
    fn rooms_lie_on_the_sides_asked_for() {
        let plan = |name: &str, side| RoomPlan { name: name.to_string(), synonyms: Vec::new(), side };
        let plans = [plan("bedroom", Direction::Right), plan("kitchen", Direction::Left)];
        let map = home_of_rooms("new", &plans, &mut Dice::new(0, 0));
        assert_eq!(map.side_of("bedroom"), Some(Direction::Right));
        assert_eq!(map.side_of("kitchen"), Some(Direction::Left));
    }
}
