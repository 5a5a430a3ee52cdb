//! Noun phrases: what goes before a noun, what the noun is, and what it is called.

use std::borrow::Cow;

use super::morphology::singular;
use super::unit::Unit;
use super::word_class::{Class, Role, Roles};
use crate::record::Direction;

/// Most words before a noun: longer runs are no noun phrase.
const MOST_MODIFIERS: usize = 8;
/// Most nouns in a row that are one: keeps reading linear in nonsense.
const MOST_NOUNS: usize = 12;

/// How a noun phrase begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Article {
    /// Without one.
    None,
    /// "The", "that", "my": one that is known.
    Definite,
    /// "A", "some", "another": one among others.
    Indefinite,
}

/// A noun phrase over units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NounPhrase {
    /// First unit.
    pub first: usize,
    /// Where its name begins: "coffee" in "the small coffee mug".
    pub name: usize,
    /// The unit that is the noun.
    pub head: usize,
    /// One past the last unit.
    pub past: usize,
    /// What the noun names; nothing for a word that is not known.
    pub class: Option<Class>,
    /// The class was not written down but inferred.
    pub inferred: bool,
    /// "The thing", "something": names nothing.
    pub generic: bool,
    /// How it begins.
    pub article: Article,
    /// Said in the plural or with a number.
    pub plural: bool,
    /// "The left door".
    pub side: Option<Direction>,
    /// "The back wall", "the far table".
    pub part: Option<Direction>,
    /// "The second door".
    pub ordinal: Option<u32>,
    /// The room before it: "the kitchen table".
    pub room: Option<usize>,
    /// What a container holds: "a box of crackers".
    pub contents: Option<usize>,
}

impl NounPhrase {
    /// Whether the noun is known.
    pub fn is_known(&self) -> bool {
        self.class.is_some() || self.generic
    }

    /// Whether it is furniture or something fixed.
    pub fn is_furniture(&self) -> bool {
        self.class.is_some_and(Class::is_furniture)
    }
}

/// The noun phrase that begins at a position. Its noun may be a word that nobody knows.
pub fn noun_phrase(units: &[Unit], first: usize) -> Option<NounPhrase> {
    let start = past_partitive(units, first);
    let mut reader = Reader { units, at: start, phrase: empty(first) };
    while reader.at < start + MOST_MODIFIERS && reader.take_modifier(start) {}
    reader.head(start)
}

fn empty(first: usize) -> NounPhrase {
    NounPhrase {
        first,
        name: first,
        head: first,
        past: first,
        class: None,
        inferred: false,
        generic: false,
        article: Article::None,
        plural: false,
        side: None,
        part: None,
        ordinal: None,
        room: None,
        contents: None,
    }
}

/// "One of the", "all of the", "a pair of", "some kind of": the noun comes after.
fn past_partitive(units: &[Unit], first: usize) -> usize {
    let article = usize::from(units.get(first).is_some_and(|unit| unit.has(Role::Determiner)));
    let word = |at: usize| units.get(at).map_or("", |unit| unit.lower.as_ref());
    let partial = matches!(
        word(first + article),
        "one"
            | "all"
            | "both"
            | "each"
            | "couple"
            | "pair"
            | "pairs"
            | "kind"
            | "sort"
            | "type"
            | "set"
            | "bunch"
            | "lot"
            | "lots"
            | "some"
            | "two"
            | "rest"
    );
    if partial && word(first + article + 1) == "of" { first + article + 2 } else { first }
}

struct Reader<'u> {
    units: &'u [Unit<'u>],
    at: usize,
    phrase: NounPhrase,
}

/// Roles of words that begin a clause or an action, not a thing.
const VERBS: Roles = Roles::of(Role::Look)
    .with(Roles::of(Role::Find))
    .with(Roles::of(Role::Bring))
    .with(Roles::of(Role::Give))
    .with(Roles::of(Role::Put))
    .with(Roles::of(Role::Act))
    .with(Roles::of(Role::Motion))
    .with(Roles::of(Role::Turn))
    .with(Roles::of(Role::Modal));

impl<'u> Reader<'u> {
    fn unit(&self, at: usize) -> Option<&'u Unit<'u>> {
        self.units.get(at)
    }

