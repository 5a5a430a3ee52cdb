//! Failures for people.

use super::{Blames, Stage};
use crate::evaluation::Rate;
use crate::record::{Grounding, Node};

const STAGES: [(Stage, &str); 5] = [
    (Stage::Chunk, "chunk"),
    (Stage::Ground, "ground"),
    (Stage::Plan, "plan"),
    (Stage::Perceive, "perceive"),
    (Stage::Drive, "drive, or words that fit another piece as well"),
];

/// The charges, then each failure.
pub fn blame_text(blames: &Blames) -> String {
    let share = Rate { hit: blames.failed, of: blames.descriptions };
    let (low, high) = share.interval();
    let percent = [share.share(), low, high].map(|share| 100.0 * share);
    let mut lines = vec![format!(
        "{} of {} descriptions failed: {:.1} % ({:.1}–{:.1})",
        blames.failed, blames.descriptions, percent[0], percent[1], percent[2]
    )];
    if blames.unjudged > 0 {
        lines.push(format!("{} more have no gold meaning and were left out", blames.unjudged));
    }
    lines.extend(STAGES.iter().filter_map(|(stage, name)| Some(format!("{:6}  {name}", blames.charged.get(stage)?))));
    for failure in &blames.failures {
        let name = |stage: &Stage| STAGES.iter().find(|(s, _)| s == stage).map_or("", |(_, name)| *name);
        lines.push(String::new());
        lines.push(format!("{}: {}", failure.id, failure.text));
        lines.push(format!("   charged to {}", name(&failure.charged)));
        let others: Vec<&str> = failure.mended_by.iter().skip(1).map(name).collect();
        if !others.is_empty() {
            lines.push(format!("   also mended by the gold of {}", others.join(", ")));
        }
        let first = failure.first.as_deref().unwrap_or("nothing");
        lines.push(format!("   went to     {first}, not {}", failure.wanted.join(" or ")));
        lines.push(format!("   understood  {}", or_nothing(&failure.understood)));
        lines.push(format!("   meant       {}", or_nothing(&failure.meant)));
    }
    lines.join("\n")
}

fn or_nothing(phrase: &str) -> &str {
    if phrase.is_empty() { "nothing" } else { phrase }
}

/// A meaning in one line.
pub fn meaning_phrase(meaning: &Grounding) -> String {
    let room = meaning.room.as_ref().map(|room| {
        let side = room.side.map(|side| format!("room on the {}", side.name()));
        [room.name.as_ref().map(|name| name.replace('_', " ")), side]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(", ")
    });
    let object = meaning.object.as_ref().map(|object| object.name.replace('_', " "));
    let parts = room.into_iter().chain(meaning.nodes.iter().map(node_phrase)).chain(object);
    // A move that says neither whence nor whither has no words of its own.
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
}

fn node_phrase(node: &Node) -> String {
    let pairs: Vec<String> = node.pairs.iter().map(|pair| pair.phrase()).collect();
    match &node.target {
        Some(target) if pairs.is_empty() => target.replace('_', " "),
        Some(target) => format!("{}: {}", target.replace('_', " "), pairs.join(", ")),
        None => pairs.join(", "),
    }
}
