//! A second opinion on pieces that were kept apart: the seat and the back of a chair with air between them.
//!
//! Joining looks at a pair's shapes only. Here a pair that was nearly joined is
//! also named: it becomes one when together it looks more like some furniture
//! than its two parts do.

use super::floor_grid::FloorGrid;
use super::forest::Forest;
use super::joining::Joining;
use super::measures::measure;
use super::model::NOTHING;
use super::patches::{NONE, Patch};
use super::points::Points;
use super::segment::{LEAST_CELLS, Pixels, group_pixels, segment};
use super::walls::Wall;

/// Pairs less likely one piece than this are not looked at again.
const LEAST_CHANCE: f32 = 0.2;
/// What the whole must gain in likeness over its parts, by area, and may lose to the better part.
const GAIN: f32 = 0.08;
const LOSS: f32 = 0.0;

/// Joins the pairs that are likelier furniture together.
pub fn reconsider(
    joining: &mut Joining,
    (grid, points, walls): (&FloorGrid, &Points, &[Wall]),
    (joins, category): (&Forest, &Forest),
) {
    let large = |patch: u32| joining.patches[patch as usize].cells.len() >= LEAST_CELLS;
    let pairs = joining.pairs().into_iter().filter(|(a, b)| large(*a) && large(*b));
    let chances = pairs.map(|pair| (joins.probabilities(&joining.features(pair))[1], pair));
    let mut doubtful: Vec<(f32, (u32, u32))> = chances.filter(|(chance, _)| *chance > LEAST_CHANCE).collect();
    if doubtful.is_empty() {
        return;
    }
    doubtful.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut opinion = Opinion::new(&joining.patches, grid, points, walls, category);
    for (_, (kept, gone)) in doubtful {
        let (a, b) = (&joining.patches[kept as usize], &joining.patches[gone as usize]);
        if !a.cells.is_empty() && !b.cells.is_empty() && opinion.prefers_one((kept, a), (gone, b)) {
            opinion.joined(kept, gone, b);
            joining.join(kept, gone);
        }
    }
}

/// What pieces look like, as far as it was asked for.
struct Opinion<'a> {
    grid: &'a FloorGrid,
    walls: &'a [Wall],
    category: &'a Forest,
    group_of: Vec<u32>,
    pixels: Vec<Pixels>,
    likeness: Vec<Option<f32>>,
}

impl<'a> Opinion<'a> {
    fn new(patches: &[Patch], grid: &'a FloorGrid, points: &Points, walls: &'a [Wall], category: &'a Forest) -> Self {
        let mut group_of = vec![NONE; grid.cells.len()];
        for (number, patch) in (0_u32..).zip(patches) {
            patch.cells.iter().for_each(|cell| group_of[*cell as usize] = number);
        }
        let pixels = group_pixels(grid, points, &group_of, patches.len());
        Self { grid, walls, category, group_of, pixels, likeness: vec![None; patches.len()] }
    }

    fn prefers_one(&mut self, (a, one): (u32, &Patch), (b, other): (u32, &Patch)) -> bool {
        let [p, q] = [(a, one), (b, other)].map(|(number, patch)| self.likeness_of(number, patch));
        let both = Patch { cells: [&one.cells[..], &other.cells].concat(), sums: one.sums.joined(&other.sums) };
        let whole = self.likeness(&both, self.pixels[a as usize].joined(&self.pixels[b as usize]), &[a, b]);
        let (m, n) = (one.cells.len() as f32, other.cells.len() as f32);
        let better = whole > (m * p + n * q) / (m + n) + GAIN && whole > p.max(q) - LOSS;
        if better {
            self.likeness[a as usize] = Some(whole);
        }
        better
    }

    fn joined(&mut self, kept: u32, gone: u32, patch: &Patch) {
        patch.cells.iter().for_each(|cell| self.group_of[*cell as usize] = kept);
        self.pixels[kept as usize] = self.pixels[kept as usize].joined(&self.pixels[gone as usize]);
    }

    fn likeness_of(&mut self, number: u32, patch: &Patch) -> f32 {
        let at = number as usize;
        let known = self.likeness[at].unwrap_or_else(|| self.likeness(patch, self.pixels[at], &[number]));
        self.likeness[at] = Some(known);
        known
    }

    /// How much a piece looks like the furniture it looks most like; zero for what is too small or too low.
    fn likeness(&self, patch: &Patch, pixels: Pixels, groups: &[u32]) -> f32 {
        let mut cells = patch.cells.clone();
        cells.sort_unstable();
        let is_own = |cell: usize| self.group_of.get(cell).is_some_and(|group| groups.contains(group));
        let Some(piece) = segment(self.grid, is_own, &cells, patch.sums, pixels) else { return 0.0 };
        let chances = self.category.probabilities(&measure(self.grid, self.walls, &piece).features);
        chances[..NOTHING].iter().copied().fold(0.0, f32::max)
    }
}
