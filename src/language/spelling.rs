//! What a word that is no word of English was meant to be.

/// Shorter words are too near to too many others to be taken for misspelt.
const LETTERS_FOR_ONE_EDIT: usize = 3;
const LETTERS_FOR_TWO_EDITS: usize = 9;

/// The candidate nearest to a misspelt word: one edit away (a transposition is one), or two for a long word; the same
/// first letter; the nearest, then the first in the alphabet. Short words only where two letters changed places.
pub fn nearest<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let letters = word.chars().count();
    let first = word.chars().next()?;
    if letters < LETTERS_FOR_ONE_EDIT || !word.chars().all(char::is_alphabetic) {
        return None;
    }
    let most = if letters < LETTERS_FOR_TWO_EDITS { 1 } else { 2 };
    let near = candidates.filter(|name| name.starts_with(first) && name.len().abs_diff(word.len()) <= most);
    let near = near.map(|name| (strsim::osa_distance(word, name), name)).filter(|(distance, _)| *distance <= most);
    near.filter(|(_, name)| letters > 4 || same_letters(word, name)).min().map(|(_, name)| name)
}

fn same_letters(a: &str, b: &str) -> bool {
    let sorted = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    sorted(a) == sorted(b)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn one_slip_of_the_fingers_is_mended_and_a_short_word_only_when_letters_changed_places() {
        let known = ["mug", "table", "ladder", "bedroom", "refrigerator"];
        let mended = |word| nearest(word, known.into_iter());
        assert_eq!([mended("mgu"), mended("mag"), mended("tabel")], [Some("mug"), None, Some("table")]);
        assert_eq!([mended("laddder"), mended("refridgerater")], [Some("ladder"), Some("refrigerator")]);
        assert_eq!([mended("able"), mended("zzz")], [None, None]);
    }
}
