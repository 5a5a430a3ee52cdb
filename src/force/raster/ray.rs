//! A ray through the covariogram: its stretches, and the forces along it.
//!
//! The ray is followed column by column along the axis it is closer to. Within
//! a column it crosses at most one line of nodes, so each column is two stretches,
//! the second one often empty: no branches, and eight columns side by side.

use multiversion::multiversion;

use super::super::Force;
use super::correlation::{Counts, Covariogram};
use super::nodes::{Count, Shifts};
use super::stretch::Stretch;

/// Columns worked on at a time.
const BLOCK: usize = 64;
/// Columns side by side in one instruction.
const LANES: usize = 8;
/// Before this column stretches are long for their distance, and integrate in closed form.
const NEAR_COLUMNS: i32 = 6;

/// Stretches in the order of the ray, one array per quantity.
#[derive(Clone, Debug)]
struct Stretches {
    middle: [f64; BLOCK],
    half: [f64; BLOCK],
    q: [[f64; BLOCK]; 3],
}

/// C at the six nodes of each column: three on either side of it.
#[derive(Clone, Debug)]
struct Nodes<T> {
    near: [[T; BLOCK]; 3],
    far: [[T; BLOCK]; 3],
    /// Where the ray enters the column, from the first node's line, 0 to 1.
    entry: [f64; BLOCK],
    /// The place of the first node in the table.
    place: [i64; BLOCK],
}

impl<T: Count> Nodes<T> {
    fn new() -> Self {
        let nothing = [[T::default(); BLOCK]; 3];
        Self { near: nothing, far: nothing, entry: [0.0; BLOCK], place: [0; BLOCK] }
    }
}

/// The way of a ray through the table.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Components of the direction along the closer axis and across it, both positive.
    main: f64,
    cross: f64,
    /// Steps in the table along and across, and the place of the origin.
    main_step: i64,
    cross_step: i64,
    origin: i64,
    /// The columns in which C may differ from zero.
    columns: (i32, i32),
}

impl Way {
    fn new(shifts: &Shifts, sin: f64, cos: f64) -> Self {
        let stride = shifts.stride() as i64;
        let along_x = (cos, 1, (shifts.low.0, shifts.high.0));
        let along_y = (sin, stride, (shifts.low.1, shifts.high.1));
        let (main, cross) = if cos.abs() >= sin.abs() { (along_x, along_y) } else { (along_y, along_x) };
        let forward = |(component, step, (low, high)): (f64, i64, (i32, i32))| {
            if component < 0.0 { (-component, -step, (-high, -low)) } else { (component.abs(), step, (low, high)) }
        };
        let ((main, main_step, reach), (cross, cross_step, side)) = (forward(main), forward(cross));
        let columns = columns(cross / main, reach, side);
        Self { main, cross, main_step, cross_step, origin: shifts.origin(), columns }
    }
}

/// The columns where the ray y = slope·x is within the box, its margin aside.
fn columns(slope: f64, reach: (i32, i32), side: (i32, i32)) -> (i32, i32) {
    if slope <= 0.0 {
        let within = side.0 < 0 && side.1 > 0;
        return if within { (reach.0.max(0), reach.1) } else { (0, 0) };
    }
    let first = (f64::from(side.0.max(0)) / slope).floor();
    let last = (f64::from(side.1.max(0)) / slope).ceil();
    // `as` saturates, which is what is wanted of a nearly level ray.
    let first = if side.0 > 0 { (first as i32).saturating_sub(1) } else { 0 };
    (reach.0.max(0).max(first), reach.1.min(last as i32))
}

/// Sums forces along rays.
#[derive(Debug)]
pub(super) struct Rays {
    forces: Vec<Force>,
    sums: Vec<f64>,
    nodes: (Nodes<i32>, Nodes<i64>),
    stretches: [Stretches; 2],
}

impl Rays {
    /// Rays for forces in units of cells.
    pub(super) fn new(forces: Vec<Force>) -> Self {
        let zeros = [0.0; BLOCK];
        let stretches = || Stretches { middle: [1.0; BLOCK], half: zeros, q: [zeros; 3] };
        Self {
            sums: vec![0.0; forces.len()],
            forces,
            nodes: (Nodes::new(), Nodes::new()),
            stretches: [stretches(), stretches()],
        }
    }

