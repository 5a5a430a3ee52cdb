//! Patches joined into pieces: a couch is a seat, a back and arms; a table and the chair at it are two.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::floor_grid::{CELL_M, FloorGrid};
use super::forest::Forest;
use super::patches::{NONE, Patch, Sums, between, reach};
use crate::geometry::Vec2;

/// Patches of fewer cells are joined to the neighbour they touch most.
const CRUMB_CELLS: usize = 6;
/// Pieces cut apart by something before them are joined over at most this, metres.
const GAP_M: f64 = 0.6;
/// Smaller pieces are not joined over a gap, square metres.
const LEAST_AREA_M2: f64 = 0.012;

/// How two patches touch, or how they are apart.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact {
    /// Pairs of neighbouring cells.
    pub count: f64,
    /// The sum of their differences in height, metres.
    pub steps: f64,
    /// Metres between the two; 0 when they touch.
    pub gap: f64,
    /// Share of the way between them where no floor was seen.
    pub hidden: f64,
}

/// Patches and their contacts, joined step by step.
#[derive(Clone, Debug)]
pub struct Joining {
    /// The patches; those that were joined to others are empty.
    pub patches: Vec<Patch>,
    /// Of each patch the others it touches; every contact stands with both.
    contacts: Vec<BTreeMap<u32, Contact>>,
    /// How often each patch has changed.
    changes: Vec<u32>,
}

/// A pair that may be joined, as both stood when its chance was told.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    chance: f32,
    pair: (u32, u32),
    changes: (u32, u32),
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.chance.total_cmp(&other.chance).then(other.pair.cmp(&self.pair)).then(self.changes.cmp(&other.changes))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Joining {
    /// The contacts of patches on the grid; crumbs are joined at once.
    pub fn new(grid: &FloorGrid, patches: Vec<Patch>, patch_of: &[u32]) -> Self {
        let contacts = contacts(grid, &patches, patch_of);
        let mut joining = Self { contacts, changes: vec![0; patches.len()], patches };
        let is_crumb = |p: &u32| joining.patches[*p as usize].cells.len() < CRUMB_CELLS;
        let crumbs: Vec<u32> = (0..joining.patches.len() as u32).filter(is_crumb).collect();
        for crumb in crumbs {
            let touched = joining.contacts[crumb as usize].iter();
            let most = touched.max_by(|a, b| a.1.count.total_cmp(&b.1.count)).map(|(other, _)| *other);
            if let Some(other) = most {
                joining.join(other, crumb);
            }
        }
        joining
    }

    /// All pairs that touch, the lower number first, in order.
    pub fn pairs(&self) -> Vec<(u32, u32)> {
        let of = |(a, others): (u32, &BTreeMap<u32, Contact>)| {
            others.keys().filter(move |b| a < **b).map(move |b| (a, *b)).collect::<Vec<_>>()
        };
        (0_u32..).zip(&self.contacts).flat_map(of).collect()
    }

    /// Whether a pair still touches.
    pub fn touches(&self, (a, b): (u32, u32)) -> bool {
        self.contacts[a as usize].contains_key(&b)
    }

    /// Joins `gone` to `kept`.
    pub fn join(&mut self, kept: u32, gone: u32) {
        let cells = std::mem::take(&mut self.patches[gone as usize]);
        let patch = &mut self.patches[kept as usize];
        patch.cells.extend(cells.cells);
        patch.sums = patch.sums.joined(&cells.sums);
        self.changes[kept as usize] += 1;
        self.changes[gone as usize] += 1;
        for (other, contact) in std::mem::take(&mut self.contacts[gone as usize]) {
            self.contacts[other as usize].remove(&gone);
            if other == kept {
                continue;
            }
            let known = self.contacts[kept as usize].get(&other);
            let both = known.map_or(contact, |known| known.and(&contact));
            self.contacts[kept as usize].insert(other, both);
            self.contacts[other as usize].insert(kept, both);
        }
    }

    /// Joins the likeliest pair until no pair is likely to be one piece.
    pub fn run(&mut self, forest: &Forest) {
        let mut waiting: BinaryHeap<Candidate> =
            self.pairs().into_iter().filter_map(|pair| self.candidate(forest, pair)).collect();
        while let Some(best) = waiting.pop() {
            let (kept, gone) = best.pair;
            if best.changes != (self.changes[kept as usize], self.changes[gone as usize]) {
                continue;
            }
            self.join(kept, gone);
            let others: Vec<u32> = self.contacts[kept as usize].keys().copied().collect();
            waiting.extend(others.into_iter().filter_map(|other| self.candidate(forest, ordered(kept, other))));
        }
    }

    /// A pair that is likelier one piece than two.
    fn candidate(&self, forest: &Forest, pair: (u32, u32)) -> Option<Candidate> {
        let chance = forest.probabilities(&self.features(pair))[1];
        let changes = (self.changes[pair.0 as usize], self.changes[pair.1 as usize]);
        (chance > 0.5).then_some(Candidate { chance, pair, changes })
    }

    /// Adds the pairs that do not touch but may be one piece behind something.
    pub fn bridge(&mut self, grid: &FloorGrid) {
        let whole: Vec<u32> =
            (0..self.patches.len() as u32).filter(|p| self.patches[*p as usize].sums.area() > LEAST_AREA_M2).collect();
        let sample = |p: &u32| {
            let cells = &self.patches[*p as usize].cells;
            Sample::of(cells.iter().step_by(1 + cells.len() / 40).map(|c| grid.centre(*c as usize)).collect())
        };
        let samples: Vec<Sample> = whole.iter().map(sample).collect();
        let mut bridges = Vec::new();
        for i in 0..whole.len() {
            for j in i + 1..whole.len() {
                let pair = ordered(whole[i], whole[j]);
                if !self.touches(pair)
                    && let Some(contact) = gap(grid, &samples[i], &samples[j])
                {
                    bridges.push((pair, contact));
                }
            }
        }
        for ((a, b), contact) in bridges {
            self.contacts[a as usize].insert(b, contact);
            self.contacts[b as usize].insert(a, contact);
        }
    }

    /// What tells whether a pair is one piece; the higher patch first.
    pub fn features(&self, (a, b): (u32, u32)) -> Vec<f32> {
        let contact = self.contacts[a as usize].get(&b).copied().unwrap_or_default();
        let (a, b) = (&self.patches[a as usize].sums, &self.patches[b as usize].sums);
        let (high, low) = if a.top().0 >= b.top().0 { (a, b) } else { (b, a) };
        let both = high.joined(low);
        let ((high_top, high_spread), (low_top, low_spread)) = (high.top(), low.top());
        let (h, l, u) = (high.sides(), low.sides(), both.sides());
        let fill = |s: &Sums, sides: (f64, f64)| s.area() / (sides.0 * sides.1);
        let filled = |s: &Sums| s.filled[0] / s.filled[1].max(1.0);
        let (ch, cl) = (high.color(), low.color());
        let bright = |c: [f64; 3]| c.iter().sum::<f64>() / 3.0;
        let hue = (0..3).map(|i| (ch[i] - bright(ch) - cl[i] + bright(cl)).abs()).sum::<f64>();
        let length = contact.count.sqrt() * CELL_M;
        let values = [
            high_top,
            low_top,
            high_top - low_top,
            contact.count * CELL_M * 0.1,
            length / high.area().min(low.area()).sqrt(),
            high.area(),
            low.area(),
            h.0,
            h.1,
            l.0,
            l.1,
            u.0,
            u.1,
            fill(high, h),
            fill(low, l),
            fill(&both, u),
            filled(high),
            filled(low),
            high_spread,
            low_spread,
            hue,
            (bright(ch) - bright(cl)).abs(),
            both.middle().norm(),
            (high.middle() - low.middle()).norm(),
            high.middle().norm() - low.middle().norm(),
            contact.steps / contact.count.max(1.0),
            contact.gap,
            contact.hidden,
        ];
        values.map(|value| value as f32).to_vec()
    }
}

