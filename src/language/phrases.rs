//! Phrases with what they mean: computed once, where their words are recognised.

use super::chart::{Edge, cheapest};
use super::corrections::{continue_moves, rule_out, take_back_corrected};
use super::grammar::{Grammar, RuleKind, Source};
use super::lexicon::Lexicon;
use super::matching::Text;
use super::noun_phrases::{Article, NounPhrase};
use super::numbers;
use super::phrase::{Act, From, Kind, Phrase, Recipient, can_be_carried};
use super::relations::Relation;
use super::subjects::settle_subjects;
use super::unit::Unit;
use super::word_class::{Class, Role};
use crate::record::{Amount, Direction};

/// A text as phrases.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading<'t> {
    /// Its units.
    pub units: Vec<Unit<'t>>,
    /// The phrases, in order, not overlapping.
    pub phrases: Vec<Phrase>,
    /// What the reading costs.
    pub cost: f32,
}

/// The phrases of a text.
pub fn find<'t>(units: Vec<Unit<'t>>, lexicon: &Lexicon) -> Reading<'t> {
    let grammar = Grammar::embedded();
    let text = Text::new(&units, lexicon, grammar);
    let path = cheapest(&text, grammar);
    let mut phrases: Vec<Phrase> = Vec::with_capacity(path.edges.len() + 2);
    let mut from = 0;
    for edge in &path.edges {
        add_stops(&mut phrases, &units, from, edge.first);
        phrases.push(phrase(&text, grammar, edge));
        from = edge.past;
    }
    add_stops(&mut phrases, &units, from, units.len());
    settle_subjects(&mut phrases, &units);
    settle_superlatives(&mut phrases, &units);
    take_back_corrected(&mut phrases, &units);
    continue_moves(&mut phrases, &units);
    rule_out(&mut phrases, &units);
    Reading { units, phrases, cost: path.cost }
}

/// "The farthest cabinet from the door", "the closest chair to the bed": the most of what the noun says.
fn settle_superlatives(phrases: &mut [Phrase], units: &[Unit]) {
    for at in 1..phrases.len() {
        let (before, rest) = phrases.split_at_mut(at);
        let (named, place) = (&before[at - 1], &mut rest[0]);
        if named.past != place.first || !matches!(place.kind, Kind::Target | Kind::Part | Kind::ObjectMark) {
            continue;
        }
        let says =
            |words: &[&str]| units[named.first..named.past].iter().any(|unit| words.contains(&unit.lower.as_ref()));
        let far = place.relation == Some(Relation::From) && says(&["farthest", "furthest"]);
        let near = place.relation == Some(Relation::To) && says(&["closest", "nearest"]);
        if far || near {
            let direction = if far { Direction::Far } else { Direction::Side };
            place.kind = Kind::Landmark;
            place.relation = Some(Relation::Landmark(direction));
            place.directions = [Some(direction), None];
            before[at - 1].nouns.iter_mut().for_each(|noun| noun.part = None);
        }
    }
}

fn add_stops(phrases: &mut Vec<Phrase>, units: &[Unit], from: usize, past: usize) {
    for at in (from..past).filter(|&at| units[at].stop) {
        phrases.push(empty(Kind::Stop, at, at + 1, "stop"));
    }
}

fn empty(kind: Kind, first: usize, past: usize, rule: &'static str) -> Phrase {
    Phrase {
        kind,
        first,
        past,
        inner: None,
        rule,
        act: Act::None,
        from: From::Nothing,
        directions: [None, None],
        relation: None,
        nouns: Vec::new(),
        side: None,
        recipient: None,
        amount: None,
        held: false,
        entering: false,
    }
}

