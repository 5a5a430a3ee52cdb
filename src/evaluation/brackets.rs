//! Chunk trees as sets of labelled brackets over words, for precision and recall.

use std::collections::BTreeSet;

use crate::record::{Chunk, Tag};

/// A tag over words from the first to one past the last.
pub type Bracket = (Tag, usize, usize);

/// The brackets of a tree over the words of `text`, words being what spaces separate.
pub fn brackets_of(text: &str, chunks: &[Chunk]) -> BTreeSet<Bracket> {
    let words = word_spans(text);
    let mut found = BTreeSet::new();
    let mut waiting: Vec<&Chunk> = chunks.iter().collect();
    while let Some(chunk) = waiting.pop() {
        let first = words.partition_point(|(start, _)| *start < chunk.start);
        let past = words.partition_point(|(_, end)| *end <= chunk.end);
        if first < past {
            found.insert((chunk.tag, first, past));
        }
        waiting.extend(&chunk.chunks);
    }
    found
}

/// First byte and one past the last of each word.
fn word_spans(text: &str) -> Vec<(usize, usize)> {
    let offset = |word: &str| word.as_ptr() as usize - text.as_ptr() as usize;
    text.split_whitespace().map(|word| (offset(word), offset(word) + word.len())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_count_words() {
        let inner = Chunk { tag: Tag::Furtp, start: 11, end: 16, rule: None, chunks: Vec::new() };
        let outer = Chunk { tag: Tag::Obtp, start: 0, end: 16, rule: None, chunks: vec![inner] };
        let found = brackets_of("the mug is on it", &[outer]);
        assert_eq!(found, BTreeSet::from([(Tag::Obtp, 0, 5), (Tag::Furtp, 3, 5)]));
    }
}
