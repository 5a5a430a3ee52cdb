//! A ROS `map_server` pair, YAML and image, as a room map.
//!
//! A grid has no names: the YAML's own key `rooms` (which `map_server`
//! ignores) gives each room a point to start from, or its outline. A room is
//! the box of walls round the free space of its point; doors are where the
//! wall between two rooms is open.

mod doors;
mod grid;
mod image;
mod mode;
mod rooms;

use std::path::Path;

use serde::Deserialize;

use super::error::{WorldError, read};
use super::room_map::{Door, FORMAT_VERSION, Room, RoomMap};
use crate::geometry::{Pose, vec2};
use crate::limits::{HOME_COORDINATE_M, HOME_CORNERS, HOME_ROOMS};
use grid::Grid;
use mode::{Mode, Negate, Thresholds};

/// The YAML file.
#[derive(Deserialize)]
struct MapFile {
    image: String,
    resolution: f64,
    origin: [f64; 3],
    mode: Option<String>,
    negate: Option<Negate>,
    #[serde(default = "usual_occupied")]
    occupied_thresh: f64,
    #[serde(default = "usual_free")]
    free_thresh: f64,
    start: Option<[f64; 3]>,
    wall_height: Option<f64>,
    #[serde(default)]
    rooms: Vec<RoomKey>,
    doors: Option<Vec<Door>>,
}

/// A room of the key `rooms`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RoomKey {
    name: String,
    #[serde(default)]
    synonyms: Vec<String>,
    #[serde(default)]
    passage: bool,
    seed: Option<[f64; 2]>,
    outline: Option<Vec<[f64; 2]>>,
}

fn usual_occupied() -> f64 {
    0.65
}

fn usual_free() -> f64 {
    0.196
}

/// Sides of a cell that a map can have, metres.
const FINEST_M: f64 = 0.005;
const COARSEST_M: f64 = 1.0;

/// Names the file in what is wrong with it.
struct Source<'a>(&'a str);

impl Source<'_> {
    fn wrong(&self, item: &str, message: impl Into<String>) -> WorldError {
        WorldError::Wrong { file: self.0.to_string(), item: item.to_string(), message: message.into() }
    }
}

/// Whether a file is the YAML of such a pair, by its name.
pub(super) fn is_map_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "yaml" || extension == "yml")
}

/// Reads a `map_server` pair.
pub(super) fn load(path: &Path) -> Result<RoomMap, WorldError> {
    let file = path.display().to_string();
    let source = Source(&file);
    let keys = parse(&read(path)?, &file)?;
    if keys.origin[2].abs() > 1e-9 {
        return Err(source.wrong("origin", "a turned map is not read; turn the image instead and give yaw 0"));
    }
    if !(FINEST_M..=COARSEST_M).contains(&keys.resolution) {
        let message = format!("must be {FINEST_M} to {COARSEST_M} m a cell; 0.05 is usual");
        return Err(source.wrong("resolution", message));
    }
    if !keys.origin.iter().all(|v| v.abs() <= HOME_COORDINATE_M.value as f64) {
        let message = format!("must be numbers of metres, none beyond {}", HOME_COORDINATE_M.value);
        return Err(source.wrong("origin", message));
    }
    HOME_ROOMS.check(keys.rooms.len()).map_err(|message| source.wrong("rooms", message))?;
    let corners = keys.rooms.iter().filter_map(|room| room.outline.as_ref()).map(Vec::len).sum();
    HOME_CORNERS.check(corners).map_err(|message| source.wrong("rooms", message))?;
    let image = path.parent().unwrap_or(Path::new("")).join(&keys.image);
    let thresholds = thresholds(&keys, &source)?;
    let grid = Grid::read(&image, keys.resolution, vec2(keys.origin[0], keys.origin[1]), thresholds)
        .map_err(|message| source.wrong("image", format!("{}: {message}", image.display())))?;
    let name = path.file_stem().map_or_else(|| "map".to_string(), |stem| stem.to_string_lossy().into_owned());
    room_map(name, keys, &grid, &source)
}

