//! Gold corpora and the files of meanings and trees beside them are read or refused by line, never with a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::evaluation::{parse_tree, read_gold, score, with_texts};

fuzz_target!(|text: &str| {
    if let Ok(tree) = parse_tree(text) {
        assert!(tree.chunks.iter().all(|chunk| tree.text.get(chunk.start..chunk.end).is_some()));
    }
    let gold = read_gold(text, "fuzz").unwrap_or_default();
    let _ = with_texts(gold.clone(), gold.clone());
    let lines: Vec<String> = text.lines().map(str::to_string).collect();
    let _ = score(&gold, &lines);
});
