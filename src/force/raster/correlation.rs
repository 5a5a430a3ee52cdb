//! The covariogram C(w) = Σ A(p + w)·B(p) of two images at integer shifts, exactly.
//!
//! The mixed second differences of C are sums over pairs of corners, so that
//! for images with few corners C costs four running sums over the box in which
//! it is not zero. Images with many corners are correlated by Fourier transform
//! and rounded: the sums are integers far below what a float holds.

use super::corners::{Corner, corners};
use super::fourier;
use super::nodes::{Count, Shifts};
use super::{Fuzzy, Raster};

/// What a transform costs per node and octave, in pairs of corners.
const TRANSFORM_COST: f64 = 4.0;

/// A correlation on the nodes of integer shifts, in units of full membership.
#[derive(Clone, Debug)]
pub(super) struct Covariogram {
    /// What a count of one means.
    pub(super) unit: f64,
    pub(super) table: Counts,
    pub(super) shifts: Shifts,
}

/// The counts, as narrow as they fit: memory is what the rays wait for.
#[derive(Clone, Debug)]
pub(super) enum Counts {
    Narrow(Vec<i32>),
    Wide(Vec<i64>),
}

impl Covariogram {
    /// C at an integer shift, in cells.
    pub(super) fn at(&self, x: i32, y: i32) -> f64 {
        if !self.shifts.contains(x, y) {
            return 0.0;
        }
        let index = self.shifts.index(x, y);
        self.unit
            * match &self.table {
                Counts::Narrow(counts) => f64::from(counts[index]),
                Counts::Wide(counts) => counts[index] as f64,
            }
    }

    /// Whether cells of the two touch or overlap.
    pub(super) fn touches(&self) -> bool {
        (-1..=1).any(|y| (-1..=1).any(|x| self.at(x, y) > 0.0))
    }

    /// Cells between the two: C is open where it is positive at one of a square's nodes.
    pub(super) fn distance(&self) -> f64 {
        let mut least = i64::MAX;
        for y in self.shifts.low.1..=self.shifts.high.1 {
            let dy = i64::from(y.abs() - 1).max(0);
            for x in self.shifts.low.0..=self.shifts.high.0 {
                let dx = i64::from(x.abs() - 1).max(0);
                if dx * dx + dy * dy < least && self.at(x, y) > 0.0 {
                    least = dx * dx + dy * dy;
                }
            }
        }
        (least as f64).sqrt()
    }
}

/// One pair of images whose correlation is to be added with a weight.
#[derive(Debug)]
struct Layer {
    weight: i32,
    a: Vec<Corner>,
    b: Vec<Corner>,
}

/// The covariogram of two rasters of one size.
pub(super) fn covariogram(a: &Raster, b: &Raster, fuzzy: Fuzzy) -> Covariogram {
    let crisp = a.full() == 1 && b.full() == 1;
    let (layers, unit) = match fuzzy {
        Fuzzy::Minimum if !crisp => level_layers(a, b),
        _ => (vec![whole_layer(a, b)], 1.0 / (f64::from(a.full()) * f64::from(b.full()))),
    };
    let shifts = shifts_of(&layers);
    let table = match most(&layers, a.levels().len()) {
        most if most <= i64::from(i32::MAX) => Counts::Narrow(count(&layers, shifts)),
        _ => Counts::Wide(count(&layers, shifts)),
    };
    Covariogram { unit, table, shifts }
}

fn whole_layer(a: &Raster, b: &Raster) -> Layer {
    Layer { weight: 1, a: corners(a.levels(), a.size().0), b: corners(b.levels(), b.size().0) }
}

/// One layer for each level that either raster has: the cells of at least that membership.
fn level_layers(a: &Raster, b: &Raster) -> (Vec<Layer>, f64) {
    let (full_a, full_b) = (u32::from(a.full()), u32::from(b.full()));
    // On the scale full_a·full_b both memberships are integers.
    let mut cuts: Vec<u32> = a.levels().iter().map(|l| u32::from(*l) * full_b).collect();
    cuts.extend(b.levels().iter().map(|l| u32::from(*l) * full_a));
    cuts.sort_unstable();
    cuts.dedup();
    let cut = |raster: &Raster, scale: u32, at: u32| -> Vec<Corner> {
        let mask: Vec<u8> = raster.levels().iter().map(|l| u8::from(u32::from(*l) * scale >= at)).collect();
        corners(&mask, raster.size().0)
    };
    let mut below = 0;
    let mut layers = Vec::new();
    for at in cuts.into_iter().filter(|at| *at > 0) {
        layers.push(Layer { weight: (at - below) as i32, a: cut(a, full_b, at), b: cut(b, full_a, at) });
        below = at;
    }
    layers.retain(|layer| !layer.a.is_empty() && !layer.b.is_empty());
    (layers, 1.0 / (f64::from(full_a) * f64::from(full_b)))
}

/// A bound on the counts: all weight on every cell.
fn most(layers: &[Layer], cells: usize) -> i64 {
    let top = |corners: &[Corner]| i64::from(corners.iter().map(|c| c.weight.abs()).max().unwrap_or(0));
    layers.iter().map(|l| i64::from(l.weight) * top(&l.a) * top(&l.b) * cells as i64).sum()
}

