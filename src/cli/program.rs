//! The one `main` of the seven binaries.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use clap::Parser;
use schemars::Schema;

use super::interrupt::yield_to_interrupt;
use super::{Common, Exit, Failure, Reporter, exit};

/// A binary: its arguments, what it adds to a record, and its work.
pub trait Program: Parser {
    /// The binary's name.
    const NAME: &'static str;

    /// The shared options.
    fn common(&self) -> &Common;

    /// The JSON Schema of what it adds to a record.
    fn schema() -> Schema;

    /// Whether it waits for records on standard input when no file is named.
    fn reads_standard_input(&self) -> bool {
        self.common().files.is_empty()
    }

    /// Does the work.
    fn run(self) -> Result<Exit, Failure>;
}

/// The command line of a binary, for completions and manual pages.
pub fn command_of<P: Program>() -> clap::Command {
    P::command().name(P::NAME)
}

/// Parses the arguments, runs the binary, reports how it ended.
pub fn main<P: Program>() -> ExitCode {
    let program = match P::try_parse() {
        Ok(program) => program,
        Err(error) => {
            // A closed pipe after `--help` is no error.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { 2 } else { 0 });
        }
    };
    let reporter = Reporter::new(P::NAME, program.common());
    let result = dispatch(program);
    yield_to_interrupt();
    match &result {
        Err(Failure::BrokenPipe) | Ok(_) => {}
        Err(failure) => reporter.fatal(&failure.to_string()),
    }
    exit::code(&result)
}

fn dispatch<P: Program>(program: P) -> Result<Exit, Failure> {
    if program.common().schema {
        return print(&format!("{:#}\n", P::schema().as_value()));
    }
    if let Some(shell) = program.common().completions {
        let mut script = Vec::new();
        clap_complete::generate(shell, &mut command_of::<P>(), P::NAME, &mut script);
        return print(&String::from_utf8_lossy(&script));
    }
    if program.reads_standard_input() && io::stdin().is_terminal() {
        // Usage on standard error, for someone who typed the bare name.
        let _ = writeln!(io::stderr(), "{}", command_of::<P>().render_help());
        return Err(Failure::Usage("no input: name a file, or pipe records in".to_string()));
    }
    program.run()
}

fn print(text: &str) -> Result<Exit, Failure> {
    let mut out = io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.map(|()| Exit::Done).map_err(|error| Failure::writing("standard output", &error))
}
