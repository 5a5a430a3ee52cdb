//! A detector of one's own in place of ours: a command that reads frames as JSON lines and answers with detections.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::{Mutex, PoisonError};

use serde::Deserialize;

use crate::record::Detection;

/// A running command. Frames go to it one at a time, and it answers each before the next.
#[derive(Debug)]
pub struct ExternalDetector {
    command: String,
    running: Mutex<Running>,
}

#[derive(Debug)]
struct Running {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

/// What the command answers for a frame; other keys are its own.
#[derive(Deserialize)]
struct Answer {
    detections: Vec<Detection>,
}

/// Why the command gave no detections.
#[derive(Debug, thiserror::Error)]
#[error("--detector `{command}`: {what}")]
pub struct ExternalError {
    command: String,
    what: String,
}

impl ExternalDetector {
    /// Starts the command in a shell; what it says on standard error is seen.
    ///
    /// # Errors
    /// When the command cannot be started.
    pub fn start(command: &str) -> Result<Self, ExternalError> {
        let (shell, flag) = if cfg!(windows) { ("cmd", "/C") } else { ("sh", "-c") };
        let failed = |what: String| ExternalError { command: command.to_string(), what };
        let spawned = Command::new(shell).args([flag, command]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|error| failed(format!("cannot be started: {error}")))?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let output = BufReader::new(output.ok_or_else(|| failed("has no standard output".to_string()))?);
        Ok(Self { command: command.to_string(), running: Mutex::new(Running { child, input, output }) })
    }

    /// The command's detections in the frame that `record` names (one JSON object, without line breaks).
    ///
    /// # Errors
    /// When the command ends, or answers what is no list of detections.
    pub fn detect(&self, record: &str) -> Result<Vec<Detection>, ExternalError> {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        running.ask(record).map_err(|what| ExternalError { command: self.command.clone(), what })
    }
}

impl Running {
    fn ask(&mut self, record: &str) -> Result<Vec<Detection>, String> {
        let written = self.input.as_mut().map(|input| writeln!(input, "{record}").and_then(|()| input.flush()));
        let mut answer = String::new();
        let read = self.output.read_line(&mut answer).map_err(|error| format!("its answer cannot be read: {error}"))?;
        if read == 0 {
            return Err(self.ended(written.is_some_and(|written| written.is_err())));
        }
        let parsed: Result<Answer, _> = serde_json::from_str(&answer);
        let shape = "for each frame it must write one line with `detections`, as `perceive --schema` describes them";
        parsed.map(|answer| answer.detections).map_err(|error| {
            format!(
                "its answer, column {}: {}; {shape}",
                error.column(),
                crate::record::message_without_position(&error)
            )
        })
    }

    fn ended(&mut self, refused: bool) -> String {
        self.input = None;
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let when = if refused { "before it read the frame" } else { "without an answer to this frame" };
        format!("ended {when} ({status})")
    }
}

impl Drop for ExternalDetector {
    fn drop(&mut self) {
        let running = self.running.get_mut().unwrap_or_else(PoisonError::into_inner);
        // Closing its input tells it that there are no more frames.
        running.input = None;
        let _ = running.child.wait();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_command_answers_frame_by_frame() {
        let echo = r#"while read frame; do echo '{"detections":[]}'; done"#;
        let detector = ExternalDetector::start(echo).expect("started");
        assert_eq!(detector.detect("{}").expect("an answer"), []);
        assert_eq!(detector.detect("{}").expect("an answer"), []);
    }

    #[test]
    fn a_command_that_ends_or_talks_nonsense_is_named() {
        let ended = ExternalDetector::start("exit 4").expect("started").detect("{}").expect_err("no answer");
        assert!(ended.to_string().contains("`exit 4`") && ended.to_string().contains("4"), "{ended}");
        let nonsense = ExternalDetector::start("read frame; echo hello").expect("started");
        let error = nonsense.detect("{}").expect_err("no JSON").to_string();
        assert!(error.contains("must write one line with `detections`"), "{error}");
    }
}
