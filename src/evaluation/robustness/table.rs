//! Robustness as a text table.

use super::{Robustness, Tally};
use crate::evaluation::Rate;

/// The table for people: a row for each experiment, then what failed and why.
pub fn robustness_tables(robustness: &Robustness) -> String {
    let rows: Vec<&Tally> = [&robustness.kept, &robustness.broken]
        .into_iter()
        .flatten()
        .chain(&robustness.homes)
        .chain([&robustness.gold, &robustness.gold_from_text].into_iter().flatten())
        .collect();
    let heads = ("found", "right first");
    let mut lines = vec![format!(
        "{:38}{:>7}  {:>34}  {:>34}  {:>10}  {:>9}",
        "", "trials", heads.0, heads.1, "collisions", "clearance"
    )];
    lines.extend(rows.iter().map(|tally| row(tally)));
    for tally in rows {
        if !tally.not_made.is_empty() {
            lines.push(format!("\n{}: no such world could be made for {}", tally.name, tally.not_made.join(", ")));
        }
        if !tally.failures.is_empty() {
            lines.push(format!("\n{}, not found:", tally.name));
            lines.extend(tally.failures.iter().map(|failure| format!("  {failure}")));
        }
    }
    lines.join("\n")
}

fn row(tally: &Tally) -> String {
    let clearance = tally.min_clearance_m.map_or(String::new(), |clearance| format!("{:.2} m", clearance.0));
    format!(
        "{:38}{:>7}  {:>34}  {:>34}  {:>10}  {:>9}",
        tally.name,
        tally.trials,
        cell(tally.found),
        cell(tally.right_first),
        tally.collisions,
        clearance
    )
}

fn cell(rate: Rate) -> String {
    let (low, high) = rate.interval();
    format!("{:.1} % ({}/{}; {:.1} to {:.1} %)", 100.0 * rate.share(), rate.hit, rate.of, 100.0 * low, 100.0 * high)
}
