//! Scenes that cannot be.

use super::{Item, Noise, PlacedObject, Scene};
use crate::catalogue::CATEGORIES;
use crate::frame::CameraMount;
use crate::geometry::{Polygon, distance_to_segment, vec2};
use crate::language::{Class, Lexicon};
use crate::limits::{HOME_COORDINATE_M, ITEM_SIZE_M, SCENE_ITEMS, SCENE_OBJECTS};
use crate::map::checker::{Checker, TOLERANCE_M, nearest_name};
use crate::map::{Room, RoomMap, WorldError};

/// Checks a scene against its room map.
///
/// # Errors
/// What is wrong with the first wrong item, and what mends it.
pub fn check(scene: &Scene, map: &RoomMap, file: &str) -> Result<(), WorldError> {
    let checker = Checker { file };
    checker.version(scene.version)?;
    checker.require(scene.map == map.name, "map", || {
        format!("the scene is for the map `{}`, the map given is `{}`; give the one it names", scene.map, map.name)
    })?;
    checker.within(SCENE_ITEMS, "furniture", scene.furniture.len())?;
    checker.within(SCENE_OBJECTS, "objects", scene.objects.len())?;
    check_camera(&checker, scene)?;
    check_noise(&checker, scene.noise.unwrap_or_default())?;
    checker.unique("furniture", scene.furniture.iter().map(|item| item.id.as_str()))?;
    checker.unique("object", scene.objects.iter().map(|object| object.id.as_str()))?;
    for item in &scene.furniture {
        check_item(&checker, map, item)?;
    }
    check_places(&checker, scene)?;
    for object in &scene.objects {
        check_object(&checker, scene, object)?;
    }
    Ok(())
}

/// The highest camera a robot's tower carries, metres.
const HIGHEST_CAMERA_M: f64 = 2.0;
/// How far a camera looks up or down and still shows the room, degrees.
const STEEPEST_DEG: f64 = 60.0;
/// A thousand turns: beyond them an angle has lost its degrees.
const MOST_DEG: f64 = 360_000.0;

fn check_camera(checker: &Checker, scene: &Scene) -> Result<(), WorldError> {
    let CameraMount { height_m, tilt_deg } = scene.camera.unwrap_or_default();
    checker.require((0.1..=HIGHEST_CAMERA_M).contains(&height_m), "camera", || {
        format!(
            "height_m {height_m} is no height of a robot's camera; give 0.1 to {HIGHEST_CAMERA_M} m above the floor"
        )
    })?;
    checker.require((-STEEPEST_DEG..=STEEPEST_DEG).contains(&tilt_deg), "camera", || {
        format!("tilt_deg {tilt_deg} shows no room; give -{STEEPEST_DEG} (up) to {STEEPEST_DEG} (down) degrees")
    })
}

/// Errors of which a robot could still be said to drive: beyond them it stands in another house, or turns on the spot.
fn check_noise(checker: &Checker, noise: Noise) -> Result<(), WorldError> {
    const HALF_TURN: f64 = std::f64::consts::PI;
    let Noise { start_m, start_rad, wheel_scale, wheel_mismatch, track_scale, slip, .. } = noise;
    let Noise { sonar_share, sonar_m, sonar_miss, sonar_crosstalk, compass_bias_rad, compass_rad, .. } = noise;
    let values = [
        ("start_m", start_m, 2.0),
        ("start_rad", start_rad, HALF_TURN),
        ("wheel_scale", wheel_scale, 0.3),
        ("wheel_mismatch", wheel_mismatch, 0.3),
        ("track_scale", track_scale, 0.3),
        ("slip", slip, 0.3),
        ("sonar_share", sonar_share, 1.0),
        ("sonar_m", sonar_m, 2.0),
        ("sonar_miss", sonar_miss, 1.0),
        ("sonar_crosstalk", sonar_crosstalk, 1.0),
        ("compass_bias_rad", compass_bias_rad, HALF_TURN),
        ("compass_rad", compass_rad, HALF_TURN),
    ];
    values.into_iter().try_for_each(|(name, value, most)| {
        checker.require((0.0..=most).contains(&value), "noise", || {
            format!("`{name}` {value} is no size of an error; give 0 to {most:.2}")
        })
    })
}

