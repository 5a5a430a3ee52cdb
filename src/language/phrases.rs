//! Finite-state patterns over units: what each stretch of the description is about.

use super::cursor::{Cursor, Relation};
use super::lexicon::{Class, Role};
use super::units::Unit;

/// What a phrase is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A move ahead, up to its stated end.
    Go,
    /// A change of heading.
    Turn,
    /// A room or a door to a room; `inner` is the words that pick it by side.
    Room,
    /// A place relative to the hearer.
    Side,
    /// A part of the room, a wall, the door.
    Part,
    /// Furniture that holds the object or is gone to; `inner` is the move that leads there.
    Target,
    /// Furniture as landmark; `inner` is the move past it.
    Landmark,
    /// An object as landmark.
    ObjectMark,
    /// The head of a clause about the object.
    Object,
    /// Whose view a direction is said from.
    Perspective,
    /// A self-correction.
    Correction,
    /// What a correction took back.
    Corrected,
    /// The end of a sentence.
    Stop,
}

/// A stretch of units with what it is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phrase {
    /// What it is about.
    pub kind: Kind,
    /// First unit.
    pub first: usize,
    /// One past the last unit.
    pub past: usize,
    /// A phrase inside it.
    pub inner: Option<(usize, usize)>,
    /// The pattern that made it.
    pub rule: &'static str,
}

impl Phrase {
    pub(super) fn new(kind: Kind, first: usize, past: usize, rule: &'static str) -> Self {
        Self { kind, first, past, inner: None, rule }
    }

    pub(super) fn with_inner(self, first: usize, past: usize) -> Self {
        Self { inner: (first < past).then_some((first, past)), ..self }
    }
}

/// The phrases of a text, in order, not overlapping.
pub fn find(units: &[Unit]) -> Vec<Phrase> {
    let cursor = Cursor::new(units);
    let mut phrases: Vec<Phrase> = Vec::new();
    let mut at = 0;
    while at < cursor.len() {
        match cursor.phrase_at(at) {
            Some(phrase) => {
                at = phrase.past.max(at + 1);
                phrases.push(phrase);
            }
            None => at += 1,
        }
    }
    take_back_corrected(&mut phrases);
    continue_moves(&mut phrases, &cursor);
    rule_out(&mut phrases, &cursor);
    phrases
}

/// "Not the table by the door": what is ruled out stays in the tree and no longer counts.
fn rule_out(phrases: &mut [Phrase], cursor: &Cursor) {
    let mut ruled_to = None;
    for phrase in phrases.iter_mut() {
        let place = matches!(
            phrase.kind,
            Kind::Turn | Kind::Side | Kind::Part | Kind::Target | Kind::Landmark | Kind::ObjectMark
        );
        let negated = (1..=2).any(|back| {
            phrase.first >= back
                && cursor.role(phrase.first - back) == Some(Role::Negation)
                && (back == 1 || cursor.role(phrase.first - 1) == Some(Role::Adverb))
        });
        let attached = ruled_to == Some(phrase.first) && phrase.kind != Kind::Target && phrase.kind != Kind::Turn;
        if place && (negated || attached) {
            phrase.kind = Kind::Corrected;
            phrase.inner = None;
            ruled_to = Some(phrase.past);
        }
    }
}

/// "Go forward and then to the right": a side joined to a move is a move as well.
fn continue_moves(phrases: &mut [Phrase], cursor: &Cursor) {
    for at in 1..phrases.len() {
        let (before, phrase) = (phrases[at - 1], phrases[at]);
        let moved = matches!(before.kind, Kind::Go | Kind::Turn);
        let gap = before.past..phrase.first;
        let joined = gap.clone().any(|i| cursor.role(i) == Some(Role::Conjunction))
            && gap.clone().all(|i| matches!(cursor.role(i), Some(Role::Conjunction | Role::Adverb)));
        if !(moved && joined && phrase.kind == Kind::Side) {
            continue;
        }
        let turns = (phrase.first..phrase.past).any(|i| cursor.role(i) == Some(Role::Side));
        let to_side = (phrase.first..phrase.past).any(|i| cursor.is(i, &["to", "towards", "toward"]));
        if turns && to_side {
            phrases[at].kind = Kind::Turn;
        } else if !turns && cursor.role(phrase.first) == Some(Role::Ahead) {
            phrases[at].kind = Kind::Go;
        }
    }
}

