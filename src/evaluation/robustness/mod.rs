//! How well the words lead the robot when the furniture is not where it was: random placements, other homes, and homes
//! made so that a given gold grounding is true.

mod category;
mod fits;
mod gold_home;
mod gold_line;
mod own_homes;
mod placements;
mod table;
mod tally;

use schemars::JsonSchema;
use serde::Serialize;

pub use gold_home::{GoldHome, home_for};
pub use gold_line::{GoldLine, read_gold_lines, read_texts};
pub use own_homes::{OwnHome, own_homes};
pub use placements::{Experiment, gold_homes, homes, placements};
pub use table::robustness_tables;
pub use tally::Tally;

/// What `evaluate robustness` adds up.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Robustness {
    /// The furniture elsewhere, all relations as they were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<Tally>,
    /// The furniture elsewhere, the relations broken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub broken: Option<Tally>,
    /// The other shipped homes with their own descriptions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub homes: Vec<Tally>,
    /// Homes made so that each gold grounding is true, driven by the gold grounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gold: Option<Tally>,
    /// The same, driven by the text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gold_from_text: Option<Tally>,
}
