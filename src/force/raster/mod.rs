//! Histograms of forces between rasters, exactly, with each cell a square of its own membership.
//!
//! F(θ) = ∫ φ(ρ) C(ρ·u_θ) dρ, where C(w) is the area (or summed membership) of
//! A ∩ (B + w). For cells C is exactly the bilinear interpolation of the
//! integer cross-correlation of the two images, so that one correlation serves
//! every direction, every r and the hybrid force; along a ray it is a quadratic
//! in each cell, which φ integrates in closed form.

mod corners;
mod correlation;
mod fourier;
mod image;
mod nodes;
mod ray;
mod stretch;

pub use self::image::{Raster, RasterError};

use self::correlation::Covariogram;
use self::ray::Rays;
use super::histogram::direction;
use super::polygon::hybrid_of_areas;
use super::{Force, Histogram, Infinite};

/// How the memberships of two cells combine (Dubois & Jaulent; Krishnapuram, Keller & Ma).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fuzzy {
    /// The product: double sum over the level cuts of both.
    #[default]
    Product,
    /// The lesser: single sum over common level cuts.
    Minimum,
}

/// Two rasters' correlation, from which every histogram follows.
///
/// ```
/// use spatial_fetch::force::{Force, raster::{Fuzzy, RasterPair, Raster}};
/// let a = Raster::from_rows(&["...#"], 1.0).unwrap();
/// let b = Raster::from_rows(&["#..."], 1.0).unwrap();
/// let pair = RasterPair::new(&a, &b, Fuzzy::Product).unwrap();
/// let histogram = pair.histogram(Force::Power(2.0), 360).unwrap();
/// assert!((histogram.values()[0] - (9.0_f64 / 8.0).ln()).abs() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct RasterPair {
    covariogram: Covariogram,
    cell: f64,
    smaller_area: f64,
}

impl RasterPair {
    /// Correlates two rasters of the same size and cell.
    ///
    /// # Errors
    /// [`RasterError`] where they differ in size or cell.
    pub fn new(a: &Raster, b: &Raster, fuzzy: Fuzzy) -> Result<Self, RasterError> {
        a.require_alike(b)?;
        let covariogram = correlation::covariogram(a, b, fuzzy);
        Ok(Self { covariogram, cell: a.cell(), smaller_area: a.area().min(b.area()) })
    }

    /// The histogram of A against B.
    ///
    /// # Errors
    /// [`Infinite`] where the force diverges: r ≥ 2 and cells touch, or r ≥ 1 and they overlap.
    pub fn histogram(&self, force: Force, directions: usize) -> Result<Histogram, Infinite> {
        self.histograms(&[force], directions).remove(0)
    }

    /// The histograms of several forces, for little more than the price of one.
    pub fn histograms(&self, forces: &[Force], directions: usize) -> Vec<Result<Histogram, Infinite>> {
        let finite: Vec<Force> = forces.iter().copied().filter(|force| self.is_finite(*force)).collect();
        let mut computed = self.finite_histograms(&finite, directions).into_iter();
        forces
            .iter()
            .map(|f| if self.is_finite(*f) { computed.next().ok_or(Infinite) } else { Err(Infinite) })
            .collect()
    }

    pub(super) fn finite_histograms(&self, forces: &[Force], directions: usize) -> Vec<Histogram> {
        let in_cells = |force: &Force| match force {
            Force::Hybrid(y0) => Force::Hybrid(y0 / self.cell),
            Force::Power(r) => Force::Power(*r),
        };
        let mut rays = Rays::new(forces.iter().map(in_cells).collect());
        let mut values = vec![vec![0.0; directions]; forces.len()];
        for i in 0..directions {
            let (sin, cos) = direction(i, directions);
            for (values, sum) in values.iter_mut().zip(rays.resultants(&self.covariogram, sin, cos)) {
                values[i] = sum;
            }
        }
        for (values, force) in values.iter_mut().zip(forces) {
            // F_r scales with length to the power 3 − r.
            let scale = if let Force::Power(r) = force { self.cell.powf(3.0 - r) } else { self.cell };
            values.iter_mut().for_each(|value| *value = (*value * scale).max(0.0));
        }
        values.into_iter().map(Histogram::from_values).collect()
    }

    /// The hybrid force with Y0 as Matsakis & Wendling choose it.
    pub fn hybrid(&self) -> Force {
        hybrid_of_areas(self.smaller_area, self.shared_area())
    }

    /// Area of the intersection (summed membership for fuzzy rasters), square metres.
    pub fn shared_area(&self) -> f64 {
        self.covariogram.at(0, 0) * self.cell * self.cell
    }

    /// Metres between the nearest cells, zero when they touch.
    pub fn distance(&self) -> f64 {
        self.covariogram.distance() * self.cell
    }

    fn is_finite(&self, force: Force) -> bool {
        match force {
            Force::Hybrid(_) => true,
            Force::Power(r) => r < 1.0 || self.shared_area() == 0.0 && (r < 2.0 || !self.covariogram.touches()),
        }
    }
}

#[cfg(test)]
mod tests;
