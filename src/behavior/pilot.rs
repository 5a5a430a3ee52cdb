//! Drives, turns and looks: what every step of the executive is made of.

use std::f64::consts::PI;

use super::route::route;
use super::{Beliefs, Journal, Watcher};
use crate::geometry::{ClearanceGrid, Polygon, Pose, Vec2, vec2, wrap_angle};
use crate::perception::{Eyes, View};
use crate::robot::{MobileBase, RobotError};
use crate::world::RoomMap;

/// Control period, seconds.
const TICK_S: f64 = 0.1;
/// Ticks between two looks while driving.
const TICKS_PER_LOOK: usize = 6;
/// The P3DX turns in place within 0.368 m; what is planned keeps this clear, metres.
pub const SWING_M: f64 = 0.43;
/// What a route may shrink to before it is planned anew, metres.
const LEAST_M: f64 = 0.39;
/// Cell of the planning grid, metres.
const CELL_M: f64 = 0.1;
/// Beyond this, distances to obstacles are not told apart, metres.
const REACH_M: f64 = 0.8;
/// Speeds and the braking they count on.
const SPEED_M_S: f64 = 0.5;
const TURN_RAD_S: f64 = 1.2;
const BRAKE_M_S2: f64 = 0.25;
const TURN_BRAKE_RAD_S2: f64 = 0.8;
/// How near a driven-to point must be, metres, and a turned-to heading, radians.
const NEAR_M: f64 = 0.06;
const NEAR_RAD: f64 = 0.03;
/// Off the line by more than this, the robot stops and turns first, radians.
const OFF_LINE_RAD: f64 = 0.35;
/// The sonar's last word: nothing ahead nearer than this, metres from the sonar.
const GUARD_M: f64 = 0.15;
/// Sonars within this of straight ahead watch the way, radians.
const GUARD_RAD: f64 = 0.7;
/// How often a blocked way is planned anew before the robot gives up.
const MOST_REPLANS: usize = 8;