    fn has(&self, at: usize, role: Role) -> bool {
        self.unit(at).is_some_and(|unit| unit.has(role))
    }

    fn is(&self, at: usize, words: &[&str]) -> bool {
        self.unit(at).is_some_and(|unit| words.contains(&unit.lower.as_ref()))
    }

    /// A unit that goes on without a comma.
    fn next(&self, at: usize) -> Option<&'u Unit<'u>> {
        self.unit(at).filter(|unit| !unit.pause)
    }

    /// Steps over one word before the noun.
    fn take_modifier(&mut self, start: usize) -> bool {
        let at = self.at;
        let Some(unit) = self.unit(at) else { return false };
        if at > start && unit.pause && !(self.has(at - 1, Role::Adjective) && unit.has(Role::Adjective)) {
            return false;
        }
        // "A grandfather clock": before a thing, a person only describes.
        let kin = at > start
            && unit.has(Role::Person)
            && unit.noun.is_none()
            && self.next(at + 1).is_some_and(|next| next.noun.is_some() && !next.roles.meet(VERBS));
        let taken = kin || self.take_article(at, start) || self.take_place(at) || self.describes(at, start);
        self.at += usize::from(taken);
        taken
    }

    fn take_article(&mut self, at: usize, start: usize) -> bool {
        let unit = &self.units[at];
        let leads = at == start || self.is(at - 1, &["all", "both", "half"]);
        if unit.has(Role::Determiner) && leads {
            let indefinite = matches!(unit.lower.as_ref(), "a" | "an" | "some" | "another" | "any" | "each");
            self.phrase.article = if indefinite { Article::Indefinite } else { Article::Definite };
            return true;
        }
        if unit.has(Role::Hearer) && (leads || at == start) {
            self.phrase.article = Article::Definite;
            return true;
        }
        // "Brian 's desk", "my mother 's chair".
        let owner =
            unit.lower == "'s" && at > start && (self.units[at - 1].is_unknown() || self.has(at - 1, Role::Person));
        if owner {
            self.phrase.article = Article::Definite;
        }
        let owns = unit.has(Role::Person) && self.next(at + 1).is_some_and(|next| next.lower == "'s");
        // "The dog's leash".
        let thing_owns = unit.noun.is_some()
            && self.next(at + 1).is_some_and(|next| next.lower == "'s")
            && self.next(at + 2).is_some_and(|next| {
                next.noun.is_some()
                    || self.leads_on(at + 2) && self.next(at + 3).is_some_and(|last| last.noun.is_some())
            })
            && !self.next(at + 2).is_some_and(|next| next.has(Role::Determiner) || next.has(Role::Preposition));
        let owner = owner
            || unit.lower == "'s"
                && at > start
                && self.units[at - 1].noun.is_some()
                && self.next(at + 1).is_some_and(|next| next.noun.is_some() || self.leads_on(at + 1));
        owner || owns || thing_owns || leads && at == start && matches!(unit.lower.as_ref(), "all" | "both")
    }

    /// "Left", "back", "second", "two" before a noun.
    fn take_place(&mut self, at: usize) -> bool {
        let unit = &self.units[at];
        if unit.has(Role::Number) || matches!(unit.lower.as_ref(), "couple" | "few") {
            self.phrase.plural |= unit.number.is_some_and(|number| number > 1.0);
            return !self.is(at, &["one"]) || self.leads_on(at + 1);
        }
        if unit.has(Role::Ordinal) && !self.is(at, &["next"]) {
            let names = ["first", "second", "third", "fourth", "fifth", "sixth"];
            let place = names.iter().position(|name| *name == unit.lower);
            self.phrase.ordinal = place.map(|place| place as u32 + 1).or(self.phrase.ordinal);
            return true;
        }
        let leads_on = self.leads_on(at + 1) || self.is(at + 1, &["hand", "side", "most"]) && self.leads_on(at + 2);
        if unit.has(Role::Side) && leads_on {
            self.phrase.side = side(unit);
            return true;
        }
        if unit.has(Role::Part) && leads_on {
            self.phrase.part = part(&unit.lower);
            return true;
        }
        let hand = self.is(at, &["hand", "side", "most"]) && at > 0 && self.has(at - 1, Role::Side);
        hand && self.leads_on(at + 1)
    }