fn phrase(text: &Text, grammar: &Grammar, edge: &Edge) -> Phrase {
    let rule = grammar.rule(edge.rule);
    let caught = &edge.caught;
    let mut phrase = empty(Kind::Aside, edge.first, edge.past, rule.written);
    phrase.inner = caught.inner;
    phrase.relation = caught.relation;
    phrase.nouns = nouns(text, caught.noun, caught.list_past);
    phrase.directions = directions(&rule.meaning.directions, &phrase, caught.side, caught.zone);
    phrase.amount = rule.meaning.fraction.map(Amount::Fraction);
    for word in &rule.meaning.words {
        apply(&mut phrase, word, caught.person);
    }
    phrase.kind = match rule.kind {
        RuleKind::Turn => Kind::Turn,
        RuleKind::Go => Kind::Go,
        RuleKind::Side => Kind::Side,
        RuleKind::It => Kind::Landmark,
        RuleKind::Part => Kind::Part,
        RuleKind::Room => Kind::Room,
        RuleKind::Leave => Kind::Leave,
        // "The lamp by the window", with no verb: the thing that is asked for.
        RuleKind::Furniture if asks_for_thing(&phrase) => {
            phrase.act = Act::State;
            Kind::Object
        }
        RuleKind::Related | RuleKind::Furniture => related(&phrase),
        RuleKind::Held | RuleKind::Inverse => Kind::ObjectMark,
        RuleKind::Object => object(&phrase),
        RuleKind::To => Kind::Recipient,
        RuleKind::View => Kind::Perspective,
        RuleKind::Correction => Kind::Correction,
        RuleKind::Not => Kind::Not,
        RuleKind::Aside => Kind::Aside,
    };
    finish(&mut phrase, rule.kind, text, caught.side);
    phrase
}

/// What a kind still needs: amounts of moves, sides of rooms, turned relations.
fn finish(phrase: &mut Phrase, rule: RuleKind, text: &Text, side: Option<Direction>) {
    let units = text.units;
    match rule {
        RuleKind::Turn | RuleKind::Go => phrase.amount = amount(&units[phrase.first..phrase.past]),
        RuleKind::Room => phrase.side = side.or_else(|| phrase.noun().and_then(|noun| noun.side)),
        RuleKind::Part if phrase.from == From::Room && is_passage(phrase, units) => {
            // "On the left side of the hall" picks the room; "at the end of the hall" is on the way.
            let lateral = matches!(phrase.directions, [Some(Direction::Left | Direction::Right), None]);
            phrase.kind = if lateral { Kind::Side } else { Kind::Aside };
            phrase.from = if lateral { From::Robot } else { From::Nothing };
            phrase.nouns.clear();
        }
        RuleKind::Related if units[phrase.first].lower == "with" => phrase.held = true,
        RuleKind::Held => phrase.held = true,
        RuleKind::Inverse => {
            // "The desk has a lamp to the left of it": the desk is to the right of the lamp.
            let turned = |direction: Direction| match direction {
                Direction::Front => Direction::Back,
                Direction::Back => Direction::Front,
                Direction::Above => Direction::Under,
                Direction::Under => Direction::Above,
                other => other.mirrored(),
            };
            phrase.directions[0] = match phrase.relation {
                Some(Relation::Landmark(direction)) => Some(turned(direction)),
                _ => Some(Direction::Side),
            };
        }
        RuleKind::Related if phrase.kind == Kind::Landmark && phrase.directions[0].is_none() => {
            phrase.directions[0] = phrase.noun().and_then(|noun| noun.side).or(Some(Direction::Side));
        }
        RuleKind::Related | RuleKind::View if phrase.kind != Kind::Target && phrase.directions[0].is_none() => {
            phrase.directions[0] = Some(Direction::Side);
        }
        _ => {}
    }
}

/// Whether the room is a hallway.
fn is_passage(phrase: &Phrase, units: &[Unit]) -> bool {
    phrase.noun().is_some_and(|noun| {
        let name = &units[noun.head].lower;
        name.contains("hall") || name == "corridor"
    })
}

fn nouns(text: &Text, first: Option<usize>, past: usize) -> Vec<NounPhrase> {
    let Some(first) = first else { return Vec::new() };
    let Some(noun) = text.noun(first) else { return Vec::new() };
    let mut nouns = vec![*noun];
    let mut at = noun.past;
    while at < past {
        let next = text.noun(at).filter(|noun| noun.past <= past && !text.units[at].has(Role::Conjunction));
        match next {
            Some(noun) => {
                nouns.push(*noun);
                at = noun.past;
            }
            None => at += 1,
        }
    }
    nouns
}

fn directions(
    sources: &[Source],
    phrase: &Phrase,
    side: Option<Direction>,
    zone: Option<[Option<Direction>; 2]>,
) -> [Option<Direction>; 2] {
    let noun = phrase.noun();
    let mut all: Vec<Direction> = Vec::with_capacity(2);
    for source in sources {
        match source {
            Source::Fixed(direction) => all.push(*direction),
            Source::Side => all.extend(side),
            Source::Zone => all.extend(zone.into_iter().flatten().flatten()),
            Source::Noun => {
                let told = side.or_else(|| noun.and_then(|noun| noun.side.or(noun.part)));
                all.push(told.filter(|direction| *direction != Direction::Central).unwrap_or(Direction::Side));
            }
            Source::Relation => all.extend(match phrase.relation {
                Some(Relation::Landmark(direction)) => Some(direction),
                _ => None,
            }),
        }
    }
    [all.first().copied(), all.get(1).copied()]
}

