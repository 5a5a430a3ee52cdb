//! From one RGB-D frame to what is in it.

use std::sync::Arc;

use super::describe::describe;
use super::floor_grid::FloorGrid;
use super::footprint::Footprint;
use super::forest::Forest;
use super::front::{Facing, Hidden, facings, hidden_sides};
use super::items::parts_of_items;
use super::joining::Joining;
use super::measures::{Measured, measure};
use super::model::{CATEGORIES, Model, NOTHING};
use super::objects::{may_hold, sightings};
use super::parts::{Parts, room};
use super::patches::patches;
use super::points::Points;
use super::reconsider::reconsider;
use super::segment::{Segment, segments};
use super::tabletop::things;
use super::walls::{Wall, furniture_cells};
use super::{ObjectSighting, View};
use crate::catalogue::OBJECTS;
use crate::catalogue::{self, Orientation};
use crate::frame::RgbdFrame;
use crate::geometry::{Polygon, Pose, wrap_angle};
use crate::map::RoomMap;
use crate::record::Detection;

/// Two sightings of one name nearer than this are of one object, metres.
const SAME_M: f64 = 0.15;
/// What is likelier no furniture than this is left out.
const MOST_NOTHING: f32 = 0.85;
/// An object is named only when its name is at least this likely.
const LEAST_NAME: f32 = 0.35;
/// On pieces less likely tables or chests nothing is looked for: on beds and seats cushions would pass for things.
const LEAST_HOLDER: f32 = 0.03;
/// The training rooms show so much more clutter on tops – edges, shades, patterns – than a top has objects.
const CLUTTER: f32 = 0.08;

/// Finds furniture and small objects in frames.
#[derive(Clone, Debug)]
pub struct Detector {
    model: Arc<Model>,
}

impl Default for Detector {
    fn default() -> Self {
        Self { model: Model::shipped() }
    }
}

/// A frame as far as it can be read without a model.
pub(crate) fn surfaces(frame: &RgbdFrame, map: Option<&RoomMap>) -> (Points, FloorGrid, Vec<Wall>, Joining) {
    let (points, grid, walls) = room(frame, map);
    let (patches, patch_of) = patches(&grid, &furniture_cells(&grid, &walls));
    let joining = Joining::new(&grid, patches, &patch_of);
    (points, grid, walls, joining)
}

/// Takes a frame apart into pieces; with a classifier pieces that only together look like something are joined too.
pub(crate) fn parts(frame: &RgbdFrame, map: Option<&RoomMap>, joins: &Forest, category: Option<&Forest>) -> Parts {
    let (points, grid, walls, mut joining) = surfaces(frame, map);
    joining.run(joins);
    joining.bridge(&grid);
    joining.run(joins);
    if let Some(category) = category {
        reconsider(&mut joining, (&grid, &points, &walls), (joins, category));
    }
    let groups = joining.patches.into_iter().map(|patch| (patch.cells, patch.sums)).collect();
    let segments = segments(&grid, &points, groups);
    Parts { points, grid, walls, segments }
}

impl Detector {
    /// A detector with a model of one's own.
    pub fn new(model: Model) -> Self {
        Self { model: Arc::new(model) }
    }

    /// What one frame shows, in the frame's world; `map` tells which surfaces are walls.
    pub fn detect(&self, frame: &RgbdFrame, map: Option<&RoomMap>) -> View {
        self.view(frame, &parts(frame, map, &self.model.joining, Some(&self.model.category)))
    }

    /// The same of a frame of which each pixel's item is known, 0 for none.
    pub fn detect_items(&self, frame: &RgbdFrame, map: Option<&RoomMap>, item_of: &[u16]) -> View {
        self.view(frame, &parts_of_items(frame, map, item_of))
    }

    fn view(&self, frame: &RgbdFrame, parts: &Parts) -> View {
        let (mut furniture, mut objects) = (Vec::new(), Vec::new());
        for (number, piece) in (0_u32..).zip(&parts.segments.pieces) {
            let measured = measure(&parts.grid, &parts.walls, piece);
            let chances = self.model.category.probabilities(&measured.features);
            if holder_chance(&chances) > LEAST_HOLDER {
                objects.extend(self.objects(frame, parts, piece, measured.measures.plate));
            }
            furniture.extend(self.piece(parts, (number, piece), &measured, &chances));
        }
        let furniture: Vec<Detection> = without_doubles(furniture).into_iter().map(rounded).collect();
        // Two witnesses: what was learned misses tall thin things, the usual measures miss small ones of odd colour.
        for sighting in sightings(frame, &furniture) {
            let known = |other: &ObjectSighting| other.name == sighting.name && other.distance_to(&sighting) < SAME_M;
            match objects.iter_mut().find(|other| known(other)) {
                Some(other) => other.recognisable |= sighting.recognisable,
                None => objects.push(sighting),
            }
        }
        View { furniture, objects }
    }

