//! Counts with their Wilson 95 % intervals.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::record::Rounded;

/// So many of so many, with the interval that the true rate lies in with 95 % confidence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rate {
    /// How many succeeded.
    pub hit: usize,
    /// Of how many.
    pub of: usize,
}

/// As it is written.
#[derive(Serialize, JsonSchema)]
struct Written {
    hit: usize,
    of: usize,
    rate: Rounded,
    low: Rounded,
    high: Rounded,
}

impl Rate {
    /// Counts one trial.
    pub fn count(&mut self, success: bool) {
        self.hit += usize::from(success);
        self.of += 1;
    }

    /// The share, zero of none.
    pub fn share(self) -> f64 {
        if self.of == 0 { 0.0 } else { self.hit as f64 / self.of as f64 }
    }

    /// Wilson's score interval at 95 % (Wilson, JASA 22, 1927).
    pub fn interval(self) -> (f64, f64) {
        if self.of == 0 {
            return (0.0, 1.0);
        }
        const Z: f64 = 1.959_963_984_540_054;
        let (n, p) = (self.of as f64, self.share());
        let middle = p + Z * Z / (2.0 * n);
        let spread = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let scale = 1.0 + Z * Z / n;
        (((middle - spread) / scale).max(0.0), ((middle + spread) / scale).min(1.0))
    }
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let (low, high) = self.interval();
        write!(f, "{:.3} ({}/{}, 95 % interval {low:.3} to {high:.3})", self.share(), self.hit, self.of)
    }
}

impl Serialize for Rate {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (low, high) = self.interval();
        let written =
            Written { hit: self.hit, of: self.of, rate: self.share().into(), low: low.into(), high: high.into() };
        written.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Rate {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Counts {
            hit: usize,
            of: usize,
        }
        Counts::deserialize(deserializer).map(|Counts { hit, of }| Self { hit, of })
    }
}

impl std::ops::AddAssign for Rate {
    fn add_assign(&mut self, other: Self) {
        self.hit += other.hit;
        self.of += other.of;
    }
}

impl JsonSchema for Rate {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Rate".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Written::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_131_in_149_is_the_published_one() {
        let (low, high) = Rate { hit: 131, of: 149 }.interval();
        assert!((low - 0.817).abs() < 1e-3 && (high - 0.922).abs() < 1e-3, "{low} {high}");
    }

    #[test]
    fn nothing_counted_says_nothing() {
        assert_eq!(Rate::default().interval(), (0.0, 1.0));
    }
}
