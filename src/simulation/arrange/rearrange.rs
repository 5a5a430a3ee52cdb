//! The same furniture in other places, with the relations that words tell kept, or broken.

use super::access::everything_is_accessible;
use super::relations::{Part, RELATED_M, Standing, part, standing};
use super::standing_room::{is_free, rounded};
use super::{Furnisher, Spot};
use crate::geometry::{Pose, vec2};
use crate::map::RoomMap;
use crate::simulation::Dice;
use crate::simulation::{Item, Scene};

/// What becomes of the relations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relations {
    /// The words that held still hold: sides in the viewer's and each piece's own frame, nearness, parts of the room.
    Kept,
    /// Of each piece that holds an object, at least half of what related it to its neighbours no longer holds.
    Broken,
}

/// Moves tried per piece before the arrangement counts as random.
const MOVES_PER_ITEM: usize = 60;
/// How often an arrangement that leaves the robot no way, or cannot be, is made anew.
const ATTEMPTS: usize = 40;
/// Pieces nearer to each other than this may move as a group, metres.
const GROUP_M: f64 = 0.6;

/// The furniture of `scene` in other places of its rooms. Nothing when no arrangement was found that leaves a way.
pub fn rearranged(map: &RoomMap, scene: &Scene, relations: Relations, dice: &mut Dice) -> Option<Scene> {
    (0..ATTEMPTS).find_map(|_| {
        let arranged = match relations {
            Relations::Kept => Walk::new(map, scene).run(dice),
            Relations::Broken => scattered(map, scene, dice)?,
        };
        let sound = super::super::check(&arranged, map, "the arrangement").is_ok();
        (sound && everything_is_accessible(map, &arranged)).then_some(arranged)
    })
}

/// What the words tell of a scene: each piece's part of the room, and how it stands to each other piece there.
struct Told {
    parts: Vec<Option<Part>>,
    standings: Vec<Vec<Option<Standing>>>,
}

/// A random walk through the arrangements that the same words tell.
struct Walk<'a> {
    map: &'a RoomMap,
    rooms: Vec<Option<(String, Pose)>>,
    told: Told,
    scene: Scene,
}

impl<'a> Walk<'a> {
    fn new(map: &'a RoomMap, scene: &Scene) -> Self {
        let rooms: Vec<_> = scene.furniture.iter().map(|item| room_of(map, item)).collect();
        let n = scene.furniture.len();
        let parts = (0..n)
            .map(|i| rooms[i].as_ref().and_then(|(room, entry)| part(&scene.furniture[i], map, room, *entry)))
            .collect();
        let standings = (0..n).map(|i| (0..n).map(|j| stand(&scene.furniture, &rooms, i, j)).collect()).collect();
        Self { map, rooms, told: Told { parts, standings }, scene: scene.clone() }
    }

    fn run(mut self, dice: &mut Dice) -> Scene {
        for _ in 0..MOVES_PER_ITEM * self.scene.furniture.len() {
            let first = dice.below(self.scene.furniture.len());
            let moved = if dice.chance(0.4) { self.group(first) } else { vec![first] };
            let spread = if dice.chance(0.3) { 0.8 } else { 0.25 };
            let by = vec2(dice.normal(0.0, spread), dice.normal(0.0, spread));
            let turn = dice.normal(0.0, 4.0);
            let before: Vec<Item> = moved.iter().map(|&i| self.scene.furniture[i].clone()).collect();
            for &i in &moved {
                let item = &mut self.scene.furniture[i];
                (item.x, item.y) = (rounded(item.x + by.x), rounded(item.y + by.y));
                if moved.len() == 1 {
                    item.yaw_deg = rounded(item.yaw_deg + turn);
                }
            }
            if !moved.iter().all(|&i| self.holds(i)) {
                moved.iter().zip(before).for_each(|(&i, item)| self.scene.furniture[i] = item);
            }
        }
        self.scene
    }

    fn group(&self, first: usize) -> Vec<usize> {
        let near = |j: &usize| self.told.standings[first][*j].is_some_and(|s| s.gap_m < GROUP_M);
        std::iter::once(first).chain((0..self.scene.furniture.len()).filter(near)).collect()
    }

    /// Whether the piece stands where it can, and all that was told of it still holds.
    fn holds(&self, i: usize) -> bool {
        let Some((room, entry)) = &self.rooms[i] else { return true };
        let item = &self.scene.furniture[i];
        let told = self.told.parts[i]
            .is_none_or(|was| part(item, self.map, room, *entry).is_some_and(|now| was.is_told_like(&now)));
        told && straight_enough(item) && is_free(self.map, &self.scene.furniture, i, *entry) && self.stands_as_told(i)
    }

    fn stands_as_told(&self, i: usize) -> bool {
        let (items, rooms) = (&self.scene.furniture, &self.rooms);
        let alike = |a: usize, b: usize| match self.told.standings[a][b] {
            Some(was) => stand(items, rooms, a, b).is_some_and(|now| was.is_told_like(&now)),
            None => true,
        };
        (0..items.len()).all(|j| alike(i, j) && alike(j, i))
    }
}

