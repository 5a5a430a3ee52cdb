//! What there is in a home: rooms, doors, furniture, objects; for people, for programs, and drawn.

use schemars::JsonSchema;
use serde::Serialize;

use super::Home;
use crate::drawing::{Outline, Plot};
use crate::geometry::{Pose, Vec2};
use crate::record::Rounded;
use crate::recording::spoken;

/// What there is in a home.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Inventory {
    /// Name of the room map.
    pub map: String,
    /// Name of the arrangement of the furniture.
    pub scene: String,
    /// Where the robot starts: metres, and radians counter-clockwise from east.
    pub start: Pose,
    /// The rooms.
    pub rooms: Vec<ListedRoom>,
    /// The furniture.
    pub furniture: Vec<ListedPiece>,
    /// The small objects.
    pub objects: Vec<ListedObject>,
}

/// A room.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ListedRoom {
    /// Its name.
    pub name: String,
    /// Other names for it.
    pub synonyms: Vec<String>,
    /// Whether it is a hallway, in which nothing is looked for unless it is named.
    pub passage: bool,
    /// Square metres.
    pub area_m2: Rounded,
    /// Its doors.
    pub doors: Vec<ListedDoor>,
}

/// A door.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ListedDoor {
    /// Its name.
    pub id: String,
    /// The room behind it.
    pub to: String,
    /// Metres.
    pub width_m: Rounded,
}

/// A piece of furniture.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ListedPiece {
    /// Its name.
    pub id: String,
    /// Its category.
    pub category: String,
    /// The room it stands in.
    pub room: Option<String>,
    /// Middle of the footprint, metres.
    pub x: Rounded,
    /// Middle of the footprint, metres.
    pub y: Rounded,
    /// Heading of its front, degrees counter-clockwise from east, where it has one.
    pub yaw_deg: Option<Rounded>,
}

/// A small object.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ListedObject {
    /// Its name.
    pub id: String,
    /// What it is, as sentences call it.
    pub name: String,
    /// The piece it lies on.
    pub on: String,
    /// The room it lies in.
    pub room: Option<String>,
    /// Metres.
    pub x: Rounded,
    /// Metres.
    pub y: Rounded,
}

impl Inventory {
    /// Of a home.
    pub fn of(home: &Home) -> Self {
        let room_at = |at: Vec2| home.map.room_at(at).map(|room| room.name.clone());
        let pieces = home.scene.furniture.iter().map(|item| ListedPiece {
            id: item.id.clone(),
            category: item.category.clone(),
            room: room_at(item.pose().position()),
            x: item.x.into(),
            y: item.y.into(),
            yaw_deg: item.has_front().then_some(item.yaw_deg.into()),
        });
        let lying = home.scene.objects.iter().filter_map(|object| Some((object, home.scene.item(&object.on)?)));
        let objects = lying.map(|(object, item)| {
            let at = object.pose_on(item).position();
            let (id, name, on) = (object.id.clone(), object.name.clone(), object.on.clone());
            ListedObject { id, name, on, room: room_at(item.pose().position()), x: at.x.into(), y: at.y.into() }
        });
        Self {
            map: home.map.name.clone(),
            scene: home.scene.name.clone(),
            start: home.map.start,
            rooms: rooms(home),
            furniture: pieces.collect(),
            objects: objects.collect(),
        }
    }

    /// For people: a room a paragraph, with what stands in it and lies on it.
    pub fn text(&self) -> String {
        let (rooms, pieces, objects) = (self.rooms.len(), self.furniture.len(), self.objects.len());
        let mut lines = vec![format!("{}: {rooms} rooms, {pieces} pieces of furniture, {objects} objects", self.scene)];
        for room in &self.rooms {
            lines.push(String::new());
            lines.push(room.text());
            for piece in self.furniture.iter().filter(|piece| piece.room.as_ref() == Some(&room.name)) {
                let on_it = self.objects.iter().filter(|object| object.on == piece.id);
                let on_it: Vec<String> = on_it.map(|object| object.name.replace('_', " ")).collect();
                let holds = if on_it.is_empty() { String::new() } else { format!("with {}", on_it.join(", ")) };
                lines.push(format!("  {:24} {holds}", spoken(&piece.id)).trim_end().to_string());
            }
        }
        lines.join("\n")
    }
}

impl ListedRoom {
    fn text(&self) -> String {
        let names = |names: &[String]| names.iter().map(|name| spoken(name)).collect::<Vec<_>>().join(", ");
        let also = if self.synonyms.is_empty() { String::new() } else { format!(", also {}", names(&self.synonyms)) };
        let start = if self.passage { ", a passage" } else { "" };
        let doors: Vec<String> =
            self.doors.iter().map(|door| format!("to the {} ({:.2} m)", spoken(&door.to), door.width_m.0)).collect();
        let doors = if doors.is_empty() { "no door".to_string() } else { format!("doors {}", doors.join(", ")) };
        format!("{}{also}{start}: {:.0} m², {doors}", spoken(&self.name), self.area_m2.0)
    }
}

fn rooms(home: &Home) -> Vec<ListedRoom> {
    let rooms = home.map.rooms.iter().map(|room| {
        let doors = home.map.doors.iter().filter_map(|door| {
            let other = door.between.iter().find(|other| **other != room.name)?;
            let is_ours = door.between.contains(&room.name);
            is_ours.then(|| ListedDoor { id: door.id.clone(), to: other.clone(), width_m: door.width.into() })
        });
        ListedRoom {
            name: room.name.clone(),
            synonyms: room.synonyms.clone(),
            passage: room.passage,
            area_m2: room.polygon().area().into(),
            doors: doors.collect(),
        }
    });
    rooms.collect()
}

/// A home drawn: rooms, furniture by its names, objects, and where the robot starts.
pub fn drawn(home: &Home) -> String {
    let pieces = home.pieces();
    let furniture = pieces.iter().map(|piece| Outline {
        label: piece.spoken(),
        corners: piece.corners.clone(),
        found: false,
        front: piece.front,
        visits: Vec::new(),
    });
    let plot = Plot {
        title: home.scene.name.clone(),
        caption: format!("{} pieces of furniture, {} objects", pieces.len(), home.scene.objects.len()),
        rooms: home.map.rooms.iter().map(|room| (room.name.clone(), room.polygon().centroid())).collect(),
        walls: home.map.walls(),
        furniture: furniture.collect(),
        path: vec![home.map.start],
        found_at: None,
        sought: pieces.iter().flat_map(|piece| piece.holds.clone()).collect(),
    };
    plot.to_svg()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_room_is_listed_with_its_doors_its_furniture_and_what_lies_on_it() {
        let home = Home::load(None, None).expect("the apartment");
        let text = Inventory::of(&home).text();
        assert!(text.starts_with("apartment: 3 rooms, 12 pieces of furniture, 6 objects\n"), "{text}");
        let bedroom = text.split("\n\n").find(|part| part.starts_with("bedroom")).expect("a bedroom");
        assert!(
            bedroom.contains("to the hallway") && bedroom.contains("  hexagon table 1          with mug"),
            "{text}"
        );
    }

    #[test]
    fn the_drawing_names_furniture_and_objects() {
        let svg = drawn(&Home::load(None, None).expect("the apartment"));
        assert!(svg.contains(">hexagon table 1</text>") && svg.contains(">glasses case</text>"), "{svg}");
    }
}
