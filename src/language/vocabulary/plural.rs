//! Singulars that an English plural may come from; a table says which of them there is.

use std::borrow::Cow;

/// What a plural ends in, and its singular instead, in the order to try. Irregular plurals stand in `nouns.tsv`, which
/// leaves out those that this makes: `build.py` has the same list.
const ENDINGS: [(&str, &str); 6] = [("s", ""), ("es", ""), ("ies", "y"), ("ves", "f"), ("ves", "fe"), ("men", "man")];

/// Shorter words are no stems: "is", "as", "gas".
const LEAST_LETTERS: usize = 3;

/// The singulars that may have this plural: "knives" gives "knive", "kniv", "knif", "knife". A word in -ss is none.
pub(super) fn singulars(plural: &str) -> impl Iterator<Item = Cow<'_, str>> {
    let endings = if plural.ends_with("ss") { &[] } else { &ENDINGS[..] };
    endings.iter().filter_map(|(end, instead)| {
        let stem = plural.strip_suffix(end)?;
        let singular = if instead.is_empty() { Cow::Borrowed(stem) } else { Cow::Owned(format!("{stem}{instead}")) };
        (singular.len() >= LEAST_LETTERS).then_some(singular)
    })
}
