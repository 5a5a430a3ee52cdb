//! Eyes of a real robot: a detector behind a camera whose frames come as a stream, or no camera at all.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::frame::RgbdFrame;
use crate::geometry::{Pose, vec2, wrap_angle};
use crate::perception::{Detector, Eyes, View};
use crate::recording::{Follow, FrameOptions, FrameReader, TimedFrame};
use crate::robot::arcos::client::Stopper;
use crate::world::RoomMap;

/// A robot that stands waits so long for a picture taken where it stands.
const FRESH_WITHIN: Duration = Duration::from_millis(1500);
/// And so long for the first of all.
const FIRST_WITHIN: Duration = Duration::from_secs(10);
/// A frame was taken where the robot stands when it is no farther off than this.
const SAME_PLACE_M: f64 = 0.03;
const SAME_HEADING_RAD: f64 = 0.03;

/// A robot without a camera.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoEyes;

impl Eyes for NoEyes {
    fn look(&mut self, _believed: Pose) -> View {
        View::default()
    }

    fn can_see(&self) -> bool {
        false
    }
}

/// The newest frame of a stream.
#[derive(Default)]
struct Newest {
    frame: Option<TimedFrame>,
    count: u64,
    ended: Option<String>,
}

#[derive(Default)]
struct Stream {
    newest: Mutex<Newest>,
    changed: Condvar,
}

/// A detector behind a stream of frames.
pub struct StreamEyes {
    stream: Arc<Stream>,
    detector: Detector,
    map: RoomMap,
    robot: Stopper,
    seen: u64,
    last: Option<RgbdFrame>,
}

impl StreamEyes {
    /// Reads frames from `path`: a file that may still be growing, a FIFO, or `-` for standard input.
    pub fn open(path: &Path, map: RoomMap, robot: Stopper) -> io::Result<Self> {
        let stream = Arc::new(Stream::default());
        let (theirs, path) = (Arc::clone(&stream), path.to_path_buf());
        // A FIFO opens only when its writer comes: not on this thread.
        std::thread::Builder::new().name("camera".to_string()).spawn(move || {
            let why = read(&path, &theirs).err().unwrap_or_else(|| "the stream has ended".to_string());
            theirs.newest.lock().unwrap_or_else(PoisonError::into_inner).ended = Some(why);
            theirs.changed.notify_all();
        })?;
        Ok(Self { stream, detector: Detector::default(), map, robot, seen: 0, last: None })
    }

    /// The newest frame; while the robot stands, one taken where it stands.
    fn newest(&mut self, odometry: Pose) -> Option<TimedFrame> {
        let standing = !self.robot.is_moving();
        let patience = if self.seen == 0 { FIRST_WITHIN } else { FRESH_WITHIN };
        let until = Instant::now() + patience;
        let mut newest = self.stream.newest.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            let fresh =
                newest.frame.as_ref().is_some_and(|frame| taken_at(frame, odometry, newest.count > self.seen + 1));
            let moving_on = !standing && newest.count > 0;
            if fresh || moving_on || newest.ended.is_some() || Instant::now() >= until {
                self.seen = newest.count;
                return newest.frame.clone();
            }
            let waited = self.stream.changed.wait_timeout(newest, Duration::from_millis(50));
            newest = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// Whether a frame was taken where the robot stands; when the stream does not say where, the second one after a halt was.
fn taken_at(frame: &TimedFrame, odometry: Pose, is_second: bool) -> bool {
    frame.robot.map_or(is_second, |at| {
        at.distance_to(odometry.position()) < SAME_PLACE_M
            && wrap_angle(at.heading - odometry.heading).abs() < SAME_HEADING_RAD
    })
}

impl Eyes for StreamEyes {
    fn look(&mut self, believed: Pose) -> View {
        let odometry = self.robot.pose();
        let Some(timed) = self.newest(odometry) else { return View::default() };
        let mut frame = timed.frame;
        // A stream knows odometry; the executive may know better.
        let camera = match timed.robot {
            Some(_) => placed(&frame.world_from_camera, inverse(odometry)),
            None => frame.world_from_camera,
        };
        frame.world_from_camera = placed(&camera, believed);
        let view = self.detector.detect(&frame, Some(&self.map));
        self.last = Some(frame);
        view
    }

    fn frame(&self) -> Option<&RgbdFrame> {
        self.last.as_ref()
    }
}

/// The pose that undoes `pose`.
pub(super) fn inverse(pose: Pose) -> Pose {
    let at = pose.to_local(vec2(0.0, 0.0));
    Pose::new(at.x, at.y, -pose.heading)
}

/// A camera that is known from its robot, on a robot at `pose`.
pub(super) fn placed(camera: &[[f64; 4]; 4], pose: Pose) -> [[f64; 4]; 4] {
    let (sin, cos) = pose.heading.sin_cos();
    let mut world = *camera;
    for column in 0..4 {
        world[0][column] = cos * camera[0][column] - sin * camera[1][column];
        world[1][column] = sin * camera[0][column] + cos * camera[1][column];
    }
    world[0][3] += pose.x;
    world[1][3] += pose.y;
    world
}

fn read(path: &Path, stream: &Arc<Stream>) -> Result<(), String> {
    let name = path.display().to_string();
    let named = |error: String| format!("{name}: {error}");
    let source = open(path).map_err(|error| named(error.to_string()))?;
    let mut frames =
        FrameReader::new(source, &name, FrameOptions::default()).map_err(|error| named(error.to_string()))?;
    for read in &mut frames {
        // What is lost on the way is one picture less.
        let Ok(frame) = read else { continue };
        let mut newest = stream.newest.lock().unwrap_or_else(PoisonError::into_inner);
        newest.frame = Some(frame);
        newest.count += 1;
        stream.changed.notify_all();
        if Arc::strong_count(stream) == 1 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_ahead_of_its_robot_turns_and_moves_with_it() {
        let mut camera = [[0.0; 4]; 4];
        camera[0] = [0.0, 0.0, 1.0, 0.1];
        let world = placed(&camera, Pose::new(2.0, 3.0, std::f64::consts::FRAC_PI_2));
        assert!((world[0][3] - 2.0).abs() < 1e-12 && (world[1][3] - 3.1).abs() < 1e-12);
        assert!(world[0][2].abs() < 1e-12 && (world[1][2] - 1.0).abs() < 1e-12);
    }
}
