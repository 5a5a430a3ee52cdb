//! What a statement is about: the thing, or furniture that is itself asked for.

use super::noun_phrases::Article;
use super::phrase::{Act, Kind, Phrase, can_be_carried};
use super::relations::Relation;
use super::unit::Unit;
use super::word_class::Class;

/// "The lamp is on the desk" is about the lamp; "the sofa is behind you" brings in the sofa.
pub(super) fn settle_subjects(phrases: &mut [Phrase], units: &[Unit]) {
    for at in 0..phrases.len() {
        let phrase = &phrases[at];
        let furniture = phrase.noun().is_some_and(|noun| noun.is_furniture());
        if phrase.kind == Kind::Object && phrase.act == Act::State && furniture && !is_thing(at, phrases, units) {
            phrases[at].kind = Kind::Target;
        }
    }
}

/// Whether furniture is told to stand on other furniture, and small enough to be what is looked for.
fn is_thing(at: usize, phrases: &[Phrase], units: &[Unit]) -> bool {
    let phrase = &phrases[at];
    let Some(noun) = phrase.noun().filter(|noun| noun.article == Article::Definite) else { return false };
    let small = can_be_carried(noun) || matches!(noun.class, Some(Class::Storage | Class::Appliance | Class::Screen));
    let next = phrases[at + 1..].iter().find(|next| next.kind != Kind::Aside);
    let after_room = phrases[at + 1..].iter().find(|next| !matches!(next.kind, Kind::Aside | Kind::Room));
    let in_room = next.is_some_and(|next| next.kind == Kind::Room && next.first == phrase.past);
    let holds = |next: &Phrase| {
        let on = matches!(next.relation, Some(Relation::On | Relation::In)) && next.kind == Kind::Target;
        on && next.noun().is_some_and(|noun| {
            matches!(
                noun.class,
                Some(Class::TableLike | Class::Storage | Class::Seat | Class::Couch | Class::Bed | Class::Appliance)
            )
        })
    };
    let on_it = units.get(phrase.past).is_some_and(|unit| unit.lower == "on")
        && units.get(phrase.past + 1).is_some_and(|unit| matches!(unit.lower.as_ref(), "it" | "there"));
    small && (after_room.is_some_and(holds) || on_it) || in_room && can_be_carried(noun)
}
