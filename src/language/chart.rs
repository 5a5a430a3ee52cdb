//! The best way to read a text as phrases: dynamic programming over all places where a rule fits.
//!
//! Words that no rule takes cost something instead of blocking; of all ways to
//! cover the text the cheapest is taken. Linear in the text's length.

use super::grammar::{Grammar, RuleKind};
use super::matching::{Caught, Text};
use super::unit::Unit;
use super::word_class::{Class, Role};

/// A rule where it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The rule.
    pub rule: u16,
    /// First unit.
    pub first: usize,
    /// One past the last unit.
    pub past: usize,
    /// What the rule caught.
    pub caught: Caught,
    cost: f32,
}

/// The cheapest reading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// Its phrases, in order.
    pub edges: Vec<Edge>,
    /// What it costs.
    pub cost: f32,
}

/// What a longer phrase is worth beside shorter ones that cost the same.
const LENGTH_BONUS: f32 = 0.02;
/// What the costs of the grammar are worth beside those of words left out.
const PHRASE_SCALE: f32 = 0.7;
/// What a phrase costs more when its noun is one that nobody knows, or whose class was inferred.
const UNKNOWN_NOUN: f32 = 0.5;
const INFERRED_NOUN: f32 = 0.1;

/// The cheapest way through the text.
pub fn cheapest(text: &Text, grammar: &Grammar) -> Path {
    let length = text.units.len();
    let mut best: Vec<f32> = vec![f32::INFINITY; length + 1];
    let mut came: Vec<Option<Edge>> = vec![None; length + 1];
    best[0] = 0.0;
    let mut tried: Vec<u32> = vec![0; grammar.len()];
    for at in 0..length {
        let skipped = best[at] + skip_cost(&text.units[at]);
        if skipped < best[at + 1] {
            (best[at + 1], came[at + 1]) = (skipped, None);
        }
        let unit = &text.units[at];
        let (noun, relation) = (text.noun(at).is_some(), text.relation(at).is_some());
        let stamp = at as u32 + 1;
        grammar.beginning(text.id(at), unit.roles, noun, relation, |number| {
            if std::mem::replace(&mut tried[usize::from(number)], stamp) == stamp {
                return;
            }
            let rule = grammar.rule(number);
            let Some((past, caught)) = text.fit(&rule.elements, at) else { return };
            let cost =
                PHRASE_SCALE * rule.cost + noun_cost(text, &caught, rule.kind) - LENGTH_BONUS * (past - at) as f32;
            if best[at] + cost < best[past] {
                best[past] = best[at] + cost;
                came[past] = Some(Edge { rule: number, first: at, past, caught, cost });
            }
        });
    }
    trace(&came, best[length])
}

fn trace(came: &[Option<Edge>], cost: f32) -> Path {
    let mut edges = Vec::new();
    let mut at = came.len() - 1;
    while at > 0 {
        match came[at] {
            Some(edge) => {
                at = edge.first;
                edges.push(edge);
            }
            None => at -= 1,
        }
    }
    edges.reverse();
    Path { edges, cost }
}

fn noun_cost(text: &Text, caught: &Caught, kind: RuleKind) -> f32 {
    let Some(noun) = caught.noun.and_then(|at| text.noun(at)) else { return 0.0 };
    match noun.class {
        None if noun.generic => 0.0,
        // A thing asked for may be anything; a landmark nobody knows is doubtful.
        None if kind == RuleKind::Object => UNKNOWN_NOUN * 0.6,
        None => UNKNOWN_NOUN,
        Some(_) if noun.inferred => INFERRED_NOUN,
        Some(_) => 0.0,
    }
}

/// What it costs to leave a word out.
pub fn skip_cost(unit: &Unit) -> f32 {
    if unit.stop {
        return 0.0;
    }
    if let Some(noun) = unit.noun {
        return if noun.class == Class::Person { 0.5 } else { 2.2 };
    }
    if unit.is_unknown() {
        return 1.2;
    }
    let content = [
        (Role::Side, 2.0),
        (Role::Turn, 1.2),
        (Role::Motion, 1.2),
        (Role::Part, 1.2),
        (Role::Bring, 1.2),
        (Role::Give, 1.2),
        (Role::Put, 1.2),
        (Role::Find, 1.0),
        (Role::Look, 1.0),
        (Role::Act, 1.0),
        (Role::Exit, 1.0),
        (Role::Enter, 1.0),
        (Role::Reach, 0.8),
        (Role::Preposition, 0.6),
        (Role::Negation, 2.0),
        (Role::Correction, 2.0),
        (Role::Adjective, 0.5),
        (Role::Number, 0.4),
        (Role::Near, 0.5),
        (Role::Ahead, 0.8),
    ];
    content.iter().filter(|(role, _)| unit.has(*role)).map(|(_, cost)| *cost).fold(0.2, f32::max)
}
