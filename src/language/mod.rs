//! Text → tokens → part-of-speech tags → phrases → chunk tree. Never sees a map.
//!
//! A pipeline of small, linear steps, each total: whatever comes in, a tree
//! over the input comes out.
//!
//! 1. [`tokens`]: words and where they stand.
//! 2. [`lexicon`](Lexicon): nouns with their classes, other words with their roles; data that a person can extend.
//!    Behind it stands the [`Vocabulary`]: what is a word of English, and what an unknown noun most likely names.
//! 3. `units`: the longest entries of the lexicon in the text; fillers and addressees set aside.
//! 4. `phrases`: finite-state patterns over units: moves, turns, rooms, places, furniture, objects.
//! 5. `tree`: phrases nested under the nine tags of [`Tag`](crate::record::Tag).

mod corrections;
pub(crate) mod cursor;
mod draw;
mod lexicon;
mod motion_phrases;
mod object_phrases;
mod phrases;
mod place_phrases;
mod room_pick;
mod stage;
pub mod tokens;
mod tree;
mod units;
mod vocabulary;
mod word_class;

pub use cursor::{Relation, leading_relation};
pub use draw::draw_tree;
pub use lexicon::{Classified, Lexicon, LexiconError, Noun, lexicon_with};
pub use stage::Chunker;
pub use units::{Unit, UnitKind, tag as tag_words, units};
pub use vocabulary::{DamagedTable, NounClass, Vocabulary, VocabularyNoun};
pub use word_class::{Class, Role};

use crate::record::{Chunk, Token};

/// Tokens and chunk tree of a description, by the embedded lexicon.
pub fn chunk_text(text: &str) -> (Vec<Token>, Vec<Chunk>) {
    chunk_with(text, Lexicon::embedded())
}

/// Tokens and chunk tree of a description.
pub fn chunk_with(text: &str, lexicon: &Lexicon) -> (Vec<Token>, Vec<Chunk>) {
    let words = tokens::tokenize(text);
    let units = units(&words, lexicon);
    let phrases = phrases::find(&units);
    let chunks = tree::build(&phrases, &units, &words);
    (units::tag(&words, &units, lexicon), chunks)
}
