//! Colour in text for people.

use crate::record::Shade;

/// Text with the colours of its lines: what was said stands out, and so does how it ended.
pub(super) fn painted(text: &str, shade: impl Fn(usize, &str) -> Shade) -> String {
    let lines = text.lines().enumerate().map(|(number, line)| match code(shade(number, line)) {
        Some(code) if !line.is_empty() => format!("\x1b[{code}m{line}\x1b[0m"),
        _ => line.to_string(),
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn code(shade: Shade) -> Option<&'static str> {
    match shade {
        Shade::Plain => None,
        Shade::Said => Some("1"),
        Shade::Good => Some("32"),
        Shade::Bad => Some("31"),
        Shade::Faint => Some("2"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_coloured_on_its_own_and_plain_ones_are_left_alone() {
        let painted = painted("said\nplain", |number, _| if number == 0 { Shade::Said } else { Shade::Plain });
        assert_eq!(painted, "\x1b[1msaid\x1b[0m\nplain");
    }
}
