//! The weighted Levenshtein distance over words.

/// Distance of two word sequences in 0 to 1, for weights in 0 to 1.
///
/// A match costs nothing, a substitution the heavier of the two weights, an
/// insertion or a deletion the word's weight; the sum is divided by the longer
/// length. With all weights one this is Levenshtein's distance over the longer
/// length. `same` says which words match, `a_weight` and `b_weight` give the
/// weight of the word at a position.
pub fn weighted_distance<T>(
    a: &[T],
    b: &[T],
    same: impl Fn(&T, &T) -> bool,
    a_weight: impl Fn(usize) -> f64,
    b_weight: impl Fn(usize) -> f64,
) -> f64 {
    let longer = a.len().max(b.len());
    if longer == 0 {
        return 0.0;
    }
    let mut row = Vec::with_capacity(b.len() + 1);
    row.push(0.0);
    for j in 0..b.len() {
        row.push(row[j] + b_weight(j));
    }
    for (i, word) in a.iter().enumerate() {
        let deleted = a_weight(i);
        let mut diagonal = row[0];
        row[0] += deleted;
        for (j, other) in b.iter().enumerate() {
            let inserted = b_weight(j);
            let substituted = diagonal + if same(word, other) { 0.0 } else { deleted.max(inserted) };
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j + 1] + deleted).min(row[j] + inserted);
        }
    }
    row[b.len()] / longer as f64
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn distance(a: &[u8], b: &[u8], weights: &[f64]) -> f64 {
        let weight = |word: u8| weights[word as usize];
        weighted_distance(a, b, |x, y| x == y, |i| weight(a[i]), |j| weight(b[j]))
    }

    fn words() -> impl Strategy<Value = Vec<u8>> {
        prop::collection::vec(0..6_u8, 0..8)
    }

    fn weights() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(0.01..1.0_f64, 6)
    }

    proptest! {
        #[test]
        fn with_all_weights_one_it_is_strsims_levenshtein(a in words(), b in words()) {
            let plain = strsim::generic_levenshtein(&a, &b) as f64 / a.len().max(b.len()).max(1) as f64;
            prop_assert!((distance(&a, &b, &[1.0; 6]) - plain).abs() < 1e-12);
        }

        #[test]
        fn it_is_symmetric_and_within_bounds(a in words(), b in words(), w in weights()) {
            let d = distance(&a, &b, &w);
            prop_assert!((d - distance(&b, &a, &w)).abs() < 1e-12);
            prop_assert!((0.0..=1.0).contains(&d));
        }

        #[test]
        fn only_equal_texts_have_no_distance(a in words(), b in words(), w in weights()) {
            prop_assert_eq!(distance(&a, &b, &w) == 0.0, a == b);
        }

        #[test]
        fn no_detour_is_shorter_before_the_division(a in words(), b in words(), c in words(), w in weights()) {
            let raw = |x: &[u8], y: &[u8]| distance(x, y, &w) * x.len().max(y.len()) as f64;
            prop_assert!(raw(&a, &c) <= raw(&a, &b) + raw(&b, &c) + 1e-9);
        }
    }
}
