//! What a trial leaves beside its record: a plot, a picture, a log.

use std::path::{Path, PathBuf};

use super::{Home, Run};
use crate::behavior::{Furniture, Watcher};
use crate::drawing::{Outline, Plot};
use crate::geometry::Pose;
use crate::recording::{Piece, TrialLog};
use crate::world::camera::{Camera, SolidScene, render};

/// Where the files go; `{id}` in a name stands for the record's id.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// The way through the rooms, SVG.
    pub plot: Option<PathBuf>,
    /// Folder for what the camera shows at the end, `ID.png`.
    pub picture: Option<PathBuf>,
    /// Log of the trial, MCAP.
    pub record: Option<PathBuf>,
    /// Overwrite files that exist.
    pub force: bool,
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

    /// What the robot's camera shows at the end of a trial, PNG.
    pub fn take_picture(home: &Home, run: &Run) -> Vec<u8> {
        render(&SolidScene::new(&home.map, &home.scene), &Camera::kinect(), run.final_pose).to_png()
    }
}

/// An id as a file name: what could lead out of the folder or hide the file is replaced.
pub(super) fn file_name(id: &str) -> String {
    let safe: String =
        id.chars().map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '_' }).collect();
    if safe.is_empty() { "record".to_string() } else { safe }
}

/// A watcher that writes the log.
pub(super) struct Recorder {
    log: TrialLog,
}

impl Recorder {
    pub(super) fn new(path: &Path, force: bool, home: &Home) -> Result<Self, String> {
        let mut log = TrialLog::create(path, force)?;
        log.walls(&home.map.walls(), home.map.wall_height);
        let outlines: Vec<_> = home.scene.furniture.iter().map(|item| (item, item.footprint())).collect();
        let pieces: Vec<Piece> = outlines
            .iter()
            .map(|(item, outline)| Piece {
                label: item.id.clone(),
                corners: outline.corners(),
                height: item.size().height,
            })
            .collect();
        log.truth(&pieces);
        Ok(Self { log })
    }

    pub(super) fn finish(mut self, run: &Run, picture: Vec<u8>, record: &str) -> Result<(), String> {
        let end = run.trial.duration_s.0;
        self.log.picture(end, picture);
        self.log.record(end, record);
        self.log.finish(end)
    }
}

impl Watcher for Recorder {
    fn pose(&mut self, time_s: f64, pose: Pose) {
        self.log.pose(time_s, pose);
    }

    fn said(&mut self, time_s: f64, text: &str) {
        self.log.said(time_s, text);
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        let pieces: Vec<Piece> = furniture
            .iter()
            .map(|f| Piece { label: f.label(), corners: f.footprint.corners(), height: f.detection.height })
            .collect();
        self.log.believed(time_s, &pieces);
    }
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
