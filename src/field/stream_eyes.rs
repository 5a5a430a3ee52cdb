//! Eyes of a real robot: a detector behind a camera whose frames come as a stream, or no camera at all.
//!
//! A robot that stands waits for a picture of where it stands, and for what is
//! in it. One that drives does not wait: a thread of its own looks at the
//! newest frames, and the control loop takes what has been seen meanwhile.

use std::io;
use std::path::Path;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::frame_stream::{FrameStream, Taken, Tell};
use super::ros_camera::RosCamera;
use crate::frame::RgbdFrame;
use crate::frame::placed;
use crate::geometry::{Pose, wrap_angle};
use crate::map::RoomMap;
use crate::perception::{Detector, Eyes, View};
use crate::robot::Remote;

/// A robot that stands waits so long for a picture taken where it stands.
const FRESH_WITHIN: Duration = Duration::from_millis(1500);
/// And so long for the first of all.
const FIRST_WITHIN: Duration = Duration::from_secs(10);
/// The thread looks for so long after it was last asked what it has seen.
const WATCHES_FOR: Duration = Duration::from_secs(2);
/// One wait of a thread: what is not signalled is noticed after this.
const WAIT: Duration = Duration::from_millis(50);
/// What was seen from farther off than this, metres, or this far round, radians, is no longer what would be seen.
const STALE_M: f64 = 0.4;
const STALE_RAD: f64 = 0.2;

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

/// What makes a view of a frame.
pub type Detect = Arc<dyn Fn(&RgbdFrame) -> View + Send + Sync>;

/// A detector behind a stream of frames.
pub struct StreamEyes {
    stream: Arc<FrameStream>,
    watch: Arc<Watch>,
    detect: Detect,
    carrier: Arc<dyn Remote>,
    seen_first: bool,
    last: Option<RgbdFrame>,
}

/// What control loop and watching thread share.
#[derive(Default)]
struct Watch {
    state: Mutex<Watching>,
    changed: Condvar,
}

#[derive(Default)]
struct Watching {
    /// Where the executive last believed the robot, and where the odometry had it then.
    correction: (Pose, Pose),
    until: Option<Instant>,
    seen: Option<Seen>,
    closed: bool,
}

/// What the thread has seen.
struct Seen {
    view: View,
    frame: RgbdFrame,
    /// Where the odometry had the robot.
    at: Pose,
}

impl Watch {
    fn lock(&self) -> MutexGuard<'_, Watching> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl StreamEyes {
    /// Eyes that read frames from `path`: a file that may still be growing, a FIFO, or `-` for standard input.
    ///
    /// # Errors
    /// When the path cannot be opened.
    pub fn open(path: &Path, map: RoomMap, carrier: Arc<dyn Remote>, tell: Tell) -> io::Result<Self> {
        let stream = FrameStream::open(path, Arc::clone(&carrier), tell)?;
        Self::new(stream, shipped_detector(map), carrier)
    }

    /// Eyes behind the Kinect that is plugged into this machine, on the usual tower.
    ///
    /// # Errors
    /// When there is no Kinect, or this build does not know one.
    #[cfg(feature = "kinect")]
    pub fn kinect(map: RoomMap, carrier: Arc<dyn Remote>, tell: Tell) -> io::Result<Self> {
        let stream = FrameStream::start(Arc::clone(&carrier), tell, super::kinect::stream)?;
        Self::new(stream, shipped_detector(map), carrier)
    }

    /// Eyes behind the camera of a robot that runs ROS.
    ///
    /// # Errors
    /// When no thread can be started.
    pub fn ros(camera: RosCamera, map: RoomMap, carrier: Arc<dyn Remote>, tell: Tell) -> io::Result<Self> {
        let stream = FrameStream::start(Arc::clone(&carrier), tell, move |take| camera.stream(take))?;
        Self::new(stream, shipped_detector(map), carrier)
    }

