//! The loop of every filter: lines in, one stage, lines out, in order.

use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::arguments::Style;
use super::foreign::foreign;
use super::paint::painted;
use super::rows::Rows;
use super::{Common, Diagnostic, Exit, Failure, Format, Inputs, Line, Progress, Reporter, Source, open_output};
use crate::escape::for_terminal;
use crate::record::{Note, Record, Row, Shade, Stage, StageError};

/// Enough lines to keep the cores busy, few enough to answer soon.
const BATCH_LINES: usize = 1024;

/// What a filter takes for a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intake {
    /// JSON objects only, that earlier stages made of text.
    Records,
    /// JSON objects of the program's own; what to give it, when a line is none.
    Own(&'static str),
    /// JSON objects, or plain lines that become `{"id": …, "text": …}`.
    RecordsOrText,
}

/// What became of one line or frame.
#[derive(Default)]
pub(super) struct Outcome {
    output: Option<Output>,
    error: Option<Diagnostic>,
    warning: Option<Diagnostic>,
    told: Option<String>,
}

/// What is written of a record.
enum Output {
    Text(String),
    Row(Row),
}

/// Runs `stage` over all lines of the files, or of standard input.
///
/// # Errors
/// When a file cannot be read, the output cannot be written, or a record cannot be processed and no one said to go on.
pub fn run_filter(program: &'static str, common: &Common, intake: Intake, stage: &dyn Stage) -> Result<Exit, Failure> {
    run_filter_on(program, common, &mut Inputs::new(&common.files, common.keep_going), intake, stage)
}

/// Runs `stage` over all lines of `lines`.
///
/// # Errors
/// When the lines cannot be read, the output cannot be written, or a record cannot be processed and no one said to go
/// on.
pub fn run_filter_on(
    program: &'static str,
    common: &Common,
    lines: &mut dyn Source<Line>,
    intake: Intake,
    stage: &dyn Stage,
) -> Result<Exit, Failure> {
    refuse_rows(program, common, stage)?;
    let style = common.style();
    run_source(program, common, lines, &|line| process(line, intake, style, stage))
}

/// Says before anything is done that a stage makes no rows.
pub(super) fn refuse_rows(program: &str, common: &Common, stage: &dyn Stage) -> Result<(), Failure> {
    if common.format != Format::Csv || stage.has_rows() {
        return Ok(());
    }
    let mend = "rows are made by `drive`, and by `evaluate score`";
    Err(Failure::Usage(format!("--format csv: what `{program}` adds is no row of a table; {mend}")))
}

/// Does `work` on everything that comes, in order.
pub(super) fn run_source<T: Sync>(
    program: &'static str,
    common: &Common,
    source: &mut dyn Source<T>,
    work: &(dyn Fn(&T) -> Outcome + Sync),
) -> Result<Exit, Failure> {
    let reporter = Reporter::new(program, common);
    let sink = open_output(common)?;
    sink.discard_on_interrupt(reporter.clone());
    let workers = Workers::new(common.jobs)?;
    let progress = Progress::of_records(program, common, || source.total());
    let mut rows = Rows::default();
    let mut exit = Exit::Done;
    loop {
        let batch = source.next_batch(BATCH_LINES)?;
        for lost in source.lost() {
            reporter.warning(&lost);
            exit = Exit::Lost;
        }
        if batch.is_empty() {
            break;
        }
        let outcomes = workers.map(&batch, |item| {
            let outcome = work(item);
            progress.add(1);
            outcome
        });
        let failed = outcomes.iter().position(|o| o.error.is_some()).filter(|_| !common.keep_going);
        let written = &outcomes[..failed.unwrap_or(outcomes.len())];
        sink.write(&joined(written, &mut rows))?;
        if report(&outcomes[..failed.map_or(outcomes.len(), |at| at + 1)], &reporter) {
            exit = Exit::Lost;
        }
        if failed.is_some() {
            sink.discard();
            return Err(Failure::Failed("stopped at the first record that failed; --keep-going goes on".to_string()));
        }
    }
    sink.finish()?;
    Ok(exit)
}

fn joined(outcomes: &[Outcome], rows: &mut Rows) -> Vec<u8> {
    let mut bytes = Vec::new();
    for output in outcomes.iter().filter_map(|o| o.output.as_ref()) {
        match output {
            Output::Text(text) => bytes.extend_from_slice(text.as_bytes()),
            Output::Row(row) => bytes.extend_from_slice(rows.lines(row).as_bytes()),
        }
        bytes.push(b'\n');
    }
    bytes
}

/// Says what went wrong; true when anything did.
fn report(outcomes: &[Outcome], reporter: &Reporter) -> bool {
    for outcome in outcomes {
        if let Some(told) = &outcome.told {
            reporter.tell(told);
        }
        if let Some(error) = &outcome.error {
            reporter.error(error);
        }
        if let Some(warning) = &outcome.warning {
            reporter.warning(warning);
        }
    }
    outcomes.iter().any(|o| o.error.is_some() || o.warning.is_some())
}

fn process(line: &Line, intake: Intake, style: Style, stage: &dyn Stage) -> Outcome {
    let mut outcome = Outcome::default();
    match record_of(line, intake) {
        Ok(None) => {}
        Ok(Some(record)) => finish(line, record, style, stage, &|record| stage.run(record), &mut outcome),
        Err(error) => outcome.error = Some(error),
    }
    outcome
}

