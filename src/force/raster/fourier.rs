//! Correlation by Fourier transform, for images with very many corners.

use rustfft::num_complex::Complex;
use rustfft::{FftDirection, FftPlanner};

use super::corners::Corner;
use super::nodes::{Count, Shifts};

type Plane = Vec<Complex<f64>>;

/// Adds Σ weight·(a correlated with b) to a table of nodes, rounded to integers.
///
/// The transform is taken over a torus just larger than the table, so that
/// nothing wraps round onto a node that is read.
pub(super) fn add_correlation<'l, T: Count>(
    layers: impl Iterator<Item = (i32, &'l [Corner], &'l [Corner])>,
    shifts: Shifts,
    table: &mut [T],
) {
    let stride = shifts.stride();
    let torus = Torus { width: smooth(stride), height: smooth(table.len() / stride) };
    let mut spectrum = vec![Complex::default(); torus.width * torus.height];
    for (weight, a, b) in layers {
        let (a, b) = (torus.transform(a), torus.transform(b));
        for ((sum, a), b) in spectrum.iter_mut().zip(&a).zip(&b) {
            *sum += a * b.conj() * f64::from(weight);
        }
    }
    torus.turn(&mut spectrum, FftDirection::Inverse);
    let scale = 1.0 / spectrum.len() as f64;
    for y in shifts.low.1..=shifts.high.1 {
        for x in shifts.low.0..=shifts.high.0 {
            let value = spectrum[torus.place(x, y)].re * scale;
            let node = &mut table[shifts.index(x, y)];
            *node = node.plus(T::of(value.round() as i64));
        }
    }
}

/// A grid whose edges meet.
struct Torus {
    width: usize,
    height: usize,
}

impl Torus {
    fn place(&self, x: i32, y: i32) -> usize {
        let wrap = |v: i32, n: usize| v.rem_euclid(n as i32) as usize;
        wrap(y, self.height) * self.width + wrap(x, self.width)
    }

    fn transform(&self, corners: &[Corner]) -> Plane {
        let mut plane = vec![Complex::default(); self.width * self.height];
        for corner in corners {
            plane[self.place(corner.x, corner.y)].re += f64::from(corner.weight);
        }
        self.turn(&mut plane, FftDirection::Forward);
        plane
    }

    /// Transforms rows, then columns by way of a transposition.
    fn turn(&self, plane: &mut Plane, direction: FftDirection) {
        let mut planner = FftPlanner::new();
        planner.plan_fft(self.width, direction).process(plane);
        let mut columns = transposed(plane, self.width);
        planner.plan_fft(self.height, direction).process(&mut columns);
        *plane = transposed(&columns, self.height);
    }
}

fn transposed(plane: &[Complex<f64>], width: usize) -> Plane {
    let height = plane.len() / width;
    let mut turned = vec![Complex::default(); plane.len()];
    for (y, row) in plane.chunks_exact(width).enumerate() {
        for (x, value) in row.iter().enumerate() {
            turned[x * height + y] = *value;
        }
    }
    turned
}

/// The next number that has no prime factor above 5: transforms of such lengths are fast.
fn smooth(at_least: usize) -> usize {
    let is_smooth = |mut n: usize| {
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n == 1
    };
    (at_least.max(1)..).find(|n| is_smooth(*n)).unwrap_or(at_least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_gives_the_same_integers_as_pairs_of_corners() {
        let corner = |i: i32| Corner { x: (i * 7) % 13, y: (i * 5) % 11, weight: 1 - (i % 3) };
        let (a, b): (Vec<_>, Vec<_>) = ((0..20).map(corner).collect(), (20..50).map(corner).collect());
        let shifts = Shifts { low: (-13, -11), high: (13, 11) };
        let mut table = vec![0_i64; shifts.stride() * 27];
        add_correlation([(3, a.as_slice(), b.as_slice())].into_iter(), shifts, &mut table);
        for p in &a {
            for q in &b {
                table[shifts.index(p.x - q.x, p.y - q.y)] -= i64::from(3 * p.weight * q.weight);
            }
        }
        assert!(table.iter().all(|count| *count == 0));
    }
}
