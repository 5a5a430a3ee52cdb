//! The longest entries of the lexicon in the text, fillers set aside.

use std::borrow::Cow;

use super::lexicon::Lexicon;
use super::tokens::Word;
use super::word_class::{Class, Role};
use crate::record::Token;

/// One entry of the lexicon as it stands in the text, or a word it does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit<'t> {
    /// First word, by number.
    pub first: usize,
    /// One past the last word.
    pub past: usize,
    /// Its words in lower case, joined by spaces.
    pub lower: Cow<'t, str>,
    /// What it is.
    pub kind: UnitKind<'t>,
}

/// What a unit is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UnitKind<'t> {
    /// A noun: canonical name and class.
    Noun(&'t str, Class),
    /// Another known word.
    Word(Role),
    /// Punctuation that ends a clause.
    Stop,
    /// A word the lexicon does not have.
    Unknown,
}

impl Unit<'_> {
    /// The role, of a known word that is no noun.
    pub fn role(&self) -> Option<Role> {
        match self.kind {
            UnitKind::Word(role) => Some(role),
            _ => None,
        }
    }

    /// The class, of a noun.
    pub fn class(&self) -> Option<Class> {
        match self.kind {
            UnitKind::Noun(_, class) => Some(class),
            _ => None,
        }
    }
}

/// The units of a text without fillers, addressees and light punctuation; linear in its length.
pub fn units<'l>(words: &[Word<'l>], lexicon: &'l Lexicon) -> Vec<Unit<'l>> {
    let mut units: Vec<Unit> = Vec::with_capacity(words.len());
    let mut at = 0;
    while at < words.len() {
        let unit = longest(words, at, lexicon);
        at = unit.past;
        if !is_set_aside(&unit, units.last()) {
            units.push(unit);
        }
    }
    settle_ambiguous(&mut units);
    units
}

fn longest<'l>(words: &[Word<'l>], at: usize, lexicon: &'l Lexicon) -> Unit<'l> {
    let most = lexicon.longest_name_from(&words[at].lower).min(words.len() - at);
    for count in (2..=most).rev() {
        let joined = words[at..at + count].iter().map(|word| word.lower.as_ref()).collect::<Vec<_>>().join(" ");
        if let Some(noun) = lexicon.noun(&joined) {
            let kind = UnitKind::Noun(&noun.name, noun.class);
            return Unit { first: at, past: at + count, lower: Cow::Owned(joined), kind };
        }
    }
    let before = at.checked_sub(1).map_or("", |before| words[before].lower.as_ref());
    let mut lower = words[at].lower.clone();
    let mut kind = kind_of(&lower, before, lexicon);
    if kind == UnitKind::Unknown
        && let Some(meant) = lexicon.spelling(&lower)
    {
        lower = Cow::Borrowed(meant);
        kind = kind_of(&lower, before, lexicon);
    }
    Unit { first: at, past: at + 1, lower, kind }
}

/// Words after which a noun may stand: only there is a misspelt noun looked for.
const BEFORE_NOUN: [&str; 16] = [
    "the", "a", "an", "my", "your", "his", "her", "their", "our", "its", "this", "that", "two", "small", "little",
    "big",
];

fn kind_of<'l>(lower: &str, before: &str, lexicon: &'l Lexicon) -> UnitKind<'l> {
    if let Some((_, role)) = lexicon.word(lower) {
        return UnitKind::Word(role);
    }
    if let Some(noun) = lexicon.noun(lower) {
        return UnitKind::Noun(&noun.name, noun.class);
    }
    if lower.bytes().all(|c| c.is_ascii_digit()) {
        return UnitKind::Word(Role::Number);
    }
    if matches!(lower, "." | "!" | "?" | ";") {
        return UnitKind::Stop;
    }
    let misspelt = BEFORE_NOUN.contains(&before).then(|| lexicon.nearest_noun(lower)).flatten();
    misspelt.map_or(UnitKind::Unknown, |noun| UnitKind::Noun(&noun.name, noun.class))
}

/// Fillers say nothing; an addressee does only in "brian 's left", where the clitic goes with it.
fn is_set_aside(unit: &Unit, before: Option<&Unit>) -> bool {
    let light = unit.kind == UnitKind::Unknown && !unit.lower.chars().any(char::is_alphanumeric);
    let addressee_clitic = unit.lower == "'s" && before.is_none();
    // "The the table": a stumble.
    let again = before.is_some_and(|before| before.past == unit.first && before.lower == unit.lower);
    light || addressee_clitic || again || matches!(unit.role(), Some(Role::Filler | Role::Addressee))
}

/// Words after which "right" only strengthens: "right on the table", "right behind".
const AFTER_EMPHASIS: [&str; 22] = [
    "on", "in", "at", "behind", "next", "by", "near", "up", "when", "there", "beside", "inside", "ahead", "against",
    "past", "where", "before", "after", "as", "here", "now", "beyond",
];

