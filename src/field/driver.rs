//! Plans run on a real robot: the same executive, the robot's own sensors, and no truth to judge by.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::frame_stream::Tell;
use crate::behavior::{
    Executive, Furniture, Options, Run, Several, Silent, Watcher, note_of, object_of, plan_of, rounded, row_of,
    shade_of, text_of,
};
use crate::frame::{Camera, RgbdFrame};
use crate::geometry::{ClearanceGrid, Pose};
use crate::map::RoomMap;
use crate::perception::{Eyes, View};
use crate::record::{Note, PathPoint, Plan, Record, Row, Shade, Stage, StageError, Trial};
use crate::recording::{About, Outputs, Recorder, Told};
use crate::robot::{MobileBase, RealBase, Remote};

/// A trial that is told to stop has its log written within this.
const WRITTEN_WITHIN: Duration = Duration::from_secs(3);

/// Runs the plan of each record on a robot, one after another.
pub struct RealDriver {
    /// All that is known of the home.
    map: RoomMap,
    options: Options,
    outputs: Outputs,
    robot: Mutex<Robot>,
    remote: Arc<dyn Remote>,
    busy: Arc<Busy>,
    tell: Tell,
    unheard: Box<dyn Fn() -> bool + Send + Sync>,
}

/// The robot with its eyes.
struct Robot {
    base: Box<dyn RealBase>,
    eyes: Box<dyn Eyes + Send>,
}

/// Whether a trial is under way.
#[derive(Default)]
struct Busy(Mutex<bool>, Condvar);

impl Busy {
    fn set(&self, busy: bool) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = busy;
        self.1.notify_all();
    }

    fn wait(&self) {
        let until = Instant::now() + WRITTEN_WITHIN;
        let mut busy = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        while *busy && Instant::now() < until {
            busy = self.1.wait_timeout(busy, Duration::from_millis(50)).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// Stops a real robot from a signal handler's thread, and waits until the trial's log is whole.
pub struct Interrupter {
    remote: Arc<dyn Remote>,
    busy: Arc<Busy>,
}

impl Interrupter {
    /// Stops the robot at once; returns when motors are off and the log is written.
    pub fn stop(&self) {
        self.remote.stop();
        self.busy.wait();
    }
}

impl RealDriver {
    /// Plans will be run on `base`, seeing through `eyes`; `tell` hears what happens to the robot.
    pub fn new(
        map: RoomMap,
        options: Options,
        outputs: Outputs,
        base: Box<dyn RealBase>,
        eyes: Box<dyn Eyes + Send>,
        tell: Tell,
    ) -> Self {
        tell(base.preflight());
        let remote = base.remote();
        Self {
            map,
            options,
            outputs,
            robot: Mutex::new(Robot { base, eyes }),
            remote,
            busy: Arc::default(),
            tell,
            unheard: Box::new(|| false),
        }
    }

    /// A trial also ends when `unheard` says, at any control period, that nobody reads what comes out of it.
    pub fn while_heard(mut self, unheard: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        self.unheard = Box::new(unheard);
        self
    }

    /// What a signal handler needs.
    pub fn interrupter(&self) -> Interrupter {
        Interrupter { remote: Arc::clone(&self.remote), busy: Arc::clone(&self.busy) }
    }

    fn robot(&self) -> MutexGuard<'_, Robot> {
        self.robot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn drive(&self, record: &mut Record, plan: &Plan, id: &str) -> Result<Note, StageError> {
        let failed = |error: &dyn std::fmt::Display| StageError::new(error.to_string());
        let name = record.file_name();
        self.outputs.prepare(&name, id).map_err(|error| failed(&error))?;
        let mut robot = self.robot();
        let Robot { base, eyes } = &mut *robot;
        base.begin_trial();
        let about = About {
            map: &self.map,
            truth: &[],
            camera: Camera::kinect(),
            seed: 0,
            settings: format!("{:?}", self.options),
            record,
        };
        let recorder = Recorder::begin(&self.outputs, &name, &about).map_err(|error| failed(&error))?;
        let (mut narrator, mut story) = (self.outputs.narrator(id, record), self.outputs.story());
        let mut audience = Several::default();
        narrator.iter_mut().for_each(|narrator| audience.0.push(narrator));
        story.iter_mut().for_each(|story| audience.0.push(story));
        let mut log = Log {
            recorder,
            audience,
            silent: Silent,
            remote: Arc::clone(&self.remote),
            tell: self.tell.as_ref(),
            unheard: self.unheard.as_ref(),
        };
        let _stops = StopInPanic(self.remote.as_ref());
        let mut run = run(&self.map, plan, self.options, base.as_mut(), eyes.as_mut(), &mut log);
        log.drain(base.time_s());
        let recorder = log.recorder.take();
        drop(log);
        narrator.iter().for_each(|narrator| narrator.end(&run.trial));
        let picture = eyes.frame().map(RgbdFrame::color_png);
        let mut lost = self.outputs.leave((&self.map, &[]), &mut run, picture.as_deref(), record, &name);
        record.put(&run.trial);
        let line = serde_json::to_string(record).map_err(|error| failed(&error))?;
        if let Some(story) = story {
            let thumbnail = eyes.frame().map(RgbdFrame::thumbnail_png);
            self.outputs.tell(Told { line: line.clone(), run: run.clone(), picture: thumbnail, story });
        }
        if let Some(recorder) = recorder {
            let written = recorder.finish(run.trial.duration_s.0, picture.unwrap_or_default(), &line);
            lost.extend(written.err().map(|error| error.to_string()));
        }
        Ok(note_of(&run.trial).and(lost))
    }
}

/// Runs `plan` on a robot whose truth nobody knows.
fn run(
    map: &RoomMap,
    plan: &Plan,
    options: Options,
    base: &mut dyn RealBase,
    eyes: &mut dyn Eyes,
    watcher: &mut dyn Watcher,
) -> Run {
    let report = Executive::new(map, base, eyes, watcher, options).run(plan);
    let (pose, duration_s) = (report.pose, base.time_s());
    let mut path = report.journal.path;
    path.push(PathPoint::new(duration_s, pose));
    let trial = Trial {
        outcome: report.outcome,
        why: report.why,
        description: report.description,
        final_pose: rounded(pose),
        target_id: None,
        approached: Vec::new(),
        right_first: None,
        picture: None,
        duration_s: duration_s.into(),
        distance_m: base.trial_distance_m().into(),
        spl: None,
        collisions: 0,
        min_clearance_m: None,
        delivered: report.delivered,
        actions: report.journal.actions,
        path,
    };
    Run { trial, final_pose: pose, found_at: report.found_at, sought: object_of(plan).map(str::to_string) }
}

/// A program that panics steers no more: the robot is stopped, its motors switched off and the line closed at once.
struct StopInPanic<'a>(&'a dyn Remote);

impl Drop for StopInPanic<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop();
        }
    }
}

