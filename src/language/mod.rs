//! Text → tokens → phrases that mean something → chunk tree. Never sees a map.
//!
//! A pipeline of linear steps, each total: whatever comes in, a tree over the
//! input comes out.
//!
//! 1. [`tokens`]: words and where they stand.
//! 2. [`Lexicon`]: nouns with their classes, other words with their roles; data that a person can extend.
//! 3. [`units`]: the longest entries of the lexicon in the text; fillers and addressees set aside.
//! 4. `grammar`, `matching`, `chart`: the weighted grammar of `corpus/grammar/`, and the cheapest way to read the
//!    units as its phrases.
//! 5. [`Reading`]: phrases with their meaning, after corrections, exclusions and errands are settled.
//! 6. `tree`: phrases nested under the nine tags of [`Tag`](crate::record::Tag).

mod chart;
mod corrections;
mod draw;
mod errands;
mod grammar;
mod lexicon;
mod matching;
mod morphology;
mod noun_phrases;
mod numbers;
mod phrase;
mod phrases;
mod relations;
mod room_pick;
mod stage;
mod subjects;
pub mod tokens;
mod tree;
mod unit;
mod units;
mod vocabulary;
mod word_class;
mod zones;

pub use draw::draw_tree;
pub use lexicon::{Lexicon, LexiconError, Noun, lexicon_with};
pub use noun_phrases::{Article, NounPhrase, attributes_of, name_of};
pub use phrase::{Act, From, Kind, Phrase, Recipient};
pub use phrases::Reading;
pub use relations::Relation;
pub use room_pick::{RoomPick, is_lead};
pub use stage::Chunker;
pub use unit::{NounUnit, Unit};
pub use units::{tag as tag_words, units};
pub use vocabulary::{DamagedTable, NounClass, Vocabulary, VocabularyNoun};
pub use word_class::{Class, Role};

use std::ops::Range;

use crate::record::{Chunk, Token};
use tokens::Word;

/// An errand: its phrases by number, and those of them that pick its room, counted from its first.
pub type Errand = (Range<usize>, Option<RoomPick>);

/// The phrases of a text and its errands.
pub fn read<'t>(words: &[Word<'t>], lexicon: &'t Lexicon) -> (Reading<'t>, Vec<Errand>) {
    let mut reading = phrases::find(units(words, lexicon), lexicon);
    let ranges = errands::errands(&mut reading.phrases, &reading.units);
    let pick = |range: Range<usize>| {
        let picked = room_pick::pick(&reading.phrases[range.clone()], &reading.units);
        (range, picked)
    };
    let errands = ranges.into_iter().map(pick).collect();
    (reading, errands)
}

/// The phrases of words that may come from several places, and every noun phrase among them.
pub fn read_words<'t>(words: &[Word<'t>], lexicon: &'t Lexicon) -> (Reading<'t>, Vec<NounPhrase>) {
    let reading = phrases::find(units(words, lexicon), lexicon);
    let mut nouns = Vec::new();
    let mut at = 0;
    while at < reading.units.len() {
        match noun_phrases::noun_phrase(&reading.units, at) {
            Some(noun) => {
                at = noun.past;
                nouns.push(noun);
            }
            None => at += 1,
        }
    }
    (reading, nouns)
}

/// The chunk tree of a reading.
pub fn tree_of(reading: &Reading, errands: &[Errand], words: &[Word]) -> Vec<Chunk> {
    tree::build(errands, &reading.phrases, &reading.units, words)
}

/// Tokens and chunk tree of a description, by the embedded lexicon.
pub fn chunk_text(text: &str) -> (Vec<Token>, Vec<Chunk>) {
    chunk_with(text, Lexicon::embedded())
}

/// Tokens and chunk tree of a description.
pub fn chunk_with(text: &str, lexicon: &Lexicon) -> (Vec<Token>, Vec<Chunk>) {
    let words = tokens::tokenize(text);
    let (reading, errands) = read(&words, lexicon);
    let chunks = tree_of(&reading, &errands, &words);
    (units::tag(&words, &reading.units, lexicon), chunks)
}
