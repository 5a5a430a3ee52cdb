//! A tree as text: `(S (ORMTP go/VB (ORMRP left/DIR)) and/CC)`.

use super::super::treebank::{TokenChunk, TokenEntry, tag_of};
use crate::limits::TREE_DEPTH;

/// A tree as it is read word by word.
#[derive(Default)]
pub(super) struct TreeBuilder {
    entry: TokenEntry,
    /// Chunks that are open: their index, none for brackets that are no chunk.
    open: Vec<Option<usize>>,
    /// How many of them are chunks.
    depth: usize,
}

impl TreeBuilder {
    /// Opens a bracket; one whose name is no chunk tag only groups words.
    ///
    /// # Errors
    /// When brackets stand deeper in each other than a tree may be.
    pub fn open(&mut self, name: &str) -> Result<(), String> {
        TREE_DEPTH.check(self.open.len() + 1)?;
        let index = tag_of(name).map(|tag| {
            let (at, depth) = (self.entry.tokens.len(), self.depth);
            self.depth += 1;
            self.entry.chunks.push(TokenChunk { tag: tag.name().to_string(), start: at, end: at, depth });
            self.entry.chunks.len() - 1
        });
        self.open.push(index);
        Ok(())
    }

    /// Closes the last bracket; false when none is open.
    pub fn close(&mut self) -> bool {
        let Some(index) = self.open.pop() else { return false };
        if let Some(index) = index {
            self.depth -= 1;
            self.entry.chunks[index].end = self.entry.tokens.len();
        }
        true
    }

    /// Adds a word, with its part of speech behind a slash unless `pos` gives it.
    pub fn word(&mut self, word: &str, pos: Option<&str>) {
        let (word, tag) = match (pos, word.rsplit_once('/')) {
            (Some(pos), _) => (word, pos),
            (None, Some((word, pos))) if !word.is_empty() => (word, pos),
            _ => (word, ""),
        };
        self.entry.tokens.push((word.to_string(), tag.to_string()));
    }

    /// Adds text: words, and brackets where there are any.
    ///
    /// # Errors
    /// When a bracket closes that was not opened, or a tag is none.
    pub fn text(&mut self, text: &str) -> Result<(), String> {
        let spaced = text.replace('(', " ( ").replace(')', " ) ");
        let mut pieces = spaced.split_whitespace();
        while let Some(piece) = pieces.next() {
            match piece {
                "(" => self.open(pieces.next().ok_or("a bracket opens at the end")?)?,
                ")" if !self.close() => return Err("a bracket closes that was not opened".to_string()),
                ")" => {}
                word => self.word(word, None),
            }
        }
        Ok(())
    }

    /// The tree, without chunks that hold no word.
    ///
    /// # Errors
    /// When a bracket is left open.
    pub fn finish(mut self) -> Result<TokenEntry, String> {
        if !self.open.is_empty() {
            return Err("a bracket is not closed".to_string());
        }
        self.entry.chunks.retain(|chunk| chunk.end > chunk.start);
        self.entry.text = self.entry.tokens.iter().map(|(word, _)| word.as_str()).collect::<Vec<_>>().join(" ");
        Ok(self.entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_words_and_parts_of_speech_are_read() {
        let mut tree = TreeBuilder::default();
        tree.text("(S (ORMTP roll/VB (ORMRP left/DIR)) and/CC)").expect("a tree");
        let entry = tree.finish().expect("closed");
        assert_eq!(entry.text, "roll left and");
        assert_eq!(entry.tokens[1], ("left".to_string(), "DIR".to_string()));
        let chunks: Vec<_> = entry.chunks.iter().map(|c| (c.tag.as_str(), c.start, c.end, c.depth)).collect();
        assert_eq!(chunks, [("ORMTP", 0, 2, 0), ("ORMRP", 1, 2, 1)]);
    }

    #[test]
    fn brackets_that_do_not_match_are_refused() {
        assert!(TreeBuilder::default().text("roll )").is_err());
        let mut open = TreeBuilder::default();
        open.text("(S roll").expect("read");
        assert!(open.finish().is_err());
    }
}