/// How the image is read, where that can be.
fn thresholds(keys: &MapFile, source: &Source) -> Result<Thresholds, WorldError> {
    let (occupied, free) = (keys.occupied_thresh, keys.free_thresh);
    for (name, value) in [("occupied_thresh", occupied), ("free_thresh", free)] {
        if !(0.0..=1.0).contains(&value) {
            return Err(source.wrong(name, format!("{value} is no share of darkness; give 0 to 1")));
        }
    }
    if free > occupied {
        let message = format!("{free} is above `occupied_thresh` {occupied}; by that a cell could be both");
        return Err(source.wrong("free_thresh", message));
    }
    let named = |name: &String| {
        let unknown = || source.wrong("mode", format!("`{name}` is none; trinary, scale and raw are"));
        Mode::from_name(name).ok_or_else(unknown)
    };
    let mode = keys.mode.as_ref().map_or(Ok(Mode::Trinary), named)?;
    Ok(Thresholds { mode, occupied, free, negate: keys.negate.is_some_and(Negate::is_set) })
}

fn parse(text: &str, file: &str) -> Result<MapFile, WorldError> {
    serde_saphyr::from_str(text).map_err(|error| {
        let place = error.location();
        WorldError::Malformed {
            file: file.to_string(),
            line: place.map_or(1, |place| place.line() as usize),
            column: place.map_or(1, |place| place.column() as usize),
            message: error.without_snippet().to_string(),
        }
    })
}

fn room_map(name: String, keys: MapFile, grid: &Grid, source: &Source) -> Result<RoomMap, WorldError> {
    let keys_of_rooms = if keys.rooms.is_empty() { vec![whole(grid, source)?] } else { keys.rooms };
    let mut outlines = rooms::outlines(&keys_of_rooms, grid, source)?;
    let found = doors::join_walls(&mut outlines, grid);
    let middle = |outline: &Vec<[f64; 2]>| grid.roomiest_within(outline);
    let start = keys.start.map(|[x, y, heading]| Pose::new(x, y, heading));
    let start = start.or_else(|| middle(&outlines[0]).map(|at| Pose::new(at.x, at.y, 0.0)));
    let start =
        start.ok_or_else(|| source.wrong("start", "no free place for it was found; give `start: [x, y, heading]`"))?;
    let doors = keys.doors.unwrap_or_else(|| doors::named(found, &keys_of_rooms));
    let inner_walls = grid.walls_away_from(&outlines);
    let rooms = keys_of_rooms
        .into_iter()
        .zip(outlines)
        .map(|(key, outline)| Room { name: key.name, synonyms: key.synonyms, passage: key.passage, outline })
        .collect();
    let wall_height = keys.wall_height.unwrap_or(2.5);
    Ok(RoomMap { version: FORMAT_VERSION, name, wall_height, start, rooms, doors, inner_walls })
}

