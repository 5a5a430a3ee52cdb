//! The one `main` of the seven binaries.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use clap_complete::Shell;
use schemars::Schema;

use super::interrupt::{listen, yield_to_interrupt};
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
    listen();
    if let Some(text) = about_itself::<P>() {
        return exit::code(&print(&text));
    }
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
        return print(&schema::<P>());
    }
    if let Some(shell) = program.common().completions {
        return print(&completions(&mut command_of::<P>(), shell));
    }
    if program.reads_standard_input() && io::stdin().is_terminal() {
        // Usage on standard error, for someone who typed the bare name.
        let _ = writeln!(io::stderr(), "{}", command_of::<P>().render_help());
        let name = P::NAME;
        let typed =
            format!("no input: name a file, or pipe records in; `{name} -` reads what you type here, a line each");
        return Err(Failure::Usage(typed));
    }
    program.run()
}

/// What `--man [SUBCOMMAND]`, `--schema` and `--completions SHELL` print before anything else is parsed: they need no subcommand.
fn about_itself<P: Program>() -> Option<String> {
    let mut arguments = std::env::args().skip(1);
    let (option, value) = (arguments.next()?, arguments.next());
    let mut command = command_of::<P>();
    match option.as_str() {
        "--man" => {
            command.build();
            let page = match value {
                Some(name) => command.find_subcommand(&name)?.clone(),
                None => command,
            };
            let mut roff = Vec::new();
            // Writing to memory cannot fail.
            let _ = clap_mangen::Man::new(page).render(&mut roff);
            Some(String::from_utf8_lossy(&roff).into_owned())
        }
        "--schema" => Some(schema::<P>()),
        "--completions" => Some(completions(&mut command, Shell::from_str(&value?, true).ok()?)),
        _ => None,
    }
}

fn schema<P: Program>() -> String {
    format!("{:#}\n", P::schema().as_value())
}

fn completions(command: &mut clap::Command, shell: Shell) -> String {
    let name = command.get_name().to_string();
    let mut script = Vec::new();
    clap_complete::generate(shell, command, name, &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

fn print(text: &str) -> Result<Exit, Failure> {
    let mut out = io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.map(|()| Exit::Done).map_err(|error| Failure::writing("standard output", &error))
}
