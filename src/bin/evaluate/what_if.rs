//! `evaluate what-if`: the smallest changes of words and furniture that change the outcome.

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, HomeArguments};
use spatial_fetch::evaluation::{what_if, what_if_text};
use spatial_fetch::trial::Settings;

use crate::Command;

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
    #[command(flatten)]
    common: Common,
}

impl Command for Arguments {
    fn common(&self) -> &Common {
        &self.common
    }

    fn reads_standard_input(&self) -> bool {
        self.text.is_none()
    }

    fn run(&self) -> Result<Exit, Failure> {
        let (id, text) = match &self.text {
            Some(text) => ("1".to_string(), text.clone()),
            None => cli::find_description(&self.common.files, self.id.as_deref())?,
        };
        let home = self.home.load()?;
        if let Some(unknown) = self.piece.iter().find(|id| home.scene.item(id).is_none()) {
            let ids: Vec<&str> = home.scene.furniture.iter().map(|item| item.id.as_str()).collect();
            return Err(Failure::Usage(format!("--piece: no {unknown:?} here; there are {}", ids.join(", "))));
        }
        let settings = Settings { seed: self.common.seed, ..Settings::default() };
        let found = cli::on_threads(self.common.jobs, || what_if(&id, &text, &home, &settings, &self.piece))?;
        cli::write_report(&self.common, &found, || what_if_text(&found))?;
        Ok(Exit::Done)
    }
}
