//! The simulated robot served to other programs: its home, its camera, and its truth for a judge.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::arcos::{ServeAddress, Server, ServerSettings, serve_at};
use super::base::{Obstacles, SimulatedBase, Truth};
use super::camera::{Kinect, SolidScene};
use super::{Home, TrialSettings};
use crate::frame::{inverse, placed};
use crate::geometry::Pose;
use crate::recording::{FrameWriter, TimedFrame};

/// Time between two pictures, at least.
const PICTURE_EVERY: Duration = Duration::from_millis(250);
/// Time between two lines of the truth.
const TRUTH_EVERY: Duration = Duration::from_millis(20);

/// What is served, and what beside the line comes out.
#[derive(Clone, Debug)]
pub struct Served {
    /// Where.
    pub address: ServeAddress,
    /// What the robot is set to.
    pub settings: ServerSettings,
    /// Frames of its camera, MCAP.
    pub camera: Option<PathBuf>,
    /// Where it truly is, JSON lines.
    pub truth: Option<PathBuf>,
    /// How imperfect it and its camera are.
    pub how: TrialSettings,
}

/// Where the robot is: in truth, and by its odometry.
#[derive(Clone, Copy, Default)]
pub(super) struct Whereabouts {
    truth: Pose,
    believed: Pose,
}

impl Served {
    /// Serves the robot in `home` until `goes_on` says no; `tell` hears what happens.
    ///
    /// # Errors
    /// When the address cannot be listened at, or the line fails.
    pub fn run(&self, home: &Home, mut goes_on: impl FnMut() -> bool, tell: impl Fn(&str)) -> io::Result<()> {
        let noise = self.how.noise_in(home.scene.noise.unwrap_or_default());
        let obstacles = Obstacles::new(&home.map, &home.scene);
        let base = SimulatedBase::with_noise(obstacles, home.map.start, noise, self.how.seed, 0);
        // Nothing is written, filmed or said of a robot that cannot be served.
        let place = self.address.listen()?;
        let mut server = Server::new(base, self.settings.clone());
        let whereabouts = Arc::new(Mutex::new(Whereabouts::default()));
        note_server(&whereabouts, &server);
        if let Some(path) = &self.camera {
            film(path.clone(), home.clone(), Arc::clone(&whereabouts), self.how)?;
        }
        let mut truth = self.truth.as_deref().map(TruthLog::create).transpose()?;
        tell(&format!("serving at {}; ctrl-C ends it", self.address));
        serve_at(&mut server, place, |server| {
            note_server(&whereabouts, server);
            server.take_log().iter().for_each(|text| tell(text));
            server.take_heard();
            let written = truth.as_mut().map_or(Ok(()), |log| log.write_server(server));
            if let Err(error) = &written {
                tell(&format!("the truth cannot be written: {error}"));
            }
            written.is_ok() && goes_on()
        })
    }
}

fn note_server(whereabouts: &Mutex<Whereabouts>, server: &Server) {
    note(whereabouts, server.truth().borrow().pose, server.odometry());
}

/// Where the robot is now, for its camera.
pub(super) fn note(whereabouts: &Mutex<Whereabouts>, truth: Pose, believed: Pose) {
    *whereabouts.lock().unwrap_or_else(PoisonError::into_inner) = Whereabouts { truth, believed };
}

/// Films on a thread of its own, so that no picture makes a packet late. Pictures bear the time of day.
fn film(path: PathBuf, home: Home, whereabouts: Arc<Mutex<Whereabouts>>, how: TrialSettings) -> io::Result<()> {
    std::thread::Builder::new().name("camera".to_string()).spawn(move || {
        // A reader that goes away ends the film, not the robot.
        let _ = write_film(&path, &home, &whereabouts, how);
    })?;
    Ok(())
}

fn write_film(path: &Path, home: &Home, whereabouts: &Mutex<Whereabouts>, how: TrialSettings) -> Result<(), String> {
    let text = |error: &dyn std::fmt::Display| error.to_string();
    // A FIFO opens when its reader comes.
    let file = OpenOptions::new().write(true).create(true).truncate(true).open(path).map_err(|error| text(&error))?;
    let mut writer = FrameWriter::new(file).map_err(|error| text(&error))?;
    roll(home, whereabouts, how, |timed| writer.write(&timed).map_err(|error| text(&error)))
}

/// Films until `take` wants no more.
pub(super) fn roll(
    home: &Home,
    whereabouts: &Mutex<Whereabouts>,
    how: TrialSettings,
    mut take: impl FnMut(TimedFrame) -> Result<(), String>,
) -> Result<(), String> {
    let solids = SolidScene::new(&home.map, &home.scene);
    let kinect = Kinect { camera: home.camera(), ..how.kinect };
    let mut rng = ChaCha8Rng::seed_from_u64(how.seed);
    loop {
        let began = Instant::now();
        let here = *whereabouts.lock().unwrap_or_else(PoisonError::into_inner);
        let (mut frame, _) = kinect.capture(&solids, here.truth, &mut rng);
        frame.world_from_camera = placed(&placed(&frame.world_from_camera, inverse(here.truth)), here.believed);
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        take(TimedFrame::at(now.as_secs_f64(), Some(here.believed), frame))?;
        std::thread::sleep(PICTURE_EVERY.saturating_sub(began.elapsed()));
    }
}

/// Lines of `{"t":…,"x":…,"y":…,"heading":…,"speed":…,"turn":…,"driven":…,"distance_m":…,"sips":…}`.
pub(super) struct TruthLog {
    file: std::fs::File,
    next: Duration,
}

impl TruthLog {
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { file: std::fs::File::create(path)?, next: Duration::ZERO })
    }

    fn write_server(&mut self, server: &Server) -> io::Result<()> {
        let truth = server.truth();
        let truth = truth.borrow();
        self.write(server.now(), &truth, server.velocity(), server.is_driven(), server.sip_count())
    }

    /// One line, when one is due.
    pub(super) fn write(
        &mut self,
        now: Duration,
        truth: &Truth,
        (speed, turn): (f64, f64),
        driven: bool,
        reports: u64,
    ) -> io::Result<()> {
        if now < self.next {
            return Ok(());
        }
        self.next = now + TRUTH_EVERY;
        let line = serde_json::json!({
            "t": now.as_secs_f64(), "x": truth.pose.x, "y": truth.pose.y, "heading": truth.pose.heading,
            "speed": speed, "turn": turn, "driven": driven, "distance_m": truth.distance_m,
            "collisions": truth.collisions, "sips": reports,
        });
        writeln!(self.file, "{line}")
    }
}

/// Ends serving from a signal handler's thread, after the last bytes are out.
#[derive(Clone, Default)]
pub struct ServingStop(Arc<(Mutex<(bool, bool)>, Condvar)>);

/// A stop for [`Served::run`].
pub fn served_until_interrupted() -> ServingStop {
    ServingStop::default()
}

impl ServingStop {
    /// Whether to go on serving.
    pub fn goes_on(&self) -> bool {
        !self.0.0.lock().unwrap_or_else(PoisonError::into_inner).0
    }

    /// Serving has ended.
    pub fn ended(&self) {
        self.0.0.lock().unwrap_or_else(PoisonError::into_inner).1 = true;
        self.0.1.notify_all();
    }

    /// Ends serving, and waits a moment until it has ended.
    pub fn stop(&self) {
        let mut state = self.0.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.0 = true;
        if !state.1 {
            drop(self.0.1.wait_timeout(state, Duration::from_secs(1)));
        }
    }
}