/// Passes on what the executive tells, adds what happens to the robot, and hears of a stop.
struct Log<'a> {
    recorder: Option<Recorder>,
    audience: Several<'a>,
    silent: Silent,
    remote: Arc<dyn Remote>,
    tell: &'a (dyn Fn(&str) + Send + Sync),
    unheard: &'a (dyn Fn() -> bool + Send + Sync),
}

impl Log<'_> {
    fn inner(&mut self) -> &mut dyn Watcher {
        match &mut self.recorder {
            Some(recorder) => recorder,
            None => &mut self.silent,
        }
    }

    fn drain(&mut self, time_s: f64) {
        for event in self.remote.take_events() {
            (self.tell)(&event.text);
            self.inner().said(time_s, &format!("robot: {}", event.text));
        }
    }
}

impl Watcher for Log<'_> {
    fn sensed(&mut self, base: &dyn MobileBase) {
        self.drain(base.time_s());
        self.inner().sensed(base);
    }

    fn frame(&mut self, time_s: f64, believed: Pose, frame: &RgbdFrame) {
        self.inner().frame(time_s, believed, frame);
        self.audience.frame(time_s, believed, frame);
    }

    fn seen(&mut self, time_s: f64, view: &View) {
        self.inner().seen(time_s, view);
        self.audience.seen(time_s, view);
    }

    fn grid(&mut self, time_s: f64, grid: &ClearanceGrid) {
        self.inner().grid(time_s, grid);
    }

    fn said(&mut self, time_s: f64, text: &str) {
        self.inner().said(time_s, text);
        self.audience.said(time_s, text);
    }

    fn told(&mut self, time_s: f64, plain: &str) {
        self.audience.told(time_s, plain);
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        self.inner().furniture(time_s, furniture);
        self.audience.furniture(time_s, furniture);
    }

    /// Someone says so, or what the robot does can no longer be told.
    fn wants_stop(&self) -> bool {
        self.remote.is_stopping() || self.recorder.as_ref().is_some_and(Recorder::has_failed) || (self.unheard)()
    }
}

impl Stage for RealDriver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let plan = plan_of(record, &self.map)?;
        let id = record.id().unwrap_or_else(|| "record".to_string());
        self.busy.set(true);
        let driven = self.drive(record, &plan, &id);
        self.busy.set(false);
        driven
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        text_of(record)
    }

    fn shade(&self, line: &str) -> Shade {
        shade_of(line)
    }

    fn row(&self, record: &Record) -> Option<Result<Row, StageError>> {
        Some(row_of(record))
    }

    fn has_rows(&self) -> bool {
        true
    }

    fn narrates(&self) -> bool {
        true
    }
}
