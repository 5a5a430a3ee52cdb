//! The longest entries of the lexicon in the text, fillers set aside.
//!
//! A unit may be several things at once: "light" is an adjective and a noun,
//! "left" a side and a verb. Which it is, the grammar settles.

use std::borrow::Cow;

use super::lexicon::Lexicon;
use super::numbers;
use super::tokens::Word;
use super::unit::{NounUnit, Unit};
use super::vocabulary::Vocabulary;
use super::word_class::{Class, Role, Roles};
use crate::record::Token;

/// The units of a text without fillers, addressees and light punctuation; linear in its length.
pub fn units<'l>(words: &[Word<'l>], lexicon: &'l Lexicon) -> Vec<Unit<'l>> {
    let mut units: Vec<Unit> = Vec::with_capacity(words.len() + 4);
    let mut pause = false;
    let mut at = 0;
    while at < words.len() {
        if is_pause(&words[at].lower) {
            pause = true;
            at += 1;
            continue;
        }
        let mut unit = longest(words, at, lexicon);
        at = unit.past;
        unit.pause = pause && !units.is_empty();
        let begins = units.last().is_none_or(|last| last.stop);
        unit.capital = !begins && words[unit.first].text.starts_with(char::is_uppercase);
        // "Ms. Ortiz": the point ends no sentence.
        if is_title(&unit.lower) && at < words.len() {
            at += usize::from(words[at].lower == ".");
            if at < words.len() {
                unit.lower = Cow::Owned(format!("{} {}", unit.lower, words[at].lower));
                at += 1;
                (unit.past, unit.capital, unit.noun, unit.foreign) = (at, true, None, false);
            }
        }
        if joins_number(&mut units, &unit) || is_set_aside(&unit, units.last()) {
            continue;
        }
        pause = false;
        push_split(&mut units, unit, lexicon);
    }
    settle_ambiguous(&mut units);
    units
}

fn is_title(lower: &str) -> bool {
    matches!(lower, "mr" | "mrs" | "ms" | "dr" | "prof")
}

fn is_pause(lower: &str) -> bool {
    matches!(lower, "," | "-" | "–" | "—" | ":" | "(" | ")" | "…" | "/")
}

/// What a word is by itself.
#[derive(Clone, Copy, Default)]
struct Known<'l> {
    noun: Option<NounUnit<'l>>,
    roles: Roles,
    stop: bool,
    number: Option<f64>,
}

fn known<'l>(lower: &str, lexicon: &'l Lexicon) -> Option<Known<'l>> {
    if matches!(lower, "." | "!" | "?" | ";") {
        return Some(Known { stop: true, ..Known::default() });
    }
    let entry = lexicon.word(lower);
    let roles = entry.map_or(Roles::default(), |entry| entry.roles);
    // A verb or an adjective that is no plural by itself: "cans" is one of "can", "does" none of "doe".
    let noun = match entry {
        Some(_) => lexicon.noun(lower).map(|noun| (noun, is_plural_of(lower, &noun.name))),
        None => lexicon.any_number(lower),
    };
    let noun = noun.map(|(noun, plural)| NounUnit { name: &noun.name, class: noun.class, plural, inferred: false });
    let noun = noun.or_else(|| entry.is_none().then(|| lexicon.inferred(lower)).flatten());
    let number = numbers::value(lower);
    let roles = if number.is_some() { roles.with(Roles::of(Role::Number)) } else { roles };
    (noun.is_some() || !roles.is_empty()).then_some(Known { noun, roles, stop: false, number })
}

/// "Batteries" is a way to write "battery", and more than one.
fn is_plural_of(lower: &str, name: &str) -> bool {
    lower.ends_with('s') && !name.ends_with('s')
}

fn unit<'l>(lower: Cow<'l, str>, known: Known<'l>, mended: bool) -> Unit<'l> {
    let Known { noun, roles, stop, number } = known;
    Unit { first: 0, past: 0, lower, noun, roles, stop, pause: false, number, mended, foreign: false, capital: false }
}

/// "Theres" is two words written as one.
fn push_split<'l>(units: &mut Vec<Unit<'l>>, whole: Unit<'l>, lexicon: &'l Lexicon) {
    let Cow::Borrowed(lower) = whole.lower else { return units.push(whole) };
    let Some((one, other)) = lower.split_once(' ').filter(|_| whole.past == whole.first + 1 && whole.mended) else {
        return units.push(whole);
    };
    for (part, pause) in [(one, whole.pause), (other, false)] {
        let mut half = unit(Cow::Borrowed(part), known(part, lexicon).unwrap_or_default(), false);
        (half.first, half.past, half.pause) = (whole.first, whole.past, pause);
        units.push(half);
    }
}

