//! Which home a robot is simulated in, spelt alike wherever one is.

use std::path::PathBuf;

use super::Failure;
use crate::map::{RoomMap, WorldError, load_map};
use crate::simulation::Home;

/// The simulated home.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct HomeArguments {
    /// The simulated home: a scene file, or a shipped home by its name (studio, flat, …) [default: apartment]
    #[arg(long, value_name = "WORLD", visible_alias = "scene")]
    pub world: Option<PathBuf>,
    /// Room map, where the scene file does not lead to it
    #[arg(long, value_name = "MAP")]
    pub map: Option<PathBuf>,
}

impl HomeArguments {
    /// The home they name; the apartment where they name none.
    ///
    /// # Errors
    /// When there is no such home, or its files cannot be read or describe none.
    pub fn load(&self) -> Result<Home, Failure> {
        if self.map.is_some() && self.world.is_none() {
            return Err(Failure::Usage("--map needs the --world that stands on it".to_string()));
        }
        Home::load(self.map.as_deref(), self.world.as_deref()).map_err(failed)
    }

    /// What may be known of where a real robot is: the rooms alone.
    ///
    /// # Errors
    /// When there is no such home, or its room map cannot be read or is none.
    pub fn rooms(&self) -> Result<RoomMap, Failure> {
        self.map.as_deref().map_or_else(|| Ok(RoomMap::apartment()), load_map).map_err(failed)
    }
}

fn failed(error: WorldError) -> Failure {
    Failure::Failed(error.to_string())
}
