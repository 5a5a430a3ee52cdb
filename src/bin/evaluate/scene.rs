//! `evaluate scene`: one made scene, to be driven in or looked at.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::simulation::Dice;
use spatial_fetch::simulation::Home;
use spatial_fetch::simulation::arrange::{Relations, new_home, rearranged};
use spatial_fetch::simulation::world_json;

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Place the furniture elsewhere, so that what words tell of it still holds
    #[arg(long, group = "what")]
    keep: bool,
    /// Place the furniture elsewhere, so that it no longer holds
    #[arg(long, group = "what")]
    r#break: bool,
    /// Make a whole new furnished home
    #[arg(long, group = "what")]
    new: bool,
    /// The home whose furniture is placed anew: a scene file, or a shipped home by its name [default: apartment]
    #[arg(long, value_name = "WORLD", conflicts_with = "new")]
    world: Option<PathBuf>,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let mut dice = Dice::new(common.seed, 0);
        let home = if self.new { self.new_home(common, &mut dice) } else { self.rearranged(common, &mut dice) }?;
        cli::write_text(common, &world_json(&home.map, &home.scene))?;
        Ok(Exit::Done)
    }
}

impl Arguments {
    fn new_home(&self, common: &Common, dice: &mut Dice) -> Result<Home, Failure> {
        let made = new_home(&format!("home-{}", common.seed), dice);
        let (map, scene) = made.ok_or_else(|| none("no home that leaves the robot a way was found"))?;
        Ok(Home::new(map, scene))
    }

    fn rearranged(&self, common: &Common, dice: &mut Dice) -> Result<Home, Failure> {
        let home = Home::load(None, self.world.as_deref()).map_err(|error| Failure::Failed(error.to_string()))?;
        let relations = if self.r#break { Relations::Broken } else { Relations::Kept };
        let scene = rearranged(&home.map, &home.scene, relations, dice);
        let mut scene = scene.ok_or_else(|| none("no placement that leaves the robot a way was found"))?;
        let kind = if self.r#break { "broken" } else { "kept" };
        scene.name = format!("{}-{kind}-{}", home.scene.name, common.seed);
        Ok(Home::new(home.map, scene))
    }
}

fn none(what: &str) -> Failure {
    Failure::Failed(format!("{what}; try another --seed, or take a piece out of the scene"))
}