/// "Forty five" is one number.
fn joins_number(units: &mut [Unit], unit: &Unit) -> bool {
    let Some(last) = units.last_mut().filter(|last| last.past == unit.first) else { return false };
    let joined = last.number.zip(unit.number).and_then(|(before, next)| numbers::joined(before, next));
    if let Some(value) = joined {
        last.number = Some(value);
        last.past = unit.past;
    }
    joined.is_some()
}

fn longest<'l>(words: &[Word<'l>], at: usize, lexicon: &'l Lexicon) -> Unit<'l> {
    let most = lexicon.longest_name_from(&words[at].lower).min(words.len() - at);
    for count in (2..=most).rev() {
        let joined = words[at..at + count].iter().map(|word| word.lower.as_ref()).collect::<Vec<_>>().join(" ");
        if let Some((noun, plural)) = lexicon.any_number(&joined) {
            let noun = Some(NounUnit { name: &noun.name, class: noun.class, plural, inferred: false });
            let known = Known { noun, ..Known::default() };
            return Unit { first: at, past: at + count, ..unit(Cow::Owned(joined), known, false) };
        }
    }
    let lower = &words[at].lower;
    let (meant, found, mended) = match known(lower, lexicon) {
        Some(found) => (lower.clone(), found, false),
        None => otherwise(lower, lexicon).unwrap_or_else(|| (lower.clone(), Known::default(), false)),
    };
    let nothing = found.noun.is_none() && found.roles.is_empty() && !found.stop;
    let foreign = nothing && Vocabulary::embedded().is_english(&meant);
    Unit { first: at, past: at + 1, foreign, ..unit(meant, found, mended) }
}

/// A word that the lexicon has under another spelling: with a space for a hyphen, as listed, or one slip away.
fn otherwise<'l>(lower: &str, lexicon: &'l Lexicon) -> Option<(Cow<'l, str>, Known<'l>, bool)> {
    if lower.contains('-') || lower.contains('_') {
        // "Tooth-brush", "arm-chair": written as one word.
        let joined = lower.replace(['-', '_'], "");
        let whole = lexicon.any_number(&joined).map(|(noun, plural)| NounUnit {
            name: &noun.name,
            class: noun.class,
            plural,
            inferred: false,
        });
        if let Some(noun) = whole.or_else(|| lexicon.inferred(&joined)) {
            return Some((Cow::Owned(joined), Known { noun: Some(noun), ..Known::default() }, false));
        }
        let spaced = lower.replace(['-', '_'], " ");
        let found = lexicon.any_number(&spaced).map(|(noun, plural)| NounUnit {
            name: &noun.name,
            class: noun.class,
            plural,
            inferred: false,
        });
        if found.is_some() {
            return Some((Cow::Owned(spaced), Known { noun: found, ..Known::default() }, false));
        }
        let last = lower.rsplit('-').next().unwrap_or("");
        // "Sand-colored", "three-legged": describes.
        let describes = last.ends_with("ed") || last == "shaped" || last == "size" || last == "like" || last == "sized";
        return describes.then(|| {
            (Cow::Owned(lower.to_string()), Known { roles: Roles::of(Role::Adjective), ..Known::default() }, false)
        });
    }
    if let Some(meant) = lexicon.spelling(lower) {
        return Some((Cow::Borrowed(meant), known(meant, lexicon).unwrap_or_default(), true));
    }
    let noun = lexicon.mended(lower)?;
    let found = NounUnit { name: &noun.name, class: noun.class, plural: false, inferred: false };
    Some((Cow::Borrowed(&noun.name), Known { noun: Some(found), ..Known::default() }, true))
}

/// Fillers say nothing; an addressee does only in "brian 's left", where the clitic goes with it.
fn is_set_aside(unit: &Unit, before: Option<&Unit>) -> bool {
    let light = unit.is_unknown() && !unit.lower.chars().any(char::is_alphanumeric);
    let addressee_clitic = unit.lower == "'s" && before.is_none();
    // "The the table": a stumble.
    let again = before.is_some_and(|before| before.past == unit.first && before.lower == unit.lower && !unit.pause)
        && !unit.has(Role::Motion);
    let only = |role| unit.roles == Roles::of(role) && unit.noun.is_none();
    // "To the right of the robot": here it is a place.
    let told = before.is_some_and(|before| !unit.pause && (before.has(Role::Determiner) || before.lower == "of"));
    light || addressee_clitic || again || only(Role::Filler) || only(Role::Addressee) && !told
}

