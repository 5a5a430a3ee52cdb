//! The manual pages in `docs/man/` are those of the command lines.
//!
//! `UPDATE=1 cargo test --test man` writes them anew.

mod common;

use common::{ALL, run};

fn compare(page: &str, roff: &str) {
    let path = format!("{}/docs/man/{page}.1", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, roff).expect("written");
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(stored == roff, "docs/man/{page}.1 differs from the command line: run UPDATE=1 cargo test --test man");
}

#[test]
fn the_manual_pages_are_up_to_date() {
    for name in ALL {
        compare(name, &run(name, &["--man"], "").expect_code(0).out);
    }
}

#[test]
fn every_subcommand_of_evaluate_has_a_page() {
    let whole = run("evaluate", &["--man"], "").expect_code(0).out.replace("\\-", "-");
    let names: Vec<&str> =
        whole.split("evaluate-").skip(1).filter_map(|rest| rest.split_once("(1)")).map(|(name, _)| name).collect();
    assert!(names.contains(&"paper") && names.contains(&"score"), "{names:?}");
    for name in names.iter().filter(|name| **name != "help") {
        compare(&format!("evaluate-{name}"), &run("evaluate", &["--man", name], "").expect_code(0).out);
    }
}

#[test]
fn completions_are_printed_without_a_subcommand() {
    for shell in ["bash", "zsh", "fish"] {
        assert!(run("evaluate", &["--completions", shell], "").expect_code(0).out.contains("what-if"), "{shell}");
    }
}
