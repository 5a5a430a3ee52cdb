//! A grounding for people.

use crate::record::{Grounding, Node};

/// The reading in lines: room, object, nodes, then why.
pub fn table(text: &str, grounding: &Grounding) -> String {
    let mut lines = vec![text.to_string()];
    let room = grounding.room.as_ref().map_or("not said".to_string(), |room| {
        let side = room.side.map(|side| format!("on the {}", side.name()));
        [room.name.clone(), side].into_iter().flatten().collect::<Vec<_>>().join(", ")
    });
    lines.push(format!("  room    {room}"));
    lines.push(format!("  object  {}", grounding.object.as_ref().map_or("not named", |object| object.name.as_str())));
    lines.extend(grounding.nodes.iter().enumerate().map(|(i, node)| format!("  node {}  {}", i + 1, describe(node))));
    lines.push(format!("  score   {:.2}", grounding.score.0));
    lines.extend(grounding.why.iter().map(|why| {
        let words = shortened(text.get(why.start..why.end).unwrap_or(""));
        format!("    {:5} {words:40} {}", why.tag.name(), why.because)
    }));
    let remarks = grounding.warnings.iter().chain(&grounding.problems).chain(&grounding.question);
    lines.extend(remarks.map(|remark| format!("  !  {remark}")));
    if !grounding.unused.is_empty() {
        let words: Vec<&str> = grounding.unused.iter().map(|span| span.text.as_str()).collect();
        lines.push(format!("  unused  {}", words.join(", ")));
    }
    lines.join("\n")
}

/// The beginning of long words, so that the reasons stand below one another.
fn shortened(words: &str) -> String {
    if words.chars().count() <= 40 {
        return words.to_string();
    }
    words.chars().take(39).chain(['…']).collect()
}

fn describe(node: &Node) -> String {
    let attributes: String = node.attributes.iter().map(|a| format!("{a} ")).collect();
    let ordinal = node.ordinal.map(|n| format!("no. {n} ")).unwrap_or_default();
    let target = node.target.as_deref().map_or("–".to_string(), |target| format!("{ordinal}{attributes}{target}"));
    let pairs: Vec<String> =
        node.pairs.iter().map(|pair| format!("{} ({})", pair.phrase(), pair.frame.name())).collect();
    format!("{target}: {}", if pairs.is_empty() { "anywhere".to_string() } else { pairs.join(", ") })
}
