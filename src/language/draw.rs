//! The chunk tree for people.

use crate::record::Chunk;

/// Draws the tree with the words of each chunk, and its rule when it has one.
pub fn draw_tree(text: &str, chunks: &[Chunk]) -> String {
    let mut lines = vec![text.to_string()];
    draw_level(text, chunks, "", &mut lines);
    lines.join("\n")
}

fn draw_level(text: &str, chunks: &[Chunk], indent: &str, lines: &mut Vec<String>) {
    for (i, chunk) in chunks.iter().enumerate() {
        let last = i + 1 == chunks.len();
        let words = text.get(chunk.start..chunk.end).unwrap_or("");
        let rule = chunk.rule.as_ref().map(|rule| format!("   ({rule})")).unwrap_or_default();
        lines.push(format!("{indent}{} {:5} {words}{rule}", if last { "└─" } else { "├─" }, chunk.tag.name()));
        draw_level(text, &chunk.chunks, &format!("{indent}{}", if last { "   " } else { "│  " }), lines);
    }
}
