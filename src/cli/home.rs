//! Which home a robot is simulated in, spelt alike wherever one is.

use std::path::PathBuf;

use super::Failure;
use crate::trial::Home;

/// The simulated home.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct HomeArguments {
    /// The simulated home: a scene file, or a shipped home by its name (studio, flat, …) [default: apartment]
    #[arg(long, value_name = "WORLD", visible_alias = "scene")]
    pub world: Option<PathBuf>,
    /// Room map, where the scene file does not lead to it
    #[arg(long, value_name = "MAP", requires = "world")]
    pub map: Option<PathBuf>,
}

impl HomeArguments {
    /// The home they name; the apartment where they name none.
    pub fn load(&self) -> Result<Home, Failure> {
        Home::load(self.map.as_deref(), self.world.as_deref()).map_err(|error| Failure::Failed(error.to_string()))
    }
}
