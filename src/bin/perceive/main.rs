//! Frames in, furniture out.

mod fuse;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, FrameInput, FromLog, Intake, Program, Reporter, within};
use spatial_fetch::files::Claims;
use spatial_fetch::limits::DETECTOR_SECONDS;
use spatial_fetch::map::load_map;
use spatial_fetch::perception::{
    CAMERA_HEIGHTS_M, CAMERA_TILTS_DEG, Detector, ExternalDetector, Model, Perceiver, Told,
};
use spatial_fetch::record::Detection;

/// Finds furniture with pose in RGB-D frames.
///
/// Reads records that name colour and depth pictures with intrinsics and camera pose, and adds "detections".
#[derive(Parser)]
#[command(
    name = "perceive",
    version,
    after_help = "Example:\n  evaluate frames --count 10 --into frames\n  perceive --format text --overlay seen frames/index.jsonl"
)]
struct Arguments {
    /// Where relative paths of pictures begin [default: the folder of the first FILE]
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Room map whose walls are no furniture; the frames' poses must be in its world
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Make one record of all frames with the same "scene" (or the same "frame" up to its last "_")
    #[arg(long)]
    fuse: bool,
    /// Draw each frame with its boxes, and the grid map beside it, into this folder
    #[arg(long, value_name = "DIR")]
    overlay: Option<PathBuf>,
    /// How high above the floor the camera is, metres, for frames that do not tell their camera's pose
    #[arg(long, value_name = "METRES", value_parser = cli::within(CAMERA_HEIGHTS_M))]
    camera_height: Option<f64>,
    /// How far down the camera looks, degrees, for frames that do not tell their camera's pose
    #[arg(long, value_name = "DEGREES", value_parser = cli::within(CAMERA_TILTS_DEG), allow_negative_numbers = true)]
    camera_tilt: Option<f64>,
    /// Leave out what is less surely furniture than this, 0 to 1; 0 gives every guess
    #[arg(long, value_name = "CONFIDENCE", default_value_t = 0.5, value_parser = cli::within(0.0..=1.0))]
    least_confidence: f64,
    /// A model that `evaluate train` made [default: the one built in]
    #[arg(long, value_name = "FILE", conflicts_with = "detector_only")]
    model: Option<PathBuf>,
    /// A command that detects too: a frame as a JSON line in, a line with "detections" or "boxes" out
    #[arg(long, value_name = "CMD")]
    detector: Option<String>,
    /// Leave all detecting to the command
    #[arg(long, requires = "detector")]
    detector_only: bool,
    /// Seconds that the command may take for one frame
    #[arg(long, value_name = "SECONDS", requires = "detector", default_value_t = DETECTOR_SECONDS.value as f64, value_parser = within(0.1..=86_400.0))]
    detector_patience: f64,
    #[command(flatten)]
    log: FromLog,
    #[command(flatten)]
    common: Common,
}

/// Frames come from a camera, never from text.
const INTAKE: Intake =
    Intake::Own("`perceive` reads a frame a line, which names its pictures and intrinsics, or a recording (--from)");

impl Arguments {
    fn perceiver(&self) -> Result<Perceiver, Failure> {
        let failed = |error: &dyn std::fmt::Display| Failure::Failed(error.to_string());
        let beside = self.common.files.first().and_then(|file| file.parent().map(PathBuf::from));
        let patience = Some(Duration::from_secs_f64(self.detector_patience));
        let external = self.detector.as_deref().map(|command| ExternalDetector::start(command, patience));
        let external = external.transpose().map_err(|error| failed(&error))?;
        if let Some(external) = &external {
            let ender = external.ender();
            cli::on_interrupt(move || ender.end());
        }
        Ok(Perceiver {
            folder: self.folder.clone().or(beside).unwrap_or_default(),
            detector: self.model.as_deref().map_or_else(|| Ok(Detector::default()), load_detector)?,
            external: external.map(Arc::new),
            external_only: self.detector_only,
            map: self.map.as_deref().map(load_map).transpose().map_err(|e| failed(&e))?,
            told: Told { height_m: self.camera_height, tilt_deg: self.camera_tilt },
            least_confidence: self.least_confidence,
            overlay: self.overlay.clone(),
            force: self.common.force,
            claims: Claims::default(),
        })
    }
}

fn load_detector(path: &Path) -> Result<Detector, Failure> {
    let bytes = std::fs::read(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    let model = Model::read(&bytes);
    let wrong = || format!("{}: not a model of this version; `evaluate train` makes one", path.display());
    model.map(Detector::new).ok_or_else(|| Failure::Failed(wrong()))
}

impl Program for Arguments {
    const NAME: &'static str = "perceive";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Vec<Detection>)
    }
    fn reads_standard_input(&self) -> bool {
        self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let (perceiver, common) = (self.perceiver()?, &self.common);
        let exit = match FrameInput::open(&common.files, &self.log, perceiver.told, common.keep_going)? {
            input if self.fuse => fuse::run(common, input, &perceiver),
            FrameInput::Lines(mut lines) => cli::run_filter_on(Self::NAME, common, &mut lines, INTAKE, &perceiver),
            FrameInput::Logs(mut logs) => {
                cli::run_frames(Self::NAME, common, logs.as_mut(), &perceiver, &|timed, record| {
                    perceiver.see(&timed.frame, timed.pose_from, record)
                })
            }
        }?;
        let Some(Err(error)) = perceiver.external.as_deref().map(ExternalDetector::finish) else { return Ok(exit) };
        Reporter::new(Self::NAME, common).fatal(&error.to_string());
        Ok(Exit::Lost)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}