fn check_item(checker: &Checker, map: &RoomMap, item: &Item) -> Result<(), WorldError> {
    let name = format!("furniture `{}`", item.id);
    let known = CATEGORIES.iter().any(|category| category.name == item.category);
    checker.require(known, &name, || unknown_category(&item.category))?;
    let read = item.mesh.is_none() || item.loaded_mesh().is_some();
    checker.require(read, &name, || "its mesh was not read; load the scene from its file".to_string())?;
    let size = item.size();
    let sizes = [size.length, size.width, size.height];
    let most = ITEM_SIZE_M.value;
    checker.require(sizes.iter().all(|v| *v > 0.0 && *v <= most as f64), &name, || {
        let [length, width, height] = sizes;
        format!("{length} × {width} × {height}: sizes must be above 0 m and at most {most} m")
    })?;
    let numbers = [item.x, item.y].iter().all(|v| v.abs() <= HOME_COORDINATE_M.value as f64);
    checker.require(numbers && item.yaw_deg.abs() <= MOST_DEG, &name, || {
        "x, y and yaw_deg must be numbers of metres and degrees".to_string()
    })?;
    check_room(checker, map, item, &name)
}

fn unknown_category(category: &str) -> String {
    let names: Vec<&str> = CATEGORIES.iter().map(|category| category.name).collect();
    let mend = match nearest_name(category, names.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? Known"),
        None => "known".to_string(),
    };
    format!("unknown category `{category}`; {mend} are {}", names.join(", "))
}

/// A piece stands in one room, clear of its walls, of doors and of the start.
fn check_room(checker: &Checker, map: &RoomMap, item: &Item, name: &str) -> Result<(), WorldError> {
    let footprint = item.footprint();
    let Some(room) = map.room_at(vec2(item.x, item.y)) else {
        let rooms: Vec<String> = map.rooms.iter().map(extent).collect();
        let message = format!("({}, {}) lies in no room; move it into one: {}", item.x, item.y, rooms.join(", "));
        return Err(checker.wrong(name, message));
    };
    checker.require(lies_within(&footprint, &room.polygon()), name, || {
        format!("reaches into a wall of `{}`; move it further into the room", room.name)
    })?;
    let in_doorway = map.doors.iter().find(|door| footprint.distance_to(door.middle()) < door.width / 2.0);
    checker.require(in_doorway.is_none(), name, || {
        let (door, width) = in_doorway.map_or(("", 0.0), |door| (door.id.as_str(), door.width));
        format!("stands in the door `{door}`; keep {:.2} m round its middle free", width / 2.0)
    })?;
    checker.require(footprint.distance_to(map.start.position()) > 0.37, name, || {
        "stands where the robot starts; move one of the two".to_string()
    })
}

/// The room with the corners of its bounding box, for people.
fn extent(room: &Room) -> String {
    let (low, high) = room.polygon().bounds();
    format!("`{}` (x {} to {}, y {} to {})", room.name, low.x, high.x, low.y, high.y)
}

/// Whether no corner of a footprint lies outside the room, and no corner of the room inside the footprint.
fn lies_within(footprint: &Polygon, room: &Polygon) -> bool {
    let inside = footprint.corners().iter().all(|&corner| room.distance_to(corner) <= TOLERANCE_M);
    let depth = |point| footprint.edges().map(|(a, b)| distance_to_segment(point, a, b)).fold(f64::INFINITY, f64::min);
    inside && !room.corners().iter().any(|&corner| footprint.contains(corner) && depth(corner) > TOLERANCE_M)
}

