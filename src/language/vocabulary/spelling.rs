//! Which known name a misspelt word means.

/// Shorter words are too near to too many others.
const LETTERS_FOR_SWAPPED: usize = 3;
const LETTERS_FOR_ONE_EDIT: usize = 4;
const LETTERS_FOR_TWO_EDITS: usize = 9;

/// How a word comes near to a name: the less the nearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Distance {
    /// Letters left out, put in, changed, or swapped with the next.
    edits: usize,
    /// What kind of slip that is.
    slip: Slip,
}

/// Slips of spelling, the likeliest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Slip {
    /// The same letters in another order.
    Order,
    /// A letter once instead of twice, or twice instead of once.
    Doubling,
    /// A letter left out.
    Omission,
    /// Other letters.
    Other,
}

/// The number of the name, among those given with their numbers, that a word misspells: one edit away, or two for a
/// long word; the first letter the same, unless swapped with the second; of several the nearest, then the likeliest slip, then the first.
/// Linear in the names, so only for words that nothing else explains and that are no English.
pub(in crate::language) fn nearest<'n>(word: &str, names: impl Iterator<Item = (&'n str, usize)>) -> Option<usize> {
    let letters = word.chars().count();
    if letters < LETTERS_FOR_SWAPPED || !word.chars().all(char::is_alphabetic) {
        return None;
    }
    let most = if letters < LETTERS_FOR_TWO_EDITS { 1 } else { 2 };
    let near = names.filter_map(|(name, number)| {
        let distance = distance(word, name, most)?;
        (letters >= LETTERS_FOR_ONE_EDIT || distance.slip == Slip::Order).then_some((distance, number))
    });
    near.min().map(|(_, number)| number)
}

/// How near a word is to a name, if it may be that name misspelt.
fn distance(word: &str, name: &str, most: usize) -> Option<Distance> {
    // Bytes: cheap, and the names are ASCII.
    if name.len().abs_diff(word.len()) > most || !begins_alike(word, name) {
        return None;
    }
    let edits = strsim::osa_distance(word, name);
    (1..=most).contains(&edits).then(|| Distance { edits, slip: slip(word, name) })
}

fn begins_alike(word: &str, name: &str) -> bool {
    let first = |text: &str| (text.chars().next(), text.chars().nth(1));
    let (word, name) = (first(word), first(name));
    word.0 == name.0 || word == (name.1, name.0)
}

fn slip(word: &str, name: &str) -> Slip {
    let (mut word, mut name) = (sorted(word), sorted(name));
    if word == name {
        return Slip::Order;
    }
    let lacking = word.len() < name.len();
    word.dedup();
    name.dedup();
    match (word == name, lacking) {
        (true, _) => Slip::Doubling,
        (false, true) => Slip::Omission,
        (false, false) => Slip::Other,
    }
}

fn sorted(word: &str) -> Vec<char> {
    let mut letters: Vec<char> = word.chars().collect();
    letters.sort_unstable();
    letters
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 7] = ["mug", "table", "label", "couch", "fork", "refrigerator", "coffee table"];

    fn meant(word: &str) -> Option<&'static str> {
        nearest(word, NAMES.into_iter().zip(0..)).map(|number| NAMES[number])
    }

    #[test]
    fn letters_in_another_order_are_nearest() {
        assert_eq!(["mgu", "tabel", "cuoch", "ofrk"].map(meant), ["mug", "table", "couch", "fork"].map(Some));
    }

    #[test]
    fn of_names_as_near_the_likelier_slip_is_meant() {
        let of = |word, names: [&'static str; 2]| nearest(word, names.into_iter().zip(0..)).map(|number| names[number]);
        assert_eq!(of("carot", ["cart", "carrot"]), Some("carrot"));
        assert_eq!(of("shoer", ["shoes", "shower"]), Some("shower"));
        assert_eq!(of("baxes", ["boxes", "bases"]), Some("boxes"), "the first");
    }

    #[test]
    fn one_letter_may_lack_or_be_too_many_or_wrong_and_two_in_a_long_word() {
        let words = ["cuch", "tablle", "coucn", "refrigrater", "coffeetable"];
        let names = ["couch", "table", "couch", "refrigerator", "coffee table"];
        assert_eq!(words.map(meant), names.map(Some));
    }

    #[test]
    fn what_is_too_short_or_too_far_or_begins_otherwise_means_nothing() {
        assert_eq!(["mg", "mag", "couchhh", "vork", "t4ble", "", "mug"].map(meant), [None; 7]);
    }
}
