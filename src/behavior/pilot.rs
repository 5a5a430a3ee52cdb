//! Drives, turns and looks: what every step of the executive is made of.

use std::f64::consts::PI;

use super::foresight::Foresight;
use super::localizer::Localizer;
use super::progress::Idle;
use super::{Beliefs, Clearances, Journal, Watcher, Ways};
use crate::geometry::{ClearanceGrid, Polygon, Pose, Vec2, segments_touch, wrap_angle};
use crate::map::RoomMap;
use crate::perception::{Eyes, View};
use crate::robot::{Body, MobileBase, RobotError};

/// Control period, seconds.
pub(super) const TICK_S: f64 = 0.1;
/// Cell of the planning grid, metres.
const CELL_M: f64 = 0.1;
/// Beyond this, distances to obstacles are not told apart, metres.
const REACH_M: f64 = 0.8;
/// A piece so far away and so near the middle of the picture, with nothing before it, should be seen.
pub(super) const PLAIN_VIEW_M: std::ops::Range<f64> = 1.3..4.0;
const PLAIN_VIEW_RAD: f64 = 0.4;
/// A line of sight passes walls by this, metres: a cell's middle lies half a cell off them at most.
const SIGHT_M: f64 = 0.08;

/// A dead time that changes by more than this is told, seconds.
const TELLING_S: f64 = 0.03;
/// Why the executive had to end early.
#[derive(Clone, Debug, PartialEq)]
pub enum Halt {
    /// No safe way; says to where.
    Blocked(String),
    /// What is asked for does not come about; says what.
    Stuck(String),
    /// The time allowed is used up.
    Timeout,
    /// Someone asked to stop.
    Stopped,
    /// The robot is held, by its STOP button or a stall; says by what.
    Held(String),
    /// The robot no longer answers; says why.
    LinkLost(String),
}

impl From<RobotError> for Halt {
    fn from(error: RobotError) -> Self {
        match error {
            RobotError::Link(_) => Self::LinkLost(error.to_string()),
            RobotError::Held(why) => Self::Held(why),
        }
    }
}

/// The robot with its eyes, what it believes, and the account of what it did.
pub struct Pilot<'a> {
    pub(super) base: &'a mut dyn MobileBase,
    eyes: &'a mut dyn Eyes,
    watcher: &'a mut dyn Watcher,
    pub(super) body: Body,
    pub(super) clearances: Clearances,
    pub(super) foresight: Foresight,
    idle: Idle,
    localizer: Localizer,
    rooms_only: ClearanceGrid,
    pub(super) grid: ClearanceGrid,
    /// Outlines of all furniture seen, which the sonars may hear instead of a wall.
    pub(super) outlines: Vec<Polygon>,
    /// Whether outlines are taken at their word, nothing being thought to reach beyond them, and narrow gaps are passed.
    pub(super) is_bold: bool,
    time_limit_s: f64,
    view: View,
    /// What has been seen so far.
    pub beliefs: Beliefs,
    /// What was done and why.
    pub journal: Journal,
}

impl<'a> Pilot<'a> {
    /// A pilot that knows the room map and nothing else.
    pub fn new(
        map: &RoomMap,
        base: &'a mut dyn MobileBase,
        eyes: &'a mut dyn Eyes,
        watcher: &'a mut dyn Watcher,
        time_limit_s: f64,
        odometry_only: bool,
    ) -> Self {
        let body = base.body();
        let foresight = Foresight::new(body, base.time_s(), base.dead_time_s());
        let localizer = Localizer::new(map, base, odometry_only);
        let rooms_only = grid_of(map);
        let grid = rooms_only.clone();
        let (beliefs, journal, view) = (Beliefs::default(), Journal::default(), View::default());
        Self {
            base,
            eyes,
            watcher,
            body,
            clearances: Clearances::of(&body),
            foresight,
            idle: Idle::default(),
            localizer,
            rooms_only,
            grid,
            outlines: Vec::new(),
            is_bold: false,
            time_limit_s,
            view,
            beliefs,
            journal,
        }
    }

    /// Where the robot believes it is.
    pub fn pose(&self) -> Pose {
        self.localizer.pose()
    }

    /// Where the robot will be, and how fast (m/s, rad/s), when the next command reaches it.
    pub(super) fn ahead(&self) -> (Pose, (f64, f64)) {
        self.foresight.ahead(self.pose(), self.base.velocity())
    }

    /// Whether the robot has a camera.
    pub fn can_see(&self) -> bool {
        self.eyes.can_see()
    }

    /// The planning grid: rooms and all furniture seen.
    pub fn grid(&self) -> &ClearanceGrid {
        &self.grid
    }

