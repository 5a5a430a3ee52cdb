//! Furnishes rooms piece by piece: random places, taken when they are free and fit a wish.

use super::standing_room::{degrees, is_free};
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::map::RoomMap;
use crate::simulation::Dice;
use crate::simulation::{Item, PlacedObject, Scene};

/// Places tried before a piece is given up.
const TRIES: usize = 400;
/// From a wall to the back of a piece that stands against it, metres.
const BACK_TO_WALL_M: f64 = 0.06;

/// Where a piece may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// Anywhere in the room, square to its walls.
    Anywhere,
    /// With its back to a wall.
    AtWall,
    /// In a direction (radians) from a point, so many metres away, with the heading given.
    From {
        /// The point.
        point: Vec2,
        /// The least and the most distance, metres.
        distance: (f64, f64),
        /// The direction and how far it may be off, radians.
        direction: (f64, f64),
        /// The heading of the piece's front; square to the room when none is given.
        heading: Option<f64>,
    },
}

/// Puts furniture and objects into the rooms of a map.
#[derive(Debug)]
pub struct Furnisher<'a> {
    map: &'a RoomMap,
    scene: Scene,
    dice: &'a mut Dice,
}

impl<'a> Furnisher<'a> {
    /// Starts with empty rooms.
    pub fn new(map: &'a RoomMap, name: &str, dice: &'a mut Dice) -> Self {
        let scene = Scene {
            version: crate::map::FORMAT_VERSION,
            name: name.to_string(),
            map: map.name.clone(),
            furniture: Vec::new(),
            objects: Vec::new(),
            noise: None,
            camera: None,
        };
        Self { map, scene, dice }
    }

    /// What is random about it.
    pub fn dice(&mut self) -> &mut Dice {
        self.dice
    }

    /// The scene so far.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The finished scene.
    pub fn into_scene(self) -> Scene {
        self.scene
    }

    /// A new piece of a category, numbered among its like.
    pub fn piece(&self, category: &str) -> Item {
        let like = self.scene.furniture.iter().filter(|item| item.category == category).count();
        let id = format!("{}-{}", category.replace('_', "-"), like + 1);
        Item { id, category: category.to_string(), ..Item::default() }
    }

    /// Puts a piece into a room, where it is free and `fits`; its place among the furniture, or nothing.
    pub fn place(&mut self, item: Item, room: &str, spot: Spot, fits: impl Fn(&Item) -> bool) -> Option<usize> {
        let outline = self.map.room(room)?.polygon();
        let entry = self.map.entry_pose(room).unwrap_or(self.map.start);
        let index = self.scene.furniture.len();
        self.scene.furniture.push(item);
        for _ in 0..TRIES {
            let pose = self.pose(&outline, spot, entry.heading, index);
            let item = &mut self.scene.furniture[index];
            let hundredths = |v: f64| (v * 100.0).round() / 100.0;
            (item.x, item.y, item.yaw_deg) = (hundredths(pose.x), hundredths(pose.y), degrees(pose.heading));
            let inside = outline.contains(item.pose().position());
            if inside && is_free(self.map, &self.scene.furniture, index, entry) && fits(&self.scene.furniture[index]) {
                return Some(index);
            }
        }
        self.scene.furniture.pop();
        None
    }

    /// Puts an object on a piece.
    pub fn lay(&mut self, name: &str, on: usize, forward: f64, left: f64) {
        let like = self.scene.objects.iter().filter(|object| object.name == name).count();
        let id = format!("{}-{}", name.replace('_', "-"), like + 1);
        let on = self.scene.furniture[on].id.clone();
        self.scene.objects.push(PlacedObject { id, name: name.to_string(), on, forward, left, yaw_deg: 0.0 });
    }

    fn pose(&mut self, outline: &Polygon, spot: Spot, axis: f64, index: usize) -> Pose {
        let square = |dice: &mut Dice| axis + std::f64::consts::FRAC_PI_2 * dice.below(4) as f64;
        match spot {
            Spot::Anywhere => {
                let (low, high) = outline.bounds();
                let (x, y) = (self.dice.between(low.x, high.x), self.dice.between(low.y, high.y));
                Pose::new(x, y, square(self.dice))
            }
            Spot::AtWall => self.at_wall(outline, index),
            Spot::From { point, distance, direction, heading } => {
                let angle = self.dice.between(direction.0 - direction.1, direction.0 + direction.1);
                let at = point + vec2(angle.cos(), angle.sin()) * self.dice.between(distance.0, distance.1);
                let heading = heading.unwrap_or_else(|| square(self.dice));
                Pose::new(at.x, at.y, heading)
            }
        }
    }

    fn at_wall(&mut self, outline: &Polygon, index: usize) -> Pose {
        let edges: Vec<(Vec2, Vec2)> = outline.edges().collect();
        let (a, b) = edges[self.dice.below(edges.len())];
        let along = (b - a).normalize();
        let inward = vec2(-along.y, along.x);
        let size = self.scene.furniture[index].size();
        let off = self.dice.between(0.0, (b - a).norm());
        let at = a + along * off + inward * (size.length / 2.0 + BACK_TO_WALL_M);
        Pose::new(at.x, at.y, inward.y.atan2(inward.x))
    }
}
