//! What a trial leaves beside its record: a plot, a picture, a log; and who may look on.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::live::Live;
use super::narrator::{Narration, Narrator};
use super::story::{Stories, Story, Told};
use crate::behavior::Run;
use crate::drawing::{Outline, Plot};
use crate::files::{Claims, FileError, refuse_unwritable, write_file};
use crate::geometry::Vec2;
use crate::map::RoomMap;
use crate::record::Record;

/// A piece of furniture that truly stands in the home, to be shown beside what the robot believes.
#[derive(Clone, Debug)]
pub struct TruePiece {
    /// Its name in the scene.
    pub id: String,
    /// What it is.
    pub noun: String,
    /// Corners on the floor, counter-clockwise, metres.
    pub corners: Vec<Vec2>,
    /// Metres.
    pub height: f64,
    /// Where its front points, radians, where it has one.
    pub front: Option<f64>,
    /// The small things on it: what they are, and where they lie.
    pub holds: Vec<(String, Vec2)>,
}

impl TruePiece {
    /// Its name in words: "hexagon table 1".
    pub fn spoken(&self) -> String {
        spoken(&self.id)
    }
}

/// A name of a scene in words: "hexagon-table-1" is "hexagon table 1".
pub fn spoken(id: &str) -> String {
    id.replace(['-', '_'], " ")
}

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
    /// Which files belong to which record of this run.
    pub claims: Claims,
    /// How the trial is run, for the log: a JSON line, or nothing.
    pub options: String,
    /// Who is told what the robot does, while it does it.
    pub narration: Option<Narration>,
    /// Where trials are kept to be shown.
    pub stories: Option<Arc<Stories>>,
}

impl Outputs {
    /// One who tells of a trial, where that is wanted.
    pub fn narrator(&self, id: &str, record: &Record) -> Option<Narrator> {
        self.narration.as_ref().map(|narration| Narrator::begin(narration, id, record))
    }

    /// One who keeps what happens, where that is wanted.
    pub fn story(&self) -> Option<Story> {
        self.stories.as_ref().map(|_| Story::default())
    }

    /// Keeps a trial to be shown.
    pub fn tell(&self, told: Told) {
        self.stories.iter().for_each(|stories| stories.tell(told.clone()));
    }

    /// The path with the record's name in it.
    pub(super) fn named(path: &Path, name: &str) -> PathBuf {
        PathBuf::from(path.to_string_lossy().replace("{id}", name))
    }

    /// Draws the way of a trial through the rooms, past what truly stands there where that is known.
    pub fn draw_plot(map: &RoomMap, truth: &[TruePiece], run: &Run, title: &str) -> String {
        let found = run.trial.target_id.as_deref();
        let visits = |id: &str| {
            let approached = run.trial.approached.iter().enumerate();
            approached.filter(|(_, other)| *other == id).map(|(i, _)| i + 1).collect()
        };
        let furniture = truth.iter().map(|piece| Outline {
            label: piece.spoken(),
            corners: piece.corners.clone(),
            found: found == Some(piece.id.as_str()),
            front: piece.front,
            visits: visits(&piece.id),
        });
        let things = truth.iter().flat_map(|piece| &piece.holds);
        let sought = things.filter(|(name, _)| run.sought.as_ref() == Some(name)).cloned();
        let plot = Plot {
            title: title.to_string(),
            caption: format!(
                "{}: {} – {:.1} m in {:.0} s",
                run.trial.outcome.phrase(),
                run.trial.why,
                run.trial.distance_m.0,
                run.trial.duration_s.0
            ),
            rooms: map.rooms.iter().map(|room| (room.name.clone(), room.polygon().centroid())).collect(),
            walls: map.walls(),
            furniture: furniture.collect(),
            path: run.trial.path.iter().map(|point| point.pose()).collect(),
            found_at: run.found_at,
            sought: sought.collect(),
        };
        plot.to_svg()
    }

    /// Looks, before anything moves, whether what this record is to leave can be written, and claims it.
    ///
    /// # Errors
    /// When a file stands there already and nothing forces, another record of this run has it, or its folder takes none.
    pub fn prepare(&self, name: &str, id: &str) -> Result<(), FileError> {
        if let Some(folder) = &self.picture {
            std::fs::create_dir_all(folder).map_err(|e| FileError::System(folder.display().to_string(), e))?;
        }
        for path in [&self.plot, &self.record].into_iter().flatten() {
            self.claims.claim(&Self::named(path, name), id)?;
        }
        let written = self.plot.as_deref().map(|path| Self::named(path, name));
        let picture = self.picture.as_deref().map(|folder| folder.join(format!("{name}.png")));
        if let Some(path) = &picture {
            self.claims.claim(path, id)?;
        }
        written.iter().chain(&picture).try_for_each(|path| refuse_unwritable(path, self.force))
    }

    /// Writes the plot and the last picture, where they are wanted; says what could not be written. The trial has
    /// been driven by now, and is worth more than they are.
    pub fn leave(
        &self,
        (map, truth): (&RoomMap, &[TruePiece]),
        run: &mut Run,
        png: Option<&[u8]>,
        record: &Record,
        name: &str,
    ) -> Vec<String> {
        let mut lost = Vec::new();
        if let Some(path) = &self.plot {
            let title: String = record.get("text").ok().flatten().unwrap_or_default();
            let svg = Self::draw_plot(map, truth, run, &title);
            let written = write_file(&Self::named(path, name), svg.as_bytes(), self.force);
            lost.extend(written.err().map(|error| error.to_string()));
        }
        if let (Some(folder), Some(png)) = (&self.picture, png) {
            let picture = format!("{name}.png");
            match write_file(&folder.join(&picture), png, self.force) {
                Ok(()) => run.trial.picture = Some(picture),
                Err(error) => lost.push(error.to_string()),
            }
        }
        lost
    }
}
