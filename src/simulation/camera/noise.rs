//! Noise by the hundred thousand a frame: a table of normal deviates, read at random places.

use std::sync::OnceLock;

/// Entries of the table.
const COUNT: usize = 4096;

/// Quantiles of the standard normal distribution.
pub(super) struct Gaussians {
    table: Vec<f32>,
}

impl Gaussians {
    /// The table, made once.
    pub fn shared() -> &'static Self {
        static SHARED: OnceLock<Gaussians> = OnceLock::new();
        SHARED.get_or_init(|| Self { table: (0..COUNT).map(|i| quantile((i as f64 + 0.5) / COUNT as f64)).collect() })
    }

    /// What `of` makes of each deviate, to be picked by twelve bits.
    pub fn tabled<T>(&self, of: impl Fn(f32) -> T) -> Table<T> {
        Table { values: self.table.iter().map(|deviate| of(*deviate)).collect() }
    }
}

/// Something of normal deviates, made once for many pixels.
pub(super) struct Table<T> {
    pub values: Vec<T>,
}

impl<T: Copy> Table<T> {
    /// What the low twelve bits pick.
    #[inline(always)]
    pub fn pick(&self, bits: u32) -> T {
        self.values[bits as usize % COUNT]
    }
}

/// The standard normal quantile, by bisection of the distribution function.
fn quantile(probability: f64) -> f32 {
    let (mut low, mut high) = (-6.0, 6.0);
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if normal_cdf(middle) < probability { low = middle } else { high = middle }
    }
    low as f32
}

/// Abramowitz & Stegun 26.2.17, error below 7.5e-8.
fn normal_cdf(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.231_641_9 * x.abs());
    let series =
        t * (0.319_381_530 + t * (-0.356_563_782 + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    let tail = (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt() * series;
    if x >= 0.0 { 1.0 - tail } else { tail }
}

/// A number from 0 up to 2²³ cut off to an integer, in a form that is done for many at once.
#[inline(always)]
pub(super) fn whole(number: f32) -> u32 {
    // From here on up, floats lie one apart.
    const ONES: f32 = 8_388_608.0;
    (number.trunc() + ONES).to_bits().wrapping_sub(ONES.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deviates_have_mean_zero_and_variance_one() {
        let table = &Gaussians::shared().table;
        let mean = table.iter().sum::<f32>() / COUNT as f32;
        let variance = table.iter().map(|v| v * v).sum::<f32>() / COUNT as f32;
        assert!(mean.abs() < 1e-3 && (variance - 1.0).abs() < 5e-3, "{mean} {variance}");
    }
    #[test]
    fn whole_numbers_are_cut_off_as_by_a_cast() {
        for number in [0.0, 0.49, 0.5, 0.999_999_9, 1.0, 63.7, 254.999, 255.0, 3479.5, 8_388_607.0_f32] {
            assert_eq!(whole(number), number as u32, "{number}");
        }
    }
}
