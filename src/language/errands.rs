//! Where one errand ends and the next begins.

use std::ops::Range;

use super::noun_phrases::Article;
use super::phrases::{Act, Kind, Phrase};
use super::units::Unit;

/// The errands of a text, as ranges of its phrases; one for most.
///
/// A new one begins where something else is asked for: "… then find the mug in the bedroom". What is done with the
/// same thing afterwards is a delivery and no errand of its own.
pub fn errands(phrases: &[Phrase], units: &[Unit]) -> Vec<Range<usize>> {
    let mut starts = vec![0];
    let mut asked: Option<String> = None;
    for (at, phrase) in phrases.iter().enumerate() {
        if phrase.kind != Kind::Object || phrase.act == Act::LookDown {
            continue;
        }
        let Some(noun) = phrase.noun().filter(|noun| !noun.generic) else { continue };
        let name = units[noun.head].lower.to_string();
        let request = phrase.act.is_request() && phrase.act != Act::Other;
        let then = phrase.first > 0 && units[phrase.first - 1].lower == "then" && noun.article == Article::Definite;
        let fresh = asked.as_ref().is_some_and(|old| *old != name);
        if fresh && (request || then) {
            starts.push(errand_start(phrases, at, *starts.last().unwrap_or(&0)));
        }
        if request || asked.is_none() && then || phrase.act == Act::State && phrases[..at].is_empty() {
            asked = Some(name);
        }
    }
    starts.push(phrases.len());
    starts.dedup();
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

/// Rooms and moves right before a request belong to it: "then go to the bedroom and find the mug".
fn errand_start(phrases: &[Phrase], at: usize, least: usize) -> usize {
    let leads = |phrase: &Phrase| {
        matches!(phrase.kind, Kind::Go | Kind::Turn | Kind::Leave) || phrase.kind == Kind::Room && phrase.inner.is_none() || phrase.kind == Kind::Target && phrase.inner.is_some()
    };
    let mut start = at;
    while start > least + 1 && leads(&phrases[start - 1]) {
        start -= 1;
    }
    start
}
