//! Learning from rendered rooms: the shipped model is made here, bit for bit, by `evaluate train`.
//!
//! Examples are the pieces that our own segmentation makes of noisy frames, not
//! perfect masks: a merged or cut piece is what the classifier will meet.

use std::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use super::{TrainingFrame, TrueItem, frame};
use crate::catalogue::Orientation;
use crate::catalogue::{OBJECTS, Size};
use crate::geometry::{angle_between, wrap_angle};
use crate::perception::detector::{parts, surfaces};
use crate::perception::floor_grid::{FloorGrid, NOWHERE};
use crate::perception::forest::{Example, Forest, Growth};
use crate::perception::front::{facings, hidden_sides};
use crate::perception::joining::Joining;
use crate::perception::measures::measure;
use crate::perception::model::{CATEGORIES, Model, NOTHING};
use crate::perception::parts::Parts;
use crate::perception::patches::NONE;
use crate::perception::points::STRIDE;
use crate::perception::tabletop::things;
use crate::simulation::{Dice, families};

/// A lower thing on a table is part of the table, metres.
const LEAST_OWN_HEIGHT_M: f64 = 0.2;
/// Pieces whose sizes the model remembers, of each category.
const SIZES: usize = 160;

/// How a model is made.
#[derive(Clone, Copy, Debug)]
pub struct Schooling {
    /// Rendered frames.
    pub frames: u64,
    /// Their seed, and that of the forests.
    pub seed: u64,
}

/// Learns a model; the same settings give the same model on any number of cores.
pub fn train(schooling: Schooling) -> Model {
    let Schooling { frames, seed } = schooling;
    let grow = |examples: Vec<Example>, classes, trees, depth, leaf| {
        Forest::grow(&examples, classes, Growth { trees, depth, leaf, seed })
    };
    let of = |from: u64, to: u64, make: &(dyn Fn(&Labelled) -> Vec<(Lesson, Example)> + Sync)| {
        let each = |index: u64| make(&Labelled::new(frame(seed, index)));
        (from..to).into_par_iter().flat_map_iter(each).collect::<Vec<(Lesson, Example)>>()
    };
    let lesson = |examples: &[(Lesson, Example)], wanted: Lesson| -> Vec<Example> {
        examples.iter().filter(|(lesson, _)| *lesson == wanted).map(|(_, example)| example.clone()).collect()
    };
    let pairs = of(0, frames / 2, &joining_examples);
    let joining = grow(lesson(&pairs, Lesson::Joining), 2, 20, 11, 8);
    let pieces = of(0, frames, &|labelled| piece_examples(labelled, &joining));
    let category = grow(lesson(&pieces, Lesson::Category), NOTHING + 1, 80, 16, 3);
    let object = grow(lesson(&pieces, Lesson::Object), OBJECTS.len() + 1, 24, 14, 4);
    // Frames the categories were not learned from, so that their chances are as unsure as in use.
    let fronts = of(frames, frames + frames / 2, &|labelled| front_examples(labelled, &joining, &category));
    let front = grow(lesson(&fronts, Lesson::Front), 2, 24, 12, 6);
    Model { joining, category, front, object, sizes: sizes(seed) }
}

/// What an example teaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lesson {
    Joining,
    Category,
    Front,
    Object,
}

fn sizes(seed: u64) -> Vec<Vec<Size>> {
    let mut dice = Dice::new(seed, 0);
    let mut some = |category: &str| -> Vec<Size> {
        // Lamps stand on the floor or on tables.
        let family = |i: usize| if category == "lamp" && i % 2 == 1 { "table_lamp" } else { category };
        (0..SIZES).filter_map(|i| families::sample(family(i), &mut dice)).map(|piece| rounded(piece.size)).collect()
    };
    CATEGORIES.iter().map(|category| some(category)).collect()
}

/// To the millimetre, as the file keeps it.
fn rounded(size: Size) -> Size {
    let round = |v: f64| (v * 1000.0).round() / 1000.0;
    Size { length: round(size.length), width: round(size.width), height: round(size.height) }
}

