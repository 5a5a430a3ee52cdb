//! One trial: its words, way, last picture, tree and reasons.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::html::escaped;
use crate::behavior::Run;
use crate::evaluation::{Case, meaning_phrase};
use crate::map::RoomMap;
use crate::record::{ActionReport, Chunk, Outcome, Trial};
use crate::recording::{Outputs, TruePiece};
use crate::simulation::Home;

/// Failed, then wrong first, then good.
pub(super) fn rank(case: &Case) -> usize {
    match (case.run.trial.outcome, case.run.trial.right_first) {
        (Outcome::Found, Some(true)) => 2,
        (Outcome::Found, _) => 1,
        _ => 0,
    }
}

/// A folded section; the pictures stand in it.
pub(super) fn section(case: &Case, home: &Home) -> String {
    let (gold, trial) = (case.gold, &case.run.trial);
    let (result, class, verdict) = match rank(case) {
        0 => ("failed", "bad", "failed"),
        1 => ("wrong-first", "bad", "found, but not at the first furniture"),
        _ => ("good", "good", "found, right first"),
    };
    let arrangement = if case.arrangement == 0 { "original" } else { "moved" };
    let (id, text) = (escaped(&gold.id), escaped(&gold.text));
    let (form, names) = (gold.form(), gold.names().replace(' ', "-"));
    format!(
        "<details class=\"trial\" data-result=\"{result}\" data-home=\"{arrangement}\" data-form=\"{form}\" data-names=\"{names}\">\n\
         <summary><span class=\"verdict {class}\">{verdict}</span> · {id} · furniture {} · {text}</summary>\n\
         <div class=\"pictures\">{}{}</div>\n<h3>How the words were read</h3>\n{}{}<h3>What the robot did</h3>\n<ol>{}</ol>\n</details>\n",
        if case.arrangement == 0 { "as it was" } else { "moved" },
        way(case, home),
        last_picture(case, home),
        tree(&gold.text, &case.understood.chunks),
        meanings(case),
        actions(trial)
    )
}

/// What was done and why, as items of a list.
pub(super) fn actions(trial: &Trial) -> String {
    let item = |a: &ActionReport| {
        let [action, result, why] = [&a.action, &a.result, &a.why].map(|text| escaped(text));
        format!("<li>{action}: {result}<br><small>{why}</small></li>")
    };
    trial.actions.iter().map(item).collect()
}

pub(super) fn picture(media: &str, bytes: &[u8], alternative: &str, caption: &str) -> String {
    let data = STANDARD.encode(bytes);
    format!(
        "<figure><img loading=\"lazy\" src=\"data:{media};base64,{data}\" alt=\"{}\"><figcaption>{}</figcaption></figure>",
        escaped(alternative),
        escaped(caption)
    )
}

fn way(case: &Case, home: &Home) -> String {
    way_of(&case.run, &home.map, &home.pieces(), &case.gold.text)
}

/// The way of a trial through the rooms, drawn and in words.
pub(super) fn way_of(run: &Run, map: &RoomMap, truth: &[TruePiece], text: &str) -> String {
    let trial = &run.trial;
    let svg = Outputs::draw_plot(map, truth, run, text);
    let visited =
        if trial.approached.is_empty() { "no furniture".to_string() } else { trial.approached.join(", then ") };
    let alternative =
        format!("Plan of the home with the robot's way of {:.1} metres; it went to {visited}", trial.distance_m.0);
    picture("image/svg+xml", svg.as_bytes(), &alternative, "The way")
}

fn last_picture(case: &Case, home: &Home) -> String {
    let png = home.take_picture(case.run.final_pose).thumbnail_png();
    let alternative = format!("What the robot's camera shows at the end: {}", case.run.trial.why);
    picture("image/png", &png, &alternative, "The last picture")
}

/// The chunk tree as nested lists.
pub(super) fn tree(text: &str, chunks: &[Chunk]) -> String {
    format!("<ul class=\"tree\">{}</ul>\n", branches(text, chunks))
}

fn branches(text: &str, chunks: &[Chunk]) -> String {
    let branch = |chunk: &Chunk| {
        let words = escaped(text.get(chunk.start..chunk.end).unwrap_or_default());
        let inner = branches(text, &chunk.chunks);
        let inner = if inner.is_empty() { inner } else { format!("<ul>{inner}</ul>") };
        format!("<li><span class=\"tag\">{}</span> {words}{inner}</li>", chunk.tag.name())
    };
    chunks.iter().map(branch).collect()
}

fn meanings(case: &Case) -> String {
    let understood = escaped(&meaning_phrase(&case.understood.grounding));
    let meant = case.gold.grounding.as_ref().map(|meaning| escaped(&meaning_phrase(meaning)));
    let meant = meant.map(|meant| format!("<dt>meant (gold)</dt><dd>{meant}</dd>")).unwrap_or_default();
    let end = escaped(&case.run.trial.why);
    format!("<dl><dt>understood</dt><dd>{understood}</dd>{meant}<dt>end</dt><dd>{end}</dd></dl>\n")
}
