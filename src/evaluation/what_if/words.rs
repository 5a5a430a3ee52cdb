//! Words dropped, or replaced by their neighbours in the lexicon.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Upshot, upshot};
use crate::evaluation::Pipeline;
use crate::language::{Class, Lexicon};

/// A change of words.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Wording {
    /// In words: `left → right`, `drop "behind"`.
    pub change: String,
    /// The description then.
    pub text: String,
    /// What it comes to then.
    pub then: Upshot,
}

/// Words of place that people say for one another.
const PLACES: [&[&str]; 5] = [
    &["left", "right"],
    &["front", "back"],
    &["behind", "beside", "before"],
    &["forward", "left", "right"],
    &["near", "far"],
];

/// An edit of one word: what stands in its place, if anything.
#[derive(Clone)]
struct Edit {
    start: usize,
    end: usize,
    new: Option<String>,
}

/// The fewest words whose change changes the upshot: all single changes that do, else all pairs that do.
pub(super) fn changes(pipeline: &Pipeline, id: &str, text: &str, now: &Upshot) -> Vec<Wording> {
    let edits = edits(pipeline, text);
    let singles: Vec<Vec<&Edit>> = edits.iter().map(|edit| vec![edit]).collect();
    let found = changed(pipeline, id, text, now, &singles);
    if !found.is_empty() {
        return found;
    }
    let replacements: Vec<&Edit> = edits.iter().filter(|edit| edit.new.is_some()).collect();
    let pairs = replacements.iter().enumerate().flat_map(|(i, a)| {
        replacements[i + 1..].iter().filter(|b| b.start >= a.end).map(|b| vec![*a, *b]).collect::<Vec<_>>()
    });
    changed(pipeline, id, text, now, &pairs.collect::<Vec<_>>())
}

fn changed(pipeline: &Pipeline, id: &str, text: &str, now: &Upshot, edits: &[Vec<&Edit>]) -> Vec<Wording> {
    let (home, settings) = (pipeline.home, pipeline.settings);
    let tried = edits.par_iter().map_init(
        || Pipeline::new(home, settings),
        |pipeline, edits| {
            let new = apply(text, edits);
            let then = upshot(pipeline, id, &pipeline.understand(&new).plan);
            let change: Vec<String> = edits.iter().map(|edit| phrase(text, edit)).collect();
            Some(Wording { change: change.join(", "), text: new, then }).filter(|wording| wording.then != *now)
        },
    );
    tried.collect::<Vec<_>>().into_iter().flatten().collect()
}

/// Every word dropped; and each word of place, furniture or object replaced.
fn edits(pipeline: &Pipeline, text: &str) -> Vec<Edit> {
    let mut edits = Vec::new();
    for word in text.split_whitespace() {
        let start = word.as_ptr() as usize - text.as_ptr() as usize;
        let end = start + bare(word).len();
        let replaced = neighbours(pipeline, &bare(word).to_lowercase());
        edits.extend(replaced.into_iter().map(|new| Edit { start, end, new: Some(new) }));
        edits.push(Edit { start, end, new: None });
    }
    edits
}

/// What could stand in a word's place: another place; other furniture or another object that the home has.
fn neighbours(pipeline: &Pipeline, word: &str) -> Vec<String> {
    let places = PLACES.iter().filter(|group| group.contains(&word)).flat_map(|group| group.iter().copied());
    let mut found: Vec<String> = places.map(str::to_string).collect();
    let lexicon = Lexicon::embedded();
    let scene = &pipeline.home.scene;
    match lexicon.noun(word).map(|noun| noun.class) {
        Some(Class::Object) => found.extend(scene.objects.iter().map(|object| object.name.replace('_', " "))),
        Some(Class::Room) => found.extend(pipeline.home.map.rooms.iter().map(|room| room.name.replace('_', " "))),
        Some(class) if class.is_furniture() => {
            found.extend(scene.furniture.iter().map(|item| item.kind().noun.replace('_', " ")));
        }
        _ => {}
    }
    let same = |new: &String| lexicon.canonical(new).is_some() && lexicon.canonical(new) == lexicon.canonical(word);
    found.retain(|new| new != word && !same(new));
    found.sort();
    found.dedup();
    found
}

fn apply(text: &str, edits: &[&Edit]) -> String {
    let mut new = text.to_string();
    for edit in edits.iter().rev() {
        new.replace_range(edit.start..edit.end, edit.new.as_deref().unwrap_or(""));
    }
    new.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn phrase(text: &str, edit: &Edit) -> String {
    let old = &text[edit.start..edit.end];
    let said = |text: &str| text.split_whitespace().filter(|word| bare(word) == old).count();
    let nth = if said(text) > 1 { format!(" (number {})", said(&text[..edit.start]) + 1) } else { String::new() };
    match &edit.new {
        Some(new) => format!("{old}{nth} → {new}"),
        None => format!("drop \"{old}\"{nth}"),
    }
}

/// A word without the punctuation after it.
fn bare(word: &str) -> &str {
    word.trim_end_matches(|c: char| c.is_ascii_punctuation())
}
