//! A detector of one's own in place of ours: a command that reads frames as JSON lines and answers with detections.
//!
//! The command is trusted to run, not to answer: each answer has a time and a
//! length, must be the only one to its frame, and bears the frame's number
//! where it bears one. A command that failed once in that is ended, and every
//! later frame told so: what it says afterwards may be of another frame.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::answer::Answer;
use crate::limits::{DETECTOR_ANSWER_BYTES, DETECTOR_SECONDS};

/// A command that hears that there are no more frames ends within this.
const ENDS_WITHIN: Duration = Duration::from_secs(5);

/// A running command. Frames go to it one at a time, and it answers each before the next.
#[derive(Debug)]
pub struct ExternalDetector {
    command: String,
    running: Mutex<Running>,
    ender: Ender,
}

#[derive(Debug)]
struct Running {
    child: Child,
    input: Option<ChildStdin>,
    answers: Receiver<io::Result<Vec<u8>>>,
    patience: Duration,
    /// Frames it was asked about.
    asked: u64,
    /// Why it is asked no more.
    failed: Option<String>,
}

/// Why the command gave no detections.
#[derive(Debug, thiserror::Error)]
#[error("--detector `{command}`: {what}")]
pub struct ExternalError {
    command: String,
    what: String,
}

/// Ends the command from anywhere, such as a signal handler's thread, with all its processes and the pictures that it
/// was handed.
#[derive(Clone, Debug)]
pub struct Ender(Arc<Held>);

#[derive(Debug)]
struct Held {
    /// The group of the command's processes; none once it has ended.
    group: Mutex<Option<u32>>,
    pictures: tempfile::TempDir,
}

impl Ender {
    /// Ends everything at once.
    pub fn end(&self) {
        self.kill();
        // What cannot be removed is in the folder for such things.
        let _ = std::fs::remove_dir_all(self.0.pictures.path());
    }

    fn kill(&self) {
        let Some(group) = self.0.group.lock().unwrap_or_else(PoisonError::into_inner).take() else { return };
        #[cfg(unix)]
        if let Some(group) = i32::try_from(group).ok().and_then(rustix::process::Pid::from_raw) {
            // It may have ended by itself.
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
    }
}

impl ExternalDetector {
    /// Starts the command in a shell, with `patience` for each answer; what it says on standard error is seen.
    ///
    /// # Errors
    /// When the shell cannot be started.
    pub fn start(command: &str, patience: Option<Duration>) -> Result<Self, ExternalError> {
        let failed = |what: String| ExternalError { command: command.to_string(), what };
        let pictures = tempfile::tempdir().map_err(|error| failed(format!("no place for pictures: {error}")))?;
        let mut child = shell(command).spawn().map_err(|error| failed(format!("cannot be started: {error}")))?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let output = output.ok_or_else(|| failed("has no standard output".to_string()))?;
        let (sender, answers) = sync_channel(1);
        std::thread::spawn(move || hear(output, &sender));
        let ender = Ender(Arc::new(Held { group: Mutex::new(Some(child.id())), pictures }));
        let patience = patience.unwrap_or(Duration::from_secs(DETECTOR_SECONDS.value));
        let running = Running { child, input, answers, patience, asked: 0, failed: None };
        Ok(Self { command: command.to_string(), running: Mutex::new(running), ender })
    }

    /// What ends it.
    pub fn ender(&self) -> Ender {
        self.ender.clone()
    }

    /// Where pictures for it may lie; the folder goes with it.
    pub fn pictures(&self) -> &Path {
        self.ender.0.pictures.path()
    }

    /// The command's answer for a frame: `line` makes the JSON object that names it, without line breaks, for the
    /// number the frame gets.
    ///
    /// # Errors
    /// When the command ends, is too slow, or its answer makes no sense: with what is wrong.
    pub fn detect(&self, line: impl FnOnce(u64) -> Result<String, String>) -> Result<Answer, ExternalError> {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        let answered = running.ask(line);
        if running.failed.is_some() {
            self.ender.kill();
        }
        answered.map_err(|what| self.error(what))
    }

