//! What a speech recogniser gets wrong, simulated.
//!
//! A word is hit with the given probability, and then one of four things
//! happens to it, each as often as the others: it is lost, said twice, heard as
//! a word that sounds alike, or followed by a filler. What is lost or misheard
//! is as in recognisers: short unstressed words get lost, and only words that
//! have a homophone are misheard; a word that the draw does not fit is doubled.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use serde::Serialize;

use super::super::Gold;
use super::counts::{MeaningRates, judge};
use super::{Experiment, understand};
use crate::grounding::Grounder;
use crate::record::{Grounding, Rounded};
use crate::simulation::stream_of;

/// Words that sound alike: said, heard.
const HOMOPHONES: [(&str, &str); 30] = [
    ("right", "write"),
    ("to", "two"),
    ("too", "to"),
    ("two", "too"),
    ("their", "there"),
    ("there", "their"),
    ("for", "four"),
    ("four", "for"),
    ("by", "buy"),
    ("your", "you're"),
    ("you're", "your"),
    ("its", "it's"),
    ("hall", "haul"),
    ("see", "sea"),
    ("be", "bee"),
    ("no", "know"),
    ("wood", "would"),
    ("would", "wood"),
    ("in", "inn"),
    ("past", "passed"),
    ("straight", "strait"),
    ("way", "weigh"),
    ("one", "won"),
    ("our", "are"),
    ("side", "sighed"),
    ("chairs", "chares"),
    ("through", "threw"),
    ("piece", "peace"),
    ("plate", "plait"),
    ("vase", "vays"),
];
/// Words that are said without stress.
const UNSTRESSED: [&str; 24] = [
    "the", "a", "an", "and", "of", "to", "is", "it", "be", "will", "you", "'s", "'ll", "your", "that", "are", "at",
    "should", "can", "there", "then", "so", "i", "my",
];
const FILLERS: [&str; 4] = ["um", "uh", "er", "like"];

/// How much survives the noise.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Noise {
    /// Probability that a word is hit.
    pub probability: Rounded,
    /// As the words were said.
    pub clean: MeaningRates,
    /// As they were heard.
    pub noisy: MeaningRates,
    /// Share of the clean rate that is kept: of room, object and pairs.
    pub kept: Kept,
}

/// Noisy rate over clean rate.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Kept {
    /// Room by side and name.
    pub room: Rounded,
    /// Object.
    pub object: Rounded,
    /// Pairs, by their F1.
    pub pairs: Rounded,
    /// Pairs, all of a description.
    pub all_pairs: Rounded,
}

pub(super) fn score(grounder: &Grounder, gold: &[&Gold], clean: &[Grounding], experiment: &Experiment) -> Noise {
    let hear = |gold: &&Gold| {
        let mut random = ChaCha8Rng::seed_from_u64(experiment.seed);
        random.set_stream(stream_of(&gold.id));
        understand(grounder, &misheard(&gold.text, experiment.noise, &mut random))
    };
    let heard: Vec<Grounding> = gold.par_iter().map(hear).collect();
    let mut noise = Noise { probability: Rounded(experiment.noise), ..Noise::default() };
    let (mut clean_parts, mut noisy_parts) = ([0_u32; 3], [0_u32; 3]);
    for ((gold, clean), heard) in gold.iter().zip(clean).zip(&heard) {
        let (said, got) = (judge(gold, clean), judge(gold, heard));
        noise.clean.add(&said);
        noise.noisy.add(&got);
        for (part, count) in said.parts().iter().zip(&mut clean_parts) {
            *count += u32::from(*part);
        }
        for (part, count) in got.parts().iter().zip(&mut noisy_parts) {
            *count += u32::from(*part);
        }
    }
    let share = |i: usize| Rounded(f64::from(noisy_parts[i]) / f64::from(clean_parts[i].max(1)));
    noise.kept = Kept {
        room: share(0),
        object: share(1),
        pairs: Rounded(noise.noisy.pairs_f1.0 / noise.clean.pairs_f1.0.max(f64::MIN_POSITIVE)),
        all_pairs: share(2),
    };
    noise
}

/// What a recogniser makes of a text.
pub fn misheard(text: &str, probability: f64, random: &mut ChaCha8Rng) -> String {
    let mut heard: Vec<&str> = Vec::new();
    for word in text.split_whitespace() {
        let hit = (random.next_u32() as f64) < probability * f64::from(u32::MAX);
        if !hit {
            heard.push(word);
            continue;
        }
        let lower = word.to_lowercase();
        let alike = HOMOPHONES.iter().find(|(said, _)| *said == lower).map(|(_, heard)| *heard);
        match (random.next_u32() % 4, alike) {
            (0, _) if UNSTRESSED.contains(&lower.as_str()) => {}
            (1, Some(alike)) => heard.push(alike),
            (2, _) => heard.extend([word, FILLERS[random.next_u32() as usize % FILLERS.len()]]),
            _ => heard.extend([word, word]),
        }
    }
    heard.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_noise_nothing_changes_and_with_it_the_seed_decides() {
        let text = "go to the right and the mug is on the table by the wall in the back of the room";
        let hear = |probability, seed| misheard(text, probability, &mut ChaCha8Rng::seed_from_u64(seed));
        assert_eq!(hear(0.0, 1), text);
        assert_eq!(hear(0.5, 1), hear(0.5, 1));
        assert_ne!(hear(0.5, 1), hear(0.5, 2));
    }

    #[test]
    fn content_words_are_never_lost() {
        let text = "mug table wall couch ".repeat(50);
        let heard = misheard(&text, 1.0, &mut ChaCha8Rng::seed_from_u64(3));
        for word in ["mug", "table", "wall", "couch"] {
            assert!(heard.split(' ').filter(|heard| *heard == word).count() >= 50, "{word}");
        }
    }
}
