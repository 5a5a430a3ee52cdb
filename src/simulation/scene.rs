//! The scene: the furniture and objects that are truly there. Never given to the executive.

use std::fmt;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::Noise;
use super::furniture;
use super::mesh::{Mesh, MeshFile, Point};
use super::solid::Solid;
use crate::catalogue::Color;
use crate::catalogue::{self, Orientation};
use crate::catalogue::{Category, Size, SmallObject};
use crate::frame::CameraMount;
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::map::RoomMap;

/// Furniture and objects, on a room map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of this format: 1.
    pub version: u32,
    /// Name of the arrangement.
    pub name: String,
    /// The room map it stands on: the name of one, a file beside this one, or the room map itself.
    #[serde(deserialize_with = "map_name")]
    #[schemars(with = "MapOfScene")]
    pub map: String,
    /// The furniture.
    pub furniture: Vec<Item>,
    /// The portable objects.
    #[serde(default)]
    pub objects: Vec<PlacedObject>,
    /// How imperfect the simulated robot is here, where it is not the usual one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<Noise>,
    /// Where the simulated robot's camera sits, where it is not the usual place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraMount>,
}

/// What stands at `map`.
#[derive(JsonSchema)]
#[schemars(untagged)]
#[allow(dead_code)]
enum MapOfScene {
    /// By name or file.
    Named(String),
    /// In its place.
    Whole(RoomMap),
}

/// The name of the map, whether it is named or stands there whole.
fn map_name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    struct Name;
    impl<'de> Visitor<'de> for Name {
        type Value = String;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("the name of a room map, or a room map")
        }

        fn visit_str<E>(self, name: &str) -> Result<String, E> {
            Ok(name.to_string())
        }

        fn visit_map<A: MapAccess<'de>>(self, mut keys: A) -> Result<String, A::Error> {
            let mut name = String::new();
            while let Some(key) = keys.next_key::<String>()? {
                if key == "name" {
                    name = keys.next_value()?;
                } else {
                    keys.next_value::<IgnoredAny>()?;
                }
            }
            Ok(name)
        }
    }
    deserializer.deserialize_any(Name)
}

/// A piece of furniture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// Name of the piece.
    pub id: String,
    /// Its category, one of those `docs/world.md` lists.
    pub category: String,
    /// Middle of the footprint, metres.
    pub x: f64,
    /// Middle of the footprint, metres.
    pub y: f64,
    /// Heading of the front, degrees counter-clockwise from east.
    #[serde(default)]
    pub yaw_deg: f64,
    /// Metres along the front's heading, where it is not the category's usual one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Metres across it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Metres above the floor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// Red, green, blue.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Words that hold for it, where they are not the category's: "white", "square".
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<String>,
    /// A mesh in place of the category's solids.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshFile>,
}

/// A portable object on a piece of furniture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlacedObject {
    /// Name of this one.
    pub id: String,
    /// What it is: `mug`.
    pub name: String,
    /// The furniture it lies on.
    pub on: String,
    /// From the middle of the top, along the furniture's front heading, metres.
    #[serde(default)]
    pub forward: f64,
    /// From the middle of the top, to the furniture's left, metres.
    #[serde(default)]
    pub left: f64,
    /// Turned against the furniture's front, degrees.
    #[serde(default)]
    pub yaw_deg: f64,
}

impl Item {
    /// Position and the heading of the front.
    pub fn pose(&self) -> Pose {
        Pose::new(self.x, self.y, self.yaw_deg.to_radians())
    }

    /// The category's description.
    pub fn kind(&self) -> &'static Category {
        catalogue::category(&self.category).unwrap_or(&Category::UNKNOWN)
    }

    /// Its size.
    pub fn size(&self) -> Size {
        let usual = self.loaded_mesh().map_or(self.kind().size, |mesh| mesh.size());
        Size {
            length: self.length.unwrap_or(usual.length),
            width: self.width.unwrap_or(usual.width),
            height: self.height.unwrap_or(usual.height),
        }
    }

    /// Its mesh, when it has one.
    pub fn loaded_mesh(&self) -> Option<&Arc<Mesh>> {
        self.mesh.as_ref().and_then(|file| file.loaded.as_ref())
    }

    /// How much longer, wider and higher its mesh is made.
    fn stretch(&self, mesh: &Mesh) -> Point {
        let (size, own) = (self.size(), mesh.size());
        Point::new(size.length / own.length, size.width / own.width, size.height / own.height)
    }

    /// Its outline on the floor.
    pub fn footprint(&self) -> Polygon {
        if let Some(mesh) = self.loaded_mesh() {
            let (pose, stretch) = (self.pose(), self.stretch(mesh));
            let corners = mesh.outline().iter().map(|c| pose.to_world(vec2(c.x * stretch.x, c.y * stretch.y)));
            return Polygon::new(corners.collect());
        }
        furniture::footprint(self.kind().shape, self.pose(), self.size())
    }

    /// Whether it has a front: a table has none.
    pub fn has_front(&self) -> bool {
        self.kind().orientation == Orientation::Facing
    }

    /// What can be said of its looks.
    pub fn attributes(&self) -> Vec<String> {
        if self.attributes.is_empty() {
            self.kind().attributes.iter().map(|a| (*a).to_string()).collect()
        } else {
            self.attributes.clone()
        }
    }

    /// The solids it is composed of.
    pub fn solids(&self) -> Vec<Solid> {
        let kind = self.kind();
        let color = self.color.unwrap_or(kind.color);
        if let Some(mesh) = self.loaded_mesh() {
            return vec![Solid::mesh(mesh, self.pose(), self.stretch(mesh), color)];
        }
        furniture::solids(kind.shape, self.pose(), self.size(), color)
    }
}