fn check_places(checker: &Checker, scene: &Scene) -> Result<(), WorldError> {
    let outlines: Vec<Polygon> = scene.furniture.iter().map(Item::footprint).collect();
    for (i, a) in scene.furniture.iter().enumerate() {
        for (j, b) in scene.furniture.iter().enumerate().skip(i + 1) {
            // A chair may be pushed under a table; no two pieces share a middle.
            let tucked = [a, b].iter().any(|item| item.category == "chair" || item.category == "stool");
            let clash = if tucked {
                outlines[i].contains(vec2(b.x, b.y)) || outlines[j].contains(vec2(a.x, a.y))
            } else {
                outlines[i].touches(&outlines[j])
            };
            checker.require(!clash, &format!("furniture `{}`", b.id), || {
                format!("stands in the place of `{}`; move one of the two", a.id)
            })?;
        }
    }
    Ok(())
}

fn check_object(checker: &Checker, scene: &Scene, object: &PlacedObject) -> Result<(), WorldError> {
    let name = format!("object `{}`", object.id);
    let Some(holder) = scene.item(&object.on) else {
        let meant = nearest_name(&object.on, scene.furniture.iter().map(|item| item.id.as_str()));
        let mend = meant.map_or("name a piece by its `id`".to_string(), |id| format!("did you mean `{id}`?"));
        let message = format!("lies on `{}`, which is no furniture of the scene; {mend}", object.on);
        return Err(checker.wrong(&name, message));
    };
    check_name(checker, object, &name)?;
    let numbers = [object.forward, object.left].iter().all(|v| v.abs() <= ITEM_SIZE_M.value as f64)
        && object.yaw_deg.abs() <= MOST_DEG;
    checker.require(numbers, &name, || "forward, left and yaw_deg must be numbers".to_string())?;
    let on_top = holder.footprint().contains(object.pose_on(holder).position());
    checker.require(on_top, &name, || {
        format!("lies beside `{}`, not on it; bring `forward` and `left` nearer to 0", object.on)
    })
}