    /// Ends the stream from anywhere, such as a signal handler's thread, which leaves no time to drop anything.
    pub fn closer(&self) -> impl FnOnce() + Send + 'static {
        let stream = Arc::clone(&self.stream);
        move || stream.close()
    }

    pub(super) fn new(stream: Arc<FrameStream>, detect: Detect, carrier: Arc<dyn Remote>) -> io::Result<Self> {
        let watch = Arc::new(Watch::default());
        let (frames, theirs, sees) = (Arc::clone(&stream), Arc::clone(&watch), Arc::clone(&detect));
        std::thread::Builder::new().name("eyes".to_string()).spawn(move || keep_watch(&frames, &theirs, &sees))?;
        Ok(Self { stream, watch, detect, carrier, seen_first: false, last: None })
    }

    /// The newest frame taken where the robot stands, or the newest of all when none comes in time.
    fn standing_frame(&mut self, odometry: Pose) -> Option<Taken> {
        let until = Instant::now() + if self.seen_first { FRESH_WITHIN } else { FIRST_WITHIN };
        let mut newest = self.stream.lock();
        loop {
            let is_fresh = newest.taken.as_ref().is_some_and(|taken| taken.is_from(odometry));
            if is_fresh || newest.ended || self.carrier.is_stopping() || Instant::now() >= until {
                self.seen_first |= newest.count > 0;
                return newest.taken.clone();
            }
            newest = self.stream.wait(newest, WAIT);
        }
    }
}

/// Our own detector, which knows the walls.
fn shipped_detector(map: RoomMap) -> Detect {
    let detector = Detector::default();
    Arc::new(move |frame| detector.detect(frame, Some(&map)))
}

/// The frame with its camera in the map, on a robot that the odometry has at `taken.at`.
fn in_map(taken: &Taken, (believed, odometry): (Pose, Pose)) -> RgbdFrame {
    let at = believed.to_world(odometry.to_local(taken.at.position()));
    let pose = Pose::new(at.x, at.y, believed.heading + taken.at.heading - odometry.heading);
    RgbdFrame { world_from_camera: placed(&taken.frame.world_from_camera, pose), ..taken.frame.clone() }
}