    /// Where the robot is and can go.
    pub fn ways(&self) -> Ways<'_> {
        let (grid, rooms) = (&self.grid, &self.rooms_only);
        let to_turn = self.clearances.to_turn;
        Ways { grid, rooms, from: self.pose().position(), to_turn, narrowest: self.narrowest() }
    }

    /// What the last look showed.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Notes a reason for the present action.
    pub fn because(&mut self, reason: impl Into<String>) {
        let reason = reason.into();
        let plain = reason.clone();
        self.because_plainly(reason, &plain);
    }

    /// The same, with plain words for those who look on and do not ask for figures.
    pub fn because_plainly(&mut self, reason: String, plain: &str) {
        let time_s = self.base.time_s();
        self.watcher.said(time_s, &reason);
        self.watcher.told(time_s, plain);
        self.journal.because(reason);
    }

    /// An action begins.
    pub fn begin(&mut self, action: &str) {
        self.watcher.said(self.base.time_s(), &format!("begin {action}"));
        self.journal.begin(action, self.base.time_s());
    }

    /// The present action is over.
    pub fn end(&mut self, result: &str) {
        self.watcher.said(self.base.time_s(), result);
        self.watcher.told(self.base.time_s(), result);
        self.journal.end(result, self.base.time_s());
    }

    /// Looks once and takes in what is seen; true when the furniture has changed.
    pub fn look(&mut self) -> bool {
        let view = self.eyes.look(self.pose());
        self.take_in(view)
    }

    /// Takes in what was seen on the way; true when the furniture has changed.
    pub fn glimpse(&mut self) -> bool {
        self.eyes.glimpse(self.localizer.pose()).is_some_and(|view| self.take_in(view))
    }

    fn take_in(&mut self, view: View) -> bool {
        let time_s = self.base.time_s();
        if let Some(frame) = self.eyes.frame() {
            self.watcher.frame(time_s, self.localizer.pose(), frame);
        }
        self.watcher.seen(time_s, &view);
        let taken_in = self.beliefs.take_in(&view, self.localizer.pose().position());
        let cleared = self.eyes.frame().is_some_and(|frame| self.beliefs.clear(frame));
        let changed = self.doubt(&view) || taken_in || cleared;
        self.view = view;
        if changed {
            self.rebuild_grid();
            self.watcher.furniture(time_s, &self.beliefs.furniture);
            self.watcher.grid(time_s, &self.grid);
        }
        changed
    }

    /// Doubts what should show in a look and does not; true when a piece is now taken to be not there.
    fn doubt(&mut self, view: &View) -> bool {
        let (pose, rooms) = (self.pose(), &self.rooms_only);
        let outlines: Vec<Polygon> = self.beliefs.furniture.iter().map(|f| f.footprint().clone()).collect();
        self.beliefs.doubt(view, |furniture| {
            let centre = furniture.centre();
            let between = |other: &&Polygon| other.edges().any(|(a, b)| segments_touch(pose.position(), centre, a, b));
            // Its own outline is crossed, too.
            PLAIN_VIEW_M.contains(&pose.distance_to(centre))
                && pose.bearing_to(centre).abs() < PLAIN_VIEW_RAD
                && rooms.clearance_along(pose.position(), centre) > SIGHT_M
                && outlines.iter().filter(between).count() <= 1
        })
    }

    /// From now on takes outlines at their word, and passes narrower gaps; or no longer does.
    pub fn be_bold(&mut self, is_bold: bool) {
        self.is_bold = is_bold;
        self.rebuild_grid();
    }

    pub(super) fn rebuild_grid(&mut self) {
        let there = self.beliefs.furniture.iter().filter(|furniture| !furniture.is_refuted());
        self.outlines.clear();
        self.grid = self.rooms_only.clone();
        for furniture in there {
            let margin = if self.is_bold { 0.0 } else { furniture.margin() };
            self.beliefs.free_space.add_to(&mut self.grid, furniture.footprint(), margin);
            self.outlines.push(furniture.footprint().clone());
        }
        for &bump in &self.beliefs.bumps {
            self.grid.add_polygon(&Polygon::rectangle(Pose::new(bump.x, bump.y, 0.0), 0.1, 0.1));
        }
    }

    /// Turns through `half_angle` to both sides of the present heading, looking every 30°, and comes back.
    ///
    /// # Errors
    /// When the robot is stopped or held fast, its time is up or its link lost.
    pub fn sweep(&mut self, half_angle: f64) -> Result<(), Halt> {
        let ahead = self.pose().heading;
        let looks = (half_angle / (PI / 6.0)).round().max(1.0) as i32;
        self.look();
        // Left first, then right: what lies ahead was seen by the look above.
        for step in (1..=looks).chain((1..=looks).map(|step| -step)).chain([0]) {
            self.turn_to(wrap_angle(ahead + half_angle * f64::from(step) / f64::from(looks)))?;
            self.look();
        }
        Ok(())
    }

    /// Lets one control period pass at these velocities (m/s, rad/s).
    pub(super) fn tick(&mut self, linear: f64, angular: f64) -> Result<(), Halt> {
        self.base.drive(linear, angular, TICK_S)?;
        let dead_time_s = self.foresight.dead_time_s();
        self.foresight.passed((linear, angular), self.base.time_s(), self.base.age_s(), self.base.velocity());
        let found_s = self.foresight.dead_time_s();
        if (found_s - dead_time_s).abs() > TELLING_S {
            self.watcher.said(self.base.time_s(), &format!("the base answers after {:.0} ms", found_s * 1000.0));
        }
        self.localizer.update(self.base, &self.outlines);
        let (time_s, pose) = (self.base.time_s(), self.pose());
        self.journal.passed(time_s, pose);
        self.watcher.sensed(self.base);
        if self.watcher.wants_stop() {
            return Err(Halt::Stopped);
        }
        self.idle.passed((linear, angular), self.base.velocity(), time_s).map_err(Halt::Stuck)?;
        if time_s > self.time_limit_s { Err(Halt::Timeout) } else { Ok(()) }
    }
}

/// The planning grid of a room map, without furniture.
pub fn grid_of(map: &RoomMap) -> ClearanceGrid {
    let walls = map.walls();
    let corners = walls.iter().flat_map(|&(a, b)| [a, b]);
    let (low, high) = corners.fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(low, high), c| {
        (low.inf(&c), high.sup(&c))
    });
    let mut grid = ClearanceGrid::new(low, high, CELL_M, REACH_M);
    for (a, b) in walls {
        grid.add_segment(a, b);
    }
    grid
}
