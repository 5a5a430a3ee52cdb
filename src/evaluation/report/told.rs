//! The trials of one's own run as one HTML file: each with its way, an animation, its words and its reasons.

use std::path::Path;

use serde::Serialize;

use super::html::{self, escaped};
use super::shown::{ShownHome, ShownTrial};
use super::trial::{actions, picture, tree, way_of};
use crate::evaluation::meaning_phrase;
use crate::files::{FileError, write_file};
use crate::map::RoomMap;
use crate::record::{Chunk, Grounding, Outcome, Record};
use crate::recording::{Told, TruePiece};

const CHOICES: &[html::Choice] = &[(
    "result",
    "Result",
    &[("failed", "not found"), ("wrong-first", "found, not at once"), ("good", "found at once, or arrived")],
)];
const NOTE: &str = "Failures come first. Open one to see it happen: play it, or drag through its time. Filled outlines are what \
    the robot believes of the furniture, dashed ones what truly stands there. SPL, success weighted by path length, \
    is 1 where the object is found on the shortest way, 0 where it is not found.";

/// Writes the page `path` about trials in a home of which `truth` is known.
///
/// # Errors
/// When the file or its folder cannot be written, or stands there already and nothing forces.
pub fn write_trials(
    path: &Path,
    trials: Vec<Told>,
    map: &RoomMap,
    truth: &[TruePiece],
    force: bool,
) -> Result<(), FileError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| FileError::System(folder.display().to_string(), error))?;
    }
    write_file(path, page(trials, map, truth).as_bytes(), force)
}

/// The page; the same trials give the same bytes, in whatever order they ended.
fn page(trials: Vec<Told>, map: &RoomMap, truth: &[TruePiece]) -> String {
    let mut order: Vec<(usize, f64, String, &Told)> = trials
        .iter()
        .map(|told| {
            let id = id_of(told);
            (rank(told), id.parse().unwrap_or(f64::INFINITY), id, told)
        })
        .collect();
    order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)).then(a.3.line.cmp(&b.3.line)));
    let found = trials.iter().filter(|told| told.run.trial.outcome == Outcome::Found).count();
    let mut page = html::head(&format!("{}: {} trials, {found} found", map.name, trials.len()));
    page.push_str(&data("home", &ShownHome::of(map, truth)));
    page.push_str(&html::filter(trials.len(), CHOICES, NOTE));
    page.extend(order.iter().map(|(rank, _, id, told)| section(*rank, id, told, map, truth)));
    page.push_str(html::FOOT);
    page
}

fn id_of(told: &Told) -> String {
    Record::parse(&told.line).ok().and_then(|record| record.id()).unwrap_or_default()
}

/// Failed, then found or arrived after all, then at once.
fn rank(told: &Told) -> usize {
    let trial = &told.run.trial;
    match (trial.outcome, trial.right_first) {
        (Outcome::Found, Some(false)) => 1,
        (Outcome::Found | Outcome::Arrived, _) => 2,
        _ => 0,
    }
}

fn section(rank: usize, id: &str, told: &Told, map: &RoomMap, truth: &[TruePiece]) -> String {
    let trial = &told.run.trial;
    let (result, class) = [("failed", "bad"), ("wrong-first", "good"), ("good", "good")][rank];
    let record = Record::parse(&told.line).unwrap_or_default();
    let text: String = record.get("text").ok().flatten().unwrap_or_default();
    let chunks: Vec<Chunk> = record.get("chunks").ok().flatten().unwrap_or_default();
    let grounding: Option<Grounding> = record.get("grounding").ok().flatten();
    let understood = grounding.map(|meaning| meaning_phrase(&meaning)).unwrap_or_default();
    let spl = trial.spl.map(|spl| format!(", SPL {:.2}", spl.0)).unwrap_or_default();
    let last = told.picture.as_deref().filter(|png| !png.is_empty()).map(|png| {
        let alternative = format!("What the robot's camera shows at the end: {}", trial.why);
        picture("image/png", png, &alternative, "The last picture")
    });
    format!(
        "<details class=\"trial\" data-result=\"{result}\">\n\
         <summary><span class=\"verdict {class}\">{}</span> · {} · {}</summary>\n\
         {}<div class=\"pictures\">{}{}</div>\n<h3>How the words were read</h3>\n{}\
         <dl><dt>understood</dt><dd>{}</dd><dt>end</dt><dd>{}: {:.1} m, {:.0} s, {} collisions{spl}</dd></dl>\n\
         <h3>What the robot did, and the figures behind it</h3>\n<ol>{}</ol>\n</details>\n",
        escaped(&trial.outcome.phrase()),
        escaped(id),
        escaped(&text),
        player(told, &text),
        way_of(&told.run, map, truth, &text),
        last.unwrap_or_default(),
        tree(&text, &chunks),
        escaped(&understood),
        escaped(&trial.why),
        trial.distance_m.0,
        trial.duration_s.0,
        trial.collisions,
        actions(trial),
    )
}