/// A pair with the lower number first.
pub fn ordered(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

impl Contact {
    /// The contact of a patch with two that become one.
    fn and(&self, other: &Self) -> Self {
        let touched = self.count > 0.0 || other.count > 0.0;
        Self {
            count: self.count + other.count,
            steps: self.steps + other.steps,
            gap: if touched { 0.0 } else { self.gap.min(other.gap) },
            hidden: self.hidden.max(other.hidden),
        }
    }
}

fn contacts(grid: &FloorGrid, patches: &[Patch], patch_of: &[u32]) -> Vec<BTreeMap<u32, Contact>> {
    let mut contacts: Vec<BTreeMap<u32, Contact>> = vec![BTreeMap::new(); patches.len()];
    for (number, patch) in (0_u32..).zip(patches) {
        for &cell in &patch.cells {
            let index = cell as usize;
            for next in grid.around(index, reach(grid.centre(index))).filter(|next| *next > index) {
                let other = patch_of[next];
                if other != NONE && other != number {
                    let step = f64::from((grid.cells[index].top - grid.cells[next].top).abs());
                    let contact = contacts[number.min(other) as usize].entry(number.max(other)).or_default();
                    contact.count += 1.0;
                    contact.steps += step;
                }
            }
        }
    }
    for number in 0..contacts.len() {
        for (other, contact) in contacts[number].clone().into_iter().filter(|(other, _)| *other as usize > number) {
            contacts[other as usize].insert(number as u32, contact);
        }
    }
    contacts
}

/// The gap between two pieces, when it is narrow.
fn gap(grid: &FloorGrid, a: &Sample, b: &Sample) -> Option<Contact> {
    if a.least_gap(b) > GAP_M {
        return None;
    }
    let mut closest = (f64::INFINITY, Vec2::zeros(), Vec2::zeros());
    for &p in &a.places {
        for &q in &b.places {
            let squared = (p - q).norm_squared();
            if squared < closest.0 {
                closest = (squared, p, q);
            }
        }
    }
    let (_, p, q) = closest;
    let gap = (p - q).norm();
    if a.places.is_empty() || b.places.is_empty() || gap >= GAP_M {
        return None;
    }
    let hidden = (1..6).filter(|i| !grid.shows_floor(between(p, q, f64::from(*i) / 6.0))).count();
    Some(Contact { count: 0.0, steps: 0.0, gap, hidden: hidden as f64 / 5.0 })
}

/// Some places of a piece, and the rectangle round them along the axes.
struct Sample {
    places: Vec<Vec2>,
    low: Vec2,
    high: Vec2,
}

impl Sample {
    fn of(places: Vec<Vec2>) -> Self {
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let (low, high) = places.iter().fold(start, |(low, high), place| (low.inf(place), high.sup(place)));
        Self { places, low, high }
    }

    /// No two places of both are nearer than this, metres.
    fn least_gap(&self, other: &Self) -> f64 {
        (self.low - other.high).max().max((other.low - self.high).max())
    }
}
