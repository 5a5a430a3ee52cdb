//! Runs the real executables.
#![allow(dead_code)]

use std::io::Write;
use std::process::{Command, Stdio};

/// What a run left.
#[derive(Debug)]
pub struct Ran {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ran {
    /// The records on standard output.
    pub fn records(&self) -> Vec<serde_json::Value> {
        self.out.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect()
    }

    /// Fails with both streams unless the run ended with `code`.
    pub fn expect_code(self, code: i32) -> Self {
        assert_eq!(self.code, code, "stdout:\n{}\nstderr:\n{}", self.out, self.err);
        self
    }
}

/// The path of one of our executables.
pub fn executable(name: &str) -> &'static str {
    match name {
        "chunk" => env!("CARGO_BIN_EXE_chunk"),
        "ground" => env!("CARGO_BIN_EXE_ground"),
        "plan" => env!("CARGO_BIN_EXE_plan"),
        "drive" => env!("CARGO_BIN_EXE_drive"),
        "hof" => env!("CARGO_BIN_EXE_hof"),
        "perceive" => env!("CARGO_BIN_EXE_perceive"),
        "evaluate" => env!("CARGO_BIN_EXE_evaluate"),
        other => panic!("no executable {other}"),
    }
}

/// All seven.
pub const ALL: [&str; 7] = ["chunk", "ground", "plan", "drive", "hof", "perceive", "evaluate"];

/// Runs one executable on `input`.
pub fn run(name: &str, arguments: &[&str], input: impl AsRef<[u8]>) -> Ran {
    let mut child = Command::new(executable(name))
        .args(arguments)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    let input = input.as_ref().to_vec();
    let writer = std::thread::spawn(move || {
        // A program that stops reading is no failure of the test.
        let _ = stdin.write_all(&input);
    });
    let output = child.wait_with_output().expect("ends");
    writer.join().expect("written");
    Ran {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).expect("UTF-8"),
        err: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

/// Runs executables one after another, each on the output of the one before; all must end with 0.
pub fn pipe(names: &[&str], input: &str) -> String {
    names.iter().fold(input.to_string(), |data, name| run(name, &[], data).expect_code(0).out)
}