/// Looks at the newest frame again and again, as long as someone wants to know.
fn keep_watch(stream: &FrameStream, watch: &Watch, detect: &Detect) {
    let mut done = 0;
    loop {
        let mut state = watch.lock();
        while !state.closed && state.until.is_none_or(|until| Instant::now() >= until) {
            state = watch.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        if state.closed {
            return;
        }
        let correction = state.correction;
        drop(state);
        let mut newest = stream.lock();
        if newest.count == done {
            newest = stream.wait(newest, WAIT);
        }
        let Some(taken) = newest.taken.clone().filter(|_| newest.count > done) else { continue };
        done = newest.count;
        drop(newest);
        let frame = in_map(&taken, correction);
        let view = detect(&frame);
        watch.lock().seen = Some(Seen { view, frame, at: taken.at });
    }
}

impl Eyes for StreamEyes {
    fn look(&mut self, believed: Pose) -> View {
        let odometry = self.carrier.pose();
        let Some(taken) = self.standing_frame(odometry) else { return View::default() };
        let frame = in_map(&taken, (believed, odometry));
        let view = (self.detect)(&frame);
        self.last = Some(frame);
        view
    }

    fn glimpse(&mut self, believed: Pose) -> Option<View> {
        let odometry = self.carrier.pose();
        let mut state = self.watch.lock();
        state.correction = (believed, odometry);
        state.until = Some(Instant::now() + WATCHES_FOR);
        self.watch.changed.notify_all();
        let seen = state.seen.take()?;
        drop(state);
        let turned = wrap_angle(seen.at.heading - odometry.heading).abs();
        if turned > STALE_RAD || seen.at.distance_to(odometry.position()) > STALE_M {
            return None;
        }
        self.last = Some(seen.frame);
        Some(seen.view)
    }

    fn frame(&self) -> Option<&RgbdFrame> {
        self.last.as_ref()
    }
}

impl Drop for StreamEyes {
    fn drop(&mut self) {
        self.watch.lock().closed = true;
        self.watch.changed.notify_all();
        self.stream.close();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Sender, channel};

    use super::*;
    use crate::frame::Intrinsics;
    use crate::perception::ObjectSighting;
    use crate::recording::TimedFrame;

    /// A robot that is where it was last put.
    #[derive(Default)]
    struct Put(Mutex<Pose>);

    impl Put {
        fn at(&self, pose: Pose) {
            *self.0.lock().expect("whole") = pose;
        }
    }

    impl Remote for Put {
        fn stop(&self) {}

        fn pause(&self) {}

        fn go_on(&self) {}

        fn is_moving(&self) -> bool {
            false
        }

        fn take_events(&self) -> Vec<crate::robot::Event> {
            Vec::new()
        }

        fn pose(&self) -> Pose {
            *self.0.lock().expect("whole")
        }

        fn is_stopping(&self) -> bool {
            false
        }
    }

    /// A frame of a camera 1 m above the wheels of a robot at `robot`; without it, of one that does not say where.
    fn frame(robot: Option<Pose>) -> TimedFrame {
        let mut camera = [[0.0, 0.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0]];
        if let Some(pose) = robot {
            camera = placed(&camera, pose);
        }
        let frame = RgbdFrame {
            width: 4,
            height: 4,
            color: Vec::new(),
            depth: vec![2000; 16],
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: 4.0, fy: 4.0, cx: 2.0, cy: 2.0 },
            world_from_camera: camera,
        };
        TimedFrame::at(0.0, robot, frame)
    }

    /// Sees one thing: where the camera is.
    fn place_of_camera(frame: &RgbdFrame) -> View {
        let [x, y] = [frame.world_from_camera[0][3], frame.world_from_camera[1][3]];
        View { objects: vec![ObjectSighting { name: "here".into(), x, y, recognisable: true }], ..View::default() }
    }

    fn eyes(carrier: &Arc<Put>, detect: Detect) -> (StreamEyes, Sender<TimedFrame>) {
        let (frames, coming) = channel();
        let carrier: Arc<dyn Remote> = carrier.clone();
        let stream = FrameStream::start(Arc::clone(&carrier), Arc::new(|_| {}), move |take| {
            while coming.recv().is_ok_and(|frame| take(Some(frame))) {}
            Ok(())
        });
        (StreamEyes::new(stream.expect("a thread"), detect, carrier).expect("a thread"), frames)
    }

    fn seen_at(view: &View) -> Option<(f64, f64)> {
        view.objects.first().map(|object| (object.x, object.y))
    }

    fn next_glimpse(eyes: &mut StreamEyes, believed: Pose) -> View {
        loop {
            if let Some(view) = eyes.glimpse(believed) {
                return view;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_glimpse_does_not_wait_for_the_detector_and_later_brings_what_it_saw() {
        let carrier = Arc::new(Put::default());
        let (release, gate) = channel::<()>();
        let (gate, begun) = (Mutex::new(gate), Arc::new(Mutex::new(false)));
        let begins = Arc::clone(&begun);
        let (mut eyes, frames) = eyes(
            &carrier,
            Arc::new(move |frame| {
                *begins.lock().expect("whole") = true;
                let _ = gate.lock().expect("whole").recv();
                place_of_camera(frame)
            }),
        );
        frames.send(frame(Some(Pose::default()))).expect("taken");
        while !*begun.lock().expect("whole") {
            assert!(eyes.glimpse(Pose::default()).is_none());
            std::thread::yield_now();
        }
        // The detector is held: a glimpse that waited for it would never come back.
        assert!((0..100).all(|_| eyes.glimpse(Pose::default()).is_none()));
        release.send(()).expect("waits");
        assert_eq!(seen_at(&next_glimpse(&mut eyes, Pose::default())), Some((0.0, 0.0)));
        assert!(eyes.frame().is_some() && eyes.glimpse(Pose::default()).is_none(), "nothing is seen twice");
        drop(release);
    }

    #[test]
    fn what_is_seen_is_placed_by_where_the_executive_believes_the_robot() {
        let carrier = Arc::new(Put::default());
        carrier.at(Pose::new(1.0, 0.0, 0.0));
        let (mut eyes, frames) = eyes(&carrier, Arc::new(place_of_camera));
        // Half a metre further on when the picture was taken; the odometry is off by two metres and a quarter turn.
        frames.send(frame(Some(Pose::new(1.25, 0.0, 0.0)))).expect("taken");
        let believed = Pose::new(1.0, 2.0, std::f64::consts::FRAC_PI_2);
        let (x, y) = seen_at(&next_glimpse(&mut eyes, believed)).expect("seen");
        assert!((x - 1.0).abs() < 1e-9 && (y - 2.25).abs() < 1e-9, "{x} {y}");
    }

    #[test]
    fn what_was_seen_before_a_turn_is_not_taken_for_what_is_seen_after_it() {
        let carrier = Arc::new(Put::default());
        let (mut eyes, frames) = eyes(&carrier, Arc::new(place_of_camera));
        frames.send(frame(Some(Pose::default()))).expect("taken");
        while eyes.watch.lock().seen.is_none() {
            // Asking would take it.
            eyes.watch.lock().until = Some(Instant::now() + WATCHES_FOR);
            eyes.watch.changed.notify_all();
            std::thread::yield_now();
        }
        carrier.at(Pose::new(0.0, 0.0, 1.0));
        assert!(eyes.glimpse(Pose::default()).is_none());
        frames.send(frame(Some(Pose::new(0.0, 0.0, 1.0)))).expect("taken");
        assert!(seen_at(&next_glimpse(&mut eyes, Pose::default())).is_some());
    }

    #[test]
    fn a_robot_that_stands_waits_for_a_picture_of_where_it_stands() {
        let carrier = Arc::new(Put::default());
        carrier.at(Pose::new(3.0, 0.0, 0.0));
        let (mut eyes, frames) = eyes(&carrier, Arc::new(place_of_camera));
        for x in [1.0, 2.0, 3.0] {
            frames.send(frame(Some(Pose::new(x, 0.0, 0.0)))).expect("taken");
        }
        assert_eq!(seen_at(&eyes.look(carrier.pose())), Some((3.0, 0.0)));
    }

    #[test]
    fn of_a_camera_that_does_not_say_where_it_was_the_second_picture_after_a_halt_is_taken() {
        let carrier = Put::default();
        let pose = Pose::new(0.5, 0.0, 0.0);
        carrier.at(pose);
        let stream = FrameStream::default();
        let tell: Tell = Arc::new(|_| {});
        for (odometry, is_of_here) in [(Pose::default(), false), (pose, false), (pose, true)] {
            assert!(stream.take(frame(None), odometry, &tell));
            let taken = stream.lock().taken.clone().expect("taken");
            assert_eq!(taken.is_from(pose), is_of_here);
        }
    }

    #[test]
    fn a_stream_that_ends_without_a_picture_is_told_and_shows_nothing() {
        let told = Arc::new(Mutex::new(Vec::new()));
        let hears = Arc::clone(&told);
        let tell: Tell = Arc::new(move |text: &str| hears.lock().expect("whole").push(text.to_string()));
        let carrier: Arc<dyn Remote> = Arc::new(Put::default());
        let stream = FrameStream::open(Path::new("no/such/file"), Arc::clone(&carrier), tell).expect("a thread");
        let mut eyes = StreamEyes::new(stream, Arc::new(place_of_camera), carrier).expect("a thread");
        assert_eq!(seen_at(&eyes.look(Pose::default())), None);
        while told.lock().expect("whole").is_empty() {
            std::thread::yield_now();
        }
        assert!(told.lock().expect("whole")[0].starts_with("camera: no/such/file: "));
    }
}