/// Furniture stands about square to the walls: a walk must not turn it away.
fn straight_enough(item: &Item) -> bool {
    let quarter = item.yaw_deg.rem_euclid(90.0);
    quarter.min(90.0 - quarter) <= 10.0
}

/// The room a piece stands in, and the pose at which it is entered.
fn room_of(map: &RoomMap, item: &Item) -> Option<(String, Pose)> {
    let room = map.room_at(item.pose().position())?;
    let entry = map.entry_pose(&room.name).unwrap_or(map.start);
    Some((room.name.clone(), entry))
}

/// How piece `i` stands to piece `j`; nothing for pieces of different rooms.
fn stand(items: &[Item], rooms: &[Option<(String, Pose)>], i: usize, j: usize) -> Option<Standing> {
    let (here, there) = (rooms[i].as_ref()?, rooms[j].as_ref()?);
    (i != j && here.0 == there.0).then(|| standing(&items[i], &items[j], here.1))
}

/// All furniture anywhere in its room, largest first.
fn scattered(map: &RoomMap, scene: &Scene, dice: &mut Dice) -> Option<Scene> {
    let mut order: Vec<usize> = (0..scene.furniture.len()).collect();
    let area = |i: &usize| -scene.furniture[*i].footprint().area();
    order.sort_by(|a, b| area(a).total_cmp(&area(b)));
    let mut furnisher = Furnisher::new(map, &scene.name, dice);
    for i in order {
        let item = &scene.furniture[i];
        let (room, _) = room_of(map, item)?;
        let spot = if furnisher.dice().chance(0.5) { Spot::AtWall } else { Spot::Anywhere };
        furnisher.place(item.clone(), &room, spot, |_| true)?;
    }
    let mut furniture = furnisher.into_scene().furniture;
    furniture.sort_by_key(|item| scene.furniture.iter().position(|other| other.id == item.id));
    let made = Scene { furniture, ..scene.clone() };
    is_broken(map, scene, &made).then_some(made)
}

/// Whether each piece that holds something has lost at least half of what related it to its neighbours.
fn is_broken(map: &RoomMap, before: &Scene, after: &Scene) -> bool {
    let rooms: Vec<_> = before.furniture.iter().map(|item| room_of(map, item)).collect();
    let holders = |i: &usize| before.objects.iter().any(|object| object.on == before.furniture[*i].id);
    (0..before.furniture.len()).filter(holders).all(|i| {
        let was: Vec<(usize, Standing)> = (0..before.furniture.len())
            .filter_map(|j| Some((j, stand(&before.furniture, &rooms, i, j)?)))
            .filter(|(_, standing)| standing.gap_m < RELATED_M)
            .collect();
        let kept = was
            .iter()
            .filter(|(j, was)| stand(&after.furniture, &rooms, i, *j).is_some_and(|now| was.is_told_like(&now)))
            .count();
        2 * kept <= was.len()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::CameraMount;
    use crate::simulation::Noise;

    fn made(relations: Relations, seed: u64) -> Scene {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        rearranged(&map, &scene, relations, &mut Dice::new(seed, 0)).expect("an arrangement")
    }

    fn mean_way(scene: &Scene) -> f64 {
        let original = Scene::apartment();
        let ways = scene.furniture.iter().zip(&original.furniture);
        ways.map(|(a, b)| (a.pose().position() - b.pose().position()).norm()).sum::<f64>()
            / original.furniture.len() as f64
    }

    #[test]
    fn the_same_seed_makes_the_same_scene_and_another_one_another() {
        assert_eq!(made(Relations::Kept, 3), made(Relations::Kept, 3));
        assert_ne!(made(Relations::Kept, 3), made(Relations::Kept, 4));
    }

    #[test]
    fn what_a_scene_says_of_its_robot_stays_as_it_was() {
        let map = RoomMap::apartment();
        let (noise, camera) = (Some(Noise::default()), Some(CameraMount::default()));
        let scene = Scene { noise, camera, ..Scene::apartment() };
        for relations in [Relations::Kept, Relations::Broken] {
            let made = rearranged(&map, &scene, relations, &mut Dice::new(1, 0)).expect("an arrangement");
            assert_eq!((made.noise, made.camera, made.objects), (scene.noise, scene.camera, scene.objects.clone()));
        }
    }

    #[test]
    fn keeping_the_relations_moves_the_furniture_and_leaves_what_is_told_of_it() {
        let (map, original) = (RoomMap::apartment(), Scene::apartment());
        for seed in 0..3 {
            let scene = made(Relations::Kept, seed);
            assert!(mean_way(&scene) > 0.2, "{}", mean_way(&scene));
            let walk = Walk { scene, ..Walk::new(&map, &original) };
            assert!((0..original.furniture.len()).all(|i| walk.holds(i)));
        }
    }

    #[test]
    fn breaking_the_relations_leaves_at_most_half_of_them() {
        let (map, original) = (RoomMap::apartment(), Scene::apartment());
        let scene = made(Relations::Broken, 1);
        assert!(is_broken(&map, &original, &scene) && mean_way(&scene) > 1.0);
        assert_eq!(scene.objects, original.objects);
    }
}