impl PlacedObject {
    fn kind(&self) -> SmallObject {
        let unusual = SmallObject {
            name: "object",
            size: Size { length: 0.12, width: 0.12, height: 0.1 },
            color: [180, 60, 160],
        };
        catalogue::object(&self.name).copied().unwrap_or(unusual)
    }

    /// Where it lies on `furniture`: its middle and heading.
    pub fn pose_on(&self, furniture: &Item) -> Pose {
        let at = furniture.pose().to_world(vec2(self.forward, self.left));
        Pose::new(at.x, at.y, furniture.pose().heading + self.yaw_deg.to_radians())
    }

    /// Its size.
    pub fn size(&self) -> Size {
        self.kind().size
    }

    /// The solids it is composed of, on `furniture`.
    pub fn solids_on(&self, furniture: &Item) -> Vec<Solid> {
        let kind = self.kind();
        furniture::object_solids(&self.name, self.pose_on(furniture), kind.size, furniture.size().height, kind.color)
    }
}

impl Scene {
    /// The piece of that id.
    pub fn item(&self, id: &str) -> Option<&Item> {
        self.furniture.iter().find(|item| item.id == id)
    }

    /// The piece at a point, or nearest to it within half a metre.
    pub fn furniture_at(&self, point: Vec2) -> Option<&Item> {
        let near = |item: &Item| item.footprint().distance_to(point);
        let best = self.furniture.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
        (near(best) < 0.5).then_some(best)
    }

    /// The objects that lie on a piece.
    pub fn objects_on<'s>(&'s self, item: &'s Item) -> impl Iterator<Item = &'s PlacedObject> {
        self.objects.iter().filter(|object| object.on == item.id)
    }

    /// The pieces on which an object of that name lies.
    pub fn holders_of(&self, name: &str) -> Vec<&Item> {
        self.objects.iter().filter(|object| object.name == name).filter_map(|object| self.item(&object.on)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_apartments_are_sound() {
        let map = RoomMap::apartment();
        for (text, file) in [
            (include_str!("../../fixtures/apartment.scene.json"), "apartment.scene.json"),
            (include_str!("../../fixtures/apartment-modified.scene.json"), "apartment-modified.scene.json"),
        ] {
            let scene = Scene::from_json(text, file, &map).expect("a sound scene");
            assert_eq!((scene.furniture.len(), scene.objects.len()), (12, 6));
        }
    }

    #[test]
    fn the_fork_lies_on_the_round_table_by_the_couch() {
        let scene = Scene::apartment();
        assert_eq!(scene.holders_of("fork")[0].id, "round-table-1");
        assert_eq!(scene.furniture_at(vec2(4.1, 2.1)).map(|item| item.id.as_str()), Some("round-table-1"));
        assert!(scene.furniture_at(vec2(0.0, 0.0)).is_none());
    }

    #[test]
    fn the_couch_is_wider_than_deep_and_faces_away_from_the_door() {
        let couch = Scene::apartment().item("couch-1").expect("a couch").footprint();
        let (low, high) = couch.bounds();
        assert!((high.x - low.x - 2.06).abs() < 1e-9 && (high.y - low.y - 0.73).abs() < 1e-9);
    }

    #[test]
    fn a_mesh_beside_the_scene_gives_a_piece_its_size_outline_and_solids() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("box.obj"), crate::simulation::mesh::tests::BOX).expect("written");
        let table = r#""id": "coffee-table-1", "category": "coffee_table","#;
        let text = include_str!("../../fixtures/apartment.scene.json")
            .replace(table, &format!(r#"{table} "mesh": {{"file": "box.obj", "front_deg": 90}}, "width": 0.7,"#));
        let path = folder.path().join("home.scene.json");
        std::fs::write(&path, text).expect("written");
        let scene = Scene::load(&path, &RoomMap::apartment()).expect("a sound scene");
        let item = scene.item("coffee-table-1").expect("there");
        assert!((item.size().length - 2.0).abs() < 1e-9 && item.size().width == 0.7);
        let (low, high) = item.footprint().bounds();
        assert!((high.x - low.x - 2.0).abs() < 1e-9 && (high.y - low.y - 0.7).abs() < 1e-9);
        let ray = crate::simulation::Ray { origin: vec2(0.0, 4.0), height: 0.3, direction: vec2(1.0, 0.0), climb: 0.0 };
        let hit = item.solids()[0].hit(&ray).expect("a hit");
        assert!((hit.distance - 3.5).abs() < 1e-9 && hit.normal[0] < -0.99, "{hit:?}");
    }
}
