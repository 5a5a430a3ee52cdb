//! Clauses about the object: "the mug is", "you will find the mug", "bring me the book", "it 's".

use super::cursor::{Cursor, NounPhrase, Relation};
use super::phrases::{Kind, Phrase};
use super::word_class::{Class, Role};

/// The verbs that go with a subject: "will be", "should be sitting", "is".
const PREDICATE: [Role; 5] = [Role::Modal, Role::Copula, Role::Lying, Role::Adverb, Role::Has];
/// What may stand between a clause's subject and its verb of finding.
const SUBJECT: [Role; 4] = [Role::Pronoun, Role::Modal, Role::Has, Role::Adverb];

impl Cursor<'_> {
    pub(super) fn object_clause(&self, at: usize) -> Option<Phrase> {
        self.finding(at)
            .or_else(|| self.there_is(at))
            .or_else(|| self.thing_is(at))
            .or_else(|| self.it_is(at))
            .or_else(|| self.is_thing(at))
    }

    /// "you will find the mug", "find the mug", "can you bring me the book", "i left my keys", "pick up the letter".
    fn finding(&self, at: usize) -> Option<Phrase> {
        let verb = self.skip(at, &SUBJECT);
        let getting = self.is(verb, &["get"]) && !self.is(verb + 1, &["in", "into", "to", "close"]);
        let looking = self.role(verb) == Some(Role::Look) && self.is(verb + 1, &["for"]);
        if !matches!(self.role(verb), Some(Role::Find | Role::Bring)) && !getting && !looking {
            return None;
        }
        let mut object = self.skip(verb + 1, &[Role::Pronoun, Role::Adverb]);
        object += usize::from(self.is(object, &["up", "for", "out"]));
        let pronoun = object > verb + 1 && self.is(object - 1, &["it", "them"]);
        match self.noun_phrase(object, true).filter(|_| !pronoun) {
            Some(noun) => match self.class(noun.head) {
                Some(Class::Object) | None => Some(Phrase::new(Kind::Object, at, noun.past, "find the object")),
                Some(class) if self.is_definite(noun) && self.stands_on(class, noun.past) => {
                    Some(Phrase::new(Kind::Object, at, noun.past, "find what stands on furniture"))
                }
                Some(class) if class.is_furniture() => Some(Phrase::new(Kind::Target, at, noun.past, "find furniture")),
                _ => None,
            },
            None => (pronoun || verb > at).then(|| Phrase::new(Kind::Object, at, object, "find it")),
        }
    }

    /// "there is the mug", "there will be a table".
    fn there_is(&self, at: usize) -> Option<Phrase> {
        let there = self.is(at, &["there", "here"]);
        let verb = self.skip(at + 1, &PREDICATE);
        if !there || verb == at + 1 {
            return None;
        }
        let noun = self.noun_phrase(verb, true)?;
        match self.class(noun.head) {
            // "There is a purse sitting there": company on the same support.
            Some(Class::Object) if self.is_company(noun) => {
                Some(Phrase::new(Kind::ObjectMark, at, self.on_it_past(noun.past), "there is another object on it"))
            }
            Some(Class::Object) | None => Some(Phrase::new(Kind::Object, at, noun.past, "there is the object")),
            Some(class) if class.is_furniture() => Some(Phrase::new(Kind::Target, at, noun.past, "there is furniture")),
            _ => None,
        }
    }

    /// "the mug is", "the glasses case will be", "keys are sitting".
    fn thing_is(&self, at: usize) -> Option<Phrase> {
        let noun = self.noun_phrase(at, true)?;
        let past = self.skip(noun.past, &PREDICATE);
        let told = self.noun_has_article(noun.first, noun.head);
        match self.class(noun.head) {
            Some(Class::Object) if past > noun.past => Some(Phrase::new(Kind::Object, at, past, "the object is")),
            // "keys on the desk", said without a verb.
            Some(Class::Object) if self.relation(past).is_some() => {
                Some(Phrase::new(Kind::Object, at, past, "the object"))
            }
            Some(Class::Object) => Some(Phrase::new(Kind::Object, at, past, "the object alone")),
            Some(class) if past > noun.past && self.is_definite(noun) && self.stands_on(class, past) => {
                Some(Phrase::new(Kind::Object, at, past, "what stands on furniture is"))
            }
            None if told && past > noun.past && self.role(noun.past) != Some(Role::Has) => {
                Some(Phrase::new(Kind::Object, at, past, "an unknown thing is"))
            }
            _ => None,
        }
    }

    fn is_definite(&self, noun: NounPhrase) -> bool {
        self.noun_has_article(noun.first, noun.head) && !self.is(noun.first, &["a", "an", "some", "another"])
    }

    /// Whether a piece of furniture is said to stand on another, and so is what is asked for: "the lamp is on the
    /// desk", "the basket is in the kitchen on the shelf"; a lamp or a plant may be so in a room as well.
    fn stands_on(&self, class: Class, at: usize) -> bool {
        if !class.is_furniture() {
            return false;
        }
        let room = self.is(at, &["in"]).then(|| self.noun_phrase(at + 1, false)).flatten();
        let room = room.filter(|noun| self.class(noun.head) == Some(Class::Room));
        let on = room.map_or(at, |noun| noun.past);
        let support = match self.relation(on).filter(|_| self.is(on, &["on", "onto", "in"])) {
            Some((Relation::On, noun)) => self.noun_phrase(noun, false).and_then(|noun| self.class(noun.head)),
            _ => None,
        };
        let holds = |class| {
            matches!(
                class,
                Class::TableLike | Class::Storage | Class::Seat | Class::Couch | Class::Bed | Class::Appliance
            )
        };
        let it = self.is(on, &["on"]) && self.is(on + 1, &["it", "there"]);
        it || support.is_some_and(holds) || room.is_some() && matches!(class, Class::Lamp | Class::Plant)
    }

    fn is_company(&self, noun: NounPhrase) -> bool {
        let lying = self.skip(noun.past, &[Role::Lying]);
        let there = lying > noun.past && self.role(lying) == Some(Role::There);
        self.is(noun.first, &["a", "an", "some"]) && (there || self.on_it_past(noun.past) > noun.past)
    }

    pub(super) fn noun_has_article(&self, first: usize, head: usize) -> bool {
        first < head && matches!(self.role(first), Some(Role::Determiner | Role::Hearer))
    }

    /// "it 's", "they 're", "its on the table".
    fn it_is(&self, at: usize) -> Option<Phrase> {
        if !self.is(at, &["it", "they", "its", "that"]) {
            return None;
        }
        let past = self.skip(at + 1, &PREDICATE);
        let short = self.is(at, &["its"]) && self.role(at + 1) == Some(Role::Preposition);
        let side = |at: usize| self.role(at) == Some(Role::Side) && self.class(at + 1).is_none();
        let place_follows = matches!(self.role(past), Some(Role::Preposition | Role::There | Role::Side | Role::Ahead))
            || matches!(self.role(past), Some(Role::Determiner | Role::Hearer)) && side(past + 1);
        let furniture_follows =
            self.noun_phrase(past, false).is_some_and(|n| self.class(n.head).is_some_and(Class::is_furniture));
        (short || past > at + 1 && (place_follows || furniture_follows) && !self.is(at, &["that"]))
            .then(|| Phrase::new(Kind::Object, at, past, "it is"))
    }

    /// "on the desk is the pad": the subject after its verb.
    fn is_thing(&self, at: usize) -> Option<Phrase> {
        let noun_at = self.skip(at, &PREDICATE);
        if noun_at == at || (at..noun_at).any(|i| self.role(i) == Some(Role::Has) && !self.is(i, &["'ve", "'s"])) {
            return None;
        }
        let noun = self.noun_phrase(noun_at, true)?;
        let known = self.class(noun.head) == Some(Class::Object);
        let told = self.class(noun.head).is_none() && self.noun_has_article(noun.first, noun.head);
        (known || told).then(|| Phrase::new(Kind::Object, at, noun.past, "is the object"))
    }
}
