//! Patches joined into pieces: a couch is a seat, a back and arms; a table and the chair at it are two.

use std::collections::BTreeMap;

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
    /// Contacts of pairs, the lower number first.
    pub contacts: BTreeMap<(u32, u32), Contact>,
}

impl Joining {
    /// The contacts of patches on the grid; crumbs are joined at once.
    pub fn new(grid: &FloorGrid, patches: Vec<Patch>, patch_of: &[u32]) -> Self {
        let mut joining = Self { contacts: contacts(grid, &patches, patch_of), patches };
        let crumbs: Vec<u32> = (0..joining.patches.len() as u32)
            .filter(|p| joining.patches[*p as usize].cells.len() < CRUMB_CELLS)
            .collect();
        for crumb in crumbs {
            let most = joining.neighbours(crumb).max_by(|a, b| a.1.count.total_cmp(&b.1.count)).map(|(n, _)| n);
            if let Some(other) = most {
                joining.join(other, crumb);
            }
        }
        joining
    }

    fn neighbours(&self, patch: u32) -> impl Iterator<Item = (u32, Contact)> + '_ {
        let touches = self.contacts.iter().filter(move |((a, b), _)| *a == patch || *b == patch);
        touches.map(move |((a, b), contact)| (if *a == patch { *b } else { *a }, *contact))
    }

    /// Joins `gone` to `kept`.
    pub fn join(&mut self, kept: u32, gone: u32) {
        let cells = std::mem::take(&mut self.patches[gone as usize]);
        let patch = &mut self.patches[kept as usize];
        patch.cells.extend(cells.cells);
        patch.sums = patch.sums.joined(&cells.sums);
        let moved: Vec<(u32, Contact)> = self.neighbours(gone).collect();
        self.contacts.retain(|(a, b), _| *a != gone && *b != gone);
        for (other, contact) in moved.into_iter().filter(|(other, _)| *other != kept) {
            let entry = self.contacts.entry(ordered(kept, other)).or_default();
            let touched = entry.count > 0.0 || contact.count > 0.0;
            entry.count += contact.count;
            entry.steps += contact.steps;
            entry.gap = if touched { 0.0 } else { entry.gap.min(contact.gap) };
            entry.hidden = entry.hidden.max(contact.hidden);
        }
    }

    /// Joins the likeliest pair until no pair is likely to be one piece.
    pub fn run(&mut self, forest: &Forest) {
        let likely = |joining: &Self, pair: (u32, u32)| forest.probabilities(&joining.features(pair))[1];
        let mut chances: BTreeMap<(u32, u32), f32> =
            self.contacts.keys().map(|pair| (*pair, likely(self, *pair))).collect();
        loop {
            let best = chances.iter().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0)));
            let Some((&(kept, gone), _)) = best.filter(|(_, chance)| **chance > 0.5) else { break };
            self.join(kept, gone);
            chances.retain(|(a, b), _| *a != gone && *b != gone);
            let again: Vec<u32> = self.neighbours(kept).map(|(other, _)| other).collect();
            for other in again {
                let pair = ordered(kept, other);
                chances.insert(pair, likely(self, pair));
            }
        }
    }

    /// Adds the pairs that do not touch but may be one piece behind something.
    pub fn bridge(&mut self, grid: &FloorGrid) {
        let whole: Vec<u32> =
            (0..self.patches.len() as u32).filter(|p| self.patches[*p as usize].sums.area() > LEAST_AREA_M2).collect();
        let sample = |p: &u32| -> Vec<Vec2> {
            let cells = &self.patches[*p as usize].cells;
            cells.iter().step_by(1 + cells.len() / 40).map(|c| grid.centre(*c as usize)).collect()
        };
        let samples: Vec<Vec<Vec2>> = whole.iter().map(sample).collect();
        let mut bridges = Vec::new();
        for i in 0..whole.len() {
            for j in i + 1..whole.len() {
                let pair = ordered(whole[i], whole[j]);
                if !self.contacts.contains_key(&pair)
                    && let Some(contact) = gap(grid, &samples[i], &samples[j])
                {
                    bridges.push((pair, contact));
                }
            }
        }
        self.contacts.extend(bridges);
    }

    /// What tells whether a pair is one piece; the higher patch first.
    pub fn features(&self, (a, b): (u32, u32)) -> Vec<f32> {
        let contact = self.contacts.get(&ordered(a, b)).copied().unwrap_or_default();
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

fn contacts(grid: &FloorGrid, patches: &[Patch], patch_of: &[u32]) -> BTreeMap<(u32, u32), Contact> {
    let mut contacts: BTreeMap<(u32, u32), Contact> = BTreeMap::new();
    for (number, patch) in (0_u32..).zip(patches) {
        for &cell in &patch.cells {
            let index = cell as usize;
            for next in grid.around(index, reach(grid.centre(index))).filter(|next| *next > index) {
                if patch_of[next] != NONE && patch_of[next] != number {
                    let contact = contacts.entry(ordered(number, patch_of[next])).or_default();
                    contact.count += 1.0;
                    contact.steps += f64::from((grid.cells[index].top - grid.cells[next].top).abs());
                }
            }
        }
    }
    contacts
}

/// The gap between two pieces, when it is narrow.
fn gap(grid: &FloorGrid, a: &[Vec2], b: &[Vec2]) -> Option<Contact> {
    let pairs = a.iter().flat_map(|p| b.iter().map(move |q| (*p, *q)));
    let (p, q) = pairs.min_by(|x, y| (x.0 - x.1).norm_squared().total_cmp(&(y.0 - y.1).norm_squared()))?;
    let gap = (p - q).norm();
    let hidden = (1..6).filter(|i| !grid.shows_floor(between(p, q, f64::from(*i) / 6.0))).count();
    (gap < GAP_M).then_some(Contact { count: 0.0, steps: 0.0, gap, hidden: hidden as f64 / 5.0 })
}
