//! Patterns over units: where a rule fits, and what it caught.

use super::grammar::{Atom, Element, Grammar, Look, Part, Repeat};
use super::lexicon::Lexicon;
use super::noun_phrases::{Article, NounPhrase, noun_phrase, side};
use super::relations::Relation;
use super::unit::Unit;
use super::word_class::{Class, Role, Roles};
use super::zones::{Zone, zone};
use crate::record::Direction;

/// Longest run of words of one kind that a pattern steps over: keeps reading linear in nonsense as well.
const LONGEST_RUN: usize = 12;
/// Most things in one list.
const LONGEST_LIST: usize = 6;

/// What a rule caught on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Caught {
    /// Where the noun phrase, or the first of a list, begins.
    pub noun: Option<usize>,
    /// One past the list.
    pub list_past: usize,
    /// Where the person begins.
    pub person: Option<usize>,
    /// The last left or right.
    pub side: Option<Direction>,
    /// The part of the room.
    pub zone: Option<[Option<Direction>; 2]>,
    /// The relation.
    pub relation: Option<Relation>,
    /// The words that lead to a place, or that pick a room.
    pub inner: Option<(usize, usize)>,
    open: usize,
}

/// Units with what is asked of them again and again.
pub struct Text<'u, 't> {
    /// The units.
    pub units: &'u [Unit<'t>],
    ids: Vec<u16>,
    nouns: Vec<Option<NounPhrase>>,
    relations: Vec<Option<(Relation, usize)>>,
}

