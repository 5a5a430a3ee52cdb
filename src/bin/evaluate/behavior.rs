//! `evaluate behavior`: the paper's Experiments 2 and 3.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, Failure, Format, Progress};
use spatial_fetch::evaluation::behavior::{
    BehaviorReport, Condition, ConditionReport, Fall, Selection, Source, behavior_tables, drive_all, explain,
    instructions,
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
        let said = instructions(&gold, &homes[0].1.map, self.instructions, self.select);
        if said.is_empty() {
            return Err(Failure::Failed("no description says what it means; --gold needs labels".to_string()));
        }
        let conditions = self.conditions(&homes);
        let settings =
            Settings { perception: self.perception, noise: self.noise, seed: self.common.seed, ..Settings::default() };
        let progress = Progress::new(&self.common, Some(self.seeds * (said.len() * conditions.len()) as u64));
        let progress = std::sync::Mutex::new(progress);
        let done = || progress.lock().map(|mut progress| progress.add(1)).unwrap_or_default();
        let mut report = BehaviorReport {
            instructions: said.len(),
            source: self.source(),
            seeds: self.seeds,
            conditions: Vec::new(),
            fall: None,
            explanations: Vec::new(),
        };
        let mut placements = Vec::new();
        for (i, condition) in conditions.iter().enumerate() {
            let scores =
                cli::on_threads(self.common.jobs, || drive_all(&said, condition, &settings, self.seeds, &done))?;
            report.conditions.push(ConditionReport::new(&condition.name, &said, &scores));
            if i < homes.len() {
                if self.explain {
                    report.explanations.extend(explain(&condition.name, condition.home, &said, &scores));
                }
                placements.push(scores);
            }
        }
        if let [first, second] = placements.as_slice() {
            report.fall = Fall::between(first, second);
        }
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

    /// Each placement, then blind, then what `--ablations` adds, in the first.
    fn conditions<'h>(&self, homes: &'h [(&'static str, Home)]) -> Vec<Condition<'h>> {
        let usual = Options::default();
        let placements = homes.iter().map(|(name, home)| Condition { name: (*name).to_string(), home, options: usual });
        let blind = ("blind: nearest table first", Options { blind: true, ..usual });
        let ablations = [
            ("first pair only", Options { first_pair_only: true, ..usual }),
            ("one frame only", Options { one_frame: true, ..usual }),
            ("no fall-back", Options { no_fallback: true, ..usual }),
            ("no localization", Options { no_localization: true, ..usual }),
            ("no glance", Options { no_glance: true, ..usual }),
        ];
        let shown = if self.ablations { ablations.len() } else { 0 };
        let others = [blind].into_iter().chain(ablations.into_iter().take(shown));
        let others = others.map(|(name, options)| Condition { name: name.to_string(), home: &homes[0].1, options });
        placements.chain(others).collect()
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
