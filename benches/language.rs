//! How fast descriptions are read and grounded, on one core.

use spatial_fetch::grounding::{Grounder, Method};
use spatial_fetch::language::{Lexicon, Vocabulary, chunk_text};

const SPOKEN: &str = "ok um drive straight ahead and take a right into the first room there then walk about halfway in \
    and um turn to your left you 'll see a small round table next to the bed the remote should be sitting on that table";

fn main() {
    divan::main();
}

#[divan::bench]
fn chunk(bencher: divan::Bencher) {
    bencher.counter(divan::counter::ItemsCount::new(1_usize)).bench(|| chunk_text(divan::black_box(SPOKEN)));
}

/// What one speaker says without an end is read in time linear in its length: four times the words, four times the time.
#[divan::bench(args = ["of ", "the ", "back of ", "on the table ", "then go to the table "], consts = [10_000, 40_000])]
fn chunk_without_end<const WORDS: usize>(bencher: divan::Bencher, words: &str) {
    let text = words.repeat(WORDS);
    bencher.bench(|| chunk_text(divan::black_box(&text)));
}

#[divan::bench(args = [false, true])]
fn ground(bencher: divan::Bencher, brief: bool) {
    let (tokens, chunks) = chunk_text(SPOKEN);
    let grounder = Grounder::new(Method::Composed, brief);
    bencher
        .counter(divan::counter::ItemsCount::new(1_usize))
        .bench(|| grounder.ground(divan::black_box(SPOKEN), &tokens, &chunks));
}

#[divan::bench(args = ["peanuts", "closed", "xyzzy"])]
fn is_english(word: &str) -> bool {
    Vocabulary::embedded().is_english(divan::black_box(word))
}

#[divan::bench(args = ["skillet", "knives", "chipped_soup_bowl", "xyzzy"])]
fn class_of(bencher: divan::Bencher, noun: &str) {
    bencher.bench(|| Vocabulary::embedded().class_of(divan::black_box(noun)));
}

#[divan::bench(args = ["closed", "tabel", "xyzzy"])]
fn mended(bencher: divan::Bencher, word: &str) {
    bencher.bench(|| Lexicon::embedded().mended(divan::black_box(word)));
}
