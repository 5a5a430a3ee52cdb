//! References and directions of a phrase.

use super::meaning::pair;
use crate::language::{Class, From, NounPhrase, Phrase, Unit, name_of};
use crate::record::{Amount, Direction, Pair};

/// The pairs of a phrase, in their likeliest frames; `it` is the furniture or thing named last.
pub fn pairs_of(phrase: &Phrase, units: &[Unit], it: Option<&str>) -> Vec<Pair> {
    let directions = || phrase.directions.iter().flatten().copied();
    let of = |reference: &str| directions().map(|direction| pair(reference, direction)).collect::<Vec<_>>();
    let mut pairs = match phrase.from {
        From::Nothing => Vec::new(),
        From::Move => of("move"),
        From::Robot => of("robot"),
        From::Room => of("room"),
        From::Wall => of("wall"),
        From::Door => of("door"),
        From::It => match it {
            Some(noun) => of(noun),
            None if phrase.directions[0] == Some(Direction::Side) => Vec::new(),
            None => of("robot"),
        },
        From::Nouns => noun_pairs(phrase, units),
    };
    if let (Some(first), Some(Amount::Fraction(_))) = (pairs.first_mut(), &phrase.amount) {
        first.amount.clone_from(&phrase.amount);
    }
    pairs
}

fn noun_pairs(phrase: &Phrase, units: &[Unit]) -> Vec<Pair> {
    let direction = phrase.directions[0].unwrap_or(Direction::Side);
    let mut pairs: Vec<Pair> = Vec::new();
    for noun in phrase.nouns.iter().filter(|noun| !noun.generic) {
        let mut own = pair(&reference_of(noun, units), direction);
        own.ordinal = noun.ordinal;
        pairs.push(own);
    }
    // The second reference of "between" is told within the pair as well.
    if direction == Direction::Between && pairs.len() == 2 {
        let [one, other] = [pairs[0].reference.clone(), pairs[1].reference.clone()];
        pairs[0].and = Some(other);
        pairs[1].and = one.thing().is_some().then_some(one).filter(|_| pairs[1].reference.thing().is_none());
    }
    // Between one wall and nothing else is no place.
    if direction == Direction::Between && pairs.len() != 2 {
        pairs.retain(|pair| pair.reference.thing().is_some());
    }
    pairs
}

fn reference_of(noun: &NounPhrase, units: &[Unit]) -> String {
    match noun.class {
        Some(Class::Wall) => "wall".to_string(),
        Some(Class::Opening) if noun.name == noun.head => "door".to_string(),
        _ => name_of(noun, units, false),
    }
}
