//! Pairs of edges that face each other over a strip: what a sweep yields and every force sums.
//!
//! A strip is the range of normal offsets that two edges share. Over it the
//! gap between them is linear, so two gaps and a weight say all:
//! F = − Σ w · mean of G over the gaps, w = sA·sB·(width of the strip).

use multiversion::multiversion;

/// Pairs summed at a time: small enough for the first-level cache.
pub(super) const CAPACITY: usize = 256;
/// Pairs that go through the processor side by side.
const LANES: usize = 8;
/// Up to this ratio of half the gap's change to its mean the series for the logarithm's mean is used.
const GENTLE: f64 = 0.1;

/// A block of pairs, one array per quantity.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    first: [f64; CAPACITY],
    last: [f64; CAPACITY],
    weight: [f64; CAPACITY],
    len: usize,
}

impl Pairs {
    pub(super) const fn new() -> Self {
        Self { first: [1.0; CAPACITY], last: [1.0; CAPACITY], weight: [0.0; CAPACITY], len: 0 }
    }

    /// Adds a pair; true when the block is now full.
    #[inline(always)]
    pub(super) fn push(&mut self, first: f64, last: f64, weight: f64) -> bool {
        let at = self.len % CAPACITY;
        self.first[at] = first;
        self.last[at] = last;
        self.weight[at] = weight;
        self.len = at + 1;
        self.len == CAPACITY
    }

    pub(super) fn is_empty(&self) -> bool {
        self.len == 0
    }

    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// The gaps at both ends and the weight of each pair.
    pub(super) fn iter(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        (0..self.len).map(|i| (self.first[i], self.last[i], self.weight[i]))
    }

    /// The number of pairs with the last group filled up by pairs that weigh nothing.
    fn padded(&mut self) -> usize {
        let end = self.len.next_multiple_of(LANES);
        self.first[self.len..end].fill(1.0);
        self.last[self.len..end].fill(1.0);
        self.weight[self.len..end].fill(0.0);
        end
    }

    /// Σ w · mean of (g − about)²/2.
    pub(super) fn sum_of_squares(&mut self, about: f64) -> f64 {
        let end = self.padded();
        sum_of_squares(&self.first[..end], &self.last[..end], &self.weight[..end], about)
    }

    /// Σ w · mean of [ln u − (u − 1)], u = g/about. `far`: every |u − 1| is at most 0.1.
    pub(super) fn sum_of_logarithms(&mut self, about: f64, far: bool) -> f64 {
        let end = self.padded();
        let (first, last, weight) = (&self.first[..end], &self.last[..end], &self.weight[..end]);
        if far {
            sum_of_far_logarithms(first, last, weight, about)
        } else {
            sum_of_logarithms(first, last, weight, about)
        }
    }

    /// Σ w · mean of g.
    pub(super) fn sum_of_gaps(&self) -> f64 {
        self.iter().map(|(first, last, weight)| weight * (first + last) / 2.0).sum()
    }
}

type Lanes = [f64; LANES];

/// The groups of three equally long slices whose length is a multiple of the lanes.
#[inline(always)]
fn groups<'s>(
    first: &'s [f64],
    last: &'s [f64],
    weight: &'s [f64],
) -> impl Iterator<Item = (&'s Lanes, &'s Lanes, &'s Lanes)> {
    let (first, last, weight) = (first.as_chunks().0, last.as_chunks().0, weight.as_chunks().0);
    first.iter().zip(last).zip(weight).map(|((f, l), w)| (f, l, w))
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_of_squares(first: &[f64], last: &[f64], weight: &[f64], about: f64) -> f64 {
    let mut sums = [0.0; LANES];
    for (f, l, w) in groups(first, last, weight) {
        for i in 0..LANES {
            let (a, b) = (f[i] - about, l[i] - about);
            sums[i] += w[i] * (a * a + a * b + b * b);
        }
    }
    sums.iter().sum::<f64>() / 6.0
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_of_logarithms(first: &[f64], last: &[f64], weight: &[f64], about: f64) -> f64 {
    let scale = 1.0 / about;
    let mut sums = [0.0; LANES];
    for (f, l, w) in groups(first, last, weight) {
        let mut slope = [0.0; LANES];
        let mut steepest = 0.0_f64;
        for i in 0..LANES {
            slope[i] = (l[i] - f[i]) / (l[i] + f[i]);
            steepest = steepest.max(slope[i].abs());
        }
        if steepest <= GENTLE {
            for i in 0..LANES {
                let middle = (f[i] + l[i]) * (0.5 * scale);
                sums[i] += w[i] * (logarithm(middle) - (middle - 1.0) + bend(slope[i]));
            }
        } else {
            for i in 0..LANES {
                sums[i] += w[i] * steep(f[i] * scale, l[i] * scale, slope[i]);
            }
        }
    }
    sums.iter().sum::<f64>()
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_of_far_logarithms(first: &[f64], last: &[f64], weight: &[f64], about: f64) -> f64 {
    let scale = 1.0 / about;
    let mut sums = [0.0; LANES];
    for (f, l, w) in groups(first, last, weight) {
        for i in 0..LANES {
            // Differences first: this is where a far pair would lose its digits.
            let middle = ((f[i] - about) + (l[i] - about)) * (0.5 * scale);
            let slope = (l[i] - f[i]) / (l[i] + f[i]);
            sums[i] += w[i] * (logarithm_less_tangent(middle) + bend(slope));
        }
    }
    sums.iter().sum::<f64>()
}

/// The mean of ln u − (u − 1) while u goes from `first` to `last`, by the logarithms at both ends.
///
/// `slope` is (last − first)/(last + first). With h = slope the mean of the
/// logarithm is (ln u0 + ln u1)/2 + (ln u1 − ln u0)/(2h) − 1.
#[inline(always)]
fn steep(first: f64, last: f64, slope: f64) -> f64 {
    let (l0, l1) = (logarithm(first), logarithm(last));
    let square = slope * slope;
    let gentle =
        square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0 + square * (1.0 / 9.0 + square * SERIES_END))));
    let divisor = if slope.abs() > GENTLE { 2.0 * slope } else { 1.0 };
    let exact = (l1 - l0) / divisor - 1.0;
    let beyond = if slope.abs() > GENTLE { exact } else { gentle };
    0.5 * (l0 + l1) + beyond - (0.5 * (first + last) - 1.0)
}

