//! Floats that print to a fixed precision, so that the same computation gives the same bytes.

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize, Serializer};

/// A float written with at most four decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Deserialize)]
#[serde(transparent)]
pub struct Rounded(pub f64);

impl Rounded {
    /// The value as it is written.
    pub fn value(self) -> f64 {
        // Adding zero turns −0 into 0, which would otherwise print as "-0.0".
        (self.0 * 1e4).round() / 1e4 + 0.0
    }
}

impl From<f64> for Rounded {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

impl Serialize for Rounded {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.value())
    }
}

impl JsonSchema for Rounded {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Rounded".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        f64::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_decimals_and_no_negative_zero() {
        let text = |v: f64| serde_json::to_string(&Rounded(v)).expect("a float serializes");
        assert_eq!(text(0.123_456), "0.1235");
        assert_eq!(text(-0.000_01), "0.0");
    }
}
