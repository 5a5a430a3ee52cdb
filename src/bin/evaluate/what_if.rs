//! `evaluate what-if`: the smallest changes of words and furniture that change the outcome.

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, HomeArguments};
use spatial_fetch::evaluation::{what_if, what_if_text};
use spatial_fetch::simulation::TrialSettings;

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// The description
    #[arg(long, value_name = "SENTENCE")]
    text: Option<String>,
    /// The description of this id in the files or on standard input
    #[arg(long, value_name = "ID", conflicts_with = "text")]
    id: Option<String>,
    #[command(flatten)]
    home: HomeArguments,
    /// Shift this piece of furniture only; may be given several times
    #[arg(long, value_name = "ID")]
    piece: Vec<String>,
}

impl Subcommand for Arguments {
    fn reads(&self) -> Reads {
        if self.text.is_none() { Reads::FilesOrStandardInput } else { Reads::Files }
    }

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let (id, text) = match &self.text {
            Some(text) => ("1".to_string(), text.clone()),
            None => cli::find_description(&common.files, self.id.as_deref())?,
        };
        let home = self.home.load()?;
        if let Some(unknown) = self.piece.iter().find(|id| home.scene.item(id).is_none()) {
            let ids: Vec<&str> = home.scene.furniture.iter().map(|item| item.id.as_str()).collect();
            return Err(Failure::Usage(format!("--piece: no {unknown:?} here; there are {}", ids.join(", "))));
        }
        let settings = TrialSettings { seed: common.seed, ..TrialSettings::default() };
        let found = cli::on_threads(common.jobs, || what_if(&id, &text, &home, &settings, &self.piece))?;
        cli::write_report(common, &found, || what_if_text(&found))?;
        Ok(Exit::Done)
    }
}
