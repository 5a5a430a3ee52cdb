//! Moves: "roll forward", "until you hit the wall", "take a left".

use super::cursor::{Cursor, Relation};
use super::phrases::{Kind, Phrase};
use super::word_class::{Class, Role};

/// Words that may stand within a move, between its verb and its end.
const WITHIN_MOVE: [Role; 9] = [
    Role::Adverb,
    Role::Ahead,
    Role::Number,
    Role::Step,
    Role::FootUnit,
    Role::MetreUnit,
    Role::Extent,
    Role::Motion,
    Role::Again,
];

impl Cursor<'_> {
    /// "go forward", "walk straight about halfway in", "take two steps forward", "go left", "come into the room …".
    pub(super) fn motion(&self, at: usize) -> Option<Phrase> {
        if self.role(at) == Some(Role::Until) && at > 0 {
            return Some(self.until(at, at));
        }
        if self.is(at, &["cross", "crosses"])
            && let Some(room) = self.noun_phrase(at + 1, false).filter(|n| self.class(n.head) == Some(Class::Room))
        {
            return Some(Phrase::new(Kind::Part, at, room.past, "cross the room"));
        }
        let steps = self.role(at) == Some(Role::Turn) && {
            let number = self.skip(at + 1, &[Role::Determiner, Role::Adverb]);
            let after = self.skip(number, &[Role::Number, Role::Preposition]);
            after > number && self.role(after) == Some(Role::Step) || self.is(after, &["step"])
        };
        let reach = self.role(at) == Some(Role::Reach) && !self.is(at, &["get"]);
        let ahead =
            self.role(at) == Some(Role::Ahead) && self.is(at, &["forward", "straight"]) && !self.is(at + 1, &["ahead"]);
        if self.role(at) != Some(Role::Motion) && !steps && !reach && !ahead {
            return None;
        }
        let mut end = at + 1;
        loop {
            let next = self.skip(end, &WITHIN_MOVE);
            let little =
                self.role(next) == Some(Role::Determiner) && self.is(next + 1, &["little", "bit", "few", "couple"]);
            let next = if little { next + 2 } else { next };
            let of = self.is(next, &["of"]) && matches!(self.role(next + 1), Some(Role::Step));
            let down = self.is(next, &["down", "up", "on", "for", "the"]) && self.role(next + 1) == Some(Role::Extent);
            let back_in = self.is(next, &["down", "back", "on", "over", "in"])
                && self.is(next + 1, &["to", "into", "toward", "towards", "until"]);
            let next = next + usize::from(of || down || back_in);
            if next == end {
                break;
            }
            end = next;
        }
        Some(self.motion_from(at, end))
    }

    fn motion_from(&self, at: usize, end: usize) -> Phrase {
        if let Some(room) = self.room(at, end) {
            return room;
        }
        let enters = self.is(at, &["enter", "enters", "entering"]);
        if let Some(noun) = enters.then(|| self.noun_phrase(end, false)).flatten()
            && let Some(room) = self.room_from(at, noun)
        {
            return room;
        }
        if let Some(past) = self.part_past(end).filter(|_| !self.is(end, &["through"])) {
            return Phrase::new(Kind::Go, at, past, "go to a part of the room");
        }
        if let Some(past) = self.side_past(end, true) {
            return Phrase::new(Kind::Turn, at, past, "go to a side");
        }
        if self.is(end, &["back", "around"])
            && self.relation(end).is_none_or(|(_, noun)| self.noun_phrase(noun, false).is_none())
        {
            return Phrase::new(Kind::Turn, at, end + 1, "go back");
        }
        if self.role(end) == Some(Role::Until) {
            return self.until(at, end);
        }
        self.leading_to(at, end).unwrap_or(Phrase::new(Kind::Go, at, end, "go"))
    }

    /// "until you hit the wall", "til you are at the table at the back".
    fn until(&self, at: usize, until: usize) -> Phrase {
        const SUBJECT_AND_VERB: [Role; 9] = [
            Role::Pronoun,
            Role::Modal,
            Role::Copula,
            Role::Reach,
            Role::Find,
            Role::Motion,
            Role::Adverb,
            Role::Has,
            Role::Look,
        ];
        let end = self.skip(until + 1, &SUBJECT_AND_VERB);
        if self.role(end) == Some(Role::Turn) {
            return Phrase::new(Kind::Go, at, until.max(at + 1), "go until a turn");
        }
        // "until you reach the opposite end", "until you are at the middle of the room".
        if end > until + 1
            && let Some(past) = self.part_after(end, end)
        {
            return Phrase::new(Kind::Go, at, past, "go until a part of the room");
        }
        let bare = self.noun_phrase(end, false).filter(|_| end > until + 1);
        if let Some(noun) = bare {
            return match self.class(noun.head) {
                Some(class) if class.is_furniture() => {
                    Phrase::new(Kind::Target, at, noun.past, "go until furniture").with_inner(at, noun.first)
                }
                _ => Phrase::new(Kind::Go, at, noun.past, "go until"),
            };
        }
        self.leading_to(at, end).unwrap_or(Phrase::new(Kind::Go, at, end, "go until"))
    }

    /// What a move leads to: furniture, a landmark to pass, a part of the room.
    fn leading_to(&self, at: usize, end: usize) -> Option<Phrase> {
        if let Some((relation, noun)) = self.relation(end)
            && let Some(noun) = self.noun_phrase(noun, false)
            && let Some(class) = self.class(noun.head).filter(|class| class.is_furniture() || *class == Class::Object)
        {
            if class == Class::Object {
                return Some(Phrase::new(Kind::ObjectMark, at, noun.past, "go to an object").with_inner(at, end));
            }
            let kind = if let Relation::Landmark(_) = relation { Kind::Landmark } else { Kind::Target };
            let inner_past = if kind == Kind::Target { noun.first } else { end };
            return Some(Phrase::new(kind, at, noun.past, "go to furniture").with_inner(at, inner_past));
        }
        let past = self.part_past(end)?;
        Some(Phrase::new(Kind::Go, at, past, "go to a part of the room"))
    }

    /// "turn left", "take a right", "make a ninety degree turn to the left", "look to your left", "then left again".
    pub(super) fn turn(&self, at: usize) -> Option<Phrase> {
        let again = self.role(at) == Some(Role::Side) && {
            // "… and left", "take a right, no, left".
            let conjunction = at > 0 && matches!(self.role(at - 1), Some(Role::Conjunction | Role::Correction));
            self.role(at + 1) == Some(Role::Again)
                || conjunction && self.class(at + 1).is_none() && !self.is(at + 1, &["of"])
        };
        if again {
            return Some(Phrase::new(Kind::Turn, at, self.skip(at + 1, &[Role::Again]), "turn again"));
        }
        // "Hang a left, then a right": the verb is said once.
        let another = self.is(at, &["a", "another"])
            && at > 0
            && self.role(at - 1) == Some(Role::Conjunction)
            && self.role(at + 1) == Some(Role::Side)
            && self.class(at + 2).is_none()
            && !self.is(at + 2, &["of"]);
        if another {
            return Some(Phrase::new(Kind::Turn, at, at + 2, "turn again"));
        }
        let looks = self.role(at) == Some(Role::Look);
        if self.role(at) != Some(Role::Turn) && !looks {
            return None;
        }
        if looks && self.is(at + 1, &["down"]) {
            return Some(Phrase::new(Kind::Object, at, at + 2, "look down"));
        }
        if looks && self.is(at + 1, &["around"]) {
            return Some(Phrase::new(Kind::Go, at, at + 2, "look around"));
        }
        if self.is(at + 1, &["around", "back"])
            && self.noun_phrase(at + 2, false).is_none_or(|noun| noun.first == noun.head)
        {
            return Some(Phrase::new(Kind::Turn, at, at + 2, "turn around"));
        }
        let mut side = at + 1;
        while side < at + 9 && self.may_precede_side(side) {
            side += 1;
        }
        if self.role(side) == Some(Role::Side) && self.class(side + 1).is_none() {
            let hand = self.skip(side + 1, &[Role::SideWord]);
            // "a left turn"; but in "turn right turn left" the second turn is its own.
            let turn = usize::from(self.is(hand, &["turn"]) && self.role(hand + 1) != Some(Role::Side));
            let past = self.skip(hand + turn, &[Role::Again, Role::Number, Role::DegreeUnit]);
            return Some(Phrase::new(Kind::Turn, at, past, "turn"));
        }
        let wall = looks.then(|| self.noun_phrase(at + 1, false)).flatten();
        if let Some(noun) = wall.filter(|noun| self.class(noun.head) == Some(Class::Wall)) {
            return Some(Phrase::new(Kind::Part, at, noun.past, "face the wall"));
        }
        self.room(at, at + 1)
    }

    fn may_precede_side(&self, at: usize) -> bool {
        const BEFORE: [Role; 8] = [
            Role::Adverb,
            Role::Determiner,
            Role::Hearer,
            Role::Adjective,
            Role::Number,
            Role::DegreeUnit,
            Role::Turn,
            Role::Ordinal,
        ];
        self.role(at).is_some_and(|role| BEFORE.contains(&role))
            // "take a le right": a word broken off.
            || self.is_unknown(at) && self.role(at - 1) == Some(Role::Determiner) && self.role(at + 1) == Some(Role::Side)
            || self.is(at, &["to", "towards", "toward", "sharp", "instant", "hard", "degrees", "then", "off"])
    }
}