    /// Whether a noun phrase goes on at a position.
    fn leads_on(&self, at: usize) -> bool {
        self.next(at).is_some_and(|unit| {
            unit.noun.is_some()
                || unit.has(Role::Adjective)
                || unit.has(Role::Side)
                || unit.has(Role::Number)
                || unit.has(Role::Ordinal)
                || unit.has(Role::Part) && self.next(at + 1).is_some_and(|next| next.noun.is_some())
                || unit.has(Role::Generic)
                || unit.is_unknown() && self.next(at + 1).is_some_and(|next| next.noun.is_some() || next.is_unknown())
        })
    }

    /// An adjective, or a word nobody knows before a noun.
    fn describes(&self, at: usize, start: usize) -> bool {
        let unit = &self.units[at];
        if unit.noun.is_some() {
            // "Light" is a lamp, and no lamp in "the light wood table".
            let on = self.next(at + 1).is_some_and(|next| {
                next.noun.is_some() || next.has(Role::Adjective) && !next.has(Role::Lying) || next.has(Role::Generic)
            });
            return unit.has(Role::Adjective) && on;
        }
        if unit.has(Role::Adjective) {
            return !unit.has(Role::Act) || at > start || self.leads_on(at + 1) && !self.has(at + 1, Role::Determiner);
        }
        let strong = matches!(unit.lower.as_ref(), "very" | "immediate" | "really" | "kind" | "sort" | "only");
        strong && at > start && self.leads_on(at + 1)
            || unit.is_unknown() && unit.lower.chars().any(char::is_alphabetic)
    }

    /// The noun at the reader's place, with the nouns it is made of and what it holds.
    fn head(mut self, start: usize) -> Option<NounPhrase> {
        let at = self.at;
        let unit = self.unit(at).filter(|unit| at == start || !unit.pause);
        let verb = |unit: &Unit| at == start && (unit.roles.meet(VERBS) || unit.has(Role::Filler));
        let Some(unit) = unit.filter(|unit| unit.noun.is_some() && !verb(unit)) else {
            return self.unnamed(start);
        };
        self.phrase.head = at;
        self.phrase.name = self.name_start(at, start);
        self.set_noun(unit);
        // "Go right, keys on the desk": without an article the side is not the thing's.
        let bare_side = self.phrase.side.is_some() && self.phrase.article == Article::None;
        if bare_side && self.phrase.class == Some(Class::Object) {
            return None;
        }
        self.compound(start);
        self.phrase.past = self.phrase.head + 1;
        self.hold();
        Some(self.phrase)
    }

    fn set_noun(&mut self, unit: &Unit) {
        if let Some(noun) = unit.noun {
            self.phrase.class = Some(noun.class);
            self.phrase.inferred = noun.inferred;
            self.phrase.plural |= noun.plural;
        }
    }

    /// "A gaming desk", "the alphabet soup": words before the noun that belong to its name.
    fn name_start(&self, head: usize, start: usize) -> usize {
        let mut name = head;
        while name > start.max(head.saturating_sub(MOST_NOUNS))
            && names_kind(&self.units[name - 1])
            && !self.units[name].pause
        {
            name -= 1;
        }
        name
    }

    /// "Computer desk": nouns in a row are one, the last says what it is; a room before it says where.
    fn compound(&mut self, start: usize) {
        let bare = self.phrase.head == start && (start == 0 || self.units[start].pause || self.units[start - 1].stop);
        while let Some(next) = self.next(self.phrase.head + 1).filter(|_| self.phrase.head < start + MOST_NOUNS) {
            if self.goes_on_unknown(next, bare) {
                self.phrase.head += 1;
                self.phrase.plural = false;
                break;
            }
            let (Some(noun), Some(class)) = (next.noun, self.phrase.class) else { break };
            if next.roles.meet(VERBS) || next.has(Role::Lying) || next.has(Role::Near) || next.has(Role::Filler) {
                break;
            }
            let head = self.phrase.head;
            let joins = match (class, noun.class) {
                // "The music room".
                (Class::Object, Class::Room) => noun.name == "room" && !bare,
                (Class::Room, Class::Room) | (_, Class::Room | Class::Person) => false,
                (Class::Room, _) => self.phrase.side.is_none() && self.units[head].lower != "room",
                (Class::Object, other) if other.is_furniture() => !self.phrase.plural && !bare,
                (Class::Object, Class::Object) => !bare && !self.phrase.plural,
                (first, other) if first.is_furniture() => {
                    other.is_furniture() || other == Class::Object && !bare || other == Class::Opening
                }
                _ => false,
            };
            if !joins {
                break;
            }
            match class {
                // "The hall table" is a kind of table, wherever it stands.
                Class::Room if self.units[head].lower != "hall" => {
                    self.phrase.room = Some(head);
                    self.phrase.name = head + 1;
                }
                Class::TableLike | Class::Seat | Class::Couch | Class::Bed | Class::Storage
                    if noun.class.is_furniture() =>
                {
                    self.phrase.name = head + 1;
                }
                _ => {}
            }
            self.phrase.head = head + 1;
            self.phrase.plural = false;
            self.set_noun(next);
        }
    }