    /// Tells the command that there are no more frames, and waits for its end.
    ///
    /// # Errors
    /// When it ends with a failure, says something that nobody asked, or does not end.
    pub fn finish(&self) -> Result<(), ExternalError> {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        if running.failed.is_some() {
            return Ok(());
        }
        running.input = None;
        let ended = running.ended_within(ENDS_WITHIN);
        let unasked = running.answers.try_recv().is_ok_and(|answer| answer.is_ok_and(|line| !line.is_empty()));
        self.ender.kill();
        match ended {
            None => Err(self.error(format!("did not end within {} s after the last frame", ENDS_WITHIN.as_secs()))),
            Some(status) if !status.success() => Err(self.error(format!("ended with {status}"))),
            _ if unasked => Err(self.error("answered more often than it was asked".to_string())),
            _ => Ok(()),
        }
    }

    fn error(&self, what: String) -> ExternalError {
        ExternalError { command: self.command.clone(), what }
    }
}

/// The command, in a group of its own, so that it ends with all that it starts.
fn shell(command: &str) -> Command {
    let (shell, flag) = if cfg!(windows) { ("cmd", "/C") } else { ("sh", "-c") };
    let mut process = Command::new(shell);
    process.args([flag, command]).stdin(Stdio::piped()).stdout(Stdio::piped());
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut process, 0);
    process
}

/// Passes on line by line what comes; an empty one is the end.
fn hear(output: ChildStdout, answers: &SyncSender<io::Result<Vec<u8>>>) {
    let mut output = BufReader::new(output);
    loop {
        let mut line = Vec::new();
        let read = output.by_ref().take(DETECTOR_ANSWER_BYTES.value + 1).read_until(b'\n', &mut line);
        let goes_on = matches!(read, Ok(count) if count > 0 && count as u64 <= DETECTOR_ANSWER_BYTES.value);
        // Nobody listens any more when the detector is dropped.
        if answers.send(read.map(|_| line)).is_err() || !goes_on {
            return;
        }
    }
}

impl Running {
    fn ask(&mut self, line: impl FnOnce(u64) -> Result<String, String>) -> Result<Answer, String> {
        if let Some(why) = &self.failed {
            return Err(format!("not asked any more: it {why}"));
        }
        let number = self.asked + 1;
        let line = line(number)?;
        match self.answers.try_recv() {
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => {}
            Ok(Ok(line)) if line.is_empty() => {}
            Ok(_) => return self.fail("answered more often than it was asked".to_string()),
        }
        self.asked = number;
        let written = self.input.as_mut().map(|input| writeln!(input, "{line}").and_then(|()| input.flush()));
        let answer = match self.answers.recv_timeout(self.patience) {
            Ok(Ok(answer)) if !answer.is_empty() => answer,
            Ok(Err(error)) => return self.fail(format!("gave an answer that cannot be read: {error}")),
            Err(RecvTimeoutError::Timeout) => {
                let seconds = self.patience.as_secs_f64();
                return self.fail(format!("gave no answer within {seconds} s; --detector-patience gives it more time"));
            }
            Ok(Ok(_)) | Err(RecvTimeoutError::Disconnected) => {
                let ended = self.ended(written.is_some_and(|written| written.is_err()));
                return self.fail(ended);
            }
        };
        if answer.len() as u64 > DETECTOR_ANSWER_BYTES.value {
            let most = DETECTOR_ANSWER_BYTES.value;
            return self.fail(format!("gave an answer of more than the {most} bytes that are taken"));
        }
        self.understood(&answer, number)
    }

    fn understood(&mut self, answer: &[u8], number: u64) -> Result<Answer, String> {
        let parsed: Result<Answer, _> = serde_json::from_slice(answer);
        let shape = "for each frame it must write one line with `detections`, as `perceive --schema` describes them, or \
                     `boxes` (docs/perception.md)";
        let parsed = parsed
            .map_err(|error| format!("column {}: {}", error.column(), crate::record::message_without_position(&error)));
        let answer = parsed.and_then(Answer::checked).map_err(|what| format!("its answer, {what}; {shape}"))?;
        match answer.number {
            Some(other) if other != number => {
                self.fail(format!("answered frame {other} when it was asked about frame {number}"))
            }
            _ => Ok(answer),
        }
    }

    fn fail<T>(&mut self, why: String) -> Result<T, String> {
        self.input = None;
        self.failed = Some(why.clone());
        Err(why)
    }

    fn ended(&mut self, refused: bool) -> String {
        self.input = None;
        let status = self.ended_within(ENDS_WITHIN);
        let status = status.map_or_else(|| "still running".to_string(), |status| status.to_string());
        let when = if refused { "before it read the frame" } else { "without an answer to this frame" };
        format!("ended {when} ({status})")
    }