/// Why the executive had to end early.
#[derive(Clone, Debug, PartialEq)]
pub enum Halt {
    /// No safe way; says to where.
    Blocked(String),
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
    base: &'a mut dyn MobileBase,
    eyes: &'a mut dyn Eyes,
    watcher: &'a mut dyn Watcher,
    rooms_only: ClearanceGrid,
    grid: ClearanceGrid,
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
    ) -> Self {
        let rooms_only = grid_of(map);
        let grid = rooms_only.clone();
        let (beliefs, journal, view) = (Beliefs::default(), Journal::default(), View::default());
        Self { base, eyes, watcher, rooms_only, grid, time_limit_s, view, beliefs, journal }
    }

    /// Where the robot believes it is.
    pub fn pose(&self) -> Pose {
        self.base.pose()
    }

    /// Whether the robot has a camera.
    pub fn can_see(&self) -> bool {
        self.eyes.can_see()
    }

    /// The planning grid: rooms and all furniture seen.
    pub fn grid(&self) -> &ClearanceGrid {
        &self.grid
    }

    /// The grid of the rooms alone.
    pub fn rooms(&self) -> &ClearanceGrid {
        &self.rooms_only
    }

    /// What the last look showed.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Notes a reason for the present action.
    pub fn because(&mut self, reason: impl Into<String>) {
        let reason = reason.into();
        self.watcher.said(self.base.time_s(), &reason);
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
        self.journal.end(result, self.base.time_s());
    }

    /// Looks once and takes in what is seen; true when the furniture has changed.
    pub fn look(&mut self) -> bool {
        let view = self.eyes.look(self.base.pose());
        let time_s = self.base.time_s();
        if let Some(frame) = self.eyes.frame() {
            self.watcher.frame(time_s, self.base.pose(), frame);
        }
        let changed = self.beliefs.take_in(&view);
        self.view = view;
        if changed {
            self.rebuild_grid();
            self.watcher.furniture(time_s, &self.beliefs.furniture);
            self.watcher.grid(time_s, &self.grid);
        }
        changed
    }

    fn rebuild_grid(&mut self) {
        self.grid = self.rooms_only.clone();
        for furniture in &self.beliefs.furniture {
            self.grid.add_polygon(&furniture.footprint);
        }
        for &bump in &self.beliefs.bumps {
            self.grid.add_polygon(&Polygon::rectangle(Pose::new(bump.x, bump.y, 0.0), 0.1, 0.1));
        }
    }

    /// Turns through `half_angle` to both sides of the present heading, looking every 30°, and comes back.
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

    /// Turns in place to a heading, radians.
    pub fn turn_to(&mut self, heading: f64) -> Result<(), Halt> {
        self.come_to_rest()?;
        loop {
            let off = wrap_angle(heading - self.pose().heading);
            let turning = self.base.velocity().1;
            if off.abs() < NEAR_RAD && turning.abs() < 0.05 {
                return self.come_to_rest();
            }
            let fastest = (2.0 * TURN_BRAKE_RAD_S2 * off.abs()).sqrt().min(TURN_RAD_S);
            self.tick(0.0, off.signum() * fastest.min(off.abs() / TICK_S * 0.5))?;
        }
    }

    /// Drives to a point, metres, round everything known.
    pub fn go_to(&mut self, goal: Vec2) -> Result<(), Halt> {
        for _ in 0..MOST_REPLANS {
            let Some(points) = route(&self.grid, self.pose().position(), goal, SWING_M) else {
                return Err(Halt::Blocked(format!("no way to ({:.1}, {:.1})", goal.x, goal.y)));
            };
            if self.follow(&points)? {
                return Ok(());
            }
        }
        Err(Halt::Blocked(format!("every way to ({:.1}, {:.1}) turned out blocked", goal.x, goal.y)))
    }

    /// Drives to a pose and turns to its heading.
    pub fn go_to_pose(&mut self, goal: Pose) -> Result<(), Halt> {
        self.go_to(goal.position())?;
        self.turn_to(goal.heading)?;
        self.look();
        Ok(())
    }

    /// True at the last point; false when what was seen on the way closed it.
    fn follow(&mut self, points: &[Vec2]) -> Result<bool, Halt> {
        for (i, &point) in points.iter().enumerate() {
            let is_last = i + 1 == points.len();
            if !self.drive_line(point, &points[i..], is_last)? {
                self.come_to_rest()?;
                return Ok(false);
            }
        }
        self.come_to_rest()?;
        Ok(true)
    }

    fn drive_line(&mut self, point: Vec2, rest: &[Vec2], is_last: bool) -> Result<bool, Halt> {
        let near = if is_last { NEAR_M } else { 2.0 * NEAR_M };
        let mut ticks = 0;
        while self.pose().distance_to(point) > near {
            let off = self.pose().bearing_to(point);
            if off.abs() > OFF_LINE_RAD {
                let heading = wrap_angle(self.pose().heading + off);
                self.turn_to(heading)?;
            }
            let free = self.guarded_distance();
            if free <= 0.0 {
                return self.met_something();
            }
            let distance = self.pose().distance_to(point);
            let fastest = (2.0 * BRAKE_M_S2 * distance.min(free)).sqrt().clamp(0.05, SPEED_M_S);
            self.tick(fastest * off.cos(), (1.5 * off).clamp(-TURN_RAD_S, TURN_RAD_S))?;
            ticks += 1;
            if ticks % TICKS_PER_LOOK == 0 && self.look() && !self.still_clear(rest) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn still_clear(&self, rest: &[Vec2]) -> bool {
        let mut at = self.pose().position();
        rest.iter().all(|&point| {
            let clear = self.grid.clearance_along(at, point) >= LEAST_M;
            at = point;
            clear
        })
    }

    /// Metres the robot may still go before the sonars' limit.
    fn guarded_distance(&self) -> f64 {
        let ahead = self.base.sonar().iter().filter(|reading| reading.bearing.abs() <= GUARD_RAD);
        ahead.map(|reading| reading.range_m - GUARD_M).fold(f64::INFINITY, f64::min)
    }

    /// The sonar found something the eyes had not: remember it, and plan anew.
    fn met_something(&mut self) -> Result<bool, Halt> {
        self.come_to_rest()?;
        let pose = self.pose();
        let ahead = self.base.sonar().iter().filter(|reading| reading.bearing.abs() <= GUARD_RAD);
        if let Some(nearest) = ahead.min_by(|a, b| a.range_m.total_cmp(&b.range_m)) {
            let direction = vec2(nearest.bearing.cos(), nearest.bearing.sin());
            let point = pose.to_world(nearest.mount + direction * nearest.range_m);
            self.beliefs.bumps.push(point);
            self.because(format!("the sonar met something at ({:.1}, {:.1}); going round", point.x, point.y));
        }
        self.rebuild_grid();
        Ok(false)
    }

    fn come_to_rest(&mut self) -> Result<(), Halt> {
        loop {
            let (linear, angular) = self.base.velocity();
            if linear.abs() < 0.01 && angular.abs() < 0.02 {
                return Ok(());
            }
            self.tick(0.0, 0.0)?;
        }
    }

    fn tick(&mut self, linear: f64, angular: f64) -> Result<(), Halt> {
        self.base.drive(linear, angular, TICK_S)?;
        let (time_s, pose) = (self.base.time_s(), self.base.pose());
        self.journal.passed(time_s, pose);
        self.watcher.sensed(self.base);
        if self.watcher.wants_stop() {
            return Err(Halt::Stopped);
        }
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
