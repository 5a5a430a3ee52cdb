//! A unit: an entry of the lexicon as it stands in the text.

use std::borrow::Cow;

use super::word_class::{Class, Role, Roles};

/// One entry of the lexicon as it stands in the text, or a word it does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit<'t> {
    /// First word, by number.
    pub first: usize,
    /// One past the last word.
    pub past: usize,
    /// Its words in lower case, joined by spaces; what was meant where a spelling was mended.
    pub lower: Cow<'t, str>,
    /// The noun it names, when it can be one.
    pub noun: Option<NounUnit<'t>>,
    /// How the grammar may use it.
    pub roles: Roles,
    /// Punctuation that ends a sentence.
    pub stop: bool,
    /// A comma or a dash stands before it.
    pub pause: bool,
    /// The number it is.
    pub number: Option<f64>,
    /// It was written otherwise.
    pub mended: bool,
    /// A word of English that is neither in the lexicon nor the name of a thing: it describes, or does.
    pub foreign: bool,
    /// It was written with a capital, and not because a sentence begins.
    pub capital: bool,
}

/// A noun as it stands in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NounUnit<'t> {
    /// Name in lower_snake, singular.
    pub name: &'t str,
    /// What kind of thing it is.
    pub class: Class,
    /// Said in the plural.
    pub plural: bool,
    /// The class was inferred from a list of English nouns, not written down in the lexicon.
    pub inferred: bool,
}

impl Unit<'_> {
    /// Whether it may have that role.
    pub fn has(&self, role: Role) -> bool {
        self.roles.has(role)
    }

    /// The class, of a noun.
    pub fn class(&self) -> Option<Class> {
        self.noun.map(|noun| noun.class)
    }

    /// Whether nothing is known of it.
    pub fn is_unknown(&self) -> bool {
        self.noun.is_none() && self.roles.is_empty() && !self.stop
    }
}
