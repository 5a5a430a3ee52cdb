//! English beyond the lexicon: thousands of nouns with a class, and what is a word at all.
//!
//! The lexicon says what the robot knows for sure; this says what an unknown noun most likely is (by WordNet's
//! hypernyms), and keeps spelling from mending words that are none to mend (by SCOWL's word lists). Both tables are
//! text in `corpus/vocabulary/`, made by its `build.py`, embedded, and searched as they are: nothing is parsed.
//!
//! It knows neither grammar nor the lexicon: who knows both weighs what was written down against what is inferred here.

mod noun_class;
mod plural;
mod sorted_lines;
mod spelling;

use std::borrow::Cow;
use std::sync::OnceLock;

pub use noun_class::NounClass;
pub use sorted_lines::DamagedTable;
use sorted_lines::SortedLines;
pub(super) use spelling::nearest;

/// A noun of the vocabulary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VocabularyNoun {
    /// Its singular in lower_snake.
    pub singular: &'static str,
    /// What it most likely names.
    pub class: NounClass,
}

/// Nouns with their classes, and the words of English.
#[derive(Clone, Copy, Debug)]
pub struct Vocabulary {
    nouns: SortedLines,
    english: SortedLines,
}

impl Vocabulary {
    /// The vocabulary this program ships.
    ///
    /// # Panics
    /// When the program was built with damaged tables: a robot that silently knows no nouns is worse than none.
    pub fn embedded() -> &'static Self {
        static EMBEDDED: OnceLock<Vocabulary> = OnceLock::new();
        EMBEDDED.get_or_init(|| {
            let nouns = include_str!("../../../corpus/vocabulary/nouns.tsv");
            let english = include_str!("../../../corpus/vocabulary/english.txt");
            Self::open(nouns, english).unwrap_or_else(|damage| panic!("{damage}"))
        })
    }

    /// A vocabulary over the text of its two tables.
    ///
    /// # Errors
    /// When a table is not as `build.py` wrote it.
    fn open(nouns: &'static str, english: &'static str) -> Result<Self, DamagedTable> {
        Ok(Self { nouns: SortedLines::open(nouns, "nouns")?, english: SortedLines::open(english, "english")? })
    }

    /// The noun that a name says as a whole, in the singular or the plural: "coffee_mugs", "knives".
    pub fn noun(&self, name: &str) -> Option<VocabularyNoun> {
        let name = &*lower_snake(name);
        self.entry(name).or_else(|| plural::singulars(name).find_map(|singular| self.entry(&singular)))
    }

    fn entry(&self, name: &str) -> Option<VocabularyNoun> {
        let (key, rest) = self.nouns.find(name)?;
        let (class, singular) = rest.split_once('\t').unwrap_or((rest, key));
        Some(VocabularyNoun { singular, class: NounClass::from_name(class)? })
    }

    /// What a noun most likely names, in lower_snake or as words. Of a compound that it does not have it knows the
    /// head: a "tea_mug" is what a mug is, a "tin_of_peanuts" what a tin is.
    pub fn class_of(&self, name: &str) -> Option<NounClass> {
        let name = lower_snake(name);
        let mut rest = name.split_once("_of_").map_or(&*name, |(head, _)| head);
        loop {
            if let Some(noun) = self.noun(rest) {
                return Some(noun.class);
            }
            rest = rest.split_once('_')?.1;
        }
    }

    /// "Is" or "are", as a name is said: "the mug is", "the keys are".
    pub fn copula(&self, name: &str) -> &'static str {
        if self.noun(name).is_some_and(|noun| noun.singular != name) { "are" } else { "is" }
    }

    /// Whether this is a word of English, British or American, inflected or not.
    pub fn is_english(&self, word: &str) -> bool {
        let word = lower_snake(word);
        self.english.find(&word).is_some() || self.noun(&word).is_some()
    }
}

/// In lower case, with underscores for spaces.
fn lower_snake(name: &str) -> Cow<'_, str> {
    if name.bytes().any(|c| c.is_ascii_uppercase() || c == b' ') {
        Cow::Owned(name.to_ascii_lowercase().replace(' ', "_"))
    } else {
        Cow::Borrowed(name)
    }
}

#[cfg(test)]
mod tests;
