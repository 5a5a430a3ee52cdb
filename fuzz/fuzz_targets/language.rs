//! Any text is read and grounded without a panic, and its chunks lie within it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::grounding::{Grounder, Method};
use spatial_fetch::language::chunk_text;
use spatial_fetch::record::Chunk;

fn within(text: &str, chunks: &[Chunk]) -> bool {
    chunks.iter().all(|chunk| text.get(chunk.start..chunk.end).is_some() && within(text, &chunk.chunks))
}

fuzz_target!(|text: &str| {
    let (tokens, chunks) = chunk_text(text);
    assert!(within(text, &chunks));
    Grounder::new(Method::Composed, false).ground(text, &tokens, &chunks);
});
