//! Where one errand ends and the next begins.

use std::ops::Range;

use super::noun_phrases::Article;
use super::phrase::{Act, Kind, Phrase};
use super::unit::Unit;

/// The errands of a text, as ranges of its phrases; one for most.
///
/// A new one begins where something else is asked for ("… then find the mug in the bedroom"), where another thing goes
/// elsewhere ("… and the bread in the pantry"), and where the robot shall go somewhere when all is done. What is done
/// with the same thing afterwards is a delivery and no errand of its own.
pub fn errands(phrases: &mut [Phrase], units: &[Unit]) -> Vec<Range<usize>> {
    let mut starts = vec![0];
    let mut so_far = SoFar::default();
    let last_that_goes_on = phrases.iter().rposition(goes_on).unwrap_or(0);
    for at in 0..phrases.len() {
        let least = *starts.last().unwrap_or(&0);
        if at > least && at >= last_that_goes_on && so_far.goes_elsewhere(phrases, at, units) {
            starts.push(at);
            so_far = SoFar::default();
        }
        let phrase = &phrases[at];
        if phrase.kind == Kind::Object && phrase.act != Act::LookDown {
            if let Some(act) = so_far.shares_verb(phrases, at, units) {
                phrases[at].act = act;
                starts.push(at);
                so_far = SoFar::default();
            } else if so_far.asks_anew(phrase, units) {
                starts.push(errand_start(phrases, at, least, units));
                so_far = SoFar::default();
            }
        }
        so_far.add(&phrases[at], units);
    }
    starts.push(phrases.len());
    starts.dedup();
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

/// What the errand has had so far.
#[derive(Default)]
struct SoFar {
    /// The noun that was asked for.
    asked: Option<String>,
    /// What was asked to be done with it.
    act: Act,
    /// A place was said after that.
    placed: bool,
    /// Moves or turns were told.
    steps: bool,
    /// A request was made.
    requested: bool,
    /// A piece of furniture or a room was gone to, and nothing else.
    went: bool,
}

impl SoFar {
    fn add(&mut self, phrase: &Phrase, units: &[Unit]) {
        let request = phrase.act.is_request() && phrase.act != Act::Other;
        match phrase.kind {
            Kind::Object => {
                let named = phrase.noun().filter(|noun| !noun.generic);
                if let Some(noun) = named.filter(|_| request || self.asked.is_none()) {
                    self.asked = Some(units[noun.head].lower.to_string());
                }
                if request {
                    (self.act, self.requested, self.placed) = (phrase.act, true, false);
                }
            }
            Kind::Target | Kind::Room | Kind::ObjectMark => {
                self.placed = true;
                self.went |= phrase.kind == Kind::Target && phrase.is_reached();
                self.requested |= request;
            }
            Kind::Go | Kind::Turn | Kind::Side | Kind::Part => {
                self.steps |= phrase.kind != Kind::Part || phrase.is_reached()
            }
            Kind::Recipient => self.placed = true,
            _ => {}
        }
    }

    /// Something else is asked for.
    fn asks_anew(&self, phrase: &Phrase, units: &[Unit]) -> bool {
        let Some(noun) = phrase.noun().filter(|noun| !noun.generic) else { return false };
        let request = phrase.act.is_request() && phrase.act != Act::Other;
        let then = phrase.first > 0 && units[phrase.first - 1].lower == "then" && noun.article == Article::Definite;
        self.asked.as_ref().is_some_and(|old| *old != units[noun.head].lower) && (request && self.requested || then)
    }

    /// "Put the milk in the fridge and the bread in the pantry": the verb is said once.
    fn shares_verb(&self, phrases: &[Phrase], at: usize, units: &[Unit]) -> Option<Act> {
        let phrase = &phrases[at];
        let bare =
            phrase.act == Act::State && phrase.noun().is_some_and(|noun| !noun.generic && noun.past == phrase.past);
        let joined = phrase.first > 0 && (units[phrase.first - 1].lower == "and" || units[phrase.first].pause);
        let place = phrases.get(at + 1).is_some_and(|next| {
            next.first == phrase.past && matches!(next.kind, Kind::Target | Kind::Room | Kind::ObjectMark)
        });
        (self.act.delivers() && self.placed && bare && joined && place).then_some(self.act)
    }

    /// "… then go to the bedroom": a place to go to when all is done, of which nothing that follows tells.
    fn goes_elsewhere(&self, phrases: &[Phrase], at: usize, units: &[Unit]) -> bool {
        let phrase = &phrases[at];
        let moved =
            phrase.kind == Kind::Room && phrase.is_moved(units) || phrase.kind == Kind::Target && phrase.is_reached();
        let fresh = phrase.first > 0 && {
            let before = &units[phrase.first - 1];
            before.lower == "then"
                || before.stop
                || units[phrase.first].pause
                || before.number.is_some()
                || before.lower == "finally"
                || before.lower == "and" && self.act == Act::Put && self.placed
        } || phrases[at - 1].kind == Kind::Aside;
        let done = self.requested && self.asked.is_some() || self.went && !self.steps && self.asked.is_none();
        moved && fresh && done
    }
}

/// Whether a phrase tells more of the errand before it.
fn goes_on(phrase: &Phrase) -> bool {
    matches!(phrase.kind, Kind::Object | Kind::Turn | Kind::Go | Kind::Recipient)
        || phrase.kind == Kind::Target && phrase.act != Act::None
}

/// Rooms and moves right before a request belong to it: "then go to the bedroom and find the mug".
fn errand_start(phrases: &[Phrase], at: usize, least: usize, units: &[Unit]) -> usize {
    let leads = |phrase: &Phrase| match phrase.kind {
        Kind::Go | Kind::Turn | Kind::Leave => true,
        Kind::Room => phrase.is_moved(units),
        Kind::Target => phrase.is_reached(),
        _ => false,
    };
    let mut start = at;
    while start > least + 1 && leads(&phrases[start - 1]) {
        start -= 1;
    }
    start
}
