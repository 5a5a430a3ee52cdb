//! What `perceive` adds: `detections`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A piece of furniture as the robot sees it, in the world frame as the robot believes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Detection {
    /// Name of the likeliest category.
    pub category: String,
    /// Probability of that category, 0 to 1.
    pub confidence: f64,
    /// Probability of each category.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub scores: BTreeMap<String, f64>,
    /// Centre of the footprint, metres.
    pub x: f64,
    /// Centre of the footprint, metres.
    pub y: f64,
    /// Heading of the item's front, radians; null where it has none.
    pub yaw: Option<f64>,
    /// Metres along the front's heading.
    pub length: f64,
    /// Metres across it.
    pub width: f64,
    /// Metres above the floor.
    pub height: f64,
    /// Corners of the footprint, counter-clockwise, metres.
    pub footprint: Vec<[f64; 2]>,
    /// Colours, materials and shapes seen on it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<String>,
    /// The features that decided.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub why: String,
}