    /// The resultant of each force in one direction, in units of cells.
    pub(super) fn resultants(&mut self, c: &Covariogram, sin: f64, cos: f64) -> impl Iterator<Item = f64> + '_ {
        let way = Way::new(&c.shifts, sin, cos);
        self.sums.fill(0.0);
        let Self { forces, sums, nodes, stretches } = self;
        let mut ray = Ray { forces, sums, stretches, way };
        match &c.table {
            Counts::Narrow(table) => ray.follow(table, &mut nodes.0),
            Counts::Wide(table) => ray.follow(table, &mut nodes.1),
        }
        let unit = c.unit;
        self.sums.iter().map(move |sum| sum * unit)
    }
}

/// One ray, and the sums it adds to.
struct Ray<'r> {
    forces: &'r [Force],
    sums: &'r mut [f64],
    stretches: &'r mut [Stretches; 2],
    way: Way,
}

impl Ray<'_> {
    fn follow<T: Count>(&mut self, table: &[T], nodes: &mut Nodes<T>) {
        let way = self.way;
        let (mut from, end) = way.columns;
        while from < end {
            let to = if from < NEAR_COLUMNS { NEAR_COLUMNS.min(end) } else { (from + BLOCK as i32).min(end) };
            let count = (to - from) as usize;
            enter(way, from, count, nodes);
            read_nodes(table, way, count, nodes);
            cut(nodes, way, from, count, self.stretches);
            if from < NEAR_COLUMNS {
                self.add_near(count)
            } else {
                self.add_far(count)
            }
            from = to;
        }
    }

    fn add_near(&mut self, count: usize) {
        for (force, sum) in self.forces.iter().zip(&mut *self.sums) {
            *sum += one_by_one(self.stretches, count, *force);
        }
    }

    fn add_far(&mut self, count: usize) {
        let (first, last) = (&self.stretches[0], &self.stretches[1]);
        let (begin, end) = (first.middle[0] - first.half[0], last.middle[count - 1] + last.half[count - 1]);
        for (force, sum) in self.forces.iter().zip(&mut *self.sums) {
            *sum += match *force {
                Force::Power(0.0) => constant(self.stretches, count),
                Force::Power(2.0) => gravitational(self.stretches, count),
                Force::Hybrid(y0) if end <= y0 => constant(self.stretches, count) / (y0 * y0),
                Force::Hybrid(y0) if begin >= y0 => gravitational(self.stretches, count),
                other => one_by_one(self.stretches, count, other),
            };
        }
    }
}

fn one_by_one(stretches: &[Stretches; 2], count: usize, force: Force) -> f64 {
    let stretch = |p: &Stretches, i: usize| Stretch { middle: p.middle[i], half: p.half[i], q: p.q.map(|q| q[i]) };
    (0..count).map(|i| stretch(&stretches[0], i).force(force) + stretch(&stretches[1], i).force(force)).sum()
}

/// Where the ray enters the columns from `from` on.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn enter<T>(way: Way, from: i32, count: usize, nodes: &mut Nodes<T>) {
    let slope = way.cross / way.main;
    let (entries, places) = (nodes.entry.as_chunks_mut::<LANES>().0, nodes.place.as_chunks_mut::<LANES>().0);
    for (lane, (entries, places)) in entries.iter_mut().zip(places).take(count.div_ceil(LANES)).enumerate() {
        let first = i64::from(from) + (lane * LANES) as i64;
        for (i, (entry, place)) in entries.iter_mut().zip(places).enumerate() {
            let column = first + i as i64;
            let height = column as f64 * slope;
            let line = height.floor();
            *entry = height - line;
            *place = way.origin + column * way.main_step + line as i64 * way.cross_step;
        }
    }
}

/// Reads C at the nodes about the ray; what is left of the last lanes becomes zero.
fn read_nodes<T: Count>(table: &[T], way: Way, count: usize, nodes: &mut Nodes<T>) {
    let (cross, main) = (way.cross_step as usize, way.main_step as usize);
    let padded = count.next_multiple_of(LANES);
    for k in 0..3 {
        // Steps may be negative: they wrap, and so does the sum.
        let aside = cross.wrapping_mul(k);
        for (i, place) in nodes.place[..count].iter().enumerate() {
            let place = (*place as usize).wrapping_add(aside);
            nodes.near[k][i] = table[place];
            nodes.far[k][i] = table[place.wrapping_add(main)];
        }
        nodes.near[k][count..padded].fill(T::default());
        nodes.far[k][count..padded].fill(T::default());
    }
}