/// The last two terms of the series of atanh(h)/h at the edge of its use.
const SERIES_END: f64 = 1.0 / 11.0 + GENTLE * GENTLE / 13.0;

/// The mean of ln(1 + h·t) over −1 ≤ t ≤ 1, for |h| ≤ 0.12: −Σ h^2k / (2k(2k+1)).
#[inline(always)]
fn bend(h: f64) -> f64 {
    let z = h * h;
    -z * (1.0 / 6.0
        + z * (1.0 / 20.0
            + z * (1.0 / 42.0 + z * (1.0 / 72.0 + z * (1.0 / 110.0 + z * (1.0 / 156.0 + z * (1.0 / 210.0)))))))
}

/// ln(1 + e) − e for |e| ≤ 0.1 by its series, which keeps all digits.
#[inline(always)]
fn logarithm_less_tangent(e: f64) -> f64 {
    let mut tail = 0.0;
    for k in (2..=17).rev() {
        tail = 1.0 / f64::from(k) - e * tail;
    }
    -e * e * tail
}

/// ln x for positive normal x, to about one unit in the last place; straight-line code that runs in lanes.
///
/// x = 2^k·m with m in [√½, √2), ln m = 2·atanh((m − 1)/(m + 1)), as in fdlibm.
#[inline(always)]
pub(super) fn logarithm(x: f64) -> f64 {
    const HALF_ROOT: u64 = 0x3fe6_a09e_667f_3bcd;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
    // 2^52: a small integer put into its mantissa becomes a float without a conversion instruction.
    const SHIFTED: u64 = 0x4330_0000_0000_0000;
    let bits = x.max(f64::MIN_POSITIVE).to_bits().wrapping_add(ONE - HALF_ROOT);
    let exponent = f64::from_bits(SHIFTED | (bits >> 52)) - (4_503_599_627_370_496.0 + 1023.0);
    let m = f64::from_bits((bits & MANTISSA) + HALF_ROOT);
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let tail = 1.0 / 3.0
        + z * (1.0 / 5.0
            + z * (1.0 / 7.0
                + z * (1.0 / 9.0
                    + z * (1.0 / 11.0 + z * (1.0 / 13.0 + z * (1.0 / 15.0 + z * (1.0 / 17.0 + z * (1.0 / 19.0))))))));
    exponent * std::f64::consts::LN_2 + (2.0 * s + 2.0 * s * z * tail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logarithm_is_that_of_the_standard_library() {
        for i in 1..4000 {
            let x = (f64::from(i) * 0.01 - 20.0).exp();
            assert!((logarithm(x) - x.ln()).abs() <= 4e-16 * x.ln().abs().max(1.0), "{x}");
        }
    }

    #[test]
    fn gentle_steep_and_far_agree_where_they_meet() {
        for (first, last) in [(0.96, 1.04), (1.05, 0.97), (0.91, 1.0899), (1.0, 1.0)] {
            let mut pairs = Pairs::new();
            pairs.push(first, last, 1.0);
            let (near, far) = (pairs.sum_of_logarithms(1.0, false), pairs.sum_of_logarithms(1.0, true));
            let exact = steep(first, last, (last - first) / (last + first));
            assert!((near - far).abs() < 1e-15 && (exact - far).abs() < 1e-14, "{first} {last}: {near} {far} {exact}");
        }
    }

    #[test]
    fn a_gap_that_closes_has_the_mean_logarithm_of_its_end_less_one() {
        let mut pairs = Pairs::new();
        pairs.push(0.0, 1.0, 1.0);
        // Mean of ln u over (0, 1) is −1, of u − 1 is −1/2.
        assert!((pairs.sum_of_logarithms(1.0, false) + 0.5).abs() < 1e-12);
    }
}