/// "right on the table" is emphasis; "i left my keys" is a verb.
fn settle_ambiguous(units: &mut [Unit]) {
    for i in 0..units.len() {
        settle_homophone(units, i);
        let side = matches!(units[i].lower.as_ref(), "right" | "left");
        if !side {
            continue;
        }
        let before = i.checked_sub(1).map(|before| &units[before]);
        let next = units.get(i + 1).map_or("", |unit| unit.lower.as_ref());
        let leads = before.and_then(Unit::role).is_some_and(|role| BEFORE_SIDE.contains(&role));
        let after_subject =
            before.is_some_and(|unit| matches!(unit.lower.as_ref(), "i" | "we" | "he" | "she" | "they"));
        if units[i].lower == "right" && !leads && AFTER_EMPHASIS.contains(&next) {
            units[i].kind = UnitKind::Word(Role::Adverb);
        } else if units[i].lower == "left" && after_subject {
            units[i].kind = UnitKind::Word(Role::Bring);
        }
    }
}

/// "Two the left" is "to the left"; "their is" is "there is".
fn settle_homophone(units: &mut [Unit], i: usize) {
    let next = units.get(i + 1).and_then(Unit::role);
    let meant = match (units[i].lower.as_ref(), next) {
        ("two", Some(Role::Determiner | Role::Hearer)) => ("to", Role::Preposition),
        ("their", Some(Role::Copula | Role::Modal)) => ("there", Role::There),
        _ => return,
    };
    units[i].lower = Cow::Borrowed(meant.0);
    units[i].kind = UnitKind::Word(meant.1);
}

/// Words after which "right" is a side.
const BEFORE_SIDE: [Role; 8] = [
    Role::Determiner,
    Role::Hearer,
    Role::Turn,
    Role::Motion,
    Role::Look,
    Role::Preposition,
    Role::Adjective,
    Role::Part,
];

/// Part-of-speech tags for all words: from the lexicon, else by the word's look.
pub fn tag(words: &[Word], units: &[Unit], lexicon: &Lexicon) -> Vec<Token> {
    let mut tags: Vec<&str> = words.iter().map(|word| guess(word, lexicon)).collect();
    for unit in units {
        if let UnitKind::Noun(_, class) = unit.kind {
            tags[unit.first..unit.past].fill(noun_tag(class));
        }
    }
    let token = |(word, pos): (&Word, &str)| Token {
        text: word.text.to_string(),
        pos: pos.to_string(),
        start: word.start,
        end: word.end,
    };
    words.iter().zip(tags).map(token).collect()
}

fn noun_tag(class: Class) -> &'static str {
    match class {
        Class::Room => "RM",
        Class::Wall | Class::Opening | Class::Structure | Class::Part => "STR",
        Class::Object => "NN",
        _ => "FUR",
    }
}

fn guess<'l>(word: &Word, lexicon: &'l Lexicon) -> &'l str {
    if let Some((pos, _)) = lexicon.word(&word.lower) {
        return pos;
    }
    let lower = word.lower.as_ref();
    match lower {
        _ if !lower.chars().any(char::is_alphanumeric) => ".",
        _ if lower.chars().all(|c| c.is_ascii_digit()) => "CD",
        _ if lower.ends_with("ing") => "VBG",
        _ if lower.ends_with("ed") => "VBN",
        _ if lower.ends_with("ly") => "RB",
        _ if lower.ends_with('s') && lower.len() > 3 => "NNS",
        _ => "NN",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::tokens::tokenize;

    fn lowers(text: &str) -> Vec<String> {
        units(&tokenize(text), Lexicon::embedded()).into_iter().map(|unit| unit.lower.into_owned()).collect()
    }

    #[test]
    fn the_longest_name_wins_and_fillers_are_set_aside() {
        assert_eq!(lowers("um the coffee table , ok"), ["the", "coffee table"]);
    }

    #[test]
    fn right_before_a_preposition_is_emphasis_unless_a_turn_leads_to_it() {
        let role = |text: &str| {
            let words = tokenize(text);
            units(&words, Lexicon::embedded()).iter().find(|u| u.lower == "right").and_then(Unit::role)
        };
        assert_eq!(role("it is right on the table"), Some(Role::Adverb));
        assert_eq!(role("turn right at the door"), Some(Role::Side));
        assert_eq!(role("on the right by the bed"), Some(Role::Side));
    }

    #[test]
    fn keys_that_were_left_are_no_direction() {
        let words = tokenize("i left my keys");
        assert_eq!(units(&words, Lexicon::embedded())[1].role(), Some(Role::Bring));
    }
}
