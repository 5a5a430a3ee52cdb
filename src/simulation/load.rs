//! Worlds by name or from files: a scene file that names its room map, or one that holds it.

use std::path::Path;

use super::check::check;
use super::scene::Scene;
use super::shipped::{SHIPPED_HOMES, ShippedHome};
use crate::language::Lexicon;
use crate::map::error::{WorldError, parse, read};
use crate::map::{RoomMap, map_of_scene, shipped_home};

impl Scene {
    /// The paper's apartment as furnished in its Fig. 3.
    pub fn apartment() -> Self {
        SHIPPED_HOMES[0].load().1
    }

    /// The apartment with its furniture moved, after the idea of the paper's Fig. 4.
    pub fn apartment_modified() -> Self {
        SHIPPED_HOMES[1].load().1
    }

    /// Reads a scene and checks it against its room map.
    ///
    /// # Errors
    /// When the file or a mesh that it names cannot be read, is malformed, or tells of a scene that cannot be.
    pub fn load(path: &Path, map: &RoomMap) -> Result<Self, WorldError> {
        let scene = parse_scene(&read(path)?, path)?;
        check(&scene, map, &path.display().to_string())?;
        Ok(scene)
    }

    /// Parses a scene and checks it against its room map; `file` is named in errors.
    ///
    /// # Errors
    /// When the text is malformed, or tells of a scene that cannot be.
    pub fn from_json(text: &str, file: &str, map: &RoomMap) -> Result<Self, WorldError> {
        let mut scene: Self = parse(text, file)?;
        scene.call_objects_by_lexicon();
        check(&scene, map, file)?;
        Ok(scene)
    }
}

impl Scene {
    /// Calls objects as sentences are read: "Phone" and "mobile" are both `cellphone`.
    fn call_objects_by_lexicon(&mut self) {
        let lexicon = Lexicon::embedded();
        for object in &mut self.objects {
            let words = object.name.trim().to_lowercase().replace(['_', '-'], " ");
            object.name = lexicon.canonical(&words).map_or_else(|| words.replace(' ', "_"), str::to_string);
        }
    }
}

/// Parses a scene file with what it refers to.
fn parse_scene(text: &str, path: &Path) -> Result<Scene, WorldError> {
    let mut scene: Scene = parse(text, &path.display().to_string())?;
    scene.call_objects_by_lexicon();
    for item in &mut scene.furniture {
        if let Some(mesh) = &mut item.mesh {
            mesh.load(path, &item.id)?;
        }
    }
    Ok(scene)
}

/// A home's room map and scene: a shipped home by its name, or a scene file with the map that it holds or names.
///
/// # Errors
/// When there is no such home or file, or what it holds is malformed or cannot be.
pub fn load_world(which: &Path) -> Result<(RoomMap, Scene), WorldError> {
    if let Some(home) = shipped_home(which)? {
        return Ok(SHIPPED_HOMES[home].load());
    }
    let (text, file) = (read(which)?, which.display().to_string());
    let map = map_of_scene(which, &text, &file)?;
    // The scene names its map by the file.
    let scene = Scene { map: map.name.clone(), ..parse_scene(&text, which)? };
    check(&scene, &map, &file)?;
    Ok((map, scene))
}

impl ShippedHome {
    /// Its room map and its scene.
    ///
    /// # Panics
    /// When what is embedded is no sound home: the program was built wrongly, and must not drive in an empty one.
    pub fn load(&self) -> (RoomMap, Scene) {
        let map = self.map.map();
        let scene = Scene::from_json(self.scene, &format!("{} (scene)", self.map.name), &map);
        (map, scene.unwrap_or_else(|error| panic!("embedded: {error}")))
    }
}

/// A home as one file: a scene that holds its room map.
pub fn world_json(map: &RoomMap, scene: &Scene) -> String {
    let mut value = serde_json::to_value(scene).unwrap_or_default();
    value["map"] = serde_json::to_value(map).unwrap_or_default();
    format!("{value:#}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::load_map;

    fn written(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).expect("written");
        }
        folder
    }

    const MAP: &str = include_str!("../../fixtures/studio.map.json");
    const SCENE: &str = include_str!("../../fixtures/studio.scene.json");

    #[test]
    fn a_scene_file_finds_the_map_beside_it() {
        let folder = written(&[("studio.map.json", MAP), ("mine.scene.json", SCENE)]);
        let (map, scene) = load_world(&folder.path().join("mine.scene.json")).expect("a world");
        assert_eq!((map.name.as_str(), scene.map.as_str()), ("studio", "studio"));
    }

    #[test]
    fn one_file_holds_both_and_is_a_map_as_well() {
        let both = SCENE.replace("\"map\": \"studio\"", &format!("\"map\": {MAP}"));
        let folder = written(&[("both.json", &both)]);
        let path = folder.path().join("both.json");
        let (map, scene) = load_world(&path).expect("a world");
        assert_eq!((&map, &scene), (&load_map(&path).expect("a map"), &SHIPPED_HOMES[2].load().1));
    }

    #[test]
    fn what_is_wrong_in_a_map_within_a_scene_is_placed_in_the_file() {
        let map = MAP.replace("\"width\"", "\"breadth\"");
        let both = SCENE.replace("\"map\": \"studio\"", &format!("\"map\": {map}"));
        let folder = written(&[("both.json", &both)]);
        let error = load_world(&folder.path().join("both.json")).expect_err("a wrong map").to_string();
        let line = 1 + both.lines().position(|line| line.contains("breadth")).expect("there");
        assert!(error.contains(&format!("both.json:{line}:")) && error.contains("`breadth`"), "{error}");
    }

    #[test]
    fn a_map_that_is_nowhere_is_named_with_what_was_tried() {
        let folder = written(&[("s.json", &SCENE.replace("\"map\": \"studio\"", "\"map\": \"castle\""))]);
        let error = load_world(&folder.path().join("s.json")).expect_err("no map").to_string();
        assert!(
            error.contains("map: no room map `castle`: looked for") && error.contains("castle.map.json"),
            "{error}"
        );
    }

    #[test]
    fn an_object_is_called_as_sentences_are_read() {
        let called = |name: &str| {
            let text = include_str!("../../fixtures/apartment.scene.json");
            let text = text.replacen("\"name\": \"mug\"", &format!("\"name\": \"{name}\""), 1);
            Scene::from_json(&text, "s.json", &RoomMap::apartment())
                .map(|s| s.objects.iter().map(|o| o.name.clone()).collect::<Vec<_>>())
        };
        assert!(called("Phone").expect("a scene").contains(&"cellphone".to_string()));
        assert!(called("coffee cup").expect("a scene").contains(&"mug".to_string()));
        assert!(called("Heirloom").expect("a scene").contains(&"heirloom".to_string()));
        let error = called("headphnes").expect_err("misspelt").to_string();
        assert!(error.contains("is no name that sentences are read by; did you mean `headphones`?"), "{error}");
        let error = called("table").expect_err("furniture").to_string();
        assert!(error.contains("`table` is furniture or a room"), "{error}");
    }

    #[test]
    fn a_home_misspelt_says_which_was_meant_and_lists_all() {
        let error = load_world(Path::new("stduio")).expect_err("no home").to_string();
        assert!(error.contains("did you mean `studio`? Shipped are apartment, apartment-modified,"), "{error}");
    }
}