/// A training frame whose pixels know which item they are part of.
struct Labelled {
    frame: TrainingFrame,
    /// Item id + 1 of each sampled pixel; small things count as what they lie on.
    pixels: Vec<u16>,
}

impl Labelled {
    fn new(frame: TrainingFrame) -> Self {
        let items: BTreeMap<usize, &TrueItem> = frame.items.iter().map(|item| (item.id, item)).collect();
        let owner = |id: u16| match items.get(&(usize::from(id).wrapping_sub(1))) {
            Some(item) if item.height < LEAST_OWN_HEIGHT_M => item.on_item.map_or(id, |on| on as u16 + 1),
            _ => id,
        };
        let (width, height) = (frame.rgbd.width, frame.rgbd.height);
        let pixels = (0..height)
            .step_by(STRIDE)
            .flat_map(|row| (0..width).step_by(STRIDE).map(move |column| row * width + column))
            .map(|at| owner(frame.ids[at]))
            .collect();
        Self { frame, pixels }
    }

    fn item(&self, id: u16) -> Option<&TrueItem> {
        self.frame.items.iter().find(|item| item.id + 1 == usize::from(id))
    }

    /// The number of the portable object that most of some pixels (of the whole picture) belong to.
    fn object(&self, pixels: &[u32]) -> usize {
        let mut counts = BTreeMap::new();
        pixels.iter().for_each(|at| *counts.entry(self.frame.ids[*at as usize]).or_default() += 1);
        let (id, share) = majority(&counts);
        let item = self.item(id).filter(|_| share > 0.5);
        let number = item.and_then(|item| OBJECTS.iter().position(|object| object.name == item.category));
        number.unwrap_or(OBJECTS.len())
    }

    /// Pixels of each item in each group of cells, and of each item in all.
    fn counts(
        &self,
        grid: &FloorGrid,
        group_of: &[u32],
    ) -> (BTreeMap<u32, BTreeMap<u16, usize>>, BTreeMap<u16, usize>) {
        let (mut groups, mut all) = (BTreeMap::<u32, BTreeMap<u16, usize>>::new(), BTreeMap::new());
        for (&cell, &id) in grid.cell_of.iter().zip(&self.pixels).filter(|(cell, _)| **cell != NOWHERE) {
            *all.entry(id).or_default() += 1;
            if group_of[cell as usize] != NONE {
                *groups.entry(group_of[cell as usize]).or_default().entry(id).or_default() += 1;
            }
        }
        (groups, all)
    }
}

/// The item most pixels of a group belong to, and their share.
fn majority(counts: &BTreeMap<u16, usize>) -> (u16, f64) {
    let all: usize = counts.values().sum();
    let most = counts.iter().max_by_key(|(id, n)| (**n, std::cmp::Reverse(**id)));
    most.map_or((0, 0.0), |(id, n)| (*id, *n as f64 / all as f64))
}

/// Pairs of patches as they stand at the start, half way and at the end of joining them rightly.
fn joining_examples(labelled: &Labelled) -> Vec<(Lesson, Example)> {
    let (_, grid, _, mut joining) = surfaces(&labelled.frame.rgbd, None);
    let mut patch_of = vec![NONE; grid.cells.len()];
    for (number, patch) in (0_u32..).zip(&joining.patches) {
        patch.cells.iter().for_each(|cell| patch_of[*cell as usize] = number);
    }
    let (counts, _) = labelled.counts(&grid, &patch_of);
    let owner: BTreeMap<u32, u16> = counts
        .iter()
        .map(|(patch, ids)| (*patch, majority(ids)))
        .filter(|(_, (_, share))| *share > 0.7)
        .map(|(patch, (id, _))| (patch, id))
        .collect();
    let same = |(a, b): (u32, u32)| Some((owner.get(&a)?, owner.get(&b)?)).map(|(a, b)| a == b && *a > 0);
    let mut examples = Vec::new();
    let mut rng = ChaCha8Rng::seed_from_u64(labelled.frame.pose.x.to_bits());
    for stage in 0..3 {
        if stage == 2 {
            joining.bridge(&grid);
        }
        let pairs = joining.pairs();
        for pair in &pairs {
            if let Some(same) = same(*pair) {
                let example = Example { features: joining.features(*pair), class: usize::from(same), weight: 1.0 };
                examples.push((Lesson::Joining, example));
            }
        }
        join_rightly(&mut joining, &pairs, &same, stage, &mut rng);
    }
    examples
}

