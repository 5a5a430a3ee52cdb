//! The options that decide what becomes of a trial: into a recording, and out of it again.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{CommandFactory, FromArgMatches};
use spatial_fetch::cli::{Failure, Reporter, TrialOptions};
use spatial_fetch::recording::OPTIONS_TOPIC;
use spatial_fetch::recording::{LogReader, RecordReader, Window};

use crate::Arguments;

impl Arguments {
    /// The options of this run that decide a simulated trial.
    pub fn trial_options(&self) -> TrialOptions {
        let home = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
        TrialOptions {
            world: home(&self.home.world),
            map: home(&self.home.map),
            noise: self.noise.unwrap_or_default(),
            dead_time: self.dead_time,
            jitter: self.jitter,
            perception: self.eyes.perception,
            depth_noise: self.eyes.depth_noise,
            depth_loss: self.eyes.depth_loss,
            light: self.eyes.light,
            blind: self.executive.blind,
            one_frame: self.executive.one_frame,
            first_pair_only: self.executive.first_pair_only,
            no_fallback: self.executive.no_fallback,
            no_glance: self.executive.no_glance,
            no_localization: self.executive.no_localization,
            time_limit: self.executive.time_limit,
            seed: self.common.seed,
        }
    }

    /// Each field by its name, so that none can be forgotten.
    fn take(&mut self, options: TrialOptions) {
        let (world, map, noise);
        let (eyes, executive) = (&mut self.eyes, &mut self.executive);
        TrialOptions {
            world,
            map,
            noise,
            dead_time: self.dead_time,
            jitter: self.jitter,
            perception: eyes.perception,
            depth_noise: eyes.depth_noise,
            depth_loss: eyes.depth_loss,
            light: eyes.light,
            blind: executive.blind,
            one_frame: executive.one_frame,
            first_pair_only: executive.first_pair_only,
            no_fallback: executive.no_fallback,
            no_glance: executive.no_glance,
            no_localization: executive.no_localization,
            time_limit: executive.time_limit,
            seed: self.common.seed,
        } = options;
        (self.home.world, self.home.map) = (world.map(PathBuf::from), map.map(PathBuf::from));
        self.noise = Some(noise);
    }

    /// With the options that the log says, where none were given.
    pub fn with_options_of(mut self, log: &Path, reporter: &Reporter) -> Result<Self, Failure> {
        let Some(line) = recorded_line(log)? else { return Ok(self) };
        let failed = |what: &dyn std::fmt::Display| Failure::Failed(format!("{}: {what}", log.display()));
        let parse = |words: Vec<std::ffi::OsString>| {
            Self::command().try_get_matches_from(words).map_err(|error| Failure::Usage(error.to_string()))
        };
        let given = parse(std::env::args_os().collect())?;
        let usual = Self::from_arg_matches(&parse(vec!["drive".into()])?);
        let usual = usual.map_err(|error| Failure::Usage(error.to_string()))?.trial_options();
        let is_given = |name: &str| given.value_source(name) == Some(ValueSource::CommandLine);
        let replayed = self.trial_options().replaying(&line, &usual, is_given).map_err(|error| failed(&error))?;
        replayed.remarks.iter().for_each(|remark| reporter.remark(remark));
        self.take(replayed.options);
        Ok(self)
    }
}

/// The options in a log, as far as it can be read.
fn recorded_line(log: &Path) -> Result<Option<Vec<u8>>, Failure> {
    let file = File::open(log).map_err(|error| Failure::Failed(format!("{}: {error}", log.display())))?;
    let log = LogReader::new(BufReader::new(file), &log.display().to_string(), false);
    let log = log.map_err(|error| Failure::Failed(error.to_string()))?;
    Ok(RecordReader::new(log, OPTIONS_TOPIC, Window::default()).find_map(Result::ok))
}
