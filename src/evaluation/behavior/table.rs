//! The figures as tables for people, the paper's beside ours.

use super::{BehaviorReport, Cell, ConditionReport};
use crate::evaluation::Rate;

/// What the paper reports (Huo et al. 2014, Tables II and III).
///
/// Its categories go by a rule it does not state, so its figures stand beside the table, not in its cells.
const PAPER: &[(&str, &str)] = &[
    ("Table II, simulation", "90.1 % (goal 89.5, path 86.0, none 98.0)"),
    ("Table II, simulation, the system before it", "84.6 %"),
    ("Table II, real robot", "81.3 % (26/32: goal 3/6, path 11/14, none 12/12)"),
    ("Table III, real robot, furniture moved", "78.1 % (25/32: goal 2/6, path 11/14, none 12/12)"),
];

/// The tables.
pub fn behavior_tables(report: &BehaviorReport) -> String {
    let mut lines =
        vec![format!("{} instructions ({}), {} trials each", report.instructions, report.source, report.seeds)];
    for condition in report.conditions.iter().take(2) {
        lines.push(String::new());
        lines.extend(condition_table(condition));
    }
    if let Some(fall) = report.fall {
        let (points, low, high) = (fall.points.0, fall.low.0, fall.high.0);
        lines.push(String::new());
        lines.push(format!(
            "right first falls by {points:.1} points from the first to the second, 95 % interval {low:.1} to {high:.1}"
        ));
    }
    lines.push(String::new());
    lines.push("The paper's, of trials in which the object was found; its categories are not those above:".to_string());
    lines.extend(PAPER.iter().map(|(what, figures)| format!("  {what:43} {figures}")));
    if report.conditions.len() > 2 {
        lines.push(String::new());
        lines.extend(comparison(&report.conditions));
    }
    for explanation in &report.explanations {
        lines.push(String::new());
        lines.push(explanation.to_string());
    }
    lines.join("\n")
}

fn condition_table(condition: &ConditionReport) -> Vec<String> {
    let mut columns: Vec<(&str, &Cell)> = vec![("all", &condition.all)];
    columns.extend(condition.by_names.iter().map(|(name, cell)| (name.as_str(), cell)));
    let row = |name: &str, value: &dyn Fn(&Cell) -> String| row(name, columns.iter().map(|(_, cell)| value(cell)));
    vec![
        self::row(&condition.name, columns.iter().map(|(name, _)| (*name).to_string())),
        row("  found", &|cell| rate(cell.found)),
        row("  95 %", &|cell| interval(cell.found)),
        row("  right first", &|cell| rate(cell.right_first)),
        row("  95 %", &|cell| interval(cell.right_first)),
        row("  instructions", &|cell| rate(cell.instructions_right_first)),
        row("  95 %", &|cell| interval(cell.instructions_right_first)),
        row("  SPL", &|cell| format!("{:.3}", cell.spl.0)),
        row("  way, time", &|cell| format!("{:.1} m, {:.0} s", cell.distance_m.0, cell.duration_s.0)),
        row("  collisions", &|cell| cell.collisions.to_string()),
        row("  least clearance", &|cell| format!("{:.3} m", cell.min_clearance_m.0)),
    ]
}

/// One line a condition, each against the first of the same home.
fn comparison(conditions: &[ConditionReport]) -> Vec<String> {
    let heads = ["found", "right first", "SPL", "way", "time", "collisions"];
    let mut lines = vec![row("what each part is worth", heads.iter().map(|head| (*head).to_string()))];
    lines.extend(conditions.iter().map(|condition| {
        let cell = &condition.all;
        let cells = [
            rate(cell.found),
            rate(cell.right_first),
            format!("{:.3}", cell.spl.0),
            format!("{:.1} m", cell.distance_m.0),
            format!("{:.0} s", cell.duration_s.0),
            cell.collisions.to_string(),
        ];
        row(&format!("  {}", condition.name), cells.into_iter())
    }));
    lines
}

fn rate(rate: Rate) -> String {
    format!("{:.1} % ({}/{})", 100.0 * rate.share(), rate.hit, rate.of)
}

fn interval(rate: Rate) -> String {
    let (low, high) = rate.interval();
    format!("{:.1} to {:.1} %", 100.0 * low, 100.0 * high)
}

fn row(name: &str, cells: impl Iterator<Item = String>) -> String {
    let cells: String = cells.map(|cell| format!("{cell:>20}")).collect();
    format!("{name:36}{cells}").trim_end().to_string()
}
