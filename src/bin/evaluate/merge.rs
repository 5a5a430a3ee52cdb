//! `evaluate merge`: the scores of the parts of a run, added up.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Table};
use spatial_fetch::evaluation::{Scores, merge_scores};

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions of the whole run: the run fails unless the parts score just as many
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::FilesOrStandardInput;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let lines = cli::read_lines(&common.files)?;
        let parse = |(i, line): (usize, &String)| -> Result<Scores, Failure> {
            let wrong = |error| Failure::Failed(format!("part {}: no scores of `evaluate score` ({error})", i + 1));
            serde_json::from_str(line).map_err(wrong)
        };
        let parts = lines.iter().enumerate().map(parse).collect::<Result<Vec<_>, _>>()?;
        let scores = merge_scores(&parts);
        if let Some(gold) = &self.gold {
            let whole = cli::load_gold(Some(gold))?.len();
            let scored = scores.all.descriptions;
            if scored != whole {
                return Err(Failure::Failed(format!("the parts score {scored} descriptions, gold has {whole}")));
            }
        }
        let title = format!("{} descriptions in {} parts", scores.all.descriptions, parts.len());
        cli::write_scores(common, &Table { title, scores })
    }
}
