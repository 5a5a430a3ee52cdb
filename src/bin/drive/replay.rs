//! The options that decide what becomes of a trial: into a recording, and out of it again.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use clap::{ArgAction, ArgMatches, CommandFactory, FromArgMatches};
use serde::{Deserialize, Serialize};
use spatial_fetch::cli::Failure;
use spatial_fetch::recording::OPTIONS_TOPIC;
use spatial_fetch::recording::{LogReader, RecordReader, Window};

use crate::Arguments;

const DECIDING: [&str; 17] = [
    "world",
    "map",
    "noise",
    "dead_time",
    "jitter",
    "perception",
    "depth_noise",
    "depth_loss",
    "light",
    "blind",
    "one_frame",
    "first_pair_only",
    "no_fallback",
    "no_glance",
    "no_localization",
    "time_limit",
    "seed",
];

/// As they stand in a recording.
#[derive(Serialize, Deserialize)]
struct Recorded {
    options: Vec<String>,
}

/// What a replay is run with, and what has to be said of it.
pub struct Replay {
    pub arguments: Arguments,
    pub remarks: Vec<String>,
}

/// The options of this run as one line, defaults included: they may change.
pub fn recorded_line() -> Result<String, Failure> {
    let given = matches(std::env::args_os())?;
    let options = values(&given).into_iter().flat_map(|(name, value)| match value.as_str() {
        "false" => vec![],
        "true" => vec![name],
        _ => vec![name, value],
    });
    // Strings always serialize.
    Ok(serde_json::to_string(&Recorded { options: options.collect() }).unwrap_or_default())
}

/// The recorded options, overridden by those of the command line; nothing when the log says none.
pub fn replay(log: &Path) -> Result<Option<Replay>, Failure> {
    let Some(recorded) = options_of(log)? else { return Ok(None) };
    let mut words = std::env::args_os();
    let program: Vec<OsString> = words.next().into_iter().collect();
    let as_recorded: Vec<OsString> = program.into_iter().chain(recorded.iter().map(OsString::from)).collect();
    let before = values(&matches(as_recorded.clone())?);
    let both = matches(as_recorded.into_iter().chain(words))?;
    let usual = values(&matches(["drive"].map(OsString::from))?);
    let shown: Vec<String> =
        before.iter().filter(|(name, value)| usual.get(*name) != Some(*value)).map(|(n, v)| option(n, v)).collect();
    let mut remarks = Vec::new();
    if !shown.is_empty() {
        remarks.push(format!("as recorded: {}", shown.join(" ")));
    }
    for (name, value) in values(&both) {
        match before.get(&name) {
            Some(was) if *was == value => {}
            Some(was) => remarks.push(format!("{} instead of {was}, as recorded", option(&name, &value))),
            None => remarks.push(format!("{}, which was not recorded", option(&name, &value))),
        }
    }
    let arguments = Arguments::from_arg_matches(&both).map_err(|error| Failure::Usage(error.to_string()))?;
    Ok(Some(Replay { arguments, remarks }))
}

fn option(name: &str, value: &str) -> String {
    if value == "true" { name.to_string() } else { format!("{name} {value}") }
}

/// The options in a log, as far as it can be read.
fn options_of(path: &Path) -> Result<Option<Vec<String>>, Failure> {
    let failed = |error: &dyn std::fmt::Display| Failure::Failed(format!("{}: {error}", path.display()));
    let file = File::open(path).map_err(|error| failed(&error))?;
    let log = LogReader::new(BufReader::new(file), &path.display().to_string(), false);
    let log = log.map_err(|error| Failure::Failed(error.to_string()))?;
    let Some(line) = RecordReader::new(log, OPTIONS_TOPIC, Window::default()).find_map(Result::ok) else {
        return Ok(None);
    };
    let recorded: Recorded = serde_json::from_slice(&line).map_err(|error| failed(&error))?;
    Ok(Some(recorded.options))
}

/// Parses words of which the later ones override the earlier.
fn matches(words: impl IntoIterator<Item = OsString>) -> Result<ArgMatches, Failure> {
    let command = Arguments::command().args_override_self(true);
    command.try_get_matches_from(words).map_err(|error| Failure::Usage(error.to_string()))
}

/// The deciding options and their values; a file by its whole path, so that it is found from elsewhere.
fn values(matches: &ArgMatches) -> BTreeMap<String, String> {
    let command = Arguments::command();
    let deciding = command.get_arguments().filter(|argument| DECIDING.contains(&argument.get_id().as_str()));
    deciding
        .filter_map(|argument| {
            let value = matches.get_raw(argument.get_id().as_str())?.next_back()?.to_string_lossy().into_owned();
            let is_file = !matches!(argument.get_action(), ArgAction::SetTrue) && Path::new(&value).is_file();
            let whole = std::path::absolute(&value).ok().filter(|_| is_file);
            let value = whole.map_or(value, |path| path.display().to_string());
            Some((format!("--{}", argument.get_long()?), value))
        })
        .collect()
}
