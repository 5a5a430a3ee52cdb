//! `evaluate behavior`: the paper's Experiments 2 and 3.

use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Format, Progress};
use spatial_fetch::evaluation::behavior::{
    BehaviorReport, Selection, Source, Study, behavior_tables, conditions, instructions,
};
use spatial_fetch::trial::{Home, NoiseLevel, Perception, Settings};
use spatial_fetch::world::Scene;

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects [default: the apartment as first furnished, then with its furniture moved]
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Where the instructions come from
    #[arg(long, value_enum, default_value = "gold")]
    instructions: Source,
    /// Which of them
    #[arg(long, value_enum, default_value = "all")]
    select: Selection,
    /// Trials of each instruction, each with its own errors of odometry, sonar and start pose
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..))]
    seeds: u64,
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    perception: Perception,
    /// How imperfect the robot's wheels, sonars, compass and start are
    #[arg(long, value_enum, default_value = "default")]
    noise: NoiseLevel,
    /// Also drive without each part of the executive, to tell what it is worth
    #[arg(long)]
    ablations: bool,
    /// Say of each instruction whose first furniture was wrong whether the words allow it
    #[arg(long)]
    explain: bool,
    #[command(flatten)]
    pub common: Common,
}

impl Arguments {
    pub fn run(self) -> Result<Exit, Failure> {
        let gold = cli::load_gold(self.gold.as_deref())?;
        let homes = self.homes()?;
        let instructions = instructions(&gold, &homes[0].1.map, self.instructions, self.select);
        if instructions.is_empty() {
            return Err(Failure::Failed("no description says what it means; --gold needs labels".to_string()));
        }
        let seed = self.common.seed;
        let study = Study {
            instructions,
            conditions: conditions(&homes, self.ablations),
            placements: homes.len(),
            settings: Settings { perception: self.perception, noise: self.noise, seed, ..Settings::default() },
            seeds: self.seeds,
            explained: self.explain,
        };
        let progress = Mutex::new(Progress::new(&self.common, Some(study.trials())));
        let done = || progress.lock().map(|mut progress| progress.add(1)).unwrap_or_default();
        let report = cli::on_threads(self.common.jobs, || study.run(&self.source(), &done))?;
        drop(progress);
        self.write(&report)
    }

    fn homes(&self) -> Result<Vec<(&'static str, Home)>, Failure> {
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
        if self.scene.is_some() {
            return Ok(vec![("furniture of --scene", home)]);
        }
        let moved = Home { scene: Scene::apartment_modified(), ..home.clone() };
        Ok(vec![("Table II: as first furnished", home), ("Table III: furniture moved", moved)])
    }

    fn source(&self) -> String {
        let source = match self.instructions {
            Source::Gold => "gold",
            Source::Text => "from their text",
        };
        let select = match self.select {
            Selection::All => "",
            Selection::Unique => ", each once",
            Selection::UniquePlaces => ", each once, bare targets aside",
        };
        format!("{source}{select}")
    }

    fn write(&self, report: &BehaviorReport) -> Result<Exit, Failure> {
        let text = match self.common.format {
            Format::Text => behavior_tables(report),
            Format::Json => serde_json::to_string(report).map_err(|e| Failure::Failed(e.to_string()))?,
        };
        let sink = cli::open_output(&self.common)?;
        sink.write(format!("{text}\n").as_bytes())?;
        sink.finish()?;
        Ok(Exit::Done)
    }
}
