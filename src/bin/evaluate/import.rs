//! `evaluate import`: the authors' public files into JSON lines.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Reporter};
use spatial_fetch::evaluation::import;

use crate::Subcommand;

/// FILE is a treebank in XML with `S` or `Note` items. What was odd about the files is told on standard error.
#[derive(Args)]
pub struct Arguments {
    /// Sheet (.xlsx) that labels the chunks, a row each
    #[arg(long, value_name = "FILE")]
    groundings: Option<PathBuf>,
    /// What the ids of the descriptions begin with
    #[arg(long, value_name = "WORD", default_value = "s")]
    prefix: String,
}

impl Subcommand for Arguments {
    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let [treebank] = common.files.as_slice() else {
            return Err(Failure::Usage("name one treebank file, as in `evaluate import treebank.xml`".to_string()));
        };
        let imported = import(treebank, self.groundings.as_deref(), &self.prefix);
        let imported = imported.map_err(|error| Failure::Failed(error.to_string()))?;
        let sink = cli::open_output(common)?;
        for line in &imported.lines {
            sink.write(format!("{line}\n").as_bytes())?;
        }
        sink.finish()?;
        let lossless = imported.remarks.iter().all(|remark| remark.contains("slip of the numbering"));
        let reporter = Reporter::new("evaluate", common);
        imported.remarks.iter().for_each(|remark| reporter.remark(remark));
        Ok(if lossless { Exit::Done } else { Exit::Lost })
    }
}