fn apply(phrase: &mut Phrase, word: &str, person: Option<usize>) {
    match word {
        "move" => phrase.from = From::Move,
        "robot" => phrase.from = From::Robot,
        "room" => phrase.from = From::Room,
        "wall" => phrase.from = From::Wall,
        "door" => {
            phrase.from = From::Door;
            phrase.directions[0] = phrase.directions[0].or(Some(Direction::Side));
        }
        "enter" => {
            phrase.from = From::Door;
            phrase.directions[0] = Some(Direction::Side);
            phrase.entering = true;
            phrase.nouns.clear();
        }
        "it" => phrase.from = From::It,
        "np" => phrase.from = From::Nouns,
        "to" => phrase.relation = Some(Relation::To),
        "find" => phrase.act = Act::Find,
        "fetch" => phrase.act = Act::Fetch,
        "give" => phrase.act = Act::Give,
        "put" => phrase.act = Act::Put,
        "act" => phrase.act = Act::Other,
        "there" => phrase.act = Act::There,
        "state" => phrase.act = Act::State,
        "down" => phrase.act = Act::LookDown,
        "me" => phrase.recipient = Some(Recipient::Speaker),
        "him" | "name" => phrase.recipient = person.map(Recipient::Person),
        _ => {}
    }
}

fn asks_for_thing(phrase: &Phrase) -> bool {
    phrase.relation.is_none()
        && phrase.noun().is_some_and(|noun| can_be_carried(noun) && noun.article == Article::Definite)
}

/// What furniture or an object after a relation is: what holds the thing, or a landmark.
fn related(phrase: &Phrase) -> Kind {
    let Some(noun) = phrase.noun() else { return Kind::Aside };
    let landmark = matches!(phrase.relation, Some(Relation::Landmark(_)));
    match noun.class {
        // A hat that hangs over a chair is on it.
        Some(Class::Seat | Class::Couch | Class::Bed)
            if phrase.relation == Some(Relation::Landmark(Direction::Above)) =>
        {
            Kind::Target
        }
        // "To the right bed": what was meant is "to the right of the bed".
        Some(Class::Bed | Class::Couch | Class::Seat) if noun.side.is_some() && noun.article == Article::Definite => {
            Kind::Landmark
        }
        // "On a footlocker": what the lexicon lacks and something stands on is more likely furniture than a thing.
        Some(Class::Object) if noun.inferred && phrase.relation == Some(Relation::On) => Kind::Target,
        Some(Class::Object) => Kind::ObjectMark,
        None if landmark => Kind::ObjectMark,
        Some(Class::Lamp | Class::Plant) if landmark => Kind::ObjectMark,
        _ if landmark => Kind::Landmark,
        _ => Kind::Target,
    }
}

/// Furniture that is asked for is a target; all else is an object. What a statement is about, its place decides.
fn object(phrase: &Phrase) -> Kind {
    let carried = |noun: &NounPhrase| {
        let large = matches!(
            noun.class,
            Some(Class::TableLike | Class::Seat | Class::Couch | Class::Bed | Class::Opening | Class::Room)
        );
        phrase.act.delivers() && !large || can_be_carried(noun) && phrase.act.is_request()
    };
    let fixed = phrase.noun().is_some_and(|noun| noun.is_furniture() && !carried(noun));
    if fixed && phrase.act != Act::State { Kind::Target } else { Kind::Object }
}

/// "three steps", "2 m", "forty five degrees".
fn amount(units: &[Unit]) -> Option<Amount> {
    let is_unit = |unit: &Unit| {
        unit.has(Role::Step) || unit.has(Role::FootUnit) || unit.has(Role::MetreUnit) || unit.has(Role::DegreeUnit)
    };
    let at = units.iter().rposition(|unit| is_unit(unit) && unit.number.is_none())?;
    let number = units[..at].iter().rev().find_map(|unit| unit.number.or_else(|| numbers::loose(&unit.lower)))?;
    let unit = &units[at];
    Some(if unit.has(Role::FootUnit) {
        Amount::Meters((number * 0.3048 * 100.0).round() / 100.0)
    } else if unit.has(Role::MetreUnit) {
        Amount::Meters(number)
    } else if unit.has(Role::DegreeUnit) {
        Amount::Degrees(number)
    } else {
        Amount::Steps(number)
    })
}
