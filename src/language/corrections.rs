//! What phrases mean beside one another: what is taken back or ruled out, and places that go on from a move.

use super::cursor::Cursor;
use super::phrases::{Kind, Phrase};
use super::word_class::Role;

/// "Not the table by the door": what is ruled out stays in the tree and no longer counts.
pub(super) fn rule_out(phrases: &mut [Phrase], cursor: &Cursor) {
    let mut ruled_to = None;
    for phrase in phrases.iter_mut() {
        let place = matches!(
            phrase.kind,
            Kind::Turn | Kind::Side | Kind::Part | Kind::Target | Kind::Landmark | Kind::ObjectMark
        );
        let negated = cursor.is_negated(phrase.first);
        let attached = ruled_to == Some(phrase.first) && phrase.kind != Kind::Target && phrase.kind != Kind::Turn;
        if place && (negated || attached) {
            phrase.kind = Kind::Corrected;
            phrase.inner = None;
            ruled_to = Some(phrase.past);
        }
    }
}

/// "Go forward and then to the right": a side joined to a move is a move as well.
pub(super) fn continue_moves(phrases: &mut [Phrase], cursor: &Cursor) {
    for at in 1..phrases.len() {
        let (before, phrase) = (phrases[at - 1], phrases[at]);
        let moved = matches!(before.kind, Kind::Go | Kind::Turn);
        let gap = before.past..phrase.first;
        let joined = gap.clone().any(|i| cursor.role(i) == Some(Role::Conjunction))
            && gap.clone().all(|i| matches!(cursor.role(i), Some(Role::Conjunction | Role::Adverb)));
        // "And to your left is a shelf" is no move.
        let told = matches!(cursor.role(phrase.past), Some(Role::Copula | Role::There));
        if !(moved && joined && phrase.kind == Kind::Side) || told {
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
pub(super) fn take_back_corrected(phrases: &mut Vec<Phrase>) {
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

impl Cursor<'_> {
    /// Whether a "not" stands right before: "not on the desk", "not the one by the door".
    fn is_negated(&self, at: usize) -> bool {
        const BETWEEN: [Role; 4] = [Role::Adverb, Role::Determiner, Role::Number, Role::Generic];
        let before = |back: usize| at.checked_sub(back).and_then(|at| self.role(at));
        let between = (1..=3).take_while(|back| before(*back).is_some_and(|role| BETWEEN.contains(&role))).count();
        before(between + 1) == Some(Role::Negation)
    }
}
