//! What is not linear yet: measured by hand, `cargo test --release --test hostile -- --ignored --nocapture`.

mod common;

use std::time::Instant;

use common::run;

/// How many times as long a text takes that is four times as long.
fn growth(stage: &str, text: impl Fn(usize) -> String, count: usize) -> f64 {
    let seconds = |count: usize| {
        let begun = Instant::now();
        run(stage, &["-j", "1"], text(count)).expect_code(0);
        begun.elapsed().as_secs_f64()
    };
    seconds(4 * count) / seconds(count)
}

#[test]
#[ignore = "`of ` is read in quadratic time"]
fn a_text_four_times_as_long_takes_about_four_times_as_long_to_read() {
    for word in ["of ", "back of ", "the ", "on the table "] {
        let grown = growth("chunk", |count| format!("{}\n", word.repeat(count)), 10_000);
        assert!(grown < 8.0, "`{word}`: {grown:.1} times");
    }
}

#[test]
#[ignore = "chunks that overlap are grounded in quadratic time"]
fn chunks_that_overlap_are_grounded_in_linear_time() {
    let record = |count: usize| {
        let chunk = r#"{"tag":"FURRP","start":0,"end":4}"#;
        format!(r#"{{"text":"left","tokens":[],"chunks":[{}]}}{}"#, vec![chunk; count].join(","), '\n')
    };
    let grounded = |count: usize| {
        let begun = Instant::now();
        run("ground", &["--method", "paper", "-j", "1"], record(count));
        begun.elapsed().as_secs_f64()
    };
    let grown = grounded(8_000) / grounded(2_000);
    assert!(grown < 8.0, "{grown:.1} times");
}