/// Words after which "right" only strengthens: "right on the table", "right behind".
const AFTER_EMPHASIS: [&str; 26] = [
    "on", "in", "at", "behind", "next", "by", "near", "up", "when", "there", "beside", "inside", "ahead", "against",
    "past", "where", "before", "after", "as", "here", "now", "beyond", "under", "above", "between", "across",
];

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

/// "Right on the table" is emphasis; "its on the desk" is "it is"; "two the left" is "to the left".
fn settle_ambiguous(units: &mut Vec<Unit>) {
    let mut i = 0;
    while i < units.len() {
        settle_homophone(units, i);
        settle_its(units, i);
        if units[i].lower == "right" && units[i].has(Role::Side) {
            let leads = i > 0 && BEFORE_SIDE.iter().any(|role| units[i - 1].has(*role));
            let next = units.get(i + 1).filter(|next| !next.pause).map_or("", |unit| unit.lower.as_ref());
            // "Turn right right when you come in": the second only strengthens.
            let again = i > 0 && units[i - 1].lower == "right";
            if (!leads || again) && (AFTER_EMPHASIS.contains(&next) || next == "away") {
                units[i].roles = Roles::of(Role::Adverb);
            }
        }
        i += 1;
    }
}

/// "Its on the table": "it is", unless a thing follows that it owns.
fn settle_its(units: &mut Vec<Unit>, i: usize) {
    if units[i].lower != "its" {
        return;
    }
    let owns = units.get(i + 1).is_some_and(|next| {
        let describes = next.has(Role::Adjective) || next.has(Role::Side) || next.has(Role::Ordinal);
        (next.noun.is_some() || describes || next.is_unknown())
            && !next.has(Role::Preposition)
            && !next.has(Role::Lying)
    });
    let subject = i == 0 || !units[i - 1].has(Role::Preposition);
    if owns && !(subject && i == 0 && units.get(i + 1).is_some_and(|next| next.noun.is_none())) || !subject {
        return;
    }
    let mut verb = units[i].clone();
    (units[i].lower, units[i].roles) = (Cow::Borrowed("it"), Roles::of(Role::Pronoun));
    (verb.lower, verb.roles, verb.pause) = (Cow::Borrowed("'s"), Roles::of(Role::Copula), false);
    units.insert(i + 1, verb);
}

/// "Two the left" is "to the left"; "their is" is "there is".
fn settle_homophone(units: &mut [Unit], i: usize) {
    let Some(next) = units.get(i + 1).map(|next| next.roles) else { return };
    let meant = match units[i].lower.as_ref() {
        // "Bring it 2 me".
        "2" if next.has(Role::Person) => ("to", Role::Preposition),
        "4" if next.has(Role::Person) => ("for", Role::Preposition),
        "two" if next.has(Role::Determiner) || next.has(Role::Hearer) => ("to", Role::Preposition),
        "their" if next.has(Role::Copula) || next.has(Role::Modal) => ("there", Role::There),
        _ => return,
    };
    units[i].lower = Cow::Borrowed(meant.0);
    units[i].roles = Roles::of(meant.1);
    units[i].number = None;
}

/// Part-of-speech tags for all words: from the lexicon, else by the word's look.
pub fn tag(words: &[Word], units: &[Unit], lexicon: &Lexicon) -> Vec<Token> {
    let mut tags: Vec<&str> = words.iter().map(|word| guess(word, lexicon)).collect();
    for unit in units {
        if let Some(noun) = unit.noun.filter(|_| unit.roles.is_empty() || unit.past > unit.first + 1) {
            tags[unit.first..unit.past].fill(noun_tag(noun.class));
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
        Class::Object | Class::Person => "NN",
        _ => "FUR",
    }
}

fn guess<'l>(word: &Word, lexicon: &'l Lexicon) -> &'l str {
    if let Some(entry) = lexicon.word(&word.lower) {
        return &entry.pos;
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
        let is_side = |text: &str| {
            let words = tokenize(text);
            units(&words, Lexicon::embedded()).iter().find(|u| u.lower == "right").map(|unit| unit.has(Role::Side))
        };
        assert_eq!(is_side("it is right on the table"), Some(false));
        assert_eq!(is_side("turn right at the door"), Some(true));
        assert_eq!(is_side("on the right by the bed"), Some(true));
    }

    #[test]
    fn two_words_written_as_one_are_two_units() {
        assert_eq!(
            lowers("theres a mug its on the desk"),
            ["there", "'s", "a", "mug", "it", "'s", "on", "the", "desk"]
        );
    }
}
