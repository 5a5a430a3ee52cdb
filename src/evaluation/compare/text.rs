//! A comparison for people.

use serde_json::Value;

use super::{Comparison, Measure};
use crate::evaluation::Rate;

/// Fixed, broken, changed, and what the test says.
pub fn comparison_text(comparison: &Comparison) -> String {
    let mut lines = Vec::new();
    let compared = comparison.first.of;
    if let Some(measure) = comparison.measure {
        let what = match measure {
            Measure::Found => "found",
            Measure::RightFirst => "right first",
        };
        lines.push(format!(
            "{what}: {} before, {} now, of {compared} records",
            cell(comparison.first),
            cell(comparison.second)
        ));
        lines.push(format!(
            "fixed {}, broken {}; McNemar's exact test: p = {:.4}",
            comparison.fixed.len(),
            comparison.broken.len(),
            comparison.mcnemar_p.value()
        ));
    }
    let lists = [
        ("fixed", &comparison.fixed),
        ("broken", &comparison.broken),
        ("missing in the second", &comparison.missing),
        ("only in the second", &comparison.extra),
        ("doubled", &comparison.doubled),
    ];
    lines.extend(
        lists.iter().filter(|(_, ids)| !ids.is_empty()).map(|(what, ids)| format!("{what}: {}", ids.join(", "))),
    );
    lines.push(format!("changed: {} values in {} records", comparison.changes.len(), comparison.differing));
    for change in &comparison.changes {
        let (from, to) = (shown(&change.from), shown(&change.to));
        lines.push(format!("  {}: {} {from} → {to}", change.id, change.field));
    }
    lines.join("\n")
}

fn cell(rate: Rate) -> String {
    format!("{} ({:.1} %)", rate.hit, 100.0 * rate.share())
}

/// A value in words; what is absent as a dash.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "–".to_string(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
