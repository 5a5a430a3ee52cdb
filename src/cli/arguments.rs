//! The options that all seven binaries spell alike.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use clap_complete::Shell;

/// Options shared by all binaries.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Common {
    /// Input files; `-` or none reads standard input
    #[arg(value_name = "FILE", help_heading = "Input")]
    pub files: Vec<PathBuf>,

    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Common options")]
    pub output: Option<PathBuf>,

    /// Overwrite files that exist
    #[arg(long, help_heading = "Common options")]
    pub force: bool,

    /// Records worked on at a time; 0 uses every core. The output is the same for any number
    #[arg(short, long, value_name = "N", default_value_t = 0, help_heading = "Common options")]
    pub jobs: usize,

    /// Report records that fail and go on; exit 3 when there was one
    #[arg(long, help_heading = "Common options")]
    pub keep_going: bool,

    /// What to write: JSON lines for programs, text for people, rows for tables
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t, help_heading = "Common options")]
    pub format: Format,

    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 0, help_heading = "Common options")]
    pub seed: u64,

    /// No progress and no remarks; errors are still reported
    #[arg(short, long, help_heading = "Common options")]
    pub quiet: bool,

    /// Tell on standard error, in words, what is made of each record; given twice, with the figures behind it
    #[arg(short, long, action = clap::ArgAction::Count, help_heading = "Common options")]
    pub verbose: u8,

    /// Colour in messages and text; NO_COLOR is respected
    #[arg(long, value_enum, value_name = "WHEN", default_value_t, help_heading = "Common options")]
    pub color: ColorChoice,

    /// Print the JSON Schema of what this program adds, and end
    #[arg(long, help_heading = "Common options")]
    pub schema: bool,

    /// Print a completion script for this shell, and end
    #[arg(long, value_enum, value_name = "SHELL", help_heading = "Common options")]
    pub completions: Option<Shell>,
}

/// What a binary writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// One JSON object a line.
    #[default]
    Json,
    /// For people.
    Text,
    /// A row for each record under a heading, for R, pandas and spreadsheets: of `drive`, and of `evaluate score`.
    Csv,
}

/// When to colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ColorChoice {
    /// On a terminal.
    #[default]
    Auto,
    /// Even into a file or pipe.
    Always,
    /// Not at all.
    Never,
}

impl Common {
    /// How records are written under these options.
    pub(super) fn style(&self) -> Style {
        let to_terminal = self.output.is_none() && io::stdout().is_terminal();
        Style {
            format: self.format,
            color: self.format == Format::Text && self.color.holds(to_terminal),
            tells: self.verbose > 0 && !self.quiet && self.format == Format::Json,
        }
    }
}

/// How a record is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// In which form.
    pub format: Format,
    /// Whether text is coloured.
    pub color: bool,
    /// Whether what a record has come to is told on standard error as well.
    pub tells: bool,
}

impl ColorChoice {
    /// Whether to colour what goes to a terminal, or elsewhere.
    pub(super) fn holds(self, to_terminal: bool) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => to_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        }
    }
}
