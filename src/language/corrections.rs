//! What phrases mean beside one another: what is taken back or ruled out, and places that go on from a move.

use super::phrase::{Act, From, Kind, Phrase};
use super::unit::Unit;
use super::word_class::{Role, Roles};

/// Most words between "not" and what it rules out.
const MOST_AFTER_NOT: usize = 4;

/// "Not the table by the door", "don't go to the bedroom": what is ruled out stays, and no longer counts.
pub(super) fn rule_out(phrases: &mut [Phrase], units: &[Unit]) {
    let mut ruled_to: Option<usize> = None;
    for at in 0..phrases.len() {
        let first = phrases[at].first;
        let after_not = at > 0 && phrases[at - 1].kind == Kind::Not && {
            let gap = phrases[at - 1].past..first;
            gap.len() <= MOST_AFTER_NOT
                && gap.clone().all(|i| {
                    let unit = &units[i];
                    unit.noun.is_none() && !unit.stop && !unit.has(Role::Conjunction) && !unit.has(Role::Side)
                })
        };
        if after_not && begins_sentence(&phrases[at]) {
            // "In the garage but it's not there the drill is …": the place before is what is ruled out.
            let before = phrases[..at - 1].iter().rposition(|phrase| matches!(phrase.kind, Kind::Target | Kind::Room));
            if let Some(before) = before {
                phrases[before].kind = Kind::RuledOut;
            }
            ruled_to = None;
            continue;
        }
        let taken_back = at > 0 && phrases[at - 1].kind == Kind::Not && phrases[at - 1].held;
        let phrase = &mut phrases[at];
        // "Apart from the beer": said with what it rules out.
        if phrase.kind == Kind::Not && !phrase.nouns.is_empty() {
            let generic = phrase.noun().is_some_and(|noun| noun.generic);
            phrase.kind = Kind::RuledOut;
            ruled_to = generic.then_some(phrase.past);
            continue;
        }
        let begins = units[first].pause || units[first].has(Role::Motion) || units[first].has(Role::Turn);
        let attaches = matches!(phrase.kind, Kind::Side | Kind::Part | Kind::Landmark | Kind::ObjectMark | Kind::Room);
        let attached = ruled_to == Some(first) && attaches && !begins;
        ruled_to = None;
        if matches!(phrase.kind, Kind::Stop | Kind::Aside | Kind::Correction | Kind::Not)
            || !after_not && !attached
            || phrase.kind == Kind::Object && phrase.nouns.is_empty() && !phrase.act.is_request()
        {
            continue;
        }
        // "Not the cup from the kitchen": what is asked for may still come from there.
        let thing = phrase.kind == Kind::Object && phrase.noun().is_some_and(|noun| !noun.generic);
        ruled_to = (!thing).then_some(phrase.past);
        // "Not the one by the door" rules out no door.
        if attached && phrase.kind != Kind::Room
            || phrase.first > 0 && matches!(units[phrase.first - 1].lower.as_ref(), "one" | "ones")
        {
            phrase.nouns.clear();
        }
        if taken_back {
            phrase.nouns.clear();
        }
        phrase.kind = Kind::RuledOut;
        phrase.inner = None;
    }
}

/// "The drill is": a statement of its own, that no "not" before it reaches.
fn begins_sentence(phrase: &Phrase) -> bool {
    phrase.kind == Kind::Object && phrase.act == Act::State && phrase.noun().is_some_and(|noun| noun.past < phrase.past)
}

/// "Go forward and then to the right": a side joined to a move is a move as well.
pub(super) fn continue_moves(phrases: &mut [Phrase], units: &[Unit]) {
    for at in 1..phrases.len() {
        let (before, phrase) = (&phrases[at - 1], &phrases[at]);
        let moved = matches!(before.kind, Kind::Go | Kind::Turn) || before.kind == Kind::Room && before.inner.is_none();
        let gap = before.past..phrase.first;
        let joined = gap.clone().any(|i| units[i].has(Role::Conjunction))
            && gap.clone().all(|i| units[i].has(Role::Conjunction) || units[i].has(Role::Adverb));
        // "And to your left is a shelf" is no move.
        let told = units.get(phrase.past).is_some_and(|unit| unit.has(Role::Copula) || unit.has(Role::There));
        let told = told
            || phrases.get(at + 1).is_some_and(|next| {
                next.first == phrase.past
                    && matches!(next.kind, Kind::Target | Kind::Object)
                    && !next.is_reached()
                    && units[next.first].roles.meet(
                        Roles::of(Role::Copula)
                            .with(Roles::of(Role::There))
                            .with(Roles::of(Role::Modal))
                            .with(Roles::of(Role::Pronoun))
                            .with(Roles::of(Role::Determiner)),
                    )
            });
        if !(moved && joined && phrase.kind == Kind::Side) || told {
            continue;
        }
        let words = &units[phrase.first..phrase.past];
        let turns = words.iter().any(|unit| unit.has(Role::Side));
        let to_side = words.iter().any(|unit| matches!(unit.lower.as_ref(), "to" | "towards" | "toward"));
        let ahead = !turns && words[0].has(Role::Ahead) && before.kind != Kind::Room;
        let kind = if turns && to_side {
            Kind::Turn
        } else if ahead {
            Kind::Go
        } else {
            continue;
        };
        phrases[at].kind = kind;
        phrases[at].from = From::Move;
    }
}

/// "Turn left, sorry, turn right": the phrase before the correction no longer counts when one of its kind follows.
pub(super) fn take_back_corrected(phrases: &mut Vec<Phrase>, units: &[Unit]) {
    for at in 1..phrases.len() {
        if phrases[at].kind != Kind::Correction {
            continue;
        }
        // A correction may come in several words: "no wait actually".
        let last = (at..phrases.len()).take_while(|&i| phrases[i].kind == Kind::Correction).last().unwrap_or(at);
        let kind = phrases[at - 1].kind;
        let again = phrases[last + 1..]
            .iter()
            .filter(|next| !matches!(next.kind, Kind::Aside) && (next.kind != Kind::Go || kind == Kind::Go))
            .take(2)
            .find(|next| alike(&phrases[at - 1], next));
        let Some(again) = again else { continue };
        // "No, the sofa is on the left": a new sentence that names no place of the kind takes nothing back.
        let far = again.first > phrases[last].past + 6;
        if far || units[phrases[at].first].stop {
            continue;
        }
        phrases[at - 1].kind = Kind::Corrected;
        phrases[at - 1].past = phrases[last].past;
        phrases[at - 1].inner = None;
    }
    // "No, not a wallet": what a correction takes back is not ruled out for good.
    for at in 1..phrases.len() {
        phrases[at].held |= phrases[at].kind == Kind::Not && phrases[at - 1].kind == Kind::Correction;
    }
    phrases.retain(|phrase| phrase.kind != Kind::Correction);
}

/// Whether one phrase can take the place of another.
fn alike(old: &Phrase, new: &Phrase) -> bool {
    let place = |kind: Kind| matches!(kind, Kind::Turn | Kind::Side | Kind::Room | Kind::Part);
    let holder = |kind: Kind| matches!(kind, Kind::Target | Kind::Landmark);
    if matches!(old.kind, Kind::Stop | Kind::Correction | Kind::Aside | Kind::Not | Kind::Leave) {
        return false;
    }
    match old.kind {
        Kind::Object => new.kind == Kind::Object && old.noun().is_some() && new.noun().is_some(),
        kind => kind == new.kind || place(kind) && place(new.kind) || holder(kind) && holder(new.kind),
    }
}
