//! A trial as people read it: a text of lines that fit a terminal, and a row of a table.

use crate::record::{Outcome, Record, Row, Shade, StageError, Trial, doubts_of};

/// The longest line, characters.
const WIDEST: usize = 100;
/// Where results begin; reasons stand one further in.
const INDENT: usize = 22;
/// Keys that the stages add: not columns of the user's own.
const STAGE_KEYS: [&str; 7] = ["id", "text", "tokens", "chunks", "grounding", "plan", "trial"];

/// A trial for people.
///
/// # Errors
/// When the record holds no trial, or one that cannot be read.
pub fn text_of(record: &Record) -> Result<String, StageError> {
    let trial: Trial = record.require_part("it is what `drive` adds")?;
    let mut lines: Vec<String> = record.get::<String>("text")?.into_iter().collect();
    for action in &trial.actions {
        let (start, end) = (action.start_s.0, action.end_s.0);
        let head = format!("{start:6.1}–{end:<6.1} {:7} ", action.action);
        lines.extend(wrapped(&head, &action.result, INDENT + 2));
        let reasons = action.why.split("; ").filter(|why| !why.is_empty());
        lines.extend(reasons.flat_map(|why| wrapped(&" ".repeat(INDENT + 1), why, INDENT + 3)));
    }
    let (metres, seconds) = (trial.distance_m.0, trial.duration_s.0);
    let end = format!("{} ({metres:.1} m, {seconds:.0} s, {} collisions)", trial.why, trial.collisions);
    lines.extend(wrapped(&format!("{}: ", trial.outcome.phrase()), &end, 2));
    lines.extend(trial.description.iter().flat_map(|description| wrapped("  ", description, 2)));
    lines.extend(trial.delivered.iter().map(|delivery| {
        let what = delivery.objects.join(" and ").replace('_', " ");
        format!("delivered: {what} {}", delivery.to.phrase())
    }));
    lines.extend(doubts_of(record)?.iter().flat_map(|doubt| wrapped("  !  ", doubt, 5)));
    Ok(lines.join("\n"))
}

/// How a line of that text is shaded: reasons stand back, the end stands out.
pub fn shade_of(line: &str) -> Shade {
    let ends = |outcome: &Outcome| line.starts_with(&format!("{}: ", outcome.phrase()));
    let bad =
        [Outcome::NotFound, Outcome::Blocked, Outcome::Stuck, Outcome::Timeout, Outcome::Stopped, Outcome::LinkLost];
    if line.starts_with(&" ".repeat(INDENT + 1)) {
        Shade::Faint
    } else if [Outcome::Found, Outcome::Arrived].iter().any(ends) {
        Shade::Good
    } else if bad.iter().any(ends) || line.starts_with("  !  ") {
        Shade::Bad
    } else {
        Shade::Plain
    }
}

/// `head` and `text` in lines that fit, cut between words; the second and further lines begin at `indent`.
fn wrapped(head: &str, text: &str, indent: usize) -> Vec<String> {
    let mut lines = vec![head.to_string()];
    let mut is_begun = true;
    for word in text.split(' ') {
        let last = lines.len() - 1;
        let width = lines[last].chars().count() + word.chars().count() + usize::from(!is_begun);
        if width > WIDEST && !is_begun {
            lines.push(format!("{}{word}", " ".repeat(indent)));
        } else {
            lines[last].push_str(if is_begun { "" } else { " " });
            lines[last].push_str(word);
        }
        is_begun = false;
    }
    lines
}

/// A trial as a row: what the user's own keys say, what was understood, and what became of it.
///
/// # Errors
/// When the record holds no trial, or one that cannot be read.
pub fn row_of(record: &Record) -> Result<Row, StageError> {
    let trial: Trial = record.require_part("it is what `drive` adds")?;
    let number = |value: crate::record::Rounded| value.value().to_string();
    let optional = |value: Option<String>| value.unwrap_or_default();
    let mut row = vec![("id".to_string(), record.id().unwrap_or_default())];
    row.push(("text".to_string(), optional(record.get("text")?)));
    row.extend(
        record.scalars().filter(|(key, _)| !STAGE_KEYS.contains(key)).map(|(key, value)| (key.to_string(), value)),
    );
    let first = trial.approached.first().cloned();
    let columns = [
        ("outcome", trial.outcome.name().to_string()),
        ("why", trial.why),
        ("description", optional(trial.description)),
        ("target_id", optional(trial.target_id)),
        ("first_approached", optional(first)),
        ("right_first", optional(trial.right_first.map(|right| right.to_string()))),
        ("visits", trial.approached.len().to_string()),
        ("approached", trial.approached.join(" ")),
        ("duration_s", number(trial.duration_s)),
        ("distance_m", number(trial.distance_m)),
        ("spl", optional(trial.spl.map(number))),
        ("collisions", trial.collisions.to_string()),
        ("min_clearance_m", optional(trial.min_clearance_m.map(number))),
    ];
    row.extend(columns.map(|(column, value)| (column.to_string(), value)));
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_reasons_are_cut_between_words_and_go_on_further_in() {
        let lines = wrapped("   ", &"seven words of a reason ".repeat(8), 5);
        assert!(lines.len() > 1 && lines.iter().all(|line| line.chars().count() <= WIDEST), "{lines:?}");
        assert!(
            lines[1].starts_with("     s") || lines[1].starts_with("     w") || lines[1].starts_with("     o"),
            "{lines:?}"
        );
    }

    #[test]
    fn what_ended_well_is_green_what_did_not_is_red_and_reasons_stand_back() {
        assert_eq!(shade_of("found: the mug is on table 1"), Shade::Good);
        assert_eq!(shade_of("not found: no mug"), Shade::Bad);
        assert_eq!(shade_of(&format!("{}because", " ".repeat(23))), Shade::Faint);
        assert_eq!(shade_of("   0.0–13.6   enter   in the bedroom"), Shade::Plain);
    }
}
