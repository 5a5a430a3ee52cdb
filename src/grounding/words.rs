//! The words of each chunk of a tree, in the order in which the tree is read.

use crate::language::tokens::{Word, tokenize};
use crate::record::{Chunk, Tag};

/// A chunk with its own words and its place in the tree.
#[derive(Clone, Debug)]
pub struct ChunkWords<'t> {
    /// The kind of phrase.
    pub tag: Tag,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// Index of the chunk around it.
    pub parent: Option<usize>,
    /// Indices of the chunks in it.
    pub children: Vec<usize>,
    /// Words that belong to it and to none of its children.
    pub words: Vec<Word<'t>>,
}

/// All chunks in pre-order. Spans that do not fit the text get no words.
pub fn chunk_words<'t>(text: &'t str, chunks: &[Chunk]) -> Vec<ChunkWords<'t>> {
    chunk_words_of(&tokenize(text), chunks)
}

/// The same for a text that has been tokenized.
pub fn chunk_words_of<'t>(words: &[Word<'t>], chunks: &[Chunk]) -> Vec<ChunkWords<'t>> {
    let mut all = Vec::new();
    // Own stack: a tree from outside may be deeper than the call stack.
    let mut waiting: Vec<(&Chunk, Option<usize>)> = chunks.iter().rev().map(|chunk| (chunk, None)).collect();
    while let Some((chunk, parent)) = waiting.pop() {
        let index = all.len();
        if let Some(parent) = parent {
            let parent: &mut ChunkWords = &mut all[parent];
            parent.children.push(index);
        }
        let from = words.partition_point(|word| word.start < chunk.start);
        let inside =
            |word: &&Word| !chunk.chunks.iter().any(|child| word.start >= child.start && word.end <= child.end);
        let own = words[from..].iter().take_while(|word| word.end <= chunk.end).filter(inside).cloned().collect();
        all.push(ChunkWords {
            tag: chunk.tag,
            start: chunk.start,
            end: chunk.end,
            parent,
            children: Vec::new(),
            words: own,
        });
        waiting.extend(chunk.chunks.iter().rev().map(|child| (child, Some(index))));
    }
    all
}

impl ChunkWords<'_> {
    /// The own words in lower case, joined by spaces.
    pub fn lower(&self) -> String {
        self.words.iter().map(|word| word.lower.as_ref()).collect::<Vec<_>>().join(" ")
    }
}