/// The whole free space as one room.
fn whole(grid: &Grid, source: &Source) -> Result<RoomKey, WorldError> {
    let (low, high) = grid.free_box().ok_or_else(|| source.wrong("image", "has no free cells"))?;
    let outline = vec![[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]];
    Ok(RoomKey { name: "room".to_string(), synonyms: Vec::new(), passage: false, seed: None, outline: Some(outline) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Direction;

    /// 8 × 6 m at 0.1 m: a hallway along the south, two rooms north of it with a door each, walls 0.2 m thick.
    fn picture() -> Vec<u8> {
        let (width, height) = (80, 60);
        let mut pixels = format!("P5\n# made for a test\n{width} {height}\n255\n").into_bytes();
        for row in 0..height {
            for x in 0..width {
                let y = height - 1 - row;
                let outer = x < 2 || x >= width - 2 || y < 2 || y >= height - 2;
                let across = (20..22).contains(&y) && !(15..26).contains(&x) && !(55..66).contains(&x);
                let between = y >= 20 && (40..42).contains(&x);
                let column = (30..33).contains(&x) && (45..48).contains(&y);
                pixels.push(if outer || across || between || column { 0 } else { 254 });
            }
        }
        pixels
    }

    const YAML: &str = "image: floor.pgm\nresolution: 0.1\norigin: [-1.0, -1.0, 0.0]\nnegate: 0\n\
        occupied_thresh: 0.65\nfree_thresh: 0.196\nstart: [-0.2, 0.1, 0.0]\nrooms:\n\
        - {name: hallway, passage: true, seed: [3.0, 0.1]}\n\
        - {name: bedroom, synonyms: [guest_room], seed: [1.0, 3.0]}\n\
        - {name: kitchen, seed: [5.0, 3.0]}\n";

    fn loaded(yaml: &str) -> Result<RoomMap, String> {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("floor.pgm"), picture()).expect("written");
        let path = folder.path().join("floor.yaml");
        std::fs::write(&path, yaml).expect("written");
        super::super::load_map(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn rooms_walls_and_doors_are_found_from_a_point_in_each_room() {
        let map = loaded(YAML).expect("a room map");
        let bedroom = map.room("bedroom").expect("there").polygon();
        let (low, high) = bedroom.bounds();
        assert!((low - vec2(-0.8, 1.1)).norm() < 0.15 && (high - vec2(3.1, 4.8)).norm() < 0.15, "{low} {high}");
        assert_eq!(map.doors.len(), 2);
        let door = map.doors.iter().find(|door| door.between.contains(&"bedroom".to_string())).expect("a door");
        assert!((door.at[0] - 1.05).abs() < 0.11 && (door.width - 1.1).abs() < 0.11, "{door:?}");
        assert_eq!(map.side_of("kitchen"), Some(Direction::Left));
        assert_eq!(map.rooms_called("guest_room"), ["bedroom"]);
    }

    #[test]
    fn what_stands_free_in_a_room_is_a_wall_as_well() {
        let map = loaded(YAML).expect("a room map");
        assert!(!map.inner_walls.is_empty());
        let near = |&(a, b): &(crate::geometry::Vec2, crate::geometry::Vec2)| {
            crate::geometry::distance_to_segment(vec2(2.15, 3.65), a, b) < 0.2
        };
        assert!(map.walls().iter().any(near));
    }

    #[test]
    fn without_rooms_the_free_space_is_one_room() {
        let yaml: String = YAML.lines().take(6).map(|line| format!("{line}\n")).collect();
        let map = loaded(&yaml).expect("a room map");
        assert_eq!((map.rooms.len(), map.rooms[0].name.as_str()), (1, "room"));
        assert!(map.room_at(map.start.position()).is_some());
    }

    #[test]
    fn modes_and_thresholds_that_cannot_be_are_named() {
        let error = |from: &str, to: &str| loaded(&YAML.replace(from, to)).expect_err("wrong");
        assert!(error("negate: 0", "negate: 0\nmode: sepia").contains("mode: `sepia` is none; trinary, scale and raw"));
        assert!(
            error("free_thresh: 0.196", "free_thresh: 0.7").contains("free_thresh: 0.7 is above `occupied_thresh`")
        );
        assert!(error("occupied_thresh: 0.65", "occupied_thresh: 65").contains("occupied_thresh: 65 is no share"));
        assert!(error("resolution: 0.1", "resolution: 1e-300").contains("resolution: must be 0.005 to 1 m a cell"));
        assert!(error("origin: [-1.0, -1.0", "origin: [.inf, -1.0").contains("origin: must be numbers of metres"));
        assert!(loaded(&YAML.replace("negate: 0", "negate: false\nmode: Trinary")).is_ok());
    }

    #[test]
    fn what_is_wrong_is_named_with_what_mends_it() {
        let error = loaded(&YAML.replace("seed: [3.0, 0.1]", "seed: [3.0, 1.1]")).expect_err("in a wall");
        assert!(error.contains("room `hallway`: seed (3, 1.1)"), "{error}");
        let error = loaded(&YAML.replace("resolution: 0.1", "resolution: a")).expect_err("no number");
        assert!(error.contains("floor.yaml:2:"), "{error}");
        let error = loaded(&YAML.replace("floor.pgm", "flor.pgm")).expect_err("no image");
        assert!(error.contains("image: ") && error.contains("flor.pgm"), "{error}");
    }
}
