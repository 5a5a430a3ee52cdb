//! Places: rooms, parts of a room, sides of the hearer, furniture.

use super::cursor::{Cursor, NounPhrase, Relation};
use super::phrases::{Kind, Phrase};
use super::word_class::{Class, Role};

/// Prepositions that lead into a room or through a door.
const INTO: [&str; 10] = ["in", "into", "to", "through", "inside", "toward", "towards", "at", "for", "of"];
/// Prepositions before a part of the room or a wall.
const BEFORE_PART: [&str; 15] = [
    "in", "at", "on", "to", "into", "near", "towards", "toward", "against", "along", "by", "across", "from", "through",
    "over",
];
/// Rooms that are passed through, not entered.
const PASSAGES: [&str; 2] = ["hallway", "intersection"];

impl Cursor<'_> {
    /// A room or door with its side, after a verb at `first` or alone.
    pub(super) fn room(&self, first: usize, at: usize) -> Option<Phrase> {
        let mut noun_at = at;
        while self.is(noun_at, &INTO) || self.is(noun_at, &["up", "down", "back"]) && self.is(noun_at + 1, &INTO) {
            noun_at += 1;
        }
        if noun_at == at && first != at {
            return None;
        }
        self.room_from(first, self.noun_phrase(noun_at, false)?)
    }

    pub(super) fn room_from(&self, first: usize, noun: NounPhrase) -> Option<Phrase> {
        let is_room = match self.class(noun.head)? {
            Class::Room => !self.names_passage(noun.head),
            // A door that is entered stands for its room; "by the door" is a place.
            Class::Opening => {
                let sided = || self.side_past(self.skip_clause_link(noun.past), false).is_some();
                let towards = (first..noun.first).any(|i| self.is(i, &["to"]));
                first == noun.first || self.leads_through(first, noun.first) || towards && first < noun.first && sided()
            }
            _ => return None,
        };
        if !is_room {
            return None;
        }
        if let Some(side) = (noun.first..noun.head).find(|&i| self.role(i) == Some(Role::Side)) {
            return Some(Phrase::new(Kind::Room, first, noun.past, "room of a side").with_inner(side, side + 1));
        }
        let ends = |at: usize| at >= self.len() || self.is_stop(at) || self.role(at) == Some(Role::Conjunction);
        if self.role(noun.past) == Some(Role::Side) && ends(noun.past + 1) {
            return Some(
                Phrase::new(Kind::Room, first, noun.past + 1, "room, side").with_inner(noun.past, noun.past + 1),
            );
        }
        let link = self.skip_passage(self.skip_clause_link(noun.past));
        match self.side_past(link, false) {
            Some(past) => Some(Phrase::new(Kind::Room, first, past, "room on a side").with_inner(link, past)),
            None => Some(Phrase::new(Kind::Room, first, noun.past, "room")),
        }
    }

    fn names_passage(&self, head: usize) -> bool {
        PASSAGES.iter().any(|name| self.lower(head).contains(name)) || self.is(head, &["hall", "corridor"])
    }

    fn leads_through(&self, first: usize, noun: usize) -> bool {
        (first..noun).any(|i| self.is(i, &["through", "enter", "enters", "into", "in", "entering"]))
    }

    /// "that 's on your left", "which is on the left": the link is skipped.
    fn skip_clause_link(&self, at: usize) -> usize {
        let link = if self.is(at, &["that", "which"]) { at + 1 } else { at };
        let link = if self.role(link) == Some(Role::Copula) && link > at { link + 1 } else { link };
        if link > at + 1 { link } else { at }
    }

    /// "(the bedroom) down the hall (to the right)".
    fn skip_passage(&self, at: usize) -> usize {
        if !self.is(at, &["down", "across", "off", "along", "in", "at", "from"]) {
            return at;
        }
        let noun = self.noun_phrase(at + 1, false).filter(|noun| self.names_passage(noun.head));
        let past = noun.map_or(at, |noun| noun.past);
        if self.side_past(past, false).is_some() { past } else { at }
    }

    /// A place that is no furniture: relative to the hearer, a part of the room, a wall, the door.
    pub(super) fn place(&self, at: usize) -> Option<Phrase> {
        let start = self.skip(at, &[Role::Adverb]);
        if let Some(past) = self.part_past(at).or_else(|| self.part_past(start)) {
            return Some(Phrase::new(Kind::Part, at, past, "part of the room"));
        }
        // "It was the right": the preposition may be missing after a verb.
        let after_copula = at > 0
            && self.role(at - 1) == Some(Role::Copula)
            && matches!(self.role(start), Some(Role::Determiner | Role::Hearer));
        let side = self.side_past(start, false).or_else(|| self.side_past(start, after_copula));
        let past = side.or_else(|| self.ahead_past(start))?;
        Some(Phrase::new(Kind::Side, at, past, "side of the hearer"))
    }

    /// One past "on the right", "to your left hand side", "ahead to your left"; not "left of the bed".
    pub(super) fn side_past(&self, at: usize, after_motion: bool) -> Option<usize> {
        let mut i = self.skip(at, &[Role::Ahead, Role::Adverb]);
        let preposition = self.is(i, &["on", "to", "at", "towards", "toward", "in", "off", "from"]);
        if preposition {
            i += 1 + usize::from(self.is(i, &["off"]) && self.is(i + 1, &["to"]));
        } else if !after_motion {
            return None;
        }
        i = self.skip(i, &[Role::Adverb]);
        i = self.skip(i, &[Role::Determiner, Role::Hearer, Role::Adjective, Role::Adverb]);
        i += usize::from(self.is_unknown(i) && self.is(i + 1, &["'s"])) * 2;
        i += 2 * usize::from(self.role(i) == Some(Role::Pronoun) && self.is(i + 1, &["'s"]));
        i += usize::from(self.is(i, &["'s"]));
        if self.role(i) != Some(Role::Side) {
            return None;
        }
        let past = self.skip(i + 1, &[Role::SideWord]);
        let of_thing = self.is(past, &["of"]) && !self.is(past + 1, &["you", "him", "me", "it", "her"]);
        let of_room =
            of_thing && self.noun_phrase(past + 1, false).is_some_and(|n| self.class(n.head) == Some(Class::Room));
        if of_thing && !of_room && self.noun_phrase(past + 1, false).is_some() {
            return None;
        }
        // "to the right bed" is about the bed; "go right keys on the desk" is not.
        let bare = after_motion && !preposition;
        if self.class(past).is_some() && !bare {
            return None;
        }
        let past = if self.is(past, &["of"]) && self.role(past + 1) == Some(Role::Pronoun) { past + 2 } else { past };
        Some(past)
    }

    /// One past "straight ahead", "in front of you", "behind you", "across from where you are".
    fn ahead_past(&self, at: usize) -> Option<usize> {
        if let Some(past) = self.opposite_past(at) {
            return Some(past);
        }
        let hearer = |i: usize| self.is(i, &["you", "him", "me", "it", "her", "robot"]);
        let ahead = self.skip(at, &[Role::Ahead]);
        if ahead > at && self.lower(ahead - 1) == "ahead" {
            return Some(if self.is(ahead, &["of"]) && hearer(ahead + 1) { ahead + 2 } else { ahead });
        }
        if self.is(at, &["in"]) && self.is(at + 1, &["front"]) {
            if self.is(at + 2, &["of"]) && hearer(at + 3) {
                return Some(at + 4);
            }
            // "In front the couch": "of" was lost.
            let of_lost = self.role(at + 2) == Some(Role::Determiner)
                && self.noun_phrase(at + 2, false).is_some_and(|n| self.class(n.head).is_some_and(Class::is_furniture));
            return (!self.is(at + 2, &["of"]) && !of_lost).then_some(at + 2);
        }
        (self.is(at, &["behind"]) && hearer(at + 1)).then_some(at + 2)
    }

    /// One past "across from you", "opposite of where he is".
    fn opposite_past(&self, at: usize) -> Option<usize> {
        let linked = self.is(at, &["across", "opposite"]) && self.is(at + 1, &["from", "of"]);
        let from = at + 2;
        let place = self.is(from, &["where"]) && self.role(from + 1) == Some(Role::Pronoun);
        let past = self.skip(from + 2, &[Role::Copula, Role::Lying]);
        match (linked, place) {
            (true, true) => Some(past),
            (true, false) if self.role(from) == Some(Role::Pronoun) => Some(from + 1),
            _ => None,
        }
    }

    /// One past a part of the room, a wall or the door.
    pub(super) fn part_past(&self, at: usize) -> Option<usize> {
        self.halfway_past(at)
            .or_else(|| self.across_past(at))
            .or_else(|| self.door_past(at))
            .or_else(|| self.just_inside_past(at))
            .or_else(|| self.named_part_past(at))
    }

    /// "about halfway in", "halfway into the room".
    fn halfway_past(&self, at: usize) -> Option<usize> {
        let half = self.skip(at, &[Role::Adverb]);
        let past = match self.lower(half) {
            "halfway" => half + 1,
            "half" if self.is(half + 1, &["way"]) => half + 2,
            _ => return None,
        };
        let into =
            past + usize::from(self.is(past, &["in", "into", "to", "through", "down", "across", "inside", "up"]));
        let room = self.noun_phrase(into, false).filter(|n| into > past && self.class(n.head) == Some(Class::Room));
        Some(room.map_or(into, |noun| noun.past))
    }

    fn across_past(&self, at: usize) -> Option<usize> {
        if !self.is(at, &["across", "cross"]) {
            return None;
        }
        self.noun_phrase(at + 1, false).filter(|n| self.class(n.head) == Some(Class::Room)).map(|n| n.past)
    }

    /// "next to the door", "behind the door", "just inside".
    fn door_past(&self, at: usize) -> Option<usize> {
        let (_, noun) =
            self.relation(at).or_else(|| self.is(at, &["after", "from"]).then_some((Relation::On, at + 1)))?;
        let noun = self.noun_phrase(noun, false)?;
        (self.class(noun.head) == Some(Class::Opening)).then_some(noun.past)
    }

    /// "just as you enter the room", "immediately after you come in", "just inside".
    fn just_inside_past(&self, at: usize) -> Option<usize> {
        let start = self.skip(at, &[Role::Adverb]);
        if start == at && !self.is(at, &["just", "right"]) {
            return None;
        }
        if self.is(start, &["inside"]) && self.role(start + 1) != Some(Role::Determiner) {
            return Some(start + 1);
        }
        if !self.is(start, &["as", "when", "after"]) {
            return None;
        }
        let verb = self.skip(start + 1, &[Role::Pronoun, Role::Modal, Role::Adverb]);
        if !self.is(verb, &["enter", "enters", "entered", "come", "comes", "walk", "go", "get", "step"]) {
            return None;
        }
        let into = verb + 1 + usize::from(self.is(verb + 1, &["in", "into", "inside", "through"]));
        if into == verb + 1 && !self.is(verb, &["enter", "enters", "entered"]) {
            return None;
        }
        let fits = |class| matches!(class, Some(Class::Room | Class::Opening));
        let noun = self.noun_phrase(into, false).filter(|noun| fits(self.class(noun.head)));
        Some(noun.map_or(into, |noun| noun.past))
    }

    /// "at the back of the room", "on the far right end", "against the left wall", "in the corner".
    fn named_part_past(&self, at: usize) -> Option<usize> {
        if !self.is(at, &BEFORE_PART) {
            return None;
        }
        let noun = at + 1 + usize::from(self.is(at, &["over"]) && self.is(at + 1, &BEFORE_PART));
        self.part_after(at, noun).or_else(|| self.side_of_room_past(at))
    }

    /// One past a part of the room or a wall whose article stands at `noun`, in a phrase that begins at `at`.
    pub(super) fn part_after(&self, at: usize, noun: usize) -> Option<usize> {
        let mut i = noun;
        i = self.skip(i, &[Role::Determiner, Role::Hearer, Role::Adverb]);
        let modifiers = i;
        while matches!(self.role(i), Some(Role::Part | Role::Side | Role::Adjective)) || self.is(i, &["opposite"]) {
            i += 1;
        }
        i += usize::from(i > modifiers && self.role(i) == Some(Role::SideWord));
        let solid = matches!(self.class(i), Some(Class::Wall | Class::Part));
        let far = (modifiers..i).any(|k| self.role(k) == Some(Role::Part) || self.is(k, &["other", "opposite"]));
        if solid {
            i += 1;
            // "against the wall on the right" says which wall.
            if self.class(i - 1) == Some(Class::Wall)
                && let Some(past) = self.side_past(i, false).filter(|_| self.is(i, &["on", "to"]))
            {
                return Some(past);
            }
        } else if !far || self.class(i).is_some() || modifiers == noun && at == noun {
            return None;
        }
        // "at the end of the bed" is about the bed.
        if self.is(i, &["of", "in"])
            && let Some(noun) = self.noun_phrase(i + 1, false)
        {
            return match self.class(noun.head) {
                // "Along the wall in the room on the left": the room has a phrase of its own.
                Some(Class::Room) if self.is(i, &["in"]) && self.side_past(noun.past, false).is_some() => Some(i),
                Some(Class::Room | Class::Wall | Class::Part) => Some(noun.past),
                Some(class) if (class.is_furniture() || class == Class::Object) && self.is(i, &["of"]) => None,
                _ => Some(i),
            };
        }
        Some(i)
    }

    /// "on the left side of the room".
    fn side_of_room_past(&self, at: usize) -> Option<usize> {
        let past = self.side_past(at, false)?;
        let noun = self.is(past, &["of"]).then(|| self.noun_phrase(past + 1, false)).flatten()?;
        (self.class(noun.head) == Some(Class::Room)).then_some(noun.past)
    }

    /// Furniture or an object after a relation, or furniture named outright.
    pub(super) fn furniture(&self, first: usize, at: usize) -> Option<Phrase> {
        let start = self.skip(at, &[Role::Adverb]);
        if let Some(phrase) = self.side_then_furniture(first, start) {
            return Some(phrase);
        }
        if let Some((relation, noun)) = self.relation(start) {
            let noun = self.noun_phrase(noun, true)?;
            return self.related(first, relation, noun);
        }
        if let Some(held) = self.held(first, start) {
            return Some(held);
        }
        let noun = self.noun_phrase(start, false)?;
        let class = self.class(noun.head)?;
        // A bare mention only counts with something before it: "table" alone may be half of anything.
        let bare = class.is_furniture() && (noun.past > noun.first + 1 || first == 0);
        if bare && self.stands_beside(first, noun, class) {
            return Some(Phrase::new(Kind::Landmark, first, noun.past, "furniture in company"));
        }
        bare.then(|| Phrase::new(Kind::Target, first, noun.past, "furniture named"))
    }

    /// "A table and two chairs", "two chairs and a table": the table holds things, the chairs keep it company.
    fn stands_beside(&self, first: usize, noun: NounPhrase, class: Class) -> bool {
        if matches!(class, Class::TableLike | Class::Storage) {
            return false;
        }
        let before =
            first >= 2 && self.is(first - 1, &["and"]) && self.class(first - 2).is_some_and(Class::is_furniture);
        let after = self.is(noun.past, &["and"])
            && self.noun_phrase(noun.past + 1, false).is_some_and(|n| self.class(n.head) == Some(Class::TableLike));
        before || after
    }

    /// "that has a flower vase", "also had a lamp on it": things on the same support.
    fn held(&self, first: usize, at: usize) -> Option<Phrase> {
        let has = self.is(at, &["has", "have", "had", "holds", "having"]);
        let noun = has.then(|| self.noun_phrase(self.skip(at + 1, &[Role::Adverb]), true)).flatten()?;
        let class = self.class(noun.head).unwrap_or(Class::Object);
        let small = matches!(class, Class::Object | Class::Lamp | Class::Screen | Class::Plant);
        let past = self.on_it_past(self.second_noun_past(noun.past, class));
        small.then(|| Phrase::new(Kind::ObjectMark, first, past, "that has an object"))
    }

    /// One past "on it", "on top of it", "on top".
    pub(super) fn on_it_past(&self, at: usize) -> usize {
        let top = at + 1 + usize::from(self.is(at + 1, &["top"])) + usize::from(self.is(at + 2, &["of"]));
        let on = self.is(at, &["on"]);
        if on && self.is(top, &["it", "them", "there"]) {
            return top + 1;
        }
        if on && self.is(at + 1, &["top"]) && self.relation(at).is_none() { at + 2 } else { at }
    }

    fn related(&self, first: usize, relation: Relation, noun: NounPhrase) -> Option<Phrase> {
        let Some(class) = self.class(noun.head) else {
            // A landmark whose name is new: "next to the terrarium".
            let told = self.noun_has_article(noun.first, noun.head) || self.role(noun.first) == Some(Role::Number);
            // "A mug with a handle": what a thing has is no landmark, what stands on it is.
            let part_of_it = self.is(noun.first - 1, &["with"]) && self.on_it_past(noun.past) == noun.past;
            let beside = matches!(relation, Relation::Landmark(_)) && told && !part_of_it;
            return beside.then(|| Phrase::new(Kind::ObjectMark, first, noun.past, "by an unknown thing"));
        };
        let past = self.second_noun_past(noun.past, class);
        match (relation, class) {
            (Relation::Landmark(_), Class::Object) => {
                Some(Phrase::new(Kind::ObjectMark, first, self.on_it_past(past), "by an object"))
            }
            (Relation::Landmark(_), Class::Lamp | Class::Plant) => {
                Some(Phrase::new(Kind::ObjectMark, first, self.on_it_past(past), "by a small thing"))
            }
            (_, Class::Object) => None,
            (Relation::Landmark(_), class) if class.is_furniture() => {
                Some(Phrase::new(Kind::Landmark, first, past, "by furniture"))
            }
            (_, class) if class.is_furniture() => Some(Phrase::new(Kind::Target, first, noun.past, "on furniture")),
            _ => None,
        }
    }

    /// "to the right bed": what was meant is "to the right of the bed".
    fn side_then_furniture(&self, first: usize, at: usize) -> Option<Phrase> {
        let side = self.skip(at + 1, &[Role::Determiner]);
        let fits = self.is(at, &["to", "on"])
            && side > at + 1
            && self.role(side) == Some(Role::Side)
            && self.class(side + 1).is_some_and(|class| class.is_furniture() && class != Class::TableLike);
        fits.then(|| Phrase::new(Kind::Landmark, first, side + 2, "side of furniture, \"of\" missing"))
    }

    /// "near a plant and a lamp": the second belongs to the same relation.
    fn second_noun_past(&self, past: usize, class: Class) -> usize {
        if !self.is(past, &["and"]) {
            return past;
        }
        let second = self.noun_phrase(past + 1, false).filter(|noun| noun.first < noun.head);
        let alike =
            |other: Class| other == class || other.is_furniture() == class.is_furniture() && other != Class::TableLike;
        let clause = |noun: &NounPhrase| matches!(self.role(noun.past), Some(Role::Copula | Role::Modal));
        match second {
            Some(noun) if self.class(noun.head).is_some_and(alike) && !clause(&noun) => noun.past,
            _ => past,
        }
    }
}
