//! Text of a stranger where it could do harm: on a terminal, in markup, as a file name. One rule for each.

use std::borrow::Cow;
use std::fmt::Write;

/// As it may stand on a terminal: control characters, and marks that turn the direction of writing, become `\u{1b}`.
/// Line ends and tabs stay.
pub fn for_terminal(text: &str) -> Cow<'_, str> {
    escaped(text, |c| is_harmful(c) && !matches!(c, '\n' | '\t'))
}

/// The same for what must stay on one line, such as a name in a message.
pub fn for_line(text: &str) -> Cow<'_, str> {
    escaped(text, is_harmful)
}

fn escaped(text: &str, is_wrong: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_wrong) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_wrong(c) { c.escape_unicode().for_each(|c| out.push(c)) } else { out.push(c) }
    }
    Cow::Owned(out)
}

/// Control characters of both sets, the line ends of Unicode, and what turns the direction of writing.
fn is_harmful(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// As it may stand in SVG and HTML, between tags and in attributes: without the characters that XML 1.0 has not.
pub fn for_markup(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push(c),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => {}
            c => out.push(c),
        }
    }
    out
}

/// Bytes of a file name; the system takes 255, and a name's ending and what stands before it need some.
const LONGEST_NAME: usize = 160;

/// An id as a file name, and another id never as the same one: letters, digits, `-`, `_` and dots within stay, every
/// other byte becomes `%2F`, as in a URL, so that the id can be read back. Of an id that is too long its beginning
/// stays, with a sum of all of it.
pub fn for_file_name(id: &str) -> String {
    let mut name = String::new();
    for (at, c) in id.char_indices() {
        if c.is_alphanumeric() || matches!(c, '-' | '_') || (c == '.' && at > 0) {
            name.push(c);
        } else {
            let mut bytes = [0; 4];
            for byte in c.encode_utf8(&mut bytes).bytes() {
                // Writing to memory cannot fail.
                let _ = write!(name, "%{byte:02X}");
            }
        }
    }
    if name.is_empty() {
        return "%".to_string();
    }
    if name.len() <= LONGEST_NAME {
        return name;
    }
    let mut end = LONGEST_NAME;
    while !name.is_char_boundary(end) {
        end -= 1;
    }
    format!("{}%~{:016x}", &name[..end], sum(id))
}

/// FNV-1a, 64 bits.
fn sum(id: &str) -> u64 {
    id.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn what_moves_a_cursor_or_turns_the_writing_is_shown_instead() {
        assert_eq!(for_terminal("a\x1b[2Jb\u{9b}c\u{7f}\r"), "a\\u{1b}[2Jb\\u{9b}c\\u{7f}\\u{d}");
        assert_eq!(for_terminal("\u{202e}txt.exe"), "\\u{202e}txt.exe");
        assert_eq!(for_terminal("zwei\n\tZeilen, größer"), "zwei\n\tZeilen, größer");
        assert_eq!(for_line("a\nb"), "a\\u{a}b");
    }

    #[test]
    fn markup_holds_no_character_that_xml_has_not() {
        assert_eq!(for_markup("a<b>&\"\u{ffff}\u{fffe}\u{7}\u{85}c"), "a&lt;b&gt;&amp;&quot;c");
    }

    #[test]
    fn ids_that_differ_have_names_that_differ_and_none_leads_out_of_its_folder() {
        let long = "x".repeat(300);
        let ids = [
            "a/b",
            "a_b",
            "a b",
            "a%2Fb",
            "",
            ".",
            "..",
            "../../etc/passwd",
            "ä",
            "record",
            "%",
            "a\0",
            &long,
            &long[1..],
        ];
        let names: BTreeSet<String> = ids.iter().map(|id| for_file_name(id)).collect();
        assert_eq!(names.len(), ids.len(), "{names:?}");
        for name in &names {
            assert!(!name.starts_with('.') && !name.contains(['/', '\0']) && name.len() < 200, "{name}");
        }
        assert_eq!(for_file_name("a/b"), "a%2Fb");
    }
}
