//! How well furniture was seen, as a text table.

use super::Rate;
use super::furniture::{FurnitureScores, SeenGroup};

/// The scores for people: a row a category, then which was taken for which.
pub fn furniture_tables(title: &str, scores: &FurnitureScores) -> String {
    let mut lines = vec![title.to_string(), String::new()];
    lines
        .push(format!("{:14}{:>17}{:>17}{:>17}{:>9}{:>7}", "", "found", "right of six", "right name", "centre", "yaw"));
    let rate = |rate: Rate| format!("{:.1} % ({}/{})", 100.0 * rate.share(), rate.hit, rate.of);
    let row = |name: &str, g: &SeenGroup| {
        let (found, kind, own) = (rate(g.found), rate(g.kind), rate(g.name));
        format!("{name:14}{found:>17}{kind:>17}{own:>17}{:>7.2} m{:>6.1}°", g.centre_m.0, g.yaw_deg.0)
    };
    lines.push(row("all", &scores.all));
    lines.extend(scores.by_category.iter().map(|(name, group)| row(name, group)));
    lines.push(String::new());
    for (what, rate) in
        [("found", scores.all.found), ("right of six", scores.all.kind), ("right name", scores.all.name)]
    {
        let (low, high) = rate.interval();
        lines.push(format!(
            "  {what}: {} of {}, 95 % interval {:.1} to {:.1} %",
            rate.hit,
            rate.of,
            100.0 * low,
            100.0 * high
        ));
    }
    let each = scores.extra as f64 / scores.frames.max(1) as f64;
    lines.push(format!("  not there: {} in {} frames, {each:.2} a frame", scores.extra, scores.frames));
    lines.push(String::new());
    for (truth, said) in &scores.confusion {
        let said: Vec<String> = said.iter().map(|(name, count)| format!("{name} {count}")).collect();
        lines.push(format!("  {truth:14}→ {}", said.join(", ")));
    }
    lines.join("\n")
}