    /// "The paint roller", "the paper towel holder": a word the lexicon lacks may end a name that began with a thing.
    fn goes_on_unknown(&self, next: &Unit, bare: bool) -> bool {
        let thing = matches!(self.phrase.class, Some(Class::Object | Class::Plant | Class::Appliance | Class::Screen));
        let verb = ["ed", "ing", "en"].iter().any(|ending| next.lower.ends_with(ending));
        let ends = self.unit(self.phrase.head + 2).is_none_or(|after| {
            after.pause
                || after.stop
                || after.has(Role::Copula)
                || after.has(Role::Preposition)
                || after.has(Role::Modal)
                || after.has(Role::Conjunction)
                || after.has(Role::Has)
                || after.has(Role::Relative)
        });
        let names = !next.lower.ends_with("ly") && next.lower != "anyhow";
        // "The garlic press": a verb by itself, and a noun here.
        let tool = next.noun.is_none() && next.has(Role::Act) && self.phrase.article != Article::None;
        (next.is_unknown() || tool) && names && thing && !bare && !self.phrase.plural && !verb && ends
    }

    /// "A box of crackers", "a slice of apple".
    fn hold(&mut self) {
        let head = &self.units[self.phrase.head];
        let past = self.phrase.past;
        // "The ball of the dog", "the keys of the car": whose it is.
        if !head.has(Role::Container)
            && self.phrase.class == Some(Class::Object)
            && self.next(past).is_some_and(|unit| unit.lower == "of")
        {
            let owner = noun_phrase(self.units, past + 1);
            let owner = owner.filter(|owner| {
                owner.class.is_none_or(|class| matches!(class, Class::Object | Class::Person)) && !owner.generic
            });
            self.phrase.past = owner.map_or(past, |owner| owner.past);
            return;
        }
        if !head.has(Role::Container) || self.next(past).is_none_or(|unit| unit.lower != "of") {
            return;
        }
        let Some(inner) = noun_phrase(self.units, past + 1) else { return };
        let thing = inner.class.is_none_or(|class| matches!(class, Class::Object | Class::Plant));
        if thing && !inner.generic && inner.article != Article::Definite {
            self.phrase.contents = Some(inner.head);
            self.phrase.past = inner.past;
        }
    }