    /// The portable objects on a piece.
    fn objects(&self, frame: &RgbdFrame, parts: &Parts, piece: &Segment, plate: f64) -> Vec<ObjectSighting> {
        let things = things(frame, &parts.points, piece, plate).into_iter();
        let named = things.filter_map(|thing| {
            let chances = self.model.object.probabilities(&thing.features);
            let best = (0..OBJECTS.len()).fold(0, |best, i| if chances[i] > chances[best] { i } else { best });
            let place = parts.points.camera.to_world(thing.place);
            let none = chances[OBJECTS.len()] * CLUTTER;
            let objects: f32 = chances[..OBJECTS.len()].iter().sum();
            let sure = !thing.is_flank && chances[best] / (objects + none) > LEAST_NAME;
            sure.then(|| ObjectSighting {
                name: OBJECTS[best].name.to_string(),
                x: place.x,
                y: place.y,
                recognisable: thing.recognisable,
            })
        });
        named.collect()
    }

    fn piece(
        &self,
        parts: &Parts,
        (number, segment): (u32, &Segment),
        measured: &Measured,
        chances: &[f32],
    ) -> Option<Detection> {
        if chances[NOTHING] > MOST_NOTHING {
            return None;
        }
        let best = (0..NOTHING).fold(0, |best, i| if chances[i] > chances[best] { i } else { best });
        let r = segment.rectangle;
        let (length, width) = (measured.measures.long, measured.measures.short);
        let hidden = hidden_sides(&parts.grid, &parts.segments, number, &parts.walls, r.pose, length, width);
        let facings = facings(&parts.grid, &parts.walls, segment, measured, hidden, chances);
        let quarter = self.front(&facings, CATEGORIES[best]);
        let facing = &facings[quarter];
        let turned: Hidden = [0, 1, 2, 3].map(|side| hidden[(side + quarter) % 4]);
        let seen = Footprint { pose: facing.pose, length: facing.length, width: facing.width };
        let whole = seen.completed(turned, measured.measures.height, &self.model.sizes[best], &parts.walls);
        Some(detection(measured, whole, chances, best, parts.points.camera))
    }

    /// The quarter turn from the rectangle's heading to the front.
    fn front(&self, facings: &[Facing; 4], category: &str) -> usize {
        // A table's heading is that of its long side: it ends at the short edge.
        if catalogue::category(category).is_none_or(|row| row.orientation != Orientation::Facing) {
            return 0;
        }
        let chance = |i: &usize| self.model.front.probabilities(&facings[*i].features)[1];
        (0..4).max_by(|a, b| chance(a).total_cmp(&chance(b)).then(b.cmp(a))).unwrap_or(0)
    }
}

/// How likely a piece is one on which things are looked for.
fn holder_chance(chances: &[f32]) -> f32 {
    CATEGORIES.iter().zip(chances).filter(|(category, _)| may_hold(category)).map(|(_, chance)| chance).sum()
}

fn detection(measured: &Measured, whole: Footprint, chances: &[f32], best: usize, camera: Pose) -> Detection {
    let place = camera.to_world(whole.pose.position());
    let pose = Pose { heading: wrap_angle(camera.heading + whole.pose.heading), ..Pose::new(place.x, place.y, 0.0) };
    let certain = 1.0 - chances[NOTHING];
    let category = CATEGORIES[best];
    let score = |i: usize| f64::from(chances[i] / certain);
    let likely = (0..NOTHING).filter(|i| score(*i) >= 0.02);
    let (attributes, why) = describe(measured, category, &whole);
    Detection {
        category: category.to_string(),
        confidence: f64::from(chances[best]),
        scores: likely.map(|i| (CATEGORIES[i].to_string(), score(i))).collect(),
        x: pose.x,
        y: pose.y,
        yaw: catalogue::category(category)
            .is_some_and(|row| row.orientation != Orientation::None)
            .then_some(pose.heading),
        length: whole.length,
        width: whole.width,
        height: measured.measures.height,
        footprint: Polygon::rectangle(pose, whole.length, whole.width).corners().iter().map(|c| [c.x, c.y]).collect(),
        attributes,
        why,
    }
}

/// How sure the eyes are that it is furniture at all: the category's chance among all over that among furniture; sure
/// when no scores tell.
pub fn furniture_chance(detection: &Detection) -> f64 {
    detection.scores.get(&detection.category).map_or(1.0, |score| detection.confidence / score.max(1e-9))
}

/// Of two that stand in the same place, the surer.
fn without_doubles(mut found: Vec<Detection>) -> Vec<Detection> {
    found.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    let mut kept: Vec<Detection> = Vec::new();
    for detection in found {
        if !kept.iter().any(|other| overlap(other, &detection) > 0.5) {
            kept.push(detection);
        }
    }
    kept
}

/// Intersection over union of two footprints.
pub fn overlap(a: &Detection, b: &Detection) -> f64 {
    let polygon = |d: &Detection| Polygon::new(d.footprint.iter().map(|c| crate::geometry::vec2(c[0], c[1])).collect());
    polygon(a).overlap(&polygon(b))
}

/// Detections are written to a tenth of a millimetre.
pub(crate) fn rounded(mut detection: Detection) -> Detection {
    let four = |v: f64| crate::record::Rounded(v).value();
    for value in
        [&mut detection.x, &mut detection.y, &mut detection.length, &mut detection.width, &mut detection.height]
    {
        *value = four(*value);
    }
    detection.yaw = detection.yaw.map(four);
    detection.confidence = four(detection.confidence);
    detection.scores.values_mut().for_each(|value| *value = four(*value));
    detection.footprint.iter_mut().flatten().for_each(|value| *value = four(*value));
    detection
}