/// Cuts the columns of a block into stretches, before and after the line of nodes that the ray crosses.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn cut<T: Count>(nodes: &Nodes<T>, way: Way, from: i32, count: usize, stretches: &mut [Stretches; 2]) {
    let slope = way.cross / way.main;
    let per_main = 1.0 / way.main;
    let [before, after] = stretches;
    // Whole lanes, so that none is left over to be done one by one.
    for i in 0..count.next_multiple_of(LANES).min(BLOCK) {
        let entry = nodes.entry[i];
        // Where the ray crosses the next line of nodes, as a share of the column.
        let crossing = ((1.0 - entry) / slope).clamp(0.0, 1.0);
        let column = f64::from(from) + i as f64;
        let near = (nodes.near[0][i].value(), nodes.near[1][i].value(), nodes.near[2][i].value());
        let far = (nodes.far[0][i].value(), nodes.far[1][i].value(), nodes.far[2][i].value());
        let (lower, upper) = ([near.0, far.0, near.1, far.1], [near.1, far.1, near.2, far.2]);
        let middle = 0.5 * crossing;
        before.middle[i] = (column + middle) * per_main;
        before.half[i] = middle * per_main;
        let q = quadratic(lower, middle, entry + slope * middle, way.main, way.cross);
        (before.q[0][i], before.q[1][i], before.q[2][i]) = q;
        let middle = 0.5 * (1.0 + crossing);
        after.middle[i] = (column + middle) * per_main;
        after.half[i] = 0.5 * (1.0 - crossing) * per_main;
        let q = quadratic(upper, middle, entry + slope * middle - 1.0, way.main, way.cross);
        (after.q[0][i], after.q[1][i], after.q[2][i]) = q;
    }
}

/// The bilinear function with the given corners, along a direction about the place (x, y).
#[inline(always)]
fn quadratic([c00, c10, c01, c11]: [f64; 4], x: f64, y: f64, main: f64, cross: f64) -> (f64, f64, f64) {
    let (by_x, by_y) = (c10 - c00, c01 - c00);
    let twist = c11 - c10 - by_y;
    let (rise_x, rise_y) = (by_x + twist * y, by_y + twist * x);
    (c00 + rise_x * x + by_y * y, rise_x * main + rise_y * cross, twist * main * cross)
}

type Lanes = [f64; LANES];

impl Stretches {
    /// The first `count` stretches, eight by eight: middles, halves and the coefficients that are asked for.
    #[inline(always)]
    fn lanes<const N: usize>(
        &self,
        count: usize,
        which: [usize; N],
    ) -> impl Iterator<Item = (&Lanes, &Lanes, [&Lanes; N])> {
        let q = which.map(|k| self.q[k].as_chunks().0);
        let (middle, half) = (self.middle.as_chunks().0, self.half.as_chunks().0);
        (0..count.div_ceil(LANES)).map(move |i| (&middle[i], &half[i], q.map(|q| &q[i])))
    }
}

#[inline(always)]
fn add(sums: &mut Lanes, term: impl Fn(usize) -> f64) {
    let terms: Lanes = std::array::from_fn(term);
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn constant(stretches: &[Stretches; 2], count: usize) -> f64 {
    let mut sums = [0.0; LANES];
    for p in stretches {
        for (_, half, [q0, q2]) in p.lanes(count, [0, 2]) {
            add(&mut sums, |i| 2.0 * half[i] * (q0[i] + q2[i] * (half[i] * half[i] * (1.0 / 3.0))));
        }
    }
    sums.iter().sum()
}

/// ∫ C(t)/t² dt over stretches with x = half/middle ≤ 1/12, by the series of its three moments: what is left out is below 1e-13.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn gravitational(stretches: &[Stretches; 2], count: usize) -> f64 {
    let mut sums = [0.0; LANES];
    for p in stretches {
        for (middle, half, [q0, q1, q2]) in p.lanes(count, [0, 1, 2]) {
            add(&mut sums, |i| {
                let inverse = 1.0 / middle[i];
                let x = half[i] * inverse;
                let z = x * x;
                let whole = 1.0 + z * (1.0 + z * (1.0 + z * (1.0 + z * (1.0 + z * (1.0 + z)))));
                let first = z * (2.0 / 3.0 + z * (4.0 / 5.0 + z * (6.0 / 7.0 + z * (8.0 / 9.0 + z * (10.0 / 11.0)))));
                let second = z * (1.0 / 3.0 + z * (3.0 / 5.0 + z * (5.0 / 7.0 + z * (7.0 / 9.0 + z * (9.0 / 11.0)))));
                2.0 * x * (q0[i] * whole * inverse - q1[i] * first + q2[i] * second * middle[i])
            });
        }
    }
    sums.iter().sum()
}
