//! `drive --talk`: lines of a person in, replies out.

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{
    Common, Diagnostic, Exit, Failure, Format, Inputs, Intake, Line, Reporter, Source, open_output, record_of,
};
use spatial_fetch::conversation::{Memory, Reply, Session};
use spatial_fetch::grounding::{Grounder, Method};
use spatial_fetch::record::{Record, StageError};
use spatial_fetch::simulation::Driver;

#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Conversation")]
pub struct Arguments {
    /// Take what a person says, a line each: understand it, drive it in the simulated home, answer in words, ask back
    #[arg(long, conflicts_with_all = ["serve", "dry_run", "list", "from", "live"])]
    pub talk: bool,
    /// Keep what was seen in this file, and begin with what it holds
    #[arg(long, value_name = "FILE", requires = "talk")]
    pub remember: Option<PathBuf>,
}

impl Arguments {
    /// Talks until the lines end.
    pub fn run(&self, driver: Driver, common: &Common, reporter: &Reporter) -> Result<(Exit, Session), Failure> {
        if common.format == Format::Csv {
            return Err(Failure::Usage("--format csv: a conversation is no table; use json or text".to_string()));
        }
        let map = driver.home.map.name.clone();
        let memory = self.remember.as_deref().map(|file| Memory::load(file, &map)).transpose();
        let memory = memory.map_err(Failure::Failed)?.unwrap_or_default();
        let memory = Memory { map, ..memory };
        let mut session = Session::new(driver, Grounder::new(Method::default(), false), memory);
        let exit = self.converse(&mut session, common, reporter)?;
        Ok((exit, session))
    }

    fn converse(&self, session: &mut Session, common: &Common, reporter: &Reporter) -> Result<Exit, Failure> {
        let is_typed = common.files.is_empty() && io::stdin().is_terminal();
        let sink = open_output(common)?;
        sink.discard_on_interrupt(reporter.clone());
        // A person at a terminal reads words.
        let in_words =
            common.format == Format::Text || is_typed && common.output.is_none() && io::stdout().is_terminal();
        let mut lines = Inputs::new(&common.files, common.keep_going);
        let mut exit = Exit::Done;
        loop {
            if is_typed {
                prompt()?;
            }
            // One line at a time: whoever speaks waits for the reply.
            let batch: Vec<Line> = lines.next_batch(1)?;
            let Some(line) = batch.first() else { break };
            match reply(session, line, in_words) {
                Ok(None) => {}
                Ok(Some(text)) => sink.write(format!("{text}\n").as_bytes())?,
                Err(error) => {
                    reporter.error(&error);
                    exit = Exit::Lost;
                    if !common.keep_going && !is_typed {
                        sink.discard();
                        return Err(Failure::Failed(
                            "stopped at the first line that failed; --keep-going goes on".to_string(),
                        ));
                    }
                }
            }
            if let Some(file) = &self.remember {
                session.memory().save(file)?;
            }
        }
        sink.finish()?;
        Ok(exit)
    }
}

fn prompt() -> Result<(), Failure> {
    let mut terminal = io::stderr();
    let written = terminal.write_all(b"> ").and_then(|()| terminal.flush());
    written.map_err(|error| Failure::writing("standard error", &error))
}

/// What is written of one line; nothing of a blank one.
fn reply(session: &mut Session, line: &Line, in_words: bool) -> Result<Option<String>, Diagnostic> {
    let Some(mut record) = record_of(line, Intake::RecordsOrText)? else { return Ok(None) };
    let id = record.id();
    let failed = |error: StageError| Diagnostic::at(line, error.offset.unwrap_or(0), id.clone(), error.message);
    let reply = session.hear(&mut record).map_err(failed)?;
    Ok(Some(written(&reply, &mut record, in_words)))
}

fn written(reply: &Reply, record: &mut Record, in_words: bool) -> String {
    let (key, text) = match reply {
        Reply::Question(text) => ("question", text),
        Reply::Answer(text) => ("answer", text),
    };
    if in_words {
        return spatial_fetch::escape::for_terminal(text).to_string();
    }
    record.set(key, text);
    // A record holds JSON already.
    serde_json::to_string(record).unwrap_or_default()
}
