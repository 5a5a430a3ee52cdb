//! The elementary force, and the mean of its second antiderivative over a gap that changes linearly.
//!
//! With φ(d) the force at distance d and G'' = φ, the force between two runs
//! [a1, a2] of A and [b1, b2] of B on one line is
//! G(a2−b1) − G(a2−b2) − G(a1−b1) + G(a1−b2), G being zero for negative
//! arguments. That one formula covers every configuration, overlaps included.

use super::quadrature::GAUSS;

/// The force by which points attract: distance to the power −r, or the hybrid of r = 0 near and r = 2 far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// d^−r. r = 0 is constant, r = 2 gravitational.
    Power(f64),
    /// 1 / max(d, Y0)²: gravitational beyond Y0, constant within it.
    Hybrid(f64),
}

/// The force diverges: the objects touch or overlap, and r is too large for that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the force is infinite: the objects touch or overlap; use the hybrid force or a smaller r")]
pub struct Infinite;

/// Terms of the series for nearly equal distances: each adds a digit where |u| < 0.1.
const SERIES_TERMS: u32 = 18;
/// Below this ratio of the gaps' difference to the gap, the mean is taken by quadrature.
const SMOOTH: f64 = 0.25;

/// G, made small where only its curvature matters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    force: Force,
    /// Where all gaps are positive any linear function may be added to G: the
    /// tangent at this distance is taken away, which leaves nothing to cancel.
    about: Option<f64>,
}

impl Kernel {
    pub(super) fn new(force: Force, least_gap: f64, greatest_gap: f64) -> Self {
        // Beyond Y0 the hybrid force is the gravitational one.
        let force = match force {
            Force::Hybrid(near) if least_gap >= near => Force::Power(2.0),
            other => other,
        };
        let separate = least_gap > 0.0 && matches!(force, Force::Power(_));
        Self { force, about: separate.then_some((least_gap + greatest_gap) / 2.0) }
    }

    /// The mean of G while the gap goes linearly from `g0` to `g1`; gaps below zero count nothing.
    pub(super) fn mean(&self, g0: f64, g1: f64) -> f64 {
        let (low, high) = if g0 <= g1 { (g0, g1) } else { (g1, g0) };
        if high <= 0.0 {
            return 0.0;
        }
        if low < 0.0 {
            // Only the part of the way on which the gap is open counts.
            return self.mean(0.0, high) * high / (high - low);
        }
        match self.force {
            Force::Hybrid(near) if low < near && high > near => {
                (self.mean_within(low, near) * (near - low) + self.mean_within(near, high) * (high - near))
                    / (high - low)
            }
            _ => self.mean_within(low, high),
        }
    }

    fn mean_within(&self, low: f64, high: f64) -> f64 {
        if let Force::Power(0.0) = self.force {
            return self.mean_of_square(low, high);
        }
        if self.about.is_some() || high - low <= SMOOTH * low {
            return self.mean_by_quadrature(low, high);
        }
        (self.second_integral(high) - self.second_integral(low)) / (high - low)
    }

    /// Half the mean of the squared distance from the tangent's place.
    fn mean_of_square(&self, low: f64, high: f64) -> f64 {
        let about = self.about.unwrap_or(0.0);
        let (a, b) = (low - about, high - about);
        (a * a + a * b + b * b) / 6.0
    }

    fn mean_by_quadrature(&self, low: f64, high: f64) -> f64 {
        // Halved until the integrand is smooth over each piece.
        if high - low > SMOOTH * low && low > 0.0 {
            let middle = (low * high).sqrt();
            return (self.mean_by_quadrature(low, middle) * (middle - low)
                + self.mean_by_quadrature(middle, high) * (high - middle))
                / (high - low);
        }
        let (centre, half) = ((low + high) / 2.0, (high - low) / 2.0);
        let pair = |&(x, w): &(f64, f64)| w * (self.value(centre - half * x) + self.value(centre + half * x));
        GAUSS.iter().map(pair).sum::<f64>() / 2.0
    }

    /// G(d), d ≥ 0.
    fn value(&self, d: f64) -> f64 {
        match (self.force, self.about) {
            (Force::Power(r), Some(about)) => about.powf(2.0 - r) * curvature(2.0 - r, d / about - 1.0, d / about),
            (Force::Power(r), None) => plain(r, d),
            (Force::Hybrid(near), _) if d <= near => d * d / (2.0 * near * near),
            (Force::Hybrid(near), _) => 2.0 * d / near - 1.5 - (d / near).ln(),
        }
    }

    /// H with H' = G, d ≥ 0.
    fn second_integral(&self, d: f64) -> f64 {
        match self.force {
            Force::Power(2.0) => d - x_ln_x(d),
            Force::Power(1.0) => d * x_ln_x(d) / 2.0 - 0.75 * d * d,
            Force::Power(3.0) => d.ln() / 2.0,
            Force::Power(r) => d.powf(3.0 - r) / ((1.0 - r) * (2.0 - r) * (3.0 - r)),
            Force::Hybrid(near) if d <= near => d.powi(3) / (6.0 * near * near),
            // Continuous at Y0, where the first branch gives Y0/6.
            Force::Hybrid(near) => {
                let beyond = |d: f64| d * d / near - 0.5 * d - d * (d / near).ln();
                near / 6.0 + beyond(d) - beyond(near)
            }
        }
    }
}

fn plain(r: f64, d: f64) -> f64 {
    match r {
        1.0 => x_ln_x(d) - d,
        2.0 => -d.ln(),
        _ => d.powf(2.0 - r) / ((1.0 - r) * (2.0 - r)),
    }
}

fn x_ln_x(x: f64) -> f64 {
    if x > 0.0 { x * x.ln() } else { 0.0 }
}

/// ((1+u)^p − 1 − p·u) / (p(p−1)), the limits at p = 0 and p = 1 included; `one_plus` is 1 + u.
fn curvature(p: f64, u: f64, one_plus: f64) -> f64 {
    if u.abs() < 0.1 {
        let mut tail = 1.0;
        for k in (3..3 + SERIES_TERMS).rev() {
            tail = 1.0 + (p - f64::from(k - 1)) / f64::from(k) * u * tail;
        }
        return u * u / 2.0 * tail;
    }
    match p {
        0.0 => u - one_plus.ln(),
        1.0 => one_plus * one_plus.ln() - u,
        _ => (one_plus.powf(p) - 1.0 - p * u) / (p * (p - 1.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_meets_the_closed_form_where_they_part() {
        for p in [-1.0, 0.0, 0.5, 1.0, 1.5, 2.0] {
            let (below, above) =
                (curvature(p, 0.099_999_999, 1.099_999_999), curvature(p, 0.100_000_001, 1.100_000_001));
            assert!((below - above).abs() < 1e-9, "p = {p}: {below} {above}");
        }
    }

    #[test]
    fn quadrature_and_closed_form_agree() {
        for force in [Force::Power(2.0), Force::Power(1.0), Force::Power(0.5), Force::Power(3.0), Force::Hybrid(0.01)] {
            let kernel = Kernel { force, about: None };
            let closed = (kernel.second_integral(3.0) - kernel.second_integral(1.0)) / 2.0;
            let halves = kernel.mean_by_quadrature(1.0, 3.0);
            assert!((closed - halves).abs() < 1e-12, "{force:?}: {closed} {halves}");
        }
    }
}
