//! Scores as text tables.

use super::{Group, Rate, Scores};
use crate::record::csv_line;

/// What has to be known to read the rows above it.
const SPL_NOTE: &str =
    "  (SPL, success weighted by path length: 1 for the shortest way to the object, 0 where it is not found)";

/// The tables for people: all, by form, by furniture named, by tag.
pub fn text_tables(title: &str, scores: &Scores) -> String {
    let mut columns: Vec<(String, &Group)> = vec![("all".to_string(), &scores.all)];
    columns.extend(scores.by_form.iter().map(|(name, group)| (name.clone(), group)));
    columns.extend(scores.by_names.iter().map(|(name, group)| (name.clone(), group)));
    let mut lines = vec![title.to_string(), String::new()];
    lines.push(row("", columns.iter().map(|(name, _)| name.clone())));
    lines.push(row("descriptions", columns.iter().map(|(_, group)| group.descriptions.to_string())));
    for (name, pick) in ROWS {
        if pick(&scores.all).of > 0 {
            lines.push(row(name, columns.iter().map(|(_, group)| cell(pick(group)))));
        }
    }
    if scores.all.bracket_recall.of > 0 {
        lines.push(row("bracket F1", columns.iter().map(|(_, group)| format!("{:.3}", group.bracket_f1()))));
    }
    if scores.all.found.of > 0 {
        let mean = |group: &Group| format!("{:.3}", group.spl_sum.0 / group.descriptions.max(1) as f64);
        lines.push(row("SPL, mean", columns.iter().map(|(_, group)| mean(group))));
        lines.push(row("collisions", columns.iter().map(|(_, group)| group.collisions.to_string())));
        lines.push(SPL_NOTE.to_string());
    }
    let interval = |name: &str, rate: Rate| {
        let (low, high) = rate.interval();
        format!(
            "  {name}: {} of {} = {:.1} %, 95 % interval {:.1} to {:.1} %",
            rate.hit,
            rate.of,
            100.0 * rate.share(),
            100.0 * low,
            100.0 * high
        )
    };
    lines.push(String::new());
    lines.extend(
        ROWS.iter()
            .map(|(name, pick)| (name, pick(&scores.all)))
            .filter(|(_, rate)| rate.of > 0)
            .map(|(name, rate)| interval(name, rate)),
    );
    for (what, ids) in [("missing", &scores.missing), ("doubled", &scores.doubled), ("not in gold", &scores.unknown)] {
        if !ids.is_empty() {
            lines.push(format!("  {what}: {}", ids.join(", ")));
        }
    }
    lines.join("\n")
}

/// The same as rows of a table: a line a group and measure, with the count and its 95 % interval.
pub fn csv_tables(scores: &Scores) -> String {
    let mut groups: Vec<(&str, &str, &Group)> = vec![("all", "all", &scores.all)];
    groups.extend(scores.by_form.iter().map(|(name, group)| ("form", name.as_str(), group)));
    groups.extend(scores.by_names.iter().map(|(name, group)| ("furniture named", name.as_str(), group)));
    let mut lines = vec!["by,group,measure,hit,of,share,low,high".to_string()];
    for (by, name, group) in groups {
        for (measure, rate) in ROWS.iter().map(|(measure, pick)| (measure, pick(group))).filter(|(_, r)| r.of > 0) {
            let (low, high) = rate.interval();
            let head = csv_line([by, name, measure]);
            lines.push(format!("{head},{},{},{:.4},{low:.4},{high:.4}", rate.hit, rate.of, rate.share()));
        }
        if group.found.of > 0 {
            let mean = group.spl_sum.0 / group.descriptions.max(1) as f64;
            lines.push(format!("{},,{},{mean:.4},,", csv_line([by, name, "SPL"]), group.descriptions));
        }
    }
    lines.join("\n")
}

type Pick = fn(&Group) -> Rate;

const ROWS: [(&str, Pick); 10] = [
    ("brackets found", |g| g.bracket_recall),
    ("brackets right", |g| g.bracket_precision),
    ("exact trees", |g| g.exact_trees),
    ("room", |g| g.room),
    ("object", |g| g.object),
    ("pairs", |g| g.pairs),
    ("command", |g| g.command),
    ("found", |g| g.found),
    ("right first", |g| g.right_first),
    ("expected first", |g| g.expected_first),
];

fn cell(rate: Rate) -> String {
    format!("{:.1} % ({}/{})", 100.0 * rate.share(), rate.hit, rate.of)
}

fn row(name: &str, cells: impl Iterator<Item = String>) -> String {
    let cells: Vec<String> = cells.map(|cell| format!("{cell:>18}")).collect();
    format!("{name:15}{}", cells.join("")).trim_end().to_string()
}
