//! Scores of grounding as text tables.

use super::{GroundingScores, MeaningRates, Noise, SplitScores, TreeRates};
use crate::evaluation::Rate;

/// The tables for people; `list` names every disagreement as well.
pub fn grounding_table(scores: &GroundingScores, list: bool) -> String {
    let mut lines = vec![format!("{}: {} labelled descriptions", scores.corpus, scores.descriptions), String::new()];
    lines.push("from plain text".to_string());
    let mut columns: Vec<(&str, &MeaningRates)> = scores.from_text.iter().map(|(name, rates)| (*name, rates)).collect();
    columns.extend(scores.by_form.iter().chain(&scores.by_names).map(|(name, rates)| (*name, rates)));
    lines.extend(meaning_rows(&columns));
    lines.push(String::new());
    if let Some(composed) = scores.from_text.get("composed") {
        lines.push(format!("  composed, command: {}", composed.command));
        lines.push(format!(
            "  composed, command, (room, back) of \"back table\" allowed: {}",
            composed.command_back_table
        ));
    }
    for (method, rates) in &scores.from_gold_trees {
        lines.extend(tree_rows(method, rates));
    }
    if !scores.splits.is_empty() {
        lines.extend(split_rows(&scores.splits));
    }
    if let Some(noise) = &scores.noise {
        lines.extend(noise_rows(noise));
    }
    lines.extend([String::new(), "scores and what they promise".to_string()]);
    lines.extend(
        scores
            .calibration
            .iter()
            .map(|bin| format!("  from {:.1}: mean score {:.2}, right {}", bin.from.0, bin.mean_score.0, bin.right)),
    );
    if list {
        lines.extend([String::new(), format!("{} disagreements (side | object | target)", scores.disagreements.len())]);
        lines.extend(scores.disagreements.iter().map(|d| {
            format!(
                "  {} {}: gold {} read {}; extra {:?}, missing {:?}",
                d.id,
                d.parts.join(", "),
                d.gold,
                d.read,
                d.extra,
                d.missing
            )
        }));
    }
    lines.join("\n")
}

type Pick = fn(&MeaningRates) -> Rate;

const ROWS: [(&str, Pick); 9] = [
    ("side of room", |r| r.side),
    ("name of room", |r| r.room_name),
    ("object", |r| r.object),
    ("last target", |r| r.target),
    ("target named", |r| r.target_named),
    ("all pairs", |r| r.pairs),
    ("pairs recall", |r| r.pairs_recall),
    ("pairs precision", |r| r.pairs_precision),
    ("command", |r| r.command),
];

fn meaning_rows(columns: &[(&str, &MeaningRates)]) -> Vec<String> {
    let cells = |first: &str, cells: Vec<String>| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>17}")).collect();
        format!("  {first:16}{cells}")
    };
    let mut lines = vec![cells("", columns.iter().map(|(name, _)| (*name).to_string()).collect())];
    for (name, pick) in ROWS {
        let cell = |rate: Rate| format!("{:.3} ({}/{})", rate.share(), rate.hit, rate.of);
        lines.push(cells(name, columns.iter().map(|(_, rates)| cell(pick(rates))).collect()));
    }
    lines.push(cells("pairs F1", columns.iter().map(|(_, rates)| format!("{:.3}", rates.pairs_f1.0)).collect()));
    lines
}

fn tree_rows(method: &str, rates: &TreeRates) -> Vec<String> {
    let by_tag: Vec<String> = rates.by_tag.iter().map(|(tag, rate)| format!("{tag} {:.3}", rate.share())).collect();
    vec![
        String::new(),
        format!("from gold trees, {method}"),
        format!("  commands {}", rates.commands),
        format!("  chunks   {}", rates.chunks),
        format!("  by tag   {}", by_tag.join(", ")),
    ]
}

fn split_rows(splits: &[SplitScores]) -> Vec<String> {
    let first = &splits[0];
    let mut lines = vec![
        String::new(),
        format!(
            "paper, from gold trees: {} random training sets of {}, tested on {} (mean, smallest to largest)",
            first.splits, first.trained_on, first.tested_on
        ),
    ];
    lines.extend(splits.iter().map(|s| {
        let variant = format!("{:?}, {:?}", s.factors, s.distance).to_lowercase();
        format!(
            "  {variant:22} commands {:.3} ({:.3} to {:.3})   chunks {:.3} ({:.3} to {:.3})",
            s.commands.mean.0, s.commands.min.0, s.commands.max.0, s.chunks.mean.0, s.chunks.min.0, s.chunks.max.0
        )
    }));
    lines
}

fn noise_rows(noise: &Noise) -> Vec<String> {
    let mut lines = vec![String::new(), format!("with noise on {:.0} % of the words", 100.0 * noise.probability.0)];
    lines.extend(meaning_rows(&[("clean", &noise.clean), ("noisy", &noise.noisy)]));
    let kept = &noise.kept;
    lines.push(format!(
        "  kept: room {:.3}, object {:.3}, pairs {:.3} (by F1), all pairs {:.3}",
        kept.room.0, kept.object.0, kept.pairs.0, kept.all_pairs.0
    ));
    lines
}