/// The animation: the script fills what is empty here.
fn player(told: &Told, text: &str) -> String {
    if told.run.trial.path.len() < 2 {
        return String::new();
    }
    let end = (10.0 * told.run.trial.duration_s.0).round();
    let label = escaped(&format!("The trial step by step: {text}"));
    format!(
        "<div class=\"player\" role=\"group\" aria-label=\"{label}\">\n{}\
         <svg class=\"stage\" role=\"img\" aria-label=\"Plan of the home with the robot at the time chosen\"></svg>\n\
         <p class=\"now\" aria-live=\"polite\"></p>\n\
         <div class=\"controls\"><button type=\"button\">Play</button>\
         <label>Time<input type=\"range\" min=\"0\" max=\"{end}\" step=\"1\" value=\"0\"></label>\
         <label>Speed<select><option value=\"1\">1 ×</option><option value=\"4\" selected>4 ×</option>\
         <option value=\"16\">16 ×</option></select></label></div>\n</div>\n",
        data("story", &ShownTrial::of(&told.run.trial.path, &told.story)),
    )
}

/// Values for the script; what could end the element is written otherwise.
fn data(class: &str, value: &impl Serialize) -> String {
    // Our own types always serialize.
    let json = serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c");
    format!("<script type=\"application/json\" class=\"{class}\">{json}</script>\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::Pipeline;
    use crate::recording::Story;
    use crate::simulation::{Home, TrialSettings, run};

    fn told(id: &str, text: &str, home: &Home) -> Told {
        let pipeline = Pipeline::new(home, TrialSettings::default());
        let understood = pipeline.understand(text);
        let mut story = Story::default();
        let run = run(home, &understood.plan, &TrialSettings::default(), 0, &mut story);
        let mut record = Record::from_text(id, text);
        record.set("chunks", &understood.chunks);
        record.set("grounding", &understood.grounding);
        let line = serde_json::to_string(&record).expect("serializes");
        Told { line, run, picture: None, story }
    }

    #[test]
    fn a_page_of_ones_own_trials_fetches_nothing_stays_small_and_cannot_be_broken_by_words() {
        let home = Home::load(None, None).expect("the apartment");
        let mug = told("2", "the mug is in the bedroom on the table by the chairs </script><b>", &home);
        let keys = told("1", "find my keys", &home);
        let page = |trials: Vec<Told>| page(trials, &home.map, &home.pieces());
        let both = page(vec![mug.clone(), keys.clone()]);
        assert_eq!(both, page(vec![keys.clone(), mug.clone()]));
        assert_eq!(both.matches("<details class=\"trial\"").count(), 2);
        assert!(both.find("find my keys") < both.find("the mug is in"), "failures come first");
        assert!(!both.contains("<b>") && !both.contains("https:"));
        assert_eq!(both.matches("http://").count(), both.matches("http://www.w3.org/2000/svg").count());
        assert!(both.contains("going to hexagon table 1, the best fit for"), "the story is told in plain words");
        let [one, other] = [mug, keys].map(|told| both.len() - page(vec![told]).len());
        assert!(one < 120_000 && other < 60_000, "{one} and {other} bytes");
    }
}
