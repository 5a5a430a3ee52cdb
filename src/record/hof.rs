//! What `hof` adds: `hof`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Histograms of forces between two objects, and what they say in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Hof {
    /// Number of directions K; value i belongs to θ = 360°·i/K, counter-clockwise from +x.
    pub directions: usize,
    /// One histogram per force, by the force's name (`0`, `2`, `hybrid`, …).
    pub forces: BTreeMap<String, HofForce>,
    /// Degrees of truth of the named directions.
    pub degrees: BTreeMap<String, DegreeOfTruth>,
    /// The direction in which the first object lies, degrees; null when the two have none.
    pub main_deg: Option<f64>,
    /// Metres between the two, zero when they touch.
    pub distance_m: f64,
    /// The gap in a word: `touching`, `very close`, `close`, `near` or `far`, by the size of the smaller object.
    pub closeness: String,
    /// Share of the first object's area that lies inside the second, 0 to 1.
    pub inside: f64,
    /// How far the second object surrounds the first, 0 to 1.
    pub surrounded: f64,
    /// How far the first object surrounds the second, 0 to 1.
    pub surrounds: f64,
    /// How far the first object lies between the second and the third, 0 to 1; only where a third, `c`, is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<f64>,
    /// One English sentence.
    pub description: String,
}

/// The values of one histogram, or the word "infinite" where the force diverges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum HofForce {
    /// One value per direction.
    Values(Vec<f64>),
    /// Always `"infinite"`.
    Infinite(String),
}

/// Degree of truth of a direction (Matsakis et al. 2001): a is the opinion, b the most that may reasonably be said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DegreeOfTruth {
    /// Degree of truth, 0 to 1.
    pub a: f64,
    /// Share of effective forces, 0 to 1.
    pub b: f64,
}
