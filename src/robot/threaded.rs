//! A robot's client on a thread of its own: the robot stops in time whatever the program does.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::{Body, Event, MobileBase, RealBase, Remote, Report, RobotError, SonarReading, Status};
use crate::geometry::{Pose, wrap_angle};

/// One turn of the thread waits no longer than this for bytes.
const TURN: Duration = Duration::from_millis(10);
/// The thread ends within this once it is told to.
const ENDS_WITHIN: Duration = Duration::from_secs(3);

/// What talks to a robot, on the thread that calls it. Dropping it brings the robot to stand and says good-bye.
pub trait Driven: Send {
    /// A velocity, m/s and rad/s: it holds until the deadline.
    fn ask(&mut self, linear: f64, angular: f64);

    /// Zero set-points go out next, whatever was asked for.
    fn zero(&mut self);

    /// Hears the robot, waiting at most `wait`, and tells it what is safe to tell.
    ///
    /// # Errors
    /// When the robot is lost.
    fn turn(&mut self, wait: Duration) -> Result<(), RobotError>;

    /// Stops the robot and says good-bye.
    fn close(&mut self);

    /// What the robot last reported, poses from where it was first heard.
    fn report(&self) -> &Report;

    /// Whether it stands since zero was asked.
    fn stands(&self) -> bool;

    /// What happened since this was last asked.
    fn take_events(&mut self) -> Vec<Event>;
}

/// What program and thread share.
#[derive(Default)]
struct State {
    start: Pose,
    ask: Option<(f64, f64)>,
    /// Whether what is asked for is passed over.
    paused: bool,
    /// Zero set-points go out before anything else.
    zero: bool,
    /// Whether the robot stands.
    stands: bool,
    report: Report,
    events: Vec<Event>,
    failed: Option<String>,
    quit: bool,
    ended: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A real robot as a mobile base, in the frame of the room map.
pub struct ThreadedBase {
    shared: Arc<Shared>,
    body: Body,
    thread: Option<JoinHandle<()>>,
    /// What of the shared state the program sees until it drives on.
    report: Report,
    resume: bool,
    preflight: String,
    /// The pose, in the map, at which the robot was first heard.
    start: Pose,
    /// When the trial began, and the metres driven before it.
    began: (Duration, f64),
    /// When the last control period ended.
    due: Option<Instant>,
}

/// Stops the robot from anywhere, such as a signal handler's thread, and knows how it is.
#[derive(Clone)]
pub struct Stopper(Arc<Shared>);

impl Remote for Stopper {
    fn is_stopping(&self) -> bool {
        self.0.lock().quit
    }

    fn is_moving(&self) -> bool {
        let state = self.0.lock();
        let (linear, angular) = state.report.velocity;
        linear.abs() > 0.005 || angular.abs() > 0.01
    }

    fn pose(&self) -> Pose {
        let state = self.0.lock();
        in_map(state.start, state.report.pose)
    }

    fn take_events(&self) -> Vec<Event> {
        std::mem::take(&mut self.0.lock().events)
    }