fn shifts_of(layers: &[Layer]) -> Shifts {
    let range = |pick: fn(&Layer) -> &[Corner], axis: fn(&Corner) -> i32| {
        let all = layers.iter().flat_map(pick).map(axis);
        all.fold((i32::MAX, i32::MIN), |(low, high), v| (low.min(v), high.max(v)))
    };
    let a = (range(|l| &l.a, |c| c.x), range(|l| &l.a, |c| c.y));
    let b = (range(|l| &l.b, |c| c.x), range(|l| &l.b, |c| c.y));
    if layers.is_empty() {
        return Shifts { low: (0, 0), high: (0, 0) };
    }
    Shifts { low: (a.0.0 - b.0.1, a.1.0 - b.1.1), high: (a.0.1 - b.0.0, a.1.1 - b.1.0) }
}

fn count<T: Count>(layers: &[Layer], shifts: Shifts) -> Vec<T> {
    let mut table = vec![T::default(); shifts.stride() * shifts.rows()];
    let pairs: f64 = layers.iter().map(|l| l.a.len() as f64 * l.b.len() as f64).sum();
    let nodes = table.len() as f64;
    let transforms = (2 * layers.len() + 1) as f64;
    if pairs <= TRANSFORM_COST * transforms * nodes * nodes.log2() / 3.0 {
        for layer in layers {
            add_corner_pairs(layer, shifts, &mut table);
        }
        sum_twice(&mut table, shifts.stride());
    } else {
        // The corners stand for the images: their correlation is C's mixed second difference.
        let stacks = layers.iter().map(|l| (l.weight, l.a.as_slice(), l.b.as_slice()));
        fourier::add_correlation(stacks, shifts, &mut table);
        sum_twice(&mut table, shifts.stride());
    }
    table
}

fn add_corner_pairs<T: Count>(layer: &Layer, shifts: Shifts, table: &mut [T]) {
    let stride = shifts.stride() as i64;
    // The place of a pair is the difference of two places: one subtraction each.
    let place_of = |corner: &Corner| i64::from(corner.y) * stride + i64::from(corner.x);
    let second: Vec<(i64, i64)> = layer.b.iter().map(|c| (place_of(c), i64::from(c.weight))).collect();
    for corner in &layer.a {
        let (place, weight) = (shifts.origin() + place_of(corner), i64::from(corner.weight) * i64::from(layer.weight));
        for (other, other_weight) in &second {
            let node = &mut table[(place - other) as usize];
            *node = node.plus(T::of(weight * other_weight));
        }
    }
}

/// Sums twice along both axes: from second differences to values, each value at the node after its differences.
fn sum_twice<T: Count>(table: &mut [T], stride: usize) {
    let (mut slopes, mut values) = (vec![T::default(); stride], vec![T::default(); stride]);
    for row in table.chunks_exact_mut(stride) {
        let (mut slope, mut value) = (T::default(), T::default());
        for node in row.iter_mut() {
            slope = slope.plus(*node);
            *node = value;
            value = value.plus(slope);
        }
        for ((node, slope), value) in row.iter_mut().zip(&mut slopes).zip(&mut values) {
            *slope = slope.plus(*node);
            *node = *value;
            *value = value.plus(*slope);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direct(a: &Raster, b: &Raster, x: i32, y: i32, combine: fn(f64, f64) -> f64) -> f64 {
        let (width, height) = a.size();
        let mut sum = 0.0;
        for row in 0..height as i32 {
            for column in 0..width as i32 {
                let (c, r) = (column + x, row - y);
                if (0..width as i32).contains(&c) && (0..height as i32).contains(&r) {
                    sum += combine(a.membership(c as usize, r as usize), b.membership(column as usize, row as usize));
                }
            }
        }
        sum
    }

    #[test]
    fn corner_sums_give_the_correlation_for_crisp_and_both_kinds_of_fuzzy() {
        let a = Raster::from_rows(&["..3#.", ".59#.", ".#...", "....."], 1.0).expect("a grid");
        let b = Raster::from_rows(&[".....", "#1...", "##..7", ".2..#"], 1.0).expect("a grid");
        for (fuzzy, combine) in [(Fuzzy::Product, (|p, q| p * q) as fn(f64, f64) -> f64), (Fuzzy::Minimum, f64::min)] {
            let covariogram = covariogram(&a, &b, fuzzy);
            for y in -4..=4 {
                for x in -5..=5 {
                    let want = direct(&a, &b, x, y, combine);
                    assert!((covariogram.at(x, y) - want).abs() < 1e-12, "{fuzzy:?} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn the_distance_is_between_the_nearest_cell_borders() {
        let a = Raster::from_rows(&["#....", ".....", "....."], 1.0).expect("a grid");
        let b = Raster::from_rows(&[".....", ".....", "...#."], 1.0).expect("a grid");
        assert_eq!(covariogram(&a, &b, Fuzzy::Product).distance(), 5.0_f64.sqrt());
    }
}
