//! The sums of one direction and its opposite, one for each force.

use super::super::Force;
use super::super::kernel::Kernel;
use super::pairs::Pairs;

/// Widest range of gaps, as a share of their mean, for which the far form of the logarithm is exact.
const FAR: f64 = 0.1;

/// The range of gaps one direction may show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gaps {
    least: f64,
    greatest: f64,
}

impl Gaps {
    /// `least` is negative where the objects overlap along the direction, or stand the other way round.
    pub(super) fn new(least: f64, greatest: f64) -> Self {
        Self { least, greatest }
    }

    /// The middle of the open gaps, about which the tangent of G is taken away.
    fn middle(self) -> f64 {
        (self.least.max(0.0) + self.greatest) / 2.0
    }

    /// Whether A lies wholly beyond B.
    fn are_open(self) -> bool {
        self.least > 0.0
    }

    fn are_far(self) -> bool {
        self.are_open() && self.greatest - self.least <= 2.0 * FAR * self.middle()
    }
}

/// What waits to be summed for one sense of the axis.
#[derive(Debug)]
struct Side {
    pairs: Pairs,
    gaps: Gaps,
    sums: Vec<f64>,
}

/// The sums of an axis: ahead (A beyond B) and behind.
#[derive(Debug)]
pub(super) struct Totals {
    forces: Vec<Force>,
    ahead: Side,
    behind: Side,
    near: Pairs,
    beyond: Pairs,
}

impl Totals {
    pub(super) fn new(forces: &[Force]) -> Self {
        let side = || Side { pairs: Pairs::new(), gaps: Gaps::new(0.0, 0.0), sums: vec![0.0; forces.len()] };
        Self { forces: forces.to_vec(), ahead: side(), behind: side(), near: Pairs::new(), beyond: Pairs::new() }
    }

    /// Begins an axis.
    pub(super) fn begin(&mut self, ahead: Gaps, behind: Gaps) {
        self.ahead.gaps = ahead;
        self.behind.gaps = behind;
    }

    /// Adds a pair of edges whose gap goes linearly from `first` to `last`.
    #[inline(always)]
    pub(super) fn add(&mut self, first: f64, last: f64, weight: f64) {
        if first >= 0.0 && last >= 0.0 {
            self.add_ahead(first, last, weight);
        } else if first <= 0.0 && last <= 0.0 {
            self.add_behind(-first, -last, weight);
        } else {
            self.add_split(first, last, weight);
        }
    }

    #[inline(always)]
    fn add_ahead(&mut self, first: f64, last: f64, weight: f64) {
        if self.ahead.pairs.push(first, last, weight) {
            self.ahead.flush(&self.forces, &mut self.near, &mut self.beyond);
        }
    }

    #[inline(always)]
    fn add_behind(&mut self, first: f64, last: f64, weight: f64) {
        if self.behind.pairs.push(first, last, weight) {
            self.behind.flush(&self.forces, &mut self.near, &mut self.beyond);
        }
    }

    /// The edges cross: one part of the strip counts ahead, the other behind.
    #[cold]
    fn add_split(&mut self, first: f64, last: f64, weight: f64) {
        let share = first / (first - last);
        if first > 0.0 {
            self.add_ahead(first, 0.0, weight * share);
            self.add_behind(0.0, -last, weight * (1.0 - share));
        } else {
            self.add_behind(-first, 0.0, weight * share);
            self.add_ahead(0.0, last, weight * (1.0 - share));
        }
    }

    /// Ends the axis: for each force the resultants ahead and behind.
    pub(super) fn take(&mut self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.ahead.flush(&self.forces, &mut self.near, &mut self.beyond);
        self.behind.flush(&self.forces, &mut self.near, &mut self.beyond);
        // Rounding may leave a trace below zero where there is no force at all.
        let take = |sum: &mut f64| std::mem::take(sum).max(0.0);
        self.ahead.sums.iter_mut().zip(&mut self.behind.sums).map(move |(ahead, behind)| [take(ahead), take(behind)])
    }
}

impl Side {
    fn flush(&mut self, forces: &[Force], near: &mut Pairs, beyond: &mut Pairs) {
        if self.pairs.is_empty() {
            return;
        }
        for (force, sum) in forces.iter().zip(&mut self.sums) {
            *sum += resultant(*force, &mut self.pairs, self.gaps, near, beyond);
        }
        self.pairs.clear();
    }
}

/// − Σ w · mean of G over a block of pairs.
fn resultant(force: Force, pairs: &mut Pairs, gaps: Gaps, near: &mut Pairs, beyond: &mut Pairs) -> f64 {
    match force {
        Force::Power(0.0) => -pairs.sum_of_squares(if gaps.are_open() { gaps.middle() } else { 0.0 }),
        // The objects are known to be apart, so the tangent may be taken away even where they interlock.
        Force::Power(2.0) => pairs.sum_of_logarithms(gaps.middle(), gaps.are_far()),
        Force::Hybrid(y0) if gaps.least >= y0 => pairs.sum_of_logarithms(gaps.middle(), gaps.are_far()),
        Force::Hybrid(y0) => hybrid(y0, pairs, near, beyond),
        Force::Power(_) => {
            let kernel = Kernel::new(force, gaps.least, gaps.greatest);
            -pairs.iter().map(|(first, last, weight)| weight * kernel.mean(first, last)).sum::<f64>()
        }
    }
}

/// The hybrid force: G = d²/(2·Y0²) up to Y0, 2d/Y0 − 3/2 − ln(d/Y0) beyond.
fn hybrid(y0: f64, pairs: &Pairs, near: &mut Pairs, beyond: &mut Pairs) -> f64 {
    let mut sum = 0.0;
    for (first, last, weight) in pairs.iter() {
        let (low, high) = (first.min(last), first.max(last));
        if high <= y0 {
            near.push(low, high, weight);
        } else if low >= y0 {
            beyond.push(low, high, weight);
        } else {
            let share = (y0 - low) / (high - low);
            near.push(low, y0, weight * share);
            beyond.push(y0, high, weight * (1.0 - share));
        }
    }
    if !near.is_empty() {
        sum -= near.sum_of_squares(0.0) / (y0 * y0);
        near.clear();
    }
    if !beyond.is_empty() {
        // The sum of logarithms has the tangent u − 1 taken away, u = d/Y0; the rest of G is linear.
        let weights: f64 = beyond.iter().map(|(_, _, weight)| weight).sum();
        sum += beyond.sum_of_logarithms(y0, false) - (beyond.sum_of_gaps() / y0 - 0.5 * weights);
        beyond.clear();
    }
    sum
}