    /// "The object", "something", "the terrarium": without a noun of the lexicon.
    fn unnamed(mut self, start: usize) -> Option<NounPhrase> {
        let at = self.at;
        let here = self.unit(at).filter(|unit| at == start || !unit.pause);
        if here.is_some_and(|unit| {
            unit.has(Role::Generic) && !unit.roles.meet(VERBS) || at > start && unit.has(Role::Generic)
        }) {
            let unit = self.unit(at)?;
            // "Something to drink" is a drink.
            let purpose = self.is(at + 1, &["to"]) && self.is(at + 2, &["drink", "eat", "read", "wear", "write"]);
            if purpose {
                (self.phrase.head, self.phrase.name, self.phrase.past) = (at + 2, at + 2, at + 3);
                self.phrase.class = Some(Class::Object);
                return Some(self.phrase);
            }
            self.phrase.generic = unit.lower != "anything" || self.is(at + 1, &["but", "like"]);
            (self.phrase.head, self.phrase.name, self.phrase.past) = (at, at, at + 1);
            self.phrase.plural |= unit.lower.ends_with('s');
            return Some(self.phrase);
        }
        // "A piece", "the pack": a container that holds nothing and is no noun of the lexicon.
        let container = here.filter(|unit| unit.has(Role::Container) && (at > start || !unit.roles.meet(VERBS)));
        if container.is_some() {
            (self.phrase.head, self.phrase.name, self.phrase.past) = (at, self.name_start(at, start), at + 1);
            self.phrase.class = Some(Class::Object);
            self.phrase.inferred = true;
            self.hold();
            return Some(self.phrase);
        }
        let head = at.checked_sub(1).filter(|&head| head >= start && self.units[head].is_unknown())?;
        // A word of English that names no thing: "earlier", "itself"; with an article it may still be one.
        let told = self.phrase.article != Article::None && !self.is(start, &["that", "this"]);
        let broken = self.units[head].lower.chars().count() < 3;
        if self.units[head].foreign && !told || broken {
            return None;
        }
        (self.phrase.head, self.phrase.past) = (head, head + 1);
        self.phrase.name = self.name_start(head, start);
        Some(self.phrase)
    }
}

/// Whether a word that the lexicon does not have names a kind rather than describes: "gaming", "alphabet".
fn names_kind(unit: &Unit) -> bool {
    let noun = unit.noun.is_some_and(|noun| noun.class == Class::Object) && !unit.has(Role::Adjective);
    let noun = noun || matches!(unit.lower.as_ref(), "grandfather" | "kid" | "kids" | "guest");
    noun || unit.is_unknown() && !unit.foreign && !describes_by_ending(&unit.lower)
        || unit.foreign && unit.lower.ends_with("ing")
}

fn describes_by_ending(word: &str) -> bool {
    const ENDINGS: [&str; 13] =
        ["y", "ish", "ed", "al", "ful", "ous", "ive", "less", "able", "ible", "ic", "est", "en"];
    ENDINGS.iter().any(|ending| word.ends_with(ending)) && word.len() > 3
}

/// Left or right.
pub fn side(unit: &Unit) -> Option<Direction> {
    match unit.lower.as_ref() {
        "left" | "left-hand" => Some(Direction::Left),
        "right" | "right-hand" => Some(Direction::Right),
        _ => None,
    }
}

fn part(word: &str) -> Option<Direction> {
    match word {
        "back" | "far" | "rear" | "end" | "further" | "farther" | "furthest" | "farthest" => Some(Direction::Back),
        "front" => Some(Direction::Front),
        "middle" | "center" | "centre" => Some(Direction::Central),
        _ => None,
    }
}

/// What a noun phrase is called, in lower_snake: landmarks and furniture in the singular, things in the number said.
pub fn name_of(phrase: &NounPhrase, units: &[Unit], counted: bool) -> String {
    let mut words: Vec<Cow<str>> = Vec::new();
    if let Some(contents) = phrase.contents {
        words.push(Cow::Owned(singular(one_name(&units[contents], false).as_ref())));
    }
    let before = &units[phrase.name..phrase.head];
    words.extend(before.iter().map(|unit| Cow::Owned(unit.lower.replace([' ', '-'], "_"))));
    words.push(one_name(&units[phrase.head], counted));
    words.join("_")
}

fn one_name<'u>(unit: &'u Unit, counted: bool) -> Cow<'u, str> {
    match unit.noun {
        Some(noun) if counted && noun.plural => Cow::Owned(unit.lower.replace([' ', '-'], "_")),
        Some(noun) => Cow::Borrowed(noun.name),
        None if counted => Cow::Owned(unit.lower.replace([' ', '-'], "_")),
        None => Cow::Owned(singular(&unit.lower).replace([' ', '-'], "_")),
    }
}

/// Colour, size, shape and material, as said.
pub fn attributes_of(phrase: &NounPhrase, units: &[Unit]) -> Vec<String> {
    let before = units[phrase.first..phrase.name].iter();
    let told = before
        .filter(|unit| unit.has(Role::Adjective) || unit.is_unknown() && unit.lower.chars().all(char::is_alphabetic));
    told.map(|unit| unit.lower.to_string()).filter(|word| !matches!(word.as_str(), "other" | "same")).collect()
}
