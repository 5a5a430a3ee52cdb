//! What a trial leaves beside its record: a plot, a picture, a log; and who may look on.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::{Home, Run};
use crate::drawing::{Outline, Plot};
use crate::frame::RgbdFrame;
use crate::recording::Live;
use crate::world::camera::{Kinect, SolidScene};

/// Where the files go; `{id}` in a name stands for the record's id.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// The way through the rooms, SVG.
    pub plot: Option<PathBuf>,
    /// Folder for what the camera shows at the end, `ID.png`.
    pub picture: Option<PathBuf>,
    /// Log of the trial, MCAP.
    pub record: Option<PathBuf>,
    /// The log, to those who look on.
    pub live: Option<Arc<Live>>,
    /// A simulated trial goes on at so many times the time of day; as fast as it can where nothing is said.
    pub pace: Option<f64>,
    /// Overwrite files that exist.
    pub force: bool,
    /// How the trial is run, for the log: a JSON line, or nothing.
    pub options: String,
}

impl Outputs {
    /// The path with the record's id in it.
    pub(super) fn named(path: &Path, id: &str) -> PathBuf {
        PathBuf::from(path.to_string_lossy().replace("{id}", &file_name(id)))
    }

    /// Draws the way of a trial.
    pub fn draw_plot(home: &Home, run: &Run, title: &str) -> String {
        let found = run.trial.target_id.as_deref();
        let furniture = home.scene.furniture.iter().map(|item| Outline {
            label: item.kind().noun.replace('_', " "),
            corners: item.footprint().corners().to_vec(),
            found: found == Some(item.id.as_str()),
        });
        let plot = Plot {
            title: title.to_string(),
            caption: format!("{} – {:.1} m in {:.0} s", run.trial.why, run.trial.distance_m.0, run.trial.duration_s.0),
            rooms: home.map.rooms.iter().map(|room| (room.name.clone(), room.polygon().centroid())).collect(),
            walls: home.map.walls(),
            furniture: furniture.collect(),
            path: run.trial.path.iter().map(|point| point.pose()).collect(),
            found_at: run.found_at,
        };
        plot.to_svg()
    }

    /// What the robot's camera shows at the end of a trial.
    pub fn take_picture(home: &Home, run: &Run) -> RgbdFrame {
        let solids = SolidScene::new(&home.map, &home.scene);
        let kinect = Kinect { camera: home.camera(), ..Kinect::default() };
        kinect.capture(&solids, run.final_pose, &mut ChaCha8Rng::seed_from_u64(0)).0
    }
}

/// An id as a file name: what could lead out of the folder or hide the file is replaced.
pub(super) fn file_name(id: &str) -> String {
    let safe: String =
        id.chars().map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '_' }).collect();
    if safe.is_empty() { "record".to_string() } else { safe }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_cannot_lead_out_of_the_folder() {
        assert_eq!(file_name("../../etc/passwd"), "______etc_passwd");
        assert_eq!(file_name(""), "record");
    }
}