/// Joins pairs that are one: half of them at the first stage, then all.
fn join_rightly(
    joining: &mut Joining,
    pairs: &[(u32, u32)],
    same: &dyn Fn((u32, u32)) -> Option<bool>,
    stage: usize,
    rng: &mut ChaCha8Rng,
) {
    for (a, b) in pairs {
        if joining.touches((*a, *b)) && same((*a, *b)) == Some(true) && (stage > 0 || rng.next_u32().is_multiple_of(2))
        {
            joining.join(*a, *b);
        }
    }
}

/// What each piece truly is: the category's number, and the item.
fn truths<'l>(labelled: &'l Labelled, parts: &Parts) -> Vec<(usize, Option<&'l TrueItem>)> {
    let (groups, all) = labelled.counts(&parts.grid, &parts.segments.piece_of);
    let nothing = (NOTHING, None);
    let truth = |piece: u32| {
        let Some(counts) = groups.get(&piece) else { return nothing };
        let (id, share) = majority(counts);
        let Some(item) = labelled.item(id).filter(|_| share > 0.6) else { return nothing };
        let whole = counts[&id] as f64 / all[&id] as f64;
        let known = CATEGORIES.iter().position(|category| *category == item.category);
        known.filter(|_| whole > 0.35).map_or(nothing, |category| (category, Some(item)))
    };
    (0..parts.segments.pieces.len() as u32).map(truth).collect()
}

/// The pieces of a frame, and the things on them.
fn piece_examples(labelled: &Labelled, joining: &Forest) -> Vec<(Lesson, Example)> {
    let parts = parts(&labelled.frame.rgbd, None, joining, None);
    let mut examples = Vec::new();
    let truths = truths(labelled, &parts);
    for (piece, (class, _)) in parts.segments.pieces.iter().zip(truths) {
        let measured = measure(&parts.grid, &parts.walls, piece);
        for thing in things(&labelled.frame.rgbd, &parts.points, piece, measured.measures.plate) {
            let class = labelled.object(&thing.pixels);
            examples.push((Lesson::Object, Example { features: thing.features, class, weight: 1.0 }));
        }
        examples.push((Lesson::Category, Example { features: measured.features, class, weight: 1.0 }));
    }
    examples
}

fn front_examples(labelled: &Labelled, joining: &Forest, category: &Forest) -> Vec<(Lesson, Example)> {
    let parts = parts(&labelled.frame.rgbd, None, joining, None);
    let mut examples = Vec::new();
    let truths = truths(labelled, &parts);
    for ((number, piece), (_, item)) in (0_u32..).zip(&parts.segments.pieces).zip(truths) {
        let Some(item) = item.filter(|item| item.orientation_kind == Orientation::Facing) else { continue };
        let measured = measure(&parts.grid, &parts.walls, piece);
        let chances = category.probabilities(&measured.features);
        let m = &measured.measures;
        let hidden =
            hidden_sides(&parts.grid, &parts.segments, number, &parts.walls, piece.rectangle.pose, m.long, m.short);
        let yaw = wrap_angle(item.yaw - parts.points.camera.heading);
        for facing in facings(&parts.grid, &parts.walls, piece, &measured, hidden, &chances) {
            let right = angle_between(facing.pose.heading, yaw) < std::f64::consts::FRAC_PI_4;
            let example = Example { features: facing.features, class: usize::from(right), weight: 1.0 };
            examples.push((Lesson::Front, example));
        }
    }
    examples
}
