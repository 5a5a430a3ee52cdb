//! The newest frame of a camera that streams, and where the robot was when it came.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::frame::RgbdFrame;
use crate::frame::{inverse, placed};
use crate::geometry::{Pose, wrap_angle};
use crate::perception::check;
use crate::recording::{Follow, FrameOptions, FrameReader, TimedFrame};
use crate::robot::Remote;

/// Two poses nearer than this are the same place.
const SAME_PLACE_M: f64 = 0.03;
const SAME_HEADING_RAD: f64 = 0.03;

/// Where remarks go.
pub type Tell = Arc<dyn Fn(&str) + Send + Sync>;

/// Takes a frame, or none; says whether more are wanted.
pub(super) type Take<'a> = dyn FnMut(Option<TimedFrame>) -> bool + 'a;

/// A frame whose camera is known from its robot.
#[derive(Clone)]
pub(super) struct Taken {
    pub frame: RgbdFrame,
    /// Where the odometry had the robot: by the stream, or when the frame came.
    pub at: Pose,
    /// When only its coming is known, a frame may show the place of the one before.
    not_before: Pose,
}

impl Taken {
    /// Whether the frame was taken where the robot is.
    pub fn is_from(&self, odometry: Pose) -> bool {
        is_same(self.at, odometry) && is_same(self.not_before, odometry)
    }
}

fn is_same(a: Pose, b: Pose) -> bool {
    a.distance_to(b.position()) < SAME_PLACE_M && wrap_angle(a.heading - b.heading).abs() < SAME_HEADING_RAD
}

#[derive(Default)]
pub(super) struct Newest {
    pub taken: Option<Taken>,
    /// Frames so far.
    pub count: u64,
    /// Frames that could not be used.
    refused: u64,
    /// No more will come.
    pub ended: bool,
    /// Nobody wants more.
    pub closed: bool,
}

/// The newest frame, for whoever waits for one.
#[derive(Default)]
pub(super) struct FrameStream {
    newest: Mutex<Newest>,
    changed: Condvar,
}

impl FrameStream {
    /// Takes in what `frames` hands over, on a thread of its own, until it ends.
    ///
    /// It hands over frames, or none to ask whether more are wanted, and shall end when they are not.
    ///
    /// # Errors
    /// When no thread can be started.
    pub fn start(
        carrier: Arc<dyn Remote>,
        tell: Tell,
        frames: impl FnOnce(&mut Take) -> Result<(), String> + Send + 'static,
    ) -> io::Result<Arc<Self>> {
        let stream = Arc::new(Self::default());
        let theirs = Arc::clone(&stream);
        std::thread::Builder::new().name("camera".to_string()).spawn(move || {
            let mut take = |frame: Option<TimedFrame>| match frame {
                Some(frame) => theirs.take(frame, carrier.pose(), &tell),
                None => !theirs.lock().closed,
            };
            let ended = frames(&mut take);
            let closed = {
                let mut newest = theirs.lock();
                newest.ended = true;
                newest.closed
            };
            theirs.changed.notify_all();
            if !closed {
                tell(&format!("camera: {}", ended.err().as_deref().unwrap_or("the stream has ended")));
            }
        })?;
        Ok(stream)
    }

    /// Reads frames from `path`: a file that may still be growing, a FIFO, or `-` for standard input.
    ///
    /// # Errors
    /// When the path cannot be opened.
    pub fn open(path: &Path, carrier: Arc<dyn Remote>, tell: Tell) -> io::Result<Arc<Self>> {
        let path = path.to_path_buf();
        // A FIFO opens only when its writer comes: not before the thread is there.
        Self::start(carrier, tell, move |take| read(&path, take))
    }

    pub fn lock(&self) -> MutexGuard<'_, Newest> {
        self.newest.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until something changes, or a moment has passed.
    pub fn wait<'a>(&self, newest: MutexGuard<'a, Newest>, most: Duration) -> MutexGuard<'a, Newest> {
        self.changed.wait_timeout(newest, most).unwrap_or_else(PoisonError::into_inner).0
    }

    /// Wants no more frames.
    pub fn close(&self) {
        self.lock().closed = true;
        self.changed.notify_all();
    }

    /// Takes in a frame that came when the odometry had the robot at `odometry`; false when no more are wanted.
    pub(super) fn take(&self, timed: TimedFrame, odometry: Pose, tell: &Tell) -> bool {
        let checked = check(&timed.frame);
        let mut newest = self.lock();
        if let Err(error) = checked {
            newest.refused += 1;
            // The first says it for all.
            if newest.refused == 1 {
                tell(&format!("camera: a frame is left out: {error}"));
            }
            return !newest.closed;
        }
        let before = newest.taken.as_ref().map_or(odometry, |taken| taken.at);
        let mut frame = timed.frame;
        let (at, not_before) = match timed.robot {
            Some(at) => (at, at),
            None => (odometry, before),
        };
        if timed.robot.is_some() {
            frame.world_from_camera = placed(&frame.world_from_camera, inverse(at));
        }
        newest.taken = Some(Taken { frame, at, not_before });
        newest.count += 1;
        self.changed.notify_all();
        !newest.closed
    }
}

fn read(path: &Path, take: &mut Take) -> Result<(), String> {
    let name = path.display().to_string();
    let named = |error: String| format!("{name}: {error}");
    let source = open(path).map_err(|error| named(error.to_string()))?;
    let frames = FrameReader::new(source, &name, FrameOptions::default()).map_err(|error| named(error.to_string()))?;
    // What is lost on the way is one picture less.
    for frame in frames.flatten() {
        if !take(Some(frame)) {
            break;
        }
    }
    Ok(())
}

fn open(path: &Path) -> io::Result<Box<dyn Read + Send>> {
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin()));
    }
    let file = File::open(path)?;
    let growing = file.metadata()?.is_file();
    Ok(if growing { Box::new(Follow::new(file, || true)) } else { Box::new(file) })
}
