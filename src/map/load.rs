//! Room maps by name or from files: JSON, the YAML of a ROS `map_server` pair, or what a scene file holds or names.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::value::RawValue;

use super::check::check_map;
use super::checker::nearest_name;
use super::error::{WorldError, parse, parse_at, read};
use super::map_server;
use super::room_map::RoomMap;
use super::shipped::{SHIPPED_MAPS, ShippedMap};

/// The one key of a scene file that leads to its room map.
#[derive(Deserialize)]
struct MapKey<'a> {
    #[serde(borrow, default)]
    map: Option<&'a RawValue>,
}

impl RoomMap {
    /// The paper's apartment.
    pub fn apartment() -> Self {
        SHIPPED_MAPS[0].map()
    }

    /// Reads and checks a room map file, JSON or the YAML of a ROS `map_server` pair.
    ///
    /// # Errors
    /// When the file cannot be read, is malformed (with line and column), or tells of a map that cannot be.
    pub fn load(path: &Path) -> Result<Self, WorldError> {
        if map_server::is_map_file(path) {
            return checked(map_server::load(path)?, &path.display().to_string());
        }
        Self::from_json(&read(path)?, &path.display().to_string())
    }

    /// Parses and checks a room map; `file` is named in errors.
    ///
    /// # Errors
    /// When the text is malformed, or tells of a map that cannot be.
    pub fn from_json(text: &str, file: &str) -> Result<Self, WorldError> {
        checked(parse(text, file)?, file)
    }
}

/// The room map, when it can be; `file` is named in errors.
fn checked(map: RoomMap, file: &str) -> Result<RoomMap, WorldError> {
    check_map(&map, file)?;
    Ok(map)
}

/// A room map: that of a shipped home by its name, a room map file, or the one that a scene file holds or names.
///
/// # Errors
/// When there is no such home or file, or what it holds is malformed or cannot be.
pub fn load_map(which: &Path) -> Result<RoomMap, WorldError> {
    if let Some(home) = shipped_home(which)? {
        return Ok(SHIPPED_MAPS[home].map());
    }
    if map_server::is_map_file(which) {
        return RoomMap::load(which);
    }
    let (text, file) = (read(which)?, which.display().to_string());
    let key: MapKey = parse(&text, &file)?;
    if key.map.is_some() { map_of_scene(which, &text, &file) } else { RoomMap::from_json(&text, &file) }
}

/// A name without extension or folder, where no such file lies, is that of a shipped home: its place among
/// [`SHIPPED_MAPS`].
///
/// # Errors
/// When no shipped home is called so.
pub fn shipped_home(which: &Path) -> Result<Option<usize>, WorldError> {
    let name = which.to_string_lossy();
    let bare = which.extension().is_none() && which.components().count() == 1;
    if !bare || which.exists() {
        return Ok(None);
    }
    if let Some(home) = SHIPPED_MAPS.iter().position(|home| home.name == name) {
        return Ok(Some(home));
    }
    let meant = nearest_name(&name, SHIPPED_MAPS.iter().map(|home| home.name));
    let meant = meant.map_or(String::new(), |name| format!("did you mean `{name}`? "));
    let message = format!("neither a file nor a shipped home; {meant}Shipped are {}", ShippedMap::names());
    Err(WorldError::Wrong { file: name.to_string(), item: "world".to_string(), message })
}

/// The room map that the scene file at `path` with that text holds, or names by its `"map"`: a room map file beside it
/// (`"home"` stands for `home.map.json`), or a shipped home.
///
/// # Errors
/// When the scene has no such key, nothing of that name is found, or what is found is malformed or cannot be.
pub fn map_of_scene(path: &Path, text: &str, file: &str) -> Result<RoomMap, WorldError> {
    let key: MapKey = parse(text, file)?;
    let wrong = |message: String| WorldError::Wrong { file: file.to_string(), item: "map".to_string(), message };
    let raw = key.map.ok_or_else(|| wrong("missing; name the room map file, or put the room map here".to_string()))?;
    if raw.get().starts_with('{') {
        // What is borrowed from the text lies within it.
        let offset = raw.get().as_ptr() as usize - text.as_ptr() as usize;
        return checked(parse_at(text, offset, raw.get().len(), file)?, file);
    }
    let name: String = parse(raw.get(), file)?;
    let beside = map_files(path, &name);
    if let Some(found) = beside.iter().find(|path| path.is_file()) {
        return RoomMap::load(found);
    }
    let tried: Vec<String> = beside.iter().map(|path| path.display().to_string()).collect();
    let none = || wrong(format!("no room map `{name}`: looked for {}", tried.join(" and ")));
    SHIPPED_MAPS.iter().find(|home| home.name == name).map(ShippedMap::map).ok_or_else(none)
}

/// The files that a scene's `"map": name` can mean, beside the scene.
fn map_files(scene: &Path, name: &str) -> Vec<PathBuf> {
    let folder = scene.parent().unwrap_or(Path::new(""));
    if Path::new(name).extension().is_some() {
        return vec![folder.join(name)];
    }
    vec![folder.join(format!("{name}.map.json")), folder.join(format!("{name}.yaml"))]
}
