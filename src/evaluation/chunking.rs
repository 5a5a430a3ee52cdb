//! The chunker against gold trees: labelled brackets, path labels, whole trees, the side of the room.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;
use serde::Serialize;

use super::grounding::said_side;
use super::{Bracket, Gold, Rate, brackets_of};
use crate::grounding::{Grounder, Method};
use crate::language::chunk_text;
use crate::record::{Direction, Rounded, Tag};

/// The scores of one corpus.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ChunkingScores {
    /// What was read.
    pub corpus: String,
    /// Descriptions with a tree.
    pub descriptions: usize,
    /// Labelled brackets, all tags together.
    pub brackets: TagScores,
    /// Words whose path of tags from the root is right.
    pub path_labels: Rate,
    /// Whole trees right.
    pub exact_trees: Rate,
    /// The side of the room, where the gold tree has exactly one of left and right under ORMTP and ORMRP.
    pub room_side: Rate,
    /// Labelled brackets by tag.
    pub by_tag: BTreeMap<String, TagScores>,
}

/// Labelled brackets: how many of those made are in gold, how many of gold were made.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct TagScores {
    /// Of those made.
    pub precision: Rate,
    /// Of those in gold.
    pub recall: Rate,
    /// Their harmonic mean.
    pub f1: Rounded,
}

impl TagScores {
    fn count(&mut self, gold: &BTreeSet<Bracket>, made: &BTreeSet<Bracket>, fits: impl Fn(Tag) -> bool) {
        gold.iter().filter(|(tag, _, _)| fits(*tag)).for_each(|bracket| self.recall.count(made.contains(bracket)));
        made.iter().filter(|(tag, _, _)| fits(*tag)).for_each(|bracket| self.precision.count(gold.contains(bracket)));
        let all = self.recall.of + self.precision.of;
        self.f1 = Rounded(2.0 * self.recall.hit as f64 / all.max(1) as f64);
    }
}

/// Chunks every text of `gold` that has a tree, and counts.
pub fn score_chunking(corpus: &str, gold: &[Gold]) -> ChunkingScores {
    let gold: Vec<&Gold> = gold.iter().filter(|gold| !gold.brackets.is_empty()).collect();
    let grounder = Grounder::new(Method::Composed, true);
    let read = |gold: &&Gold| {
        let (tokens, chunks) = chunk_text(&gold.text);
        let side = said_side(&grounder.ground(&gold.text, &tokens, &chunks));
        (brackets_of(&gold.text, &chunks), side)
    };
    let made: Vec<(BTreeSet<Bracket>, Option<Direction>)> = gold.par_iter().map(read).collect();
    let mut scores = ChunkingScores { corpus: corpus.to_string(), ..ChunkingScores::default() };
    for (gold, (made, side)) in gold.iter().zip(&made) {
        scores.add(gold, made, *side);
    }
    scores
}

impl ChunkingScores {
    fn add(&mut self, gold: &Gold, made: &BTreeSet<Bracket>, side: Option<Direction>) {
        self.descriptions += 1;
        self.brackets.count(&gold.brackets, made, |_| true);
        for tag in Tag::ALL {
            let scores = self.by_tag.entry(tag.name().to_string()).or_default();
            scores.count(&gold.brackets, made, |other| other == tag);
        }
        self.exact_trees.count(gold.brackets == *made);
        for word in 0..gold.text.split_whitespace().count() {
            self.path_labels.count(path(&gold.brackets, word) == path(made, word));
        }
        if let Some(expected) = only_side(gold) {
            self.room_side.count(side == Some(expected));
        }
    }
}

/// The tags around a word, outermost first.
fn path(brackets: &BTreeSet<Bracket>, word: usize) -> Vec<Tag> {
    let mut around: Vec<&Bracket> =
        brackets.iter().filter(|(_, first, past)| (*first..*past).contains(&word)).collect();
    around.sort_by_key(|(tag, first, past)| (*first, std::cmp::Reverse(*past), *tag));
    around.into_iter().map(|(tag, _, _)| *tag).collect()
}

/// Left or right, when just one of them stands in the chunks about the room.
fn only_side(gold: &Gold) -> Option<Direction> {
    let words: Vec<String> = gold.text.split_whitespace().map(str::to_lowercase).collect();
    let about_room = gold.brackets.iter().filter(|(tag, _, _)| matches!(tag, Tag::Ormrp | Tag::Ormtp));
    let said: Vec<&String> =
        about_room.flat_map(|(_, first, past)| words.get(*first..*past).unwrap_or_default()).collect();
    let says = |side: &str| said.iter().any(|word| *word == side);
    match (says("left"), says("right")) {
        (true, false) => Some(Direction::Left),
        (false, true) => Some(Direction::Right),
        _ => None,
    }
}

/// The table for people.
pub fn chunking_table(scores: &ChunkingScores) -> String {
    let mut lines = vec![format!("{}: {} descriptions with a tree", scores.corpus, scores.descriptions)];
    lines.push(format!("{:<16}{:>24}{:>24}{:>8}", "", "precision", "recall", "F1"));
    let row = |name: &str, tag: &TagScores| {
        format!("{name:<16}{:>24}{:>24}{:>8.3}", cell(tag.precision), cell(tag.recall), tag.f1.0)
    };
    lines.push(row("all brackets", &scores.brackets));
    lines.extend(scores.by_tag.iter().map(|(tag, scores)| row(tag, scores)));
    lines.push(format!("{:<16}{}", "path labels", scores.path_labels));
    lines.push(format!("{:<16}{}", "exact trees", scores.exact_trees));
    lines.push(format!("{:<16}{}", "side of room", scores.room_side));
    lines.join("\n")
}

fn cell(rate: Rate) -> String {
    format!("{:.3} ({}/{})", rate.share(), rate.hit, rate.of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::read_gold;

    #[test]
    fn a_tree_made_from_gold_itself_is_exact_and_another_is_not() {
        let text = include_str!("../../corpus/templates.jsonl").lines().take(1).collect::<String>();
        let gold = read_gold(&text, "t").expect("gold").remove(0);
        let mut scores = ChunkingScores::default();
        scores.add(&gold, &gold.brackets, gold.side);
        assert_eq!((scores.exact_trees.hit, scores.brackets.f1.0), (1, 1.0));
        assert_eq!(scores.path_labels.hit, gold.text.split_whitespace().count());
        scores.add(&gold, &BTreeSet::new(), None);
        assert_eq!((scores.exact_trees.hit, scores.room_side.of, scores.room_side.hit), (1, 2, 1));
        assert_eq!(scores.brackets.precision.of, gold.brackets.len());
    }

    #[test]
    fn a_path_names_the_tags_from_the_outermost_in() {
        let brackets = BTreeSet::from([(Tag::Ormrp, 2, 4), (Tag::Ormtp, 0, 4)]);
        assert_eq!(path(&brackets, 3), [Tag::Ormtp, Tag::Ormrp]);
        assert!(path(&brackets, 4).is_empty());
    }
}
