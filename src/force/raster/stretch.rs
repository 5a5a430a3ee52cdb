//! One stretch of a ray, on which the covariogram is a quadratic, and what a force makes of it.

use super::super::Force;
use super::super::quadrature::GAUSS;

/// C(t) = q0 + q1·s + q2·s² with s = t − middle, |s| ≤ half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) middle: f64,
    pub(super) half: f64,
    pub(super) q: [f64; 3],
}

/// Up to this ratio of half to middle ten points are exact to rounding.
const SMOOTH: f64 = 0.2;

impl Stretch {
    /// ∫ φ(t)·C(t) dt over the stretch.
    pub(super) fn force(&self, force: Force) -> f64 {
        if self.half <= 0.0 {
            return 0.0;
        }
        match force {
            Force::Power(0.0) => self.constant(),
            Force::Power(2.0) if self.half <= SMOOTH * self.middle => self.gravitational(),
            Force::Power(r) if self.half <= SMOOTH * self.middle => self.by_quadrature(r),
            Force::Power(r) => self.in_closed_form(r),
            Force::Hybrid(y0) => self.hybrid(y0),
        }
    }

    fn constant(&self) -> f64 {
        2.0 * self.half * (self.q[0] + self.q[2] * self.half * self.half / 3.0)
    }

    fn hybrid(&self, y0: f64) -> f64 {
        let (low, high) = (self.middle - self.half, self.middle + self.half);
        if high <= y0 {
            self.constant() / (y0 * y0)
        } else if low >= y0 {
            self.force(Force::Power(2.0))
        } else {
            self.part(low, y0).constant() / (y0 * y0) + self.part(y0, high).force(Force::Power(2.0))
        }
    }

    fn part(&self, low: f64, high: f64) -> Self {
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        let (shift, [q0, q1, q2]) = (middle - self.middle, self.q);
        Self { middle, half, q: [q0 + shift * (q1 + shift * q2), q1 + 2.0 * shift * q2, q2] }
    }

    /// r = 2, by the moments of 1/t² about the middle. What cancels in them is of the order of rounding in the sum.
    fn gravitational(&self) -> f64 {
        let (m, h, [q0, q1, q2]) = (self.middle, self.half, self.q);
        let whole = 2.0 * h / ((m - h) * (m + h));
        let log = (2.0 * h / (m - h)).ln_1p();
        let first = log - m * whole;
        q0 * whole + q1 * first + q2 * (2.0 * h - m * (log + first))
    }

    fn by_quadrature(&self, r: f64) -> f64 {
        let [q0, q1, q2] = self.q;
        let value = |s: f64| (q0 + s * (q1 + s * q2)) * (self.middle + s).powf(-r);
        let pair = |(x, w): &(f64, f64)| w * (value(self.half * x) + value(-self.half * x));
        self.half * GAUSS.iter().map(pair).sum::<f64>()
    }

    /// By the quadratic about t = 0: near the origin it loses nothing.
    fn in_closed_form(&self, r: f64) -> f64 {
        let (low, high) = ((self.middle - self.half).max(0.0), self.middle + self.half);
        let (m, [q0, q1, q2]) = (self.middle, self.q);
        let plain = [q0 - m * (q1 - m * q2), q1 - 2.0 * m * q2, q2];
        let term = |(n, k): (usize, &f64)| {
            // At the origin a divergent term stands only beside a coefficient that is zero but for rounding.
            let diverges = low <= 0.0 && n as f64 + 1.0 - r <= 0.0;
            if diverges { 0.0 } else { k * power_integral(n as f64 - r, low, high) }
        };
        plain.iter().enumerate().map(term).sum()
    }
}

/// ∫ t^p dt.
fn power_integral(p: f64, low: f64, high: f64) -> f64 {
    // The exponents of r = 2, the force asked for most, without `powf`.
    match p {
        -2.0 => 1.0 / low - 1.0 / high,
        -1.0 => (high / low).ln(),
        0.0 => high - low,
        _ => (high.powf(p + 1.0) - low.powf(p + 1.0)) / (p + 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_meets_the_closed_form() {
        let stretch = Stretch { middle: 3.0, half: 0.5, q: [2.0, -1.0, 0.3] };
        for r in [0.5, 1.0, 1.7, 2.0, 3.0, 4.5] {
            assert!((stretch.by_quadrature(r) - stretch.in_closed_form(r)).abs() < 1e-13, "r = {r}");
        }
        assert!((stretch.by_quadrature(2.0) - stretch.gravitational()).abs() < 1e-14);
    }

    #[test]
    fn a_hybrid_piece_is_the_sum_of_its_two_sides() {
        let stretch = Stretch { middle: 1.0, half: 0.7, q: [1.0, 0.5, -0.2] };
        let (near, far) = (stretch.part(0.3, 0.9), stretch.part(0.9, 1.7));
        let want = near.force(Force::Power(0.0)) / 0.81 + far.force(Force::Power(2.0));
        assert!((stretch.force(Force::Hybrid(0.9)) - want).abs() < 1e-14);
        assert!((near.constant() + far.constant() - stretch.constant()).abs() < 1e-14);
    }
}
