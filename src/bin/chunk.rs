//! Text in, tokens and chunk tree out.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use spatial_fetch::cli::{self, Common, CsvLines, Exit, Failure, FromLog, Inputs, Intake, Line, Program, Source};
use spatial_fetch::language::{Chunker, lexicon_with};
use spatial_fetch::record::{Chunk, Token};

/// Finds the phrases of a spatial description: rooms, moves, places, furniture, objects.
///
/// Reads records with "text", or plain lines of text, and adds "tokens" and "chunks".
#[derive(Parser)]
#[command(
    name = "chunk",
    version,
    after_help = "Example:\n  echo 'my mug is on the table by the chairs in the bedroom' | chunk --format text"
)]
struct Arguments {
    /// Name the rule behind each chunk
    #[arg(long)]
    explain: bool,
    /// Nouns to add to the lexicon: lines of name, class, other names, separated by tabs
    #[arg(long, value_name = "FILE")]
    lexicon: Option<PathBuf>,
    /// Read tables of comma-separated values: COLUMN holds the descriptions, the other columns are kept
    #[arg(long, value_name = "COLUMN", conflicts_with_all = ["from"])]
    csv: Option<String>,
    #[command(flatten)]
    log: FromLog,
    #[command(flatten)]
    common: Common,
}

impl Arguments {
    /// Lines, records of a log, or rows of tables.
    fn source(&self) -> Result<Box<dyn Source<Line>>, Failure> {
        if let Some(column) = &self.csv {
            return Ok(Box::new(CsvLines::new(Inputs::new(&self.common.files, self.common.keep_going), column)));
        }
        let is_table = |file: &&PathBuf| file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        if let Some(table) = self.common.files.iter().find(is_table) {
            let message =
                format!("{}: to read a table, name the column of its descriptions: --csv COLUMN", table.display());
            return Err(Failure::Usage(message));
        }
        self.log.lines(&self.common, "/fetch/input")
    }
}

/// What `chunk` adds to a record.
#[derive(schemars::JsonSchema)]
#[allow(dead_code)]
struct Chunked {
    tokens: Vec<Token>,
    chunks: Vec<Chunk>,
}

impl Program for Arguments {
    const NAME: &'static str = "chunk";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Chunked)
    }
    fn reads_standard_input(&self) -> bool {
        self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let lexicon = self.lexicon.as_deref().map(lexicon_with).transpose();
        let lexicon = lexicon.map_err(|error| Failure::Failed(error.to_string()))?.map(Arc::new);
        let chunker = Chunker { lexicon, explain: self.explain };
        let mut lines = self.source()?;
        cli::run_filter_on(Self::NAME, &self.common, lines.as_mut(), Intake::RecordsOrText, &chunker)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}