/// "Turn left, sorry, turn right": the phrase before the correction no longer counts when one of its kind follows.
fn take_back_corrected(phrases: &mut Vec<Phrase>) {
    for at in 1..phrases.len() {
        if phrases[at].kind != Kind::Correction {
            continue;
        }
        let kind = phrases[at - 1].kind;
        let about_place = |kind: Kind| matches!(kind, Kind::Turn | Kind::Side | Kind::Room | Kind::Part);
        let again = phrases[at + 1..]
            .iter()
            .filter(|next| next.kind != Kind::Go || kind == Kind::Go)
            .take(2)
            .any(|next| next.kind == kind || about_place(kind) && about_place(next.kind));
        if again && !matches!(kind, Kind::Object | Kind::Stop | Kind::Correction) {
            phrases[at - 1].kind = Kind::Corrected;
            phrases[at - 1].past = phrases[at].past;
            phrases[at - 1].inner = None;
        }
    }
    phrases.retain(|phrase| phrase.kind != Kind::Correction);
}

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
    fn phrase_at(&self, at: usize) -> Option<Phrase> {
        if self.is_stop(at) {
            return Some(Phrase::new(Kind::Stop, at, at + 1, "stop"));
        }
        self.correction(at)
            .or_else(|| self.perspective(at))
            .or_else(|| self.object_clause(at))
            .or_else(|| self.motion(at))
            .or_else(|| self.turn(at))
            .or_else(|| self.room(at, at))
            .or_else(|| self.place(at))
            .or_else(|| self.furniture(at, at))
    }

    /// "As you face it", "when you are looking at the bed", "from your point of view".
    fn perspective(&self, at: usize) -> Option<Phrase> {
        if self.is(at, &["from"]) && self.role(at + 1) == Some(Role::Hearer) {
            let view = self.is(at + 2, &["view", "perspective", "side", "point"]);
            let of_view = usize::from(self.is(at + 3, &["of"])) * 2;
            return view.then(|| Phrase::new(Kind::Perspective, at, at + 3 + of_view, "whose view"));
        }
        let subject = self.is(at, &["as", "when", "if", "while"]) && self.role(at + 1) == Some(Role::Pronoun);
        let verb = self.skip(at + 2, &[Role::Copula]);
        if !subject || !self.is(verb, &["face", "facing", "look", "looking", "looked", "faces", "looks"]) {
            return None;
        }
        let object = verb + 1 + usize::from(self.is(verb + 1, &["at", "in", "toward", "towards"]));
        // "If you look to your left" is a turn.
        if self.is(object, &["to", "left", "right", "straight", "down"]) {
            return None;
        }
        let pronoun = usize::from(self.is(object, &["it", "them", "that"]));
        let past = self.noun_phrase(object, false).map_or(object + pronoun, |noun| noun.past);
        Some(Phrase::new(Kind::Perspective, at, past, "whose view"))
    }

    fn correction(&self, at: usize) -> Option<Phrase> {
        let past = self.skip(at, &[Role::Correction]);
        if self.is(at, &["let"]) && self.is(at + 1, &["'s", "me"]) && self.is(at + 2, &["see"]) {
            return Some(Phrase::new(Kind::Correction, at, at + 3, "thinking aloud"));
        }
        let pronoun = self.is(at, &["i"]) && self.is(at + 1, &["mean"]);
        match (pronoun, past > at) {
            (true, _) => Some(Phrase::new(Kind::Correction, at, at + 2, "self-correction")),
            (_, true) => Some(Phrase::new(Kind::Correction, at, past, "self-correction")),
            _ => None,
        }
    }

    /// "go forward", "walk straight about halfway in", "take two steps forward", "go left", "come into the room …".
    fn motion(&self, at: usize) -> Option<Phrase> {
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
    fn turn(&self, at: usize) -> Option<Phrase> {
        let again = self.role(at) == Some(Role::Side) && {
            let conjunction = at > 0 && self.role(at - 1) == Some(Role::Conjunction);
            self.role(at + 1) == Some(Role::Again)
                || conjunction && self.class(at + 1).is_none() && !self.is(at + 1, &["of"])
        };
        if again {
            return Some(Phrase::new(Kind::Turn, at, self.skip(at + 1, &[Role::Again]), "turn again"));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Lexicon, tokens::tokenize, units};

    fn kinds(text: &str) -> Vec<Kind> {
        let words = tokenize(text);
        find(&units(&words, Lexicon::embedded())).into_iter().map(|phrase| phrase.kind).collect()
    }

    #[test]
    fn moves_turns_and_places() {
        assert_eq!(kinds("head forward then hang a left"), [Kind::Go, Kind::Turn]);
        assert_eq!(kinds("keep walking until you hit the wall then right again"), [Kind::Go, Kind::Turn]);
        assert_eq!(kinds("take three steps forward and make a ninety degree turn to the left"), [Kind::Go, Kind::Turn]);
    }

    #[test]
    fn rooms_and_the_side_that_picks_them() {
        assert_eq!(kinds("enter the second door on your left"), [Kind::Room]);
        assert_eq!(kinds("the mug is in the bedroom on the left hand side"), [Kind::Object, Kind::Room]);
    }

    #[test]
    fn furniture_as_target_and_as_landmark() {
        assert_eq!(kinds("on the small round table behind the couch"), [Kind::Target, Kind::Landmark]);
        assert_eq!(kinds("go past the bed to the desk"), [Kind::Landmark, Kind::Target]);
    }

    #[test]
    fn a_correction_takes_back_what_stands_before_it() {
        assert_eq!(kinds("turn left no sorry turn right"), [Kind::Corrected, Kind::Turn]);
    }
}
