//! Any text as a treebank file: read or refused by line without a panic, and what is read holds together.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::evaluation::import;

fuzz_target!(|xml: &str| {
    // The reader takes a path, as `evaluate import` does; one file a process, in memory where the system has such a place.
    let folder = std::path::Path::new("/dev/shm");
    let folder = if folder.is_dir() { folder.to_path_buf() } else { std::env::temp_dir() };
    let path = folder.join(format!("fuzz-treebank-{}.xml", std::process::id()));
    std::fs::write(&path, xml).expect("written");
    if let Ok(imported) = import(&path, None, "fuzz") {
        for line in &imported.lines {
            assert!(serde_json::from_str::<serde_json::Value>(line).is_ok_and(|line| line["id"].is_string()));
        }
    }
});
