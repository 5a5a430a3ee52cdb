//! What would change things, for people.

use super::shifts::metres;
use super::{Shift, Upshot, WhatIf};

/// As it is, then the words, then the furniture, the nearest to a change first.
pub fn what_if_text(what: &WhatIf) -> String {
    let mut lines = vec![what.text.clone(), format!("  as it is: {}", upshot(&what.now)), "  words".to_string()];
    if what.words.is_empty() {
        lines.push("    no change of one or two words was found that changes it".to_string());
    }
    lines.extend(what.words.iter().map(|wording| format!("    {:30} {}", wording.change, upshot(&wording.then))));
    lines.push("  furniture".to_string());
    let mut shifts: Vec<&Shift> = what.shifts.iter().filter(|shift| shift.metres.is_some()).collect();
    shifts.sort_by(|a, b| metres(a).total_cmp(&metres(b)));
    lines.extend(shifts.into_iter().filter_map(shift_line));
    let unmoved: Vec<&str> = what.shifts.iter().filter(|s| s.metres.is_none()).map(|s| s.id.as_str()).collect();
    if !unmoved.is_empty() {
        lines.push(format!("    no shift changes it: {}", unmoved.join(", ")));
    }
    lines.join("\n")
}

fn shift_line(shift: &Shift) -> Option<String> {
    let way = match shift.heading_deg? as i64 {
        0 => "east",
        90 => "north",
        180 => "west",
        _ => "south",
    };
    let moved = format!("{} {:.0} cm {way}", shift.id, 100.0 * shift.metres?.0);
    Some(format!("    {moved:30} {}", upshot(shift.then.as_ref()?)))
}

fn upshot(upshot: &Upshot) -> String {
    let end = upshot.outcome.phrase();
    format!("first to {}, {end}", upshot.first.as_deref().unwrap_or("nothing"))
}
