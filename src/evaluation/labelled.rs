//! Trees as a person writes them: `[OBTP=mug the mug is [ORMTP in the bedroom [ORMRP=left on the left]]]`.
//!
//! Brackets over the words of the text; after `=` the chunk's own label: a
//! side or a room for ORMTP and ORMRP, a noun for FURTP and OBTP,
//! `reference/direction` (several with commas) for the others.

use crate::record::{Chunk, Tag};

/// A chunk with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledChunk {
    /// The kind of phrase.
    pub tag: Tag,
    /// What stands after `=`.
    pub label: Option<String>,
    /// First byte in the text.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// Chunks inside.
    pub children: Vec<LabelledChunk>,
}

/// A text with its tree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabelledTree {
    /// The words, joined by single spaces.
    pub text: String,
    /// The chunks.
    pub chunks: Vec<LabelledChunk>,
}

/// A tree that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`tree`, byte {offset}: {message}")]
pub struct TreeError {
    /// Byte in the tree's text.
    pub offset: usize,
    /// What is wrong.
    pub message: String,
}

/// Reads a tree.
///
/// # Errors
/// When brackets do not match, a tag is none, or labels are not of the form, with the column.
pub fn parse_tree(tree: &str) -> Result<LabelledTree, TreeError> {
    let mut result = LabelledTree::default();
    let mut open: Vec<LabelledChunk> = Vec::new();
    for (offset, token) in pieces(tree) {
        let wrong = |message: String| TreeError { offset, message };
        if let Some(head) = token.strip_prefix('[') {
            let (name, label) =
                head.split_once('=').map_or((head, None), |(name, label)| (name, Some(label.to_string())));
            let tag = Tag::from_name(name).ok_or_else(|| wrong(format!("`{name}` is no tag")))?;
            let start = result.text.len() + usize::from(!result.text.is_empty());
            open.push(LabelledChunk { tag, label, start, end: start, children: Vec::new() });
        } else if token == "]" {
            let mut chunk = open.pop().ok_or_else(|| wrong("a bracket closes that was not opened".to_string()))?;
            chunk.end = result.text.len();
            if chunk.end <= chunk.start {
                return Err(wrong("a chunk without words".to_string()));
            }
            open.last_mut().map_or(&mut result.chunks, |parent| &mut parent.children).push(chunk);
        } else {
            if !result.text.is_empty() {
                result.text.push(' ');
            }
            result.text.push_str(token);
        }
    }
    match open.is_empty() {
        true => Ok(result),
        false => Err(TreeError { offset: tree.len(), message: "a bracket is not closed".to_string() }),
    }
}

/// Opening brackets with their head, closing brackets, and words.
fn pieces(tree: &str) -> Vec<(usize, &str)> {
    let mut pieces = Vec::new();
    let mut start = None;
    let mut flush = |start: &mut Option<usize>, end: usize| {
        if let Some(from) = start.take() {
            pieces.push((from, &tree[from..end]));
        }
    };
    for (at, c) in tree.char_indices() {
        match c {
            ' ' => flush(&mut start, at),
            '[' => {
                flush(&mut start, at);
                start = Some(at);
            }
            ']' => {
                flush(&mut start, at);
                start = Some(at);
                flush(&mut start, at + 1);
            }
            _ => {
                start.get_or_insert(at);
            }
        }
    }
    flush(&mut start, tree.len());
    pieces
}

impl LabelledChunk {
    /// The chunk as records have it.
    pub fn to_chunk(&self) -> Chunk {
        let chunks = self.children.iter().map(Self::to_chunk).collect();
        Chunk { tag: self.tag, start: self.start, end: self.end, rule: None, chunks }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_spans_and_labels_are_read() {
        let tree = parse_tree("um [OBTP=mug the mug is [FURTP=table on it]] ok").expect("a tree");
        assert_eq!(tree.text, "um the mug is on it ok");
        let chunk = &tree.chunks[0];
        assert_eq!(&tree.text[chunk.start..chunk.end], "the mug is on it");
        assert_eq!(chunk.label.as_deref(), Some("mug"));
        assert_eq!(&tree.text[chunk.children[0].start..chunk.children[0].end], "on it");
    }

    #[test]
    fn what_is_wrong_is_located() {
        assert_eq!(parse_tree("a ]").expect_err("closed").offset, 2);
        assert_eq!(parse_tree("[XYZ a]").expect_err("no tag").message, "`XYZ` is no tag");
        assert!(parse_tree("[OBTP a").is_err() && parse_tree("[OBTP ] a").is_err());
    }
}
