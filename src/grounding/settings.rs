//! The options of `ground`, and the grounder they ask for.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::paper::{Distance, Factors, LabelledTree, Model, Options};
use super::{Grounder, Method};
use crate::language::lexicon_with;
use crate::record::Record;

/// How to ground.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Settings {
    /// How chunks get their meaning
    #[arg(long, value_enum, default_value_t)]
    pub method: MethodName,

    /// Factors of the published product (--method paper); a model's own when not given
    #[arg(long, value_enum, value_name = "WHICH")]
    pub factors: Option<Factors>,

    /// Weights of words in the distance (--method paper); a model's own when not given
    #[arg(long, value_enum, value_name = "WHICH")]
    pub distance: Option<Distance>,

    /// Model to use with --method paper, instead of the shipped one
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Learn from labelled records and write the model to --output; grounds nothing
    #[arg(long, value_name = "FILE")]
    pub train: Option<PathBuf>,

    /// Nouns to add to the lexicon: lines of name, class, other names, separated by tabs
    #[arg(long, value_name = "FILE")]
    pub lexicon: Option<PathBuf>,

    /// The reply to the question of an earlier run
    #[arg(long, value_name = "TEXT")]
    pub answer: Option<String>,

    /// Leave out other readings and reasons
    #[arg(long)]
    pub brief: bool,
}

/// How chunks get their meaning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum MethodName {
    /// From what the words mean.
    #[default]
    Composed,
    /// From the nearest labelled example, by the published equations.
    Paper,
}

/// Settings that cannot be met: `FILE:LINE: message`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct SettingsError(pub String);

impl Settings {
    /// The grounder these settings ask for.
    ///
    /// # Errors
    /// When a model, lexicon or training file cannot be read.
    pub fn grounder(&self) -> Result<Grounder, SettingsError> {
        let method = match self.method {
            MethodName::Composed => Method::Composed,
            MethodName::Paper => Method::Paper(Arc::new(self.paper_model()?)),
        };
        match &self.lexicon {
            None => Ok(Grounder::new(method, self.brief)),
            Some(path) => Ok(Grounder::with_lexicon(
                method,
                self.brief,
                Arc::new(lexicon_with(path).map_err(|e| SettingsError(e.to_string()))?),
            )),
        }
    }

    /// The model that `--train` asks for, as JSON.
    ///
    /// # Errors
    /// When the training file cannot be read, or a line of it is no labelled tree.
    pub fn trained(&self) -> Result<Option<String>, SettingsError> {
        let Some(path) = &self.train else { return Ok(None) };
        let trees = read_trees(path)?;
        let json = Model::train(&trees, self.options(Options::default())).to_json();
        json.map(Some).map_err(|error| SettingsError(error.to_string()))
    }

    fn options(&self, default: Options) -> Options {
        Options {
            factors: self.factors.unwrap_or(default.factors),
            distance: self.distance.unwrap_or(default.distance),
        }
    }

    fn paper_model(&self) -> Result<Model, SettingsError> {
        let Some(path) = &self.model else { return Ok(Model::embedded(self.options(Options::default()))) };
        let model = Model::from_json(&read(path)?);
        let model = model.map_err(|error| SettingsError(format!("{}: {error}", path.display())))?;
        let options = self.options(model.options());
        Ok(model.with_options(options))
    }
}

fn read(path: &Path) -> Result<String, SettingsError> {
    std::fs::read_to_string(path).map_err(|error| SettingsError(format!("{}: {error}", path.display())))
}

fn read_trees(path: &Path) -> Result<Vec<LabelledTree>, SettingsError> {
    let text = read(path)?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(number, line)| {
            let wrong = |what: String| SettingsError(format!("{}:{}: {what}", path.display(), number + 1));
            let record = Record::parse(line).map_err(|error| wrong(error.to_string()))?;
            LabelledTree::from_record(&record).map_err(|error| wrong(error.to_string()))
        })
        .collect()
}
