//! Words and where they stand: bytes are never changed, only pointed at.

use std::borrow::Cow;

/// A word of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word<'t> {
    /// As it stands in the text.
    pub text: &'t str,
    /// In lower case, with a straight apostrophe.
    pub lower: Cow<'t, str>,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// Endings that are words of their own, longest first.
const CLITICS: [&str; 7] = ["n't", "'ll", "'re", "'ve", "'s", "'m", "'d"];

/// The words of a text, in order: letters and digits with inner hyphens, apostrophes and decimal marks; anything else
/// by itself.
pub fn tokenize(text: &str) -> Vec<Word<'_>> {
    let mut words = Vec::with_capacity(text.len() / 5 + 1);
    let mut start = None;
    let bytes = text.as_bytes();
    for (at, c) in text.char_indices() {
        if c.is_ascii_lowercase() || is_inner(c) && !is_dash(bytes, at) && !is_quote(text, at, c) {
            start.get_or_insert(at);
            continue;
        }
        if start.is_some() && is_decimal_mark(bytes, at) {
            continue;
        }
        // ".5 meters".
        if start.is_none() && c == '.' && bytes.get(at + 1).is_some_and(u8::is_ascii_digit) {
            start = Some(at);
            continue;
        }
        if let Some(from) = start.take() {
            push_split(text, from, at, &mut words);
        }
        if !c.is_whitespace() {
            push(text, at, at + c.len_utf8(), &mut words);
        }
    }
    if let Some(from) = start {
        push_split(text, from, text.len(), &mut words);
    }
    words
}

/// Letters, digits, and what holds a word together; soft hyphens and joiners belong to the word they stand in.
fn is_inner(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '\'' | '’' | '-' | '_' | '\u{2010}' | '\u{2011}') || is_invisible(c)
}

/// Characters that a typesetter adds and nobody reads: soft hyphens, joiners, and what turns the direction of writing.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}')
}

/// "Table--behind the couch": hyphens side by side are a dash, and so is one at a word's edge.
fn is_dash(bytes: &[u8], at: usize) -> bool {
    let letter =
        |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(|b| b.is_ascii_alphanumeric() || *b >= 128);
    bytes[at] == b'-' && !(letter(at.checked_sub(1)) && letter(Some(at + 1)))
}

/// An apostrophe at the edge of a word is a quotation mark, unless it begins a clitic: "'s", "'ll".
fn is_quote(text: &str, at: usize, c: char) -> bool {
    if !matches!(c, '\'' | '’') {
        return false;
    }
    let before = text[..at].chars().next_back().is_some_and(char::is_alphanumeric);
    let rest = &text[at + c.len_utf8()..];
    let after = rest.chars().next().is_some_and(char::is_alphabetic);
    if before {
        return !after;
    }
    let end = rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len());
    !matches!(rest[..end].to_ascii_lowercase().as_str(), "s" | "ll" | "re" | "ve" | "m" | "d" | "til")
}

/// "1.5", "0,5": a mark between digits belongs to the number.
fn is_decimal_mark(bytes: &[u8], at: usize) -> bool {
    let digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
    matches!(bytes[at], b'.' | b',') && digit(at.checked_sub(1)) && digit(Some(at + 1))
}

/// Splits "it's" into "it" and "'s"; a word that is only a clitic stays whole.
fn push_split<'t>(text: &'t str, start: usize, end: usize, words: &mut Vec<Word<'t>>) {
    let lower = lowered(&text[start..end]);
    // Lowering may change the length of exotic letters; only plain words have clitics.
    if lower.len() == end - start || text[start..end].contains('’') {
        for clitic in CLITICS {
            if let Some(stem) = lower.strip_suffix(clitic).filter(|stem| !stem.is_empty())
                && let Some(cut) = cut_before(&text[start..end], clitic.chars().count())
                && !stem.ends_with('\'')
            {
                push(text, start, start + cut, words);
                push(text, start + cut, end, words);
                return;
            }
        }
    }
    push(text, start, end, words);
}

/// The byte at which the last `count` characters begin.
fn cut_before(word: &str, count: usize) -> Option<usize> {
    word.char_indices().rev().nth(count - 1).map(|(at, _)| at)
}

fn push<'t>(text: &'t str, start: usize, end: usize, words: &mut Vec<Word<'t>>) {
    words.push(Word { text: &text[start..end], lower: lowered(&text[start..end]), start, end });
}

/// Borrowed where nothing changes: most speech comes in lower case.
fn lowered(word: &str) -> Cow<'_, str> {
    if word.bytes().all(|byte| byte.is_ascii() && !byte.is_ascii_uppercase()) {
        return Cow::Borrowed(word);
    }
    if word.is_ascii() {
        return Cow::Owned(word.to_ascii_lowercase());
    }
    let plain = |c: char| match c {
        '’' => '\'',
        '\u{2010}' | '\u{2011}' => '-',
        other => other,
    };
    Cow::Owned(word.to_lowercase().chars().filter(|c| !is_invisible(*c)).map(plain).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<&str> {
        tokenize(text).into_iter().map(|word| word.text).collect()
    }

    #[test]
    fn clitics_are_words_of_their_own_joined_or_not() {
        assert_eq!(
            texts("It's here, you'll see it 's fine"),
            ["It", "'s", "here", ",", "you", "'ll", "see", "it", "'s", "fine"]
        );
        assert_eq!(texts("don’t"), ["do", "n’t"]);
    }

    #[test]
    fn hyphens_hold_words_together_and_punctuation_stands_alone() {
        assert_eq!(texts("multi-sided (wood) table."), ["multi-sided", "(", "wood", ")", "table", "."]);
    }

    #[test]
    fn a_number_may_begin_with_its_mark_and_what_turns_the_writing_is_not_read() {
        assert_eq!(texts("go .5 meters. 5"), ["go", ".5", "meters", ".", "5"]);
        let turned = tokenize("the ta\u{202e}ble");
        assert_eq!(turned[1].lower, "table");
    }

    #[test]
    fn every_byte_that_is_no_space_belongs_to_one_word() {
        let text = "Über die Straße → 🤖 ok \u{130}'s";
        let covered: usize = tokenize(text).iter().map(|w| w.end - w.start).sum();
        assert_eq!(covered, text.chars().filter(|c| !c.is_whitespace()).map(char::len_utf8).sum::<usize>());
        assert!(tokenize(text).iter().all(|w| &text[w.start..w.end] == w.text));
    }

    #[test]
    fn typography_is_read_as_if_written_plainly() {
        let lower = |text| tokenize(text).into_iter().map(|word| word.lower.into_owned()).collect::<Vec<_>>();
        assert_eq!(lower("the 'mug' on ‘it’"), ["the", "'", "mug", "'", "on", "‘", "it", "'"]);
        assert_eq!(lower("table--behind"), ["table", "-", "-", "behind"]);
        assert_eq!(lower("cof\u{ad}fee\u{2011}table"), ["coffee-table"]);
        assert_eq!(lower("0,5 or 1.5 m. Then"), ["0,5", "or", "1.5", "m", ".", "then"]);
    }

    #[test]
    fn nothing_gives_no_words() {
        assert!(tokenize("").is_empty() && tokenize(" \t ").is_empty());
    }
}
