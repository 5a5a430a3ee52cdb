//! `evaluate what-if`: the smallest changes of words and furniture that change the outcome.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::evaluation::{what_if, what_if_text};
use spatial_fetch::trial::{Home, Settings};

#[derive(Args)]
pub struct Arguments {
    /// The description
    #[arg(long, value_name = "SENTENCE")]
    text: Option<String>,
    /// The description of this id in the files or on standard input
    #[arg(long, value_name = "ID", conflicts_with = "text")]
    id: Option<String>,
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects of the simulated home
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Shift this piece of furniture only; may be given several times
    #[arg(long, value_name = "ID")]
    piece: Vec<String>,
    #[command(flatten)]
    pub common: Common,
}

impl Arguments {
    /// Whether the description comes from standard input.
    pub fn reads_standard_input(&self) -> bool {
        self.text.is_none() && self.common.files.is_empty()
    }

    pub fn run(self) -> Result<Exit, Failure> {
        let (id, text) = match &self.text {
            Some(text) => ("1".to_string(), text.clone()),
            None => cli::find_description(&self.common.files, self.id.as_deref())?,
        };
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
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
