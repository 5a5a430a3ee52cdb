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

/// The words of a text, in order: letters and digits with inner hyphens and apostrophes; anything else by itself.
pub fn tokenize(text: &str) -> Vec<Word<'_>> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices() {
        if is_inner(c) {
            start.get_or_insert(at);
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

fn is_inner(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '\'' | '’' | '-' | '_')
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
    Cow::Owned(word.to_lowercase().replace('’', "'"))
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
    fn every_byte_that_is_no_space_belongs_to_one_word() {
        let text = "Über die Straße → 🤖 ok \u{130}'s";
        let covered: usize = tokenize(text).iter().map(|w| w.end - w.start).sum();
        assert_eq!(covered, text.chars().filter(|c| !c.is_whitespace()).map(char::len_utf8).sum::<usize>());
        assert!(tokenize(text).iter().all(|w| &text[w.start..w.end] == w.text));
    }

    #[test]
    fn nothing_gives_no_words() {
        assert!(tokenize("").is_empty() && tokenize(" \t ").is_empty());
    }
}