/// The record on a line; none on a blank one.
///
/// # Errors
/// When the line is no JSON object, with the column.
pub fn record_of(line: &Line, intake: Intake) -> Result<Option<Record<'_>>, Diagnostic> {
    if let Some((offset, message)) = foreign(&line.bytes, line.number == 1) {
        return Err(Diagnostic::at(line, offset, None, message));
    }
    let text = std::str::from_utf8(&line.bytes).map_err(|error| {
        let message = "this byte is not UTF-8; convert the file, for example with iconv";
        Diagnostic::at(line, error.valid_up_to(), None, message)
    })?;
    if text.trim().is_empty() { Ok(None) } else { parse(line, text, intake).map(Some) }
}

fn parse<'line>(line: &Line, text: &'line str, intake: Intake) -> Result<Record<'line>, Diagnostic> {
    let looks_like_json = text.trim_start().starts_with(['{', '[']);
    if !looks_like_json && intake == Intake::RecordsOrText {
        if let Some(column) = heading_of_text(text).filter(|_| line.number == 1) {
            let message =
                format!("this reads like the heading of a table; its descriptions are read by --csv '{column}'");
            return Err(Diagnostic::at(line, 0, None, message));
        }
        return Ok(Record::from_text(&line.ordinal.to_string(), text.trim()).at(line.ordinal));
    }
    Record::parse(text).map(|record| record.at(line.ordinal)).map_err(|error| {
        let mut message = crate::record::message_without_position(&error);
        if error.is_eof() && !line.terminated {
            message.push_str("; the input ends in the middle of this record");
        } else if !looks_like_json {
            let mend = if let Intake::Own(mend) = intake { mend } else { "pipe plain text through `chunk` first" };
            message = format!("not a JSON object; {mend}");
        }
        Diagnostic::at(line, error.column().saturating_sub(1), None, message)
    })
}

/// What columns of descriptions are called.
const TEXT_COLUMNS: [&str; 8] =
    ["text", "sentence", "description", "utterance", "instruction", "command", "transcript", "transcription"];

/// The column of descriptions, when a line looks like the heading of a table: names without spaces beside the commas.
fn heading_of_text(line: &str) -> Option<&str> {
    let names: Vec<&str> = line.trim().split([',', ';', '\t']).map(|name| name.trim_matches('"')).collect();
    let is_name = |name: &&str| !name.is_empty() && !name.contains(|c: char| c.is_whitespace());
    let is_heading = names.len() > 1 && names.iter().all(is_name);
    let describes = |name: &&&str| TEXT_COLUMNS.contains(&name.to_lowercase().as_str());
    names.iter().find(describes).copied().filter(|_| is_heading)
}

/// Does the stage's work on a record and writes it down.
pub(super) fn finish(
    line: &Line,
    mut record: Record,
    style: Style,
    stage: &dyn Stage,
    run: &dyn Fn(&mut Record) -> Result<Note, StageError>,
    outcome: &mut Outcome,
) {
    let id = record.id();
    let result = catch_unwind(AssertUnwindSafe(|| run(&mut record)))
        .unwrap_or_else(|_| Err(StageError::new("internal error, please report it with this record")));
    let output = match (&result, style.format) {
        (Ok(_), Format::Text) => for_people(stage, &record, style),
        (Ok(_), Format::Csv) => stage.row(&record).transpose().map(|row| row.map(Output::Row)),
        (Err(_), Format::Text | Format::Csv) => Ok(None),
        (_, Format::Json) => serde_json::to_string(&record)
            .map(|line| Some(Output::Text(line)))
            .map_err(|error| StageError::new(error.to_string())),
    };
    if style.tells && !stage.narrates() && result.is_ok() {
        outcome.told = stage.text(&record).ok().filter(|text| !text.is_empty());
    }
    let at = |error: &StageError| Diagnostic::at(line, error.offset.unwrap_or(0), id.clone(), error.message.clone());
    match result {
        Err(error) => outcome.error = Some(at(&error)),
        Ok(Note::Lossy(what)) => outcome.warning = Some(Diagnostic::at(line, 0, id.clone(), what)),
        Ok(Note::Done) => {}
    }
    match output {
        Ok(output) => outcome.output = output,
        Err(error) => outcome.error = Some(at(&error)),
    }
}

/// The record as text, unless there is none; coloured where that is wanted.
fn for_people(stage: &dyn Stage, record: &Record, style: Style) -> Result<Option<Output>, StageError> {
    let text = for_terminal(&stage.text(record)?).into_owned();
    let is_said = record.raw("text").is_some();
    let shade = |number, line: &str| if number == 0 && is_said { Shade::Said } else { stage.shade(line) };
    let text = if style.color { painted(&text, shade) } else { text };
    Ok((!text.is_empty()).then_some(Output::Text(text)))
}

/// Threads, started when there is more than one line to work on.
struct Workers {
    pool: Option<rayon::ThreadPool>,
}

impl Workers {
    fn new(jobs: usize) -> Result<Self, Failure> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let jobs = if jobs == 0 { cores } else { jobs };
        if jobs == 1 {
            return Ok(Self { pool: None });
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
        pool.map(|pool| Self { pool: Some(pool) })
            .map_err(|e| Failure::Failed(format!("cannot start {jobs} threads: {e}")))
    }

    fn map<T: Sync, O: Send>(&self, items: &[T], work: impl Fn(&T) -> O + Sync) -> Vec<O> {
        match &self.pool {
            Some(pool) if items.len() > 1 => pool.install(|| items.par_iter().map(&work).collect()),
            _ => items.iter().map(work).collect(),
        }
    }
}