/// An object is called by a name that sentences can mean it by.
fn check_name(checker: &Checker, object: &PlacedObject, item: &str) -> Result<(), WorldError> {
    let (lexicon, words) = (Lexicon::embedded(), object.name.replace('_', " "));
    let known = lexicon.noun(&words);
    checker.require(known.is_none_or(|noun| noun.class == Class::Object), item, || {
        format!("`{}` is furniture or a room to whoever says it; give it the name of a small thing", object.name)
    })?;
    let meant = lexicon.mended(&words).filter(|noun| known.is_none() && noun.class == Class::Object);
    checker.require(meant.is_none(), item, || {
        let meant = meant.map_or("", |noun| noun.name.as_str());
        format!("`{}` is no name that sentences are read by; did you mean `{meant}`?", object.name)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene_error(change: impl FnOnce(&mut Scene)) -> String {
        let mut scene = Scene::apartment();
        change(&mut scene);
        check(&scene, &RoomMap::apartment(), "home.json").expect_err("a wrong scene").to_string()
    }

    #[test]
    fn furniture_outside_every_room_or_in_a_wall_is_named() {
        assert!(
            scene_error(|s| s.furniture[0].x = 40.0).contains(
                "furniture `round-table-1`: (40, 2) lies in no room; move it into one: `hallway` (x -5 to 7.2"
            )
        );
        let error = scene_error(|s| s.furniture[0].x = 7.1);
        assert!(error.contains("furniture `round-table-1`: reaches into a wall of `living_room`"), "{error}");
    }

    #[test]
    fn two_items_in_one_place_are_named() {
        let error = scene_error(|s| (s.furniture[2].x, s.furniture[2].y) = (4.5, 3.0));
        assert!(error.contains("furniture `coffee-table-1`: stands in the place of `couch-1`"), "{error}");
    }

    #[test]
    fn an_unknown_category_lists_the_known_ones() {
        let error = scene_error(|s| s.furniture[0].category = "throne".to_string());
        assert!(error.contains("unknown category `throne`; known are table, "), "{error}");
    }

    #[test]
    fn not_a_number_and_no_size_are_refused() {
        assert!(scene_error(|s| s.furniture[0].x = f64::NAN).contains("must be numbers"));
        for size in [-1.0, 2000.0, 1e308, f64::INFINITY] {
            assert!(scene_error(|s| s.furniture[0].length = Some(size)).contains("sizes must be above 0 m"), "{size}");
        }
    }

    #[test]
    fn noise_that_is_negative_or_beyond_all_bounds_is_refused_by_name() {
        for (value, name) in [(-0.1, "slip"), (1e308, "slip"), (f64::NAN, "slip")] {
            let error = scene_error(|s| s.noise = Some(Noise { slip: value, ..Noise::default() }));
            assert!(error.contains(&format!("noise: `{name}` ")), "{error}");
        }
        assert!(
            scene_error(|s| s.noise = Some(Noise { sonar_miss: 1.5, ..Noise::default() })).contains("`sonar_miss`")
        );
    }

    #[test]
    fn a_scene_has_so_many_pieces_and_objects() {
        let many = |s: &mut Scene| s.furniture = vec![s.furniture[0].clone(); 1000];
        assert!(scene_error(many).contains("furniture: 1000 pieces of furniture are more than the 400"));
        let many = |s: &mut Scene| s.objects = vec![s.objects[0].clone(); 1001];
        assert!(scene_error(many).contains("objects: 1001 objects are more than the 1000"));
    }

    #[test]
    fn a_camera_on_the_ceiling_or_looking_at_its_own_feet_is_refused() {
        let mounted = |height_m, tilt_deg| scene_error(|s| s.camera = Some(CameraMount { height_m, tilt_deg }));
        assert!(
            mounted(120.0, 15.0).contains("camera: height_m 120 is no height of a robot's camera; give 0.1 to 2 m")
        );
        assert!(mounted(1.2, 89.0).contains("camera: tilt_deg 89 shows no room"));
        assert!(mounted(f64::NAN, 15.0).contains("camera: height_m NaN"));
    }

    #[test]
    fn furniture_in_a_doorway_is_refused() {
        let error = scene_error(|s| (s.furniture[0].x, s.furniture[0].y) = (2.63, 1.7));
        assert!(error.contains("stands in the door `living_room_door`"), "{error}");
    }

    #[test]
    fn an_object_on_nothing_or_beside_its_table_is_named() {
        assert!(
            scene_error(|s| s.objects[0].on = "shelf-9".to_string()).contains("object `fork-1`: lies on `shelf-9`")
        );
        assert!(scene_error(|s| s.objects[0].forward = 3.0).contains("object `fork-1`: lies beside"));
    }

    #[test]
    fn another_version_is_refused_with_the_one_that_is_read() {
        assert!(scene_error(|s| s.version = 7).contains("version 7 of the format; this program reads version 1"));
    }

    #[test]
    fn a_category_misspelt_says_which_was_meant() {
        let error = scene_error(|s| s.furniture[1].category = "coach".to_string());
        assert!(error.contains("unknown category `coach`; did you mean `couch`?"), "{error}");
    }

    #[test]
    fn a_corner_of_the_room_does_not_poke_into_furniture() {
        let mut map = RoomMap::apartment();
        let l_shape = [[1.57, 1.28], [7.2, 1.28], [7.2, 7.84], [6.0, 7.84], [6.0, 2.5], [1.57, 2.5]];
        map.rooms[1].outline = l_shape.to_vec();
        let mut scene = Scene::apartment();
        scene.furniture.retain(|item| item.id == "couch-1");
        scene.objects.clear();
        (scene.furniture[0].x, scene.furniture[0].y) = (6.2, 2.3);
        (scene.furniture[0].length, scene.furniture[0].yaw_deg) = (Some(0.9), 45.0);
        let error = check(&scene, &map, "home.json").expect_err("a wrong scene").to_string();
        assert!(error.contains("reaches into a wall of `living_room`"), "{error}");
    }

    #[test]
    fn ids_that_stand_twice_or_are_empty_are_refused() {
        assert!(scene_error(|s| s.furniture[1].id = "bed-1".to_string()).contains("furniture `bed-1`: stands twice"));
        assert!(scene_error(|s| s.objects[1].id = " ".to_string()).contains("object: has an empty name"));
    }
}