impl<'u, 't> Text<'u, 't> {
    /// Looks up words, noun phrases and relations once.
    pub fn new(units: &'u [Unit<'t>], lexicon: &Lexicon, grammar: &Grammar) -> Self {
        let all = 0..units.len();
        let relations = all.clone().map(|at| lexicon.relations().at(units, at)).collect();
        let nouns = all.map(|at| noun_phrase(units, at)).collect();
        let ids = units.iter().map(|unit| grammar.id(&unit.lower)).collect();
        Self { units, ids, nouns, relations }
    }

    /// The noun phrase that begins at a position.
    pub fn noun(&self, at: usize) -> Option<&NounPhrase> {
        self.nouns.get(at)?.as_ref()
    }

    /// The relation that begins at a position.
    pub fn relation(&self, at: usize) -> Option<(Relation, usize)> {
        self.relations.get(at).copied().flatten()
    }

    /// The number of the word at a position.
    pub fn id(&self, at: usize) -> u16 {
        self.ids.get(at).copied().unwrap_or(0)
    }

    fn has(&self, at: usize, role: Role) -> bool {
        self.units.get(at).is_some_and(|unit| unit.has(role))
    }

    fn is(&self, at: usize, words: &[&str]) -> bool {
        self.units.get(at).is_some_and(|unit| words.contains(&unit.lower.as_ref()))
    }

    /// Where the elements fit from a position: one past them, and what they caught.
    pub fn fit(&self, elements: &[Element], at: usize) -> Option<(usize, Caught)> {
        self.step(elements, at, at, Caught::default())
    }

    fn step(&self, elements: &[Element], first: usize, at: usize, mut caught: Caught) -> Option<(usize, Caught)> {
        let Some((element, rest)) = elements.split_first() else {
            return (at > first).then_some((at, caught));
        };
        match (&element.atom, element.look) {
            (Atom::InnerStart, _) => {
                caught.open = at;
                return self.step(rest, first, at, caught);
            }
            (Atom::InnerEnd, _) => {
                caught.inner = (caught.open < at).then_some((caught.open, at));
                return self.step(rest, first, at, caught);
            }
            (_, Look::Ahead) => {
                self.take(element, at, at, &mut caught.clone())?;
                return self.step(rest, first, at, caught);
            }
            (_, Look::NotAhead) => {
                let follows = self.take(element, first, at, &mut caught.clone()).is_some();
                return if follows { None } else { self.step(rest, first, at, caught) };
            }
            (_, Look::Behind) => {
                return if self.behind(element, at) { self.step(rest, first, at, caught) } else { None };
            }
            _ => {}
        }
        match element.repeat {
            Repeat::One => {
                let past = self.take(element, first, at, &mut caught)?;
                self.step(rest, first, past, caught)
            }
            Repeat::Optional => {
                let mut with = caught;
                let taken = self.take(element, first, at, &mut with);
                taken.and_then(|past| self.step(rest, first, past, with)).or_else(|| self.step(rest, first, at, caught))
            }
            Repeat::Many => self.many(element, rest, first, at, caught),
        }
    }

    /// As many as fit, then fewer and fewer.
    fn many(
        &self,
        element: &Element,
        rest: &[Element],
        first: usize,
        at: usize,
        caught: Caught,
    ) -> Option<(usize, Caught)> {
        let mut stops = [(at, caught); LONGEST_RUN + 1];
        let mut count = 0;
        while count < LONGEST_RUN {
            let (here, mut next) = stops[count];
            match self.take(element, first, here, &mut next) {
                Some(past) if past > here => {
                    count += 1;
                    stops[count] = (past, next);
                }
                _ => break,
            }
        }
        stops[..=count].iter().rev().find_map(|(past, caught)| self.step(rest, first, *past, *caught))
    }

    fn behind(&self, element: &Element, at: usize) -> bool {
        let Atom::Set { ids, roles, pause } = &element.atom else { return false };
        let comma = *pause && (at == 0 || self.units.get(at).is_some_and(|unit| unit.pause) || self.units[at - 1].stop);
        comma || at > 0 && self.in_set(ids, *roles, at - 1)
    }

    fn in_set(&self, ids: &[u16], roles: Roles, at: usize) -> bool {
        self.units[at].roles.meet(roles) || self.ids[at] != 0 && ids.contains(&self.ids[at])
    }

    /// Takes what the element fits at a position.
    fn take(&self, element: &Element, first: usize, at: usize, caught: &mut Caught) -> Option<usize> {
        match &element.atom {
            Atom::Set { ids, roles, .. } => {
                let unit = self.units.get(at)?;
                if at > first && unit.pause || !self.in_set(ids, *roles, at) {
                    return None;
                }
                if unit.has(Role::Side) && roles.has(Role::Side) {
                    caught.side = side(unit);
                }
                Some(at + 1)
            }
            Atom::Part(part) => self.take_part(*part, first, at, caught),
            Atom::InnerStart | Atom::InnerEnd => Some(at),
        }
    }

    fn take_part(&self, part: Part, first: usize, at: usize, caught: &mut Caught) -> Option<usize> {
        match part {
            Part::End => return self.ends(at).then_some(at),
            Part::End2 => return (!self.thing_follows(at)).then_some(at),
            _ => {}
        }
        let unit = self.units.get(at)?;
        if at > first && unit.pause {
            return None;
        }
        match part {
            Part::Thing | Part::Things | Part::Objects | Part::Furniture | Part::List => {
                self.take_things(part, at, caught)
            }
            Part::Room | Part::Opening | Part::Wall | Part::Sided | Part::SideWall => {
                let noun = self.noun(at).filter(|noun| fits_place(part, noun))?;
                caught.noun = Some(at);
                caught.list_past = noun.past;
                caught.side = noun.side.or(caught.side);
                Some(noun.past)
            }
            Part::Bare => {
                let bare = |noun: &&NounPhrase| noun.article == Article::None && noun.class == Some(Class::Object);
                let noun = self.noun(at).filter(bare)?;
                (caught.noun, caught.list_past) = (Some(at), noun.past);
                Some(noun.past)
            }
            Part::Person => self.person(at, caught),
            Part::Relation => {
                let (relation, past) = self.relation(at)?;
                caught.relation = Some(relation);
                Some(past)
            }
            Part::Zone => {
                let Zone { directions, past } = zone(self.units, at)?;
                caught.zone = Some(directions);
                Some(past)
            }
            Part::Possessor => self.possessor(at),
            Part::Pace => self.pace(at),
            Part::Degrees => {
                let number = usize::from(unit.number.is_some() || self.is(at, &["few", "a"]));
                (number > 0 && (self.has(at + 1, Role::DegreeUnit) || unit.number.is_some_and(|n| n >= 30.0)))
                    .then(|| at + 1 + usize::from(self.has(at + 1, Role::DegreeUnit)))
            }
            Part::OnIt => self.on_it(at),
            Part::Unknown => {
                let noun = self.noun(at).filter(|noun| noun.class.is_none() && !noun.generic)?;
                caught.noun = Some(at);
                caught.list_past = noun.past;
                (noun.article != Article::None).then_some(noun.past)
            }
            Part::Name => (unit.is_unknown() && (unit.capital || !unit.foreign)).then_some(()).map(|()| {
                caught.person = Some(at);
                at + 1
            }),
            // A word broken off.
            Part::Stumble => (unit.is_unknown() && unit.lower.len() < 5).then_some(at + 1),
            Part::Noun => unit.noun.map(|_| at + 1),
            Part::Fixed => unit.class().filter(|class| *class != Class::Object).map(|_| at + 1),
            Part::Place => self.place_follows(at).then_some(at),
            Part::To => (self.is(at, &["to", "into", "and"]) || self.has(at, Role::Conjunction)).then_some(at),
            Part::End | Part::End2 => None,
        }
    }

    /// Whether a clause ends before a position.
    pub fn ends(&self, at: usize) -> bool {
        self.units
            .get(at)
            .is_none_or(|unit| unit.stop || unit.pause || unit.has(Role::Conjunction) || unit.has(Role::Correction))
    }

    fn thing_follows(&self, at: usize) -> bool {
        self.noun(at).is_some_and(|noun| noun.class.is_some() && noun.article == Article::None) && !self.units[at].pause
    }

    /// A place may follow "it is": a preposition, a side, furniture.
    fn place_follows(&self, at: usize) -> bool {
        let Some(unit) = self.units.get(at) else { return false };
        let place = [Role::Preposition, Role::There, Role::Side, Role::Ahead, Role::Near];
        let side =
            |at: usize| self.has(at, Role::Side) && self.units.get(at + 1).is_none_or(|next| next.noun.is_none());
        place.iter().any(|role| unit.has(*role))
            || (unit.has(Role::Determiner) || unit.has(Role::Hearer)) && side(at + 1)
            || self.relation(at).is_some()
            || self
                .noun(at)
                .is_some_and(|noun| noun.class.is_some_and(|class| class.is_furniture() || class == Class::Room))
    }

    fn take_things(&self, part: Part, at: usize, caught: &mut Caught) -> Option<usize> {
        let noun = self.noun(at)?;
        let object = |class: Class| matches!(class, Class::Object | Class::Lamp | Class::Plant | Class::Screen);
        let fits = match part {
            Part::Furniture => noun.is_furniture(),
            Part::Objects => noun.class.is_some_and(object) || noun.generic && noun.article != Article::None,
            // "Next to the terrarium": a word nobody knows is a thing when it has an article.
            Part::List => match noun.class {
                Some(class) => class.is_furniture() || class == Class::Object,
                None => !noun.generic && (noun.article != Article::None || noun.plural),
            },
            _ => noun.class.is_none_or(|class| class.is_furniture() || class == Class::Object),
        };
        if !fits {
            return None;
        }
        caught.noun = Some(at);
        let between = caught.relation == Some(Relation::Landmark(Direction::Between));
        let past = match part {
            Part::List | Part::Things | Part::Objects => self.list_past(at, part, between),
            _ => noun.past,
        };
        caught.list_past = past;
        Some(past)
    }

    /// One past a list of things: "a lamp, a mug and a chair".
    fn list_past(&self, first: usize, part: Part, between: bool) -> usize {
        let Some(noun) = self.noun(first) else { return first };
        let mut past = noun.past;
        let mut sure = past;
        for _ in 0..LONGEST_LIST {
            let comma = self.units.get(past).is_some_and(|unit| unit.pause);
            let and = self.is(past, &["and", "or"]);
            let next = past + usize::from(and) + usize::from(and && self.is(past + 1, &["also", "then"]));
            if !comma && !and {
                break;
            }
            let Some(other) = self.noun(next).filter(|other| self.joins(noun, other, part, between)) else {
                break;
            };
            past = other.past;
            // A comma alone makes a list only when "and" comes in the end.
            if and {
                sure = past;
            }
        }
        sure
    }

    fn joins(&self, noun: &NounPhrase, other: &NounPhrase, part: Part, between: bool) -> bool {
        let clause = self.units.get(other.past).is_some_and(|unit| {
            !unit.pause && (unit.has(Role::Copula) || unit.has(Role::Modal) || unit.has(Role::Has))
        });
        let bare = other.article == Article::None && !other.plural;
        let alike = match (noun.class, other.class) {
            _ if between => true,
            (_, None) => !bare || part != Part::List,
            (_, Some(Class::Room | Class::Wall | Class::Opening | Class::Part | Class::Person)) => false,
            (Some(a), Some(b)) if part == Part::List => {
                a == b || b != Class::TableLike && b.is_furniture() == a.is_furniture() || !b.is_furniture()
            }
            (Some(a), Some(b)) => a.is_furniture() == b.is_furniture(),
            (None, Some(b)) => !b.is_furniture() || part == Part::List,
        };
        // "By the bed and the mug on the desk": the second begins a clause of its own.
        let own_place = part == Part::List
            && !between
            && other.class == Some(Class::Object)
            && other.article == Article::Definite
            && self.units.get(other.past).is_some_and(|unit| !unit.pause && unit.has(Role::Preposition))
            && self.relation(other.past).is_some_and(|(_, past)| !self.is(past, &["it", "them"]));
        let alike = alike || part == Part::List && other.article == Article::Indefinite && other.is_furniture();
        let asks = part == Part::List && self.units[other.first].has(Role::Act);
        alike && !clause && !own_place && !asks
    }

    fn person(&self, at: usize, caught: &mut Caught) -> Option<usize> {
        let mut head = at;
        while head < at + 4
            && self.units.get(head).is_some_and(|unit| {
                unit.has(Role::Determiner)
                    || unit.has(Role::Hearer)
                    || unit.has(Role::Adjective)
                    || unit.has(Role::Lying) && head > at
            })
            && !self.has(head, Role::Person)
        {
            head += 1;
        }
        if self.is(head, &["me", "us"]) && head > at {
            return None;
        }
        let unit = self.units.get(head)?;
        let person = unit.has(Role::Person) || unit.class() == Some(Class::Person);
        // A name has no article, and what is given follows it.
        let name = head == at
            && unit.is_unknown()
            && (unit.capital || !unit.foreign)
            && self.noun(at + 1).is_some_and(|noun| noun.article != Article::None);
        if !person && !name {
            return None;
        }
        caught.person = Some(head);
        Some(head + 1)
    }

    fn possessor(&self, at: usize) -> Option<usize> {
        let owns = self.units[at].is_unknown() || self.has(at, Role::Pronoun) || self.has(at, Role::Person);
        if owns && self.is(at + 1, &["'s"]) {
            return Some(at + 2);
        }
        self.is(at, &["'s"]).then_some(at + 1)
    }

    /// One step of what may stand within a move: "straight", "a little bit", "three steps", "down the hallway".
    fn pace(&self, at: usize) -> Option<usize> {
        let within = Roles::of(Role::Adverb)
            .with(Roles::of(Role::Ahead))
            .with(Roles::of(Role::Number))
            .with(Roles::of(Role::Step))
            .with(Roles::of(Role::FootUnit))
            .with(Roles::of(Role::MetreUnit))
            .with(Roles::of(Role::Extent))
            .with(Roles::of(Role::Motion))
            .with(Roles::of(Role::Again));
        let unit = &self.units[at];
        if unit.roles.meet(within) || self.is(at, &["little", "bit", "few", "couple", "ways", "more"]) {
            return Some(at + 1);
        }
        if self.is(at, &["a", "another", "the"])
            && (self.is(at + 1, &["little", "bit", "few", "couple", "way"]) || self.has(at + 1, Role::Step))
        {
            return Some(at + 2);
        }
        if self.is(at, &["of", "for"])
            && (self.has(at + 1, Role::Step) || self.is(at + 1, &["a"]) || self.has(at + 1, Role::Number))
        {
            return Some(at + 1);
        }
        if self.is(at, &["on", "up", "down", "over", "out", "back", "in"])
            && (self.is(at + 1, &["to", "into", "toward", "towards", "until", "in", "over"])
                || self.has(at + 1, Role::Extent)
                || self.ends(at + 1))
        {
            return Some(at + 1);
        }
        self.passage(at)
    }

    /// "Down the hallway".
    fn passage(&self, at: usize) -> Option<usize> {
        if !self.is(at, &["down", "along", "through", "up", "across", "past"]) {
            return None;
        }
        let noun = self.noun(at + 1)?;
        let hall = self.units[noun.head].lower.contains("hall") || self.is(noun.head, &["corridor", "intersection"]);
        hall.then_some(noun.past)
    }

    /// "On it", "on top of it", "on top", "in it".
    fn on_it(&self, at: usize) -> Option<usize> {
        if !self.is(at, &["on", "in", "inside"]) {
            return None;
        }
        let top = at + 1 + usize::from(self.is(at + 1, &["top"])) + usize::from(self.is(at + 2, &["of"]));
        if self.is(top, &["it", "them", "there", "that"]) && !self.thing_follows(top + 1) {
            return Some(top + 1);
        }
        (self.is(at + 1, &["top"]) && !self.is(at + 2, &["of"])).then_some(at + 2)
    }
}

fn fits_place(part: Part, noun: &NounPhrase) -> bool {
    match part {
        Part::Room => noun.class == Some(Class::Room),
        Part::Opening => noun.class == Some(Class::Opening),
        Part::SideWall => noun.class == Some(Class::Wall) && (noun.side.is_some() || noun.part.is_some()),
        Part::Sided => noun.class == Some(Class::Opening) && noun.side.is_some(),
        _ => noun.class == Some(Class::Wall),
    }
}
