//! Nouns in a grounding that nobody knows and that a known one nearly is: said, for a robot would look for them in vain.

use crate::language::{Lexicon, Vocabulary};
use crate::record::{Grounding, Node, Reference};

/// What is said of each of them: groundings come from other programs too.
pub fn misspelt(grounding: &Grounding, lexicon: &Lexicon) -> Vec<String> {
    let mut told: Vec<String> = Vec::new();
    for noun in grounding.nodes.iter().flat_map(nouns).filter(|noun| is_unknown(noun, lexicon)) {
        let Some(meant) = meant(noun, lexicon) else { continue };
        let problem = format!("`{noun}` is no noun that anyone knows; did you mean `{meant}`?");
        if !told.contains(&problem) {
            told.push(problem);
        }
    }
    told
}

fn nouns(node: &Node) -> impl Iterator<Item = &str> {
    node.target.as_deref().into_iter().chain(node.pairs.iter().filter_map(|pair| pair.reference.thing()))
}

fn is_unknown(noun: &str, lexicon: &Lexicon) -> bool {
    lexicon.class_of(noun).is_none() && Vocabulary::embedded().class_of(noun).is_none()
}

/// A part of the building one letter off, or the nearest noun of the lexicon.
fn meant(noun: &str, lexicon: &Lexicon) -> Option<String> {
    let near = |place: &Reference| strsim::osa_distance(place.name(), noun) == 1;
    let place = Reference::PLACES.into_iter().find(near).map(|place| place.name().to_string());
    place.or_else(|| lexicon.mended(&noun.replace('_', " ")).map(|noun| noun.name.replace(' ', "_")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(json: &str) -> Vec<String> {
        misspelt(&serde_json::from_str(json).expect("a grounding"), Lexicon::embedded())
    }

    #[test]
    fn a_noun_one_letter_off_is_said_once_and_one_that_is_only_rare_is_not() {
        let grounding = |target: &str, reference: &str| {
            let pair = format!(r#"{{"reference":"{reference}","direction":"left","frame":"viewer"}}"#);
            format!(r#"{{"room":null,"object":null,"nodes":[{{"target":"{target}","pairs":[{pair},{pair}]}}]}}"#)
        };
        assert_eq!(said(&grounding("table", "wal")), ["`wal` is no noun that anyone knows; did you mean `wall`?"]);
        assert!(said(&grounding("refrigerater", "bed"))[0].contains("did you mean `refrigerator`?"));
        assert!(said(&grounding("credenza", "samovar")).is_empty());
    }
}