    fn pause(&self) {
        let mut state = self.0.lock();
        (state.paused, state.zero, state.stands) = (true, true, false);
        let until = Instant::now() + ENDS_WITHIN;
        while !(state.stands || state.ended) && Instant::now() < until {
            let waited = self.0.changed.wait_timeout(state, Duration::from_millis(50));
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn go_on(&self) {
        let mut state = self.0.lock();
        (state.paused, state.zero, state.ask) = (false, true, None);
    }

    fn stop(&self) {
        let mut state = self.0.lock();
        state.quit = true;
        let until = Instant::now() + ENDS_WITHIN;
        while !state.ended && Instant::now() < until {
            let waited = self.0.changed.wait_timeout(state, Duration::from_millis(50));
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl ThreadedBase {
    /// Gives `client` its thread; `start` is where in the map the robot was first heard. It will `resume` by itself
    /// what holds it up, when that is over; `preflight` is what to know before driving off.
    ///
    /// # Errors
    /// When no thread can be started.
    pub fn start(
        client: impl Driven + 'static,
        body: Body,
        resume: bool,
        preflight: String,
        start: Pose,
    ) -> io::Result<Self> {
        let report = client.report().clone();
        let shared = Arc::new(Shared::default());
        *shared.lock() = State { start, report: report.clone(), ..State::default() };
        let theirs = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name("robot".to_string()).spawn(move || {
            // Whatever becomes of the thread, the client says good-bye when it is dropped, and the program hears of it.
            if catch_unwind(AssertUnwindSafe(|| run(client, &theirs))).is_err() {
                let mut state = theirs.lock();
                state.failed = Some("internal error in the thread that talks to it, please report it".to_string());
                state.ended = true;
                theirs.changed.notify_all();
            }
        });
        Ok(Self {
            shared,
            body,
            thread: Some(thread?),
            report,
            resume,
            preflight,
            start,
            began: (Duration::ZERO, 0.0),
            due: None,
        })
    }

    /// A handle that stops the robot.
    pub fn stopper(&self) -> Stopper {
        Stopper(Arc::clone(&self.shared))
    }

    /// The robot's last report.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Sleeps until the control period is over: what the program did meanwhile counts, unless it took longer than that.
    fn sleep(&mut self, period: Duration) {
        let now = Instant::now();
        let due = self.due.map(|last| last + period).filter(|due| *due > now).unwrap_or(now + period);
        std::thread::sleep(due - now);
        self.due = Some(due);
    }
}

/// A pose relative to `start`, in the frame of the map.
fn in_map(start: Pose, own: Pose) -> Pose {
    let at = start.to_world(own.position());
    Pose::new(at.x, at.y, wrap_angle(start.heading + own.heading))
}

fn run(mut client: impl Driven, shared: &Shared) {
    loop {
        let quit = {
            let mut state = shared.lock();
            let zero = std::mem::take(&mut state.zero);
            let ask = state.ask.take().filter(|_| !zero && !state.paused);
            if zero {
                client.zero();
            }
            if let Some((linear, angular)) = ask {
                client.ask(linear, angular);
            }
            state.quit
        };
        if quit {
            client.close();
        }
        let turned = if quit { Ok(()) } else { client.turn(TURN) };
        let mut state = shared.lock();
        state.report = client.report().clone();
        state.stands = client.stands() && !state.zero;
        state.events.extend(client.take_events());
        state.ended = quit || turned.is_err();
        state.failed = turned.err().map(|error| match error {
            RobotError::Link(why) | RobotError::Held(why) => why,
        });
        shared.changed.notify_all();
        if state.ended {
            return;
        }
    }
}

impl RealBase for ThreadedBase {
    fn preflight(&self) -> &str {
        &self.preflight
    }

    fn begin_trial(&mut self) {
        self.report = self.shared.lock().report.clone();
        self.began = (self.report.at, self.report.distance_m);
    }

    fn trial_distance_m(&self) -> f64 {
        self.report.distance_m - self.began.1
    }

    fn remote(&self) -> Arc<dyn Remote> {
        Arc::new(self.stopper())
    }
}

impl Drop for ThreadedBase {
    fn drop(&mut self) {
        self.stopper().stop();
        // A thread that hangs in a dead line is left behind; the robot's own watchdog has stopped it.
        if self.shared.lock().ended
            && let Some(thread) = self.thread.take()
        {
            let _ = thread.join();
        }
    }
}

impl MobileBase for ThreadedBase {
    fn age_s(&self) -> f64 {
        self.report.age_s()
    }

    fn dead_time_s(&self) -> f64 {
        self.report.dead_time.as_secs_f64()
    }

    fn body(&self) -> Body {
        self.body
    }

    fn pose(&self) -> Pose {
        in_map(self.start, self.report.pose)
    }

    fn velocity(&self) -> (f64, f64) {
        self.report.velocity
    }

    fn time_s(&self) -> f64 {
        self.report.at.saturating_sub(self.began.0).as_secs_f64()
    }

    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError> {
        self.shared.lock().ask = Some((linear, angular));
        self.sleep(Duration::from_secs_f64(seconds.clamp(0.0, 3600.0)));
        let state = self.shared.lock();
        self.report = state.report.clone();
        if let Some(why) = &state.failed {
            return Err(RobotError::Link(why.clone()));
        }
        match &self.report.held {
            Some(why) if !self.resume => Err(RobotError::Held(why.clone())),
            _ if state.quit => Err(RobotError::Held("told to stop".to_string())),
            _ => Ok(()),
        }
    }

    fn sonar(&self) -> &[SonarReading] {
        &self.report.sonar
    }

    fn status(&self) -> Status {
        self.report.status
    }
}
