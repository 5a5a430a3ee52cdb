//! Messages that name the place: `prog: FILE:LINE:COLUMN: message (record "42")`.

use std::io::{self, IsTerminal, Write};

use super::{Common, Line};
use crate::escape::{for_line, for_terminal};

/// A message about one place of the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// `FILE:LINE:COLUMN`, 1-based; the column counts bytes.
    pub place: String,
    /// The record's id, when it has one.
    pub id: Option<String>,
    /// What was wrong, and what mends it.
    pub message: String,
}

impl Diagnostic {
    /// A message about the given byte of a line.
    pub fn at(line: &Line, offset: usize, id: Option<String>, message: impl Into<String>) -> Self {
        Self { place: format!("{}:{}:{}", line.file, line.number, offset + 1), id, message: message.into() }
    }
}

/// Writes messages to standard error in one form.
#[derive(Clone, Debug)]
pub struct Reporter {
    program: &'static str,
    color: bool,
    quiet: bool,
}

impl Reporter {
    /// A reporter for `program` under the given options.
    pub fn new(program: &'static str, common: &Common) -> Self {
        let color = common.color.holds(io::stderr().is_terminal());
        Self { program, color, quiet: common.quiet }
    }

    /// Reports what went wrong with a record.
    pub fn error(&self, diagnostic: &Diagnostic) {
        self.line("31", &format!("{}: {}{}", for_line(&diagnostic.place), diagnostic.message, id_suffix(diagnostic)));
    }

    /// Reports what was lost on the way.
    pub fn warning(&self, diagnostic: &Diagnostic) {
        self.line(
            "33",
            &format!("{}: warning: {}{}", for_line(&diagnostic.place), diagnostic.message, id_suffix(diagnostic)),
        );
    }

    /// Reports what ended the run.
    pub fn fatal(&self, message: &str) {
        self.line("31", message);
    }

    /// What a record came to, as it is asked for: without the program's name before each line.
    pub fn tell(&self, text: &str) {
        // Nowhere left to complain when standard error is closed.
        let _ = io::stderr().lock().write_all(format!("{}\n", for_terminal(text)).as_bytes());
    }

    /// A remark that `--quiet` leaves out.
    pub fn remark(&self, message: &str) {
        if !self.quiet {
            self.line("2", message);
        }
    }

    fn line(&self, color: &str, message: &str) {
        let (program, message) = (self.program, for_terminal(message));
        let text = if self.color {
            format!("\x1b[{color}m{program}:\x1b[0m {message}\n")
        } else {
            format!("{program}: {message}\n")
        };
        // Nowhere left to complain when standard error is closed.
        let _ = io::stderr().lock().write_all(text.as_bytes());
    }
}

fn id_suffix(diagnostic: &Diagnostic) -> String {
    diagnostic.id.as_ref().map(|id| format!(" (record {id:?})")).unwrap_or_default()
}