    fn ended_within(&mut self, time: Duration) -> Option<ExitStatus> {
        let until = Instant::now() + time;
        loop {
            if let Ok(Some(status)) = self.child.try_wait() {
                return Some(status);
            }
            if Instant::now() >= until {
                return None;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Drop for ExternalDetector {
    fn drop(&mut self) {
        // A command that was not waited for before is not waited for now.
        self.ender.kill();
        let running = self.running.get_mut().unwrap_or_else(PoisonError::into_inner);
        running.input = None;
        let _ = running.child.wait();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn started(command: &str) -> ExternalDetector {
        ExternalDetector::start(command, Some(Duration::from_millis(700))).expect("started")
    }

    /// How many pieces it answers.
    fn ask(detector: &ExternalDetector) -> Result<usize, String> {
        let answer = detector.detect(|number| Ok(format!("{{\"number\":{number}}}")));
        answer.map(|answer| answer.detections.map_or(0, |pieces| pieces.len())).map_err(|error| error.to_string())
    }

    #[test]
    fn a_command_answers_frame_by_frame_and_may_say_to_which() {
        for echo in [
            r#"while read frame; do echo '{"detections":[]}'; done"#,
            r#"while read frame; do echo "$frame" | sed 's/}/,"detections":[]}/'; done"#,
        ] {
            let detector = started(echo);
            assert_eq!(ask(&detector), Ok(0));
            assert_eq!(ask(&detector), Ok(0));
            detector.finish().expect("a good end");
        }
    }

    #[test]
    fn a_command_that_ends_or_talks_nonsense_is_named() {
        let ended = ask(&started("exit 4")).expect_err("no answer");
        assert!(ended.contains("`exit 4`") && ended.contains("4"), "{ended}");
        let error = ask(&started("read frame; echo hello")).expect_err("no JSON");
        assert!(error.contains("must write one line with `detections`"), "{error}");
    }

    #[test]
    fn a_command_that_hangs_or_writes_no_end_of_line_is_ended_in_time() {
        for command in ["read frame; sleep 100", "read frame; printf '{'; sleep 100"] {
            let detector = started(command);
            let error = ask(&detector).expect_err("no answer");
            assert!(error.contains("no answer within 0.7 s; --detector-patience"), "{error}");
            assert!(ask(&detector).expect_err("ended").contains("not asked any more"));
        }
    }

    #[test]
    fn a_flood_without_line_ends_is_cut_off() {
        let detector = ExternalDetector::start("read frame; tr '\\0' x < /dev/zero", None).expect("started");
        let error = ask(&detector).expect_err("too long");
        assert!(error.contains("more than the 4194304 bytes"), "{error}");
    }

    #[test]
    fn an_answer_to_another_frame_is_taken_for_none() {
        let twice = started(r#"while read frame; do echo '{"detections":[]}'; echo '{"detections":[]}'; done"#);
        assert_eq!(ask(&twice), Ok(0));
        std::thread::sleep(Duration::from_millis(200));
        assert!(ask(&twice).expect_err("shifted").contains("more often than it was asked"));
        let wrong = started(r#"while read frame; do echo '{"detections":[],"number":7}'; done"#);
        assert!(ask(&wrong).expect_err("wrong").contains("answered frame 7 when it was asked about frame 1"));
    }

    #[test]
    fn how_a_command_ends_is_told() {
        let detector = started(r#"read frame; echo '{"detections":[]}'; exit 9"#);
        assert_eq!(ask(&detector), Ok(0));
        assert!(detector.finish().expect_err("a failure").to_string().contains("exit status: 9"));
    }

    #[test]
    fn what_a_command_started_ends_with_it_and_its_pictures_go() {
        let detector = started("sleep 1000 & echo $! >&2; echo $!; wait");
        let mut line = Vec::new();
        let running = detector.running.lock().expect("whole");
        line.extend(running.answers.recv().expect("a line").expect("readable"));
        drop(running);
        let process = String::from_utf8(line).expect("a number");
        detector.ender().end();
        assert!(!detector.pictures().exists());
        let until = Instant::now() + Duration::from_secs(20);
        let status = format!("/proc/{}/stat", process.trim());
        // A process that has ended may wait for someone who asks how.
        while std::fs::read_to_string(&status).is_ok_and(|text| !text.contains(") Z")) {
            assert!(Instant::now() < until, "{status} lives on");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}
