//! Worlds by name or from files: a scene file that names its room map, or one that holds it.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::value::RawValue;

use super::check::nearest_name;
use super::error::{WorldError, parse, parse_at, read};
use super::shipped::ShippedHome;
use super::{RoomMap, Scene};

/// The one key of a scene file that leads to its room map.
#[derive(Deserialize)]
struct MapKey<'a> {
    #[serde(borrow, default)]
    map: Option<&'a RawValue>,
}

/// A home's room map and scene: a shipped home by its name, or a scene file.
///
/// A scene file names its room map by `"map"`: a room map file beside it
/// (`"home"` stands for `home.map.json`), a shipped home, or the whole room
/// map in its place.
pub fn load_world(which: &Path) -> Result<(RoomMap, Scene), WorldError> {
    if let Some(home) = shipped(which)? {
        return home.load();
    }
    let (text, file) = (read(which)?, which.display().to_string());
    let map = map_of_scene(which, &text, &file)?;
    let scene = Scene::parse(&text, which)?.on(&map);
    super::check(&scene, &map, &file)?;
    Ok((map, scene))
}

/// A room map: that of a shipped home by its name, a room map file, or the one that a scene file holds or names.
pub fn load_map(which: &Path) -> Result<RoomMap, WorldError> {
    if let Some(home) = shipped(which)? {
        return home.map();
    }
    if super::map_server::is_map_file(which) {
        return RoomMap::load(which);
    }
    let (text, file) = (read(which)?, which.display().to_string());
    let key: MapKey = parse(&text, &file)?;
    if key.map.is_some() { map_of_scene(which, &text, &file) } else { RoomMap::from_json(&text, &file) }
}

/// A name without extension or folder, where no such file lies, is that of a shipped home.
fn shipped(which: &Path) -> Result<Option<&'static ShippedHome>, WorldError> {
    let name = which.to_string_lossy();
    let bare = which.extension().is_none() && which.components().count() == 1;
    if !bare || which.exists() {
        return Ok(None);
    }
    match ShippedHome::named(&name) {
        Some(home) => Ok(Some(home)),
        None => {
            let meant = nearest_name(&name, super::SHIPPED_HOMES.iter().map(|home| home.name));
            let meant = meant.map_or(String::new(), |name| format!("did you mean `{name}`? "));
            let message = format!("neither a file nor a shipped home; {meant}Shipped are {}", ShippedHome::names());
            Err(WorldError::Wrong { file: name.to_string(), item: "world".to_string(), message })
        }
    }
}

fn map_of_scene(path: &Path, text: &str, file: &str) -> Result<RoomMap, WorldError> {
    let key: MapKey = parse(text, file)?;
    let wrong = |message: String| WorldError::Wrong { file: file.to_string(), item: "map".to_string(), message };
    let raw = key.map.ok_or_else(|| wrong("missing; name the room map file, or put the room map here".to_string()))?;
    if raw.get().starts_with('{') {
        // What is borrowed from the text lies within it.
        let offset = raw.get().as_ptr() as usize - text.as_ptr() as usize;
        let map: RoomMap = parse_at(text, offset, raw.get().len(), file)?;
        return map.checked(file);
    }
    let name: String = parse(raw.get(), file)?;
    let beside = map_files(path, &name);
    if let Some(found) = beside.iter().find(|path| path.is_file()) {
        return RoomMap::load(found);
    }
    let tried: Vec<String> = beside.iter().map(|path| path.display().to_string()).collect();
    let none = || wrong(format!("no room map `{name}`: looked for {}", tried.join(" and ")));
    ShippedHome::named(&name).ok_or_else(none)?.map()
}

/// The files that a scene's `"map": name` can mean, beside the scene.
fn map_files(scene: &Path, name: &str) -> Vec<PathBuf> {
    let folder = scene.parent().unwrap_or(Path::new(""));
    if Path::new(name).extension().is_some() {
        return vec![folder.join(name)];
    }
    vec![folder.join(format!("{name}.map.json")), folder.join(format!("{name}.yaml"))]
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
        assert_eq!(
            (&map, &scene),
            (
                &load_map(&path).expect("a map"),
                &ShippedHome::named("studio").expect("shipped").load().expect("sound").1
            )
        );
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
    fn a_home_misspelt_says_which_was_meant_and_lists_all() {
        let error = load_world(Path::new("stduio")).expect_err("no home").to_string();
        assert!(error.contains("did you mean `studio`? Shipped are apartment, apartment-modified,"), "{error}");
    }
}
