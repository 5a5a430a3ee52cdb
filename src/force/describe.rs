//! A relative position in one English sentence.

use super::DegreeOfTruth;

/// Names of the four directions in the order right, above, left, below.
pub const NAMES: [&str; 4] = ["to the right of", "above", "to the left of", "below"];
/// The same as a second thought.
const SECOND: [&str; 4] = ["to the right", "above", "to the left", "below"];

/// Hedges of the primary direction by its degree. The literature gives the words (Matsakis et al. 2001); where
/// one ends and the next begins is our choice, spaced so that 45° between two directions is "loosely".
const HEDGES: [(f64, &str); 4] = [(0.95, "perfectly "), (0.85, ""), (0.6, "mostly "), (0.1, "loosely ")];
/// The secondary direction by its degree; below the last it is not worth a word.
const SECOND_HEDGES: [(f64, &str); 3] = [(0.35, " and also "), (0.2, " but somewhat "), (0.08, " but slightly ")];

/// Says where `a` is relative to `b`, from the degrees of right, above, left and below and how far a surrounds b.
pub fn describe(a: &str, b: &str, degrees: [DegreeOfTruth; 4], surround: f64, distance: f64) -> String {
    if surround > 0.6 {
        return format!("{a} surrounds {b}.");
    }
    let best = (0..4).fold(0, |best, i| if degrees[i].a > degrees[best].a { i } else { best });
    let Some((_, hedge)) = HEDGES.iter().find(|(least, _)| degrees[best].a >= *least) else {
        return if distance == 0.0 {
            format!("{a} and {b} lie in one place.")
        } else {
            format!("{a} lies all round {b}.")
        };
    };
    let neighbours = [(best + 1) % 4, (best + 3) % 4];
    let second = if degrees[neighbours[0]].a >= degrees[neighbours[1]].a { neighbours[0] } else { neighbours[1] };
    let addition = SECOND_HEDGES.iter().find(|(least, _)| degrees[second].a >= *least);
    let addition = addition.map(|(_, hedge)| format!("{hedge}{}", SECOND[second])).unwrap_or_default();
    let contact = if distance == 0.0 { ", touching it" } else { "" };
    format!("{a} is {hedge}{} {b}{addition}{contact}; the description is {}.", NAMES[best], assessment(degrees[best]))
}

/// How well the words do justice to the histogram: by the share of forces that are effective.
fn assessment(degree: DegreeOfTruth) -> &'static str {
    match degree.b {
        b if b >= 0.7 => "satisfactory",
        b if b >= 0.4 => "rather satisfactory",
        _ => "not satisfactory",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(values: [f64; 4]) -> [DegreeOfTruth; 4] {
        values.map(|a| DegreeOfTruth { a, b: a.max(0.8) })
    }

    #[test]
    fn the_second_direction_is_told_when_it_matters() {
        let text = describe("the table", "the couch", degrees([0.7, 0.3, 0.0, 0.0]), 0.0, 1.0);
        assert_eq!(
            text,
            "the table is mostly to the right of the couch but somewhat above; the description is satisfactory."
        );
    }

    #[test]
    fn surrounding_comes_before_directions() {
        assert_eq!(describe("a", "b", degrees([0.2; 4]), 0.9, 1.0), "a surrounds b.");
    }
}
