//! The upper tier: enter the room, navigate inside it, find the object.

use std::f64::consts::PI;

use super::motion::{Landmark, RoomFrame, Step, step_for};
use super::pilot::Pilot;
use super::relation::{Place, angle_of};
use super::search::{Wanted, references};
use super::telling::telling;
use super::visits::{Care, visits};
use super::{Halt, Journal, Watcher};
use crate::geometry::{Polygon, Pose, Vec2};
use crate::language::Lexicon;
use crate::map::{Room, RoomMap};
use crate::perception::Eyes;
use crate::record::{Action, Amount, Delivery, Outcome, Plan};
use crate::robot::MobileBase;

/// Half of the turn in which the robot looks for its target.
pub(super) const SWEEP_RAD: f64 = 2.0 * PI / 3.0;
/// Places that can be passed over in one errand: nobody says "the other one" more often.
pub const MOST_PASSED_OVER: usize = 4;

/// How the executive goes about it.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Room and object only, nearest table first: what the words are worth is measured against this.
    pub blind: bool,
    /// Read each relation in its likeliest frame only.
    pub one_frame: bool,
    /// Use only the first reference–direction pair, as the previous system did.
    pub first_pair_only: bool,
    /// Do not fall back to table-like furniture the words do not fit.
    pub no_fallback: bool,
    /// Do not go straight to an object recognised in passing: the words alone choose.
    pub no_glance: bool,
    /// Believe the odometry alone.
    pub no_localization: bool,
    /// Say where the object was found as a person would.
    pub describe: bool,
    /// Seconds of robot time a trial may take.
    pub time_limit_s: f64,
    /// Where a person said it is not: what stands or was seen there is passed over. Metres.
    pub passed_over: [Option<Vec2>; MOST_PASSED_OVER],
    /// Where the speaker is, in the map; where the robot starts when nothing tells.
    pub speaker: Option<Pose>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            blind: false,
            one_frame: false,
            first_pair_only: false,
            no_fallback: false,
            no_glance: false,
            no_localization: false,
            describe: false,
            time_limit_s: 900.0,
            passed_over: [None; MOST_PASSED_OVER],
            speaker: None,
        }
    }
}

/// How a run ended, as far as the robot knows.
#[derive(Clone, Debug)]
pub struct Report {
    /// How it ended.
    pub outcome: Outcome,
    /// One sentence that says why it ended so.
    pub why: String,
    /// Centres of the furniture approached, in order, metres.
    pub approached: Vec<Vec2>,
    /// Where the object was recognised, metres.
    pub found_at: Option<Vec2>,
    /// What was brought where.
    pub delivered: Vec<Delivery>,
    /// Where the robot believes to be at the end.
    pub pose: Pose,
    /// Where the object was found, as a person would say it; where that was asked for.
    pub description: Option<String>,
    /// What was done and why.
    pub journal: Journal,
}

/// Runs plans on a robot it knows only by its sensors.
pub struct Executive<'a> {
    pub(super) map: &'a RoomMap,
    pub(super) pilot: Pilot<'a>,
    pub(super) options: Options,
    pub(super) lexicon: &'static Lexicon,
    pub(super) approached: Vec<Vec2>,
    pub(super) found_at: Option<Vec2>,
    description: Option<String>,
    pub(super) delivered: Vec<Delivery>,
    /// Where the speaker is.
    pub(super) start: Pose,
}

/// The parts of a plan.
pub(super) struct Task<'p> {
    rooms: Vec<&'p str>,
    steps: Vec<&'p Action>,
    pub(super) wanted: Wanted,
    pub(super) object: Option<&'p str>,
    /// Further objects of the errand.
    further: Vec<&'p str>,
}

impl Task<'_> {
    /// Whether the words name neither a thing nor a place where one could be.
    fn looks_for_nothing(&self) -> bool {
        let wanted = &self.wanted;
        let is_placed = wanted.target.is_some() || !wanted.pairs.is_empty();
        self.object.is_none() && !is_placed && wanted.attributes.is_empty() && wanted.ordinal.is_none()
    }
}

impl<'a> Executive<'a> {
    /// An executive for one trial.
    pub fn new(
        map: &'a RoomMap,
        base: &'a mut dyn MobileBase,
        eyes: &'a mut dyn Eyes,
        watcher: &'a mut dyn Watcher,
        options: Options,
    ) -> Self {
        let mut pilot = Pilot::new(map, base, eyes, watcher, options.time_limit_s, options.no_localization);
        pilot.beliefs.passed_over = options.passed_over.into_iter().flatten().collect();
        let start = options.speaker.unwrap_or(pilot.pose());
        Self {
            map,
            pilot,
            options,
            lexicon: Lexicon::embedded(),
            approached: Vec::new(),
            found_at: None,
            description: None,
            delivered: Vec::new(),
            start,
        }
    }

    /// Runs the plan to its end.
    pub fn run(mut self, plan: &Plan) -> Report {
        let (outcome, why) = match self.fetch(plan) {
            Ok(ending) => ending,
            Err(Halt::Blocked(why)) => (Outcome::Blocked, format!("{}{why}", self.pilot.journal.during())),
            Err(Halt::Timeout) => {
                let (during, limit) = (self.pilot.journal.during(), self.options.time_limit_s);
                (Outcome::Timeout, format!("{during}not found within {limit} s"))
            }
            Err(Halt::Stuck(why)) => (Outcome::Stuck, format!("{}{why}", self.pilot.journal.during())),
            Err(Halt::Stopped) => (Outcome::Stopped, "told to stop".to_string()),
            Err(Halt::Held(why)) => (Outcome::Stopped, why),
            Err(Halt::LinkLost(why)) => (Outcome::LinkLost, why),
        };
        self.pilot.end(&why);
        let pose = self.pilot.pose();
        Report {
            outcome,
            why,
            approached: self.approached,
            found_at: self.found_at,
            delivered: self.delivered,
            pose,
            description: self.description,
            journal: self.pilot.journal,
        }
    }

    fn fetch(&mut self, plan: &Plan) -> Result<(Outcome, String), Halt> {
        if plan.actions.is_empty() {
            let problems = plan.problems.join("; ");
            return Ok((Outcome::NotFound, format!("nothing to do: {problems}")));
        }
        let mut told: Vec<String> = Vec::new();
        let mut outcome = Outcome::Arrived;
        for errand in errands(&plan.actions) {
            let (ended, why) = self.errand(errand)?;
            told.push(why);
            outcome = ended;
            if !matches!(ended, Outcome::Found | Outcome::Arrived) {
                break;
            }
        }
        Ok((outcome, told.join("; ")))
    }

    /// One errand: to the room, inside it, find everything, bring it.
    fn errand(&mut self, actions: &[Action]) -> Result<(Outcome, String), Halt> {
        let mut task = self.task_of(actions);
        if !self.options.blind && task.looks_for_nothing() {
            return self.only_move(actions, &task);
        }
        let mut why = String::new();
        let visits = visits(&task.rooms);
        for (i, &(room, care)) in visits.iter().enumerate() {
            if let Err(halt) = self.enter(room) {
                match halt {
                    Halt::Blocked(reason) if i + 1 < visits.len() => self.pilot.end(&format!("blocked: {reason}")),
                    halt => return Err(halt),
                }
                continue;
            }
            let frame = RoomFrame::of(self.map, room, self.pilot.pose());
            for action in task.steps.iter().filter(|_| care != Care::Again) {
                self.step(action, &frame)?;
            }
            if !self.pilot.can_see() {
                let why = without_camera(actions);
                self.deliver_all(actions)?;
                return Ok((Outcome::Arrived, why));
            }
            match self.search(&task, &frame, care)? {
                Ok(found) => {
                    why = found;
                    self.describe(&task, room, &frame);
                }
                Err(reason) => {
                    why = reason;
                    continue;
                }
            }
            for object in std::mem::take(&mut task.further) {
                task.object = Some(object);
                self.pilot.end(&why);
                self.pilot.beliefs.search_anew();
                match self.search(&task, &frame, Care::Whole)? {
                    Ok(found) => why = format!("{why}; {found}"),
                    Err(reason) => return Ok((Outcome::NotFound, format!("{why}; {reason}"))),
                }
            }
            self.pilot.end(&why);
            if let Some(brought) = self.deliver_all(actions)? {
                why = format!("{why}; {brought}");
            }
            return Ok((Outcome::Found, why));
        }
        Ok((Outcome::NotFound, why))
    }

    /// Notes where the object was found, as someone who comes into the room would be told.
    fn describe(&mut self, task: &Task, room: &str, frame: &RoomFrame) {
        let Some(found) = self.found_at.filter(|_| self.options.describe) else { return };
        let place = Place { room: frame, arrived: frame.entry };
        self.description = telling(&self.pilot.beliefs, found, task.object, room, place, self.lexicon);
    }

    /// Where nothing to look for was named, the robot goes where it was told to: into the room that was said, else
    /// from where it stands.
    fn only_move(&mut self, actions: &[Action], task: &Task) -> Result<(Outcome, String), Halt> {
        let said = actions.iter().find_map(|action| match action {
            Action::Enter { room, .. } => room.as_deref(),
            _ => None,
        });
        if let Some(room) = said {
            self.enter(room)?;
        }
        let here = self.map.room_at(self.pilot.pose().position()).map(|room| room.name.clone());
        if let Some(here) = here {
            let frame = RoomFrame::of(self.map, &here, self.pilot.pose());
            for action in &task.steps {
                self.step(action, &frame)?;
            }
        }
        let brought = self.deliver_all(actions)?;
        let place = self.map.room_at(self.pilot.pose().position()).map(|room| room.name.replace('_', " "));
        let place = place.map_or(String::new(), |room| format!("in the {room}; "));
        Ok((Outcome::Arrived, brought.unwrap_or_else(|| format!("{place}nothing to look for was named"))))
    }

    fn task_of<'p>(&self, actions: &'p [Action]) -> Task<'p> {
        let wanted = Wanted::default();
        let mut task = Task { rooms: Vec::new(), steps: Vec::new(), wanted, object: None, further: Vec::new() };
        let mut finds = 0;
        for action in actions {
            match action {
                Action::Enter { room, candidates } => {
                    task.rooms = room.iter().chain(candidates).map(String::as_str).collect();
                }
                Action::Find { object } => {
                    match object.as_deref() {
                        object if finds == 0 => task.object = object,
                        object => task.further.extend(object),
                    }
                    finds += 1;
                }
                Action::Search { .. } | Action::Deliver { .. } => {}
                step if !self.options.blind => task.steps.push(step),
                _ => {}
            }
        }
        task.wanted = match Wanted::of(actions) {
            Some(wanted) if !self.options.blind => Wanted { one_frame: self.options.one_frame, ..wanted },
            _ => Wanted { nearest_first: self.options.blind, ..Wanted::default() },
        };
        if self.options.first_pair_only {
            task.wanted.pairs.truncate(1);
        }
        task
    }

    pub(super) fn enter(&mut self, room: &str) -> Result<(), Halt> {
        self.pilot.begin("enter");
        let name = room.replace('_', " ");
        let Some(outline) = self.map.room(room).map(Room::polygon) else {
            return Err(Halt::Blocked(format!("the map has no room `{room}`")));
        };
        if outline.contains(self.pilot.pose().position()) {
            self.pilot.because("already there");
        } else if let Some(entry) = self.map.entry_pose(room) {
            let reason = format!("the {name} is entered at ({:.1}, {:.1})", entry.x, entry.y);
            self.pilot.because_plainly(reason, &format!("going into the {name}"));
            self.pilot.go_to_pose(entry)?;
        } else {
            self.pilot.go_into(&outline, &name)?;
        }
        self.pilot.end(&format!("in the {name}"));
        Ok(())
    }

    /// One dynamic step. What cannot be done is said and left out: later words may still lead there.
    fn step(&mut self, action: &Action, room: &RoomFrame) -> Result<(), Halt> {
        self.pilot.begin(if matches!(action, Action::Move { .. }) { "move" } else { "go" });
        let landmark = self.landmark_of(action, room)?;
        let landmark = landmark.as_ref().map(|(footprint, towards)| Landmark { footprint, towards: *towards });
        let done = match step_for(action, self.pilot.pose(), room, landmark.as_ref()) {
            Some(Step::Turn(heading)) => self.pilot.turn_to(heading),
            Some(Step::Drive(to)) => self.pilot.go_to_pose(to),
            None => {
                self.pilot.end("left out");
                return Ok(());
            }
        };
        match done {
            Err(Halt::Blocked(why)) => self.pilot.end(&format!("went as far as possible: {why}")),
            Err(halt) => return Err(halt),
            Ok(()) => {
                let pose = self.pilot.pose();
                self.pilot.end(&format!("at ({:.1}, {:.1}) heading {:.0}°", pose.x, pose.y, pose.heading.to_degrees()));
            }
        }
        Ok(())
    }

    /// The furniture an action names: the one nearest ahead, and where to stand by it.
    fn landmark_of(&mut self, action: &Action, room: &RoomFrame) -> Result<Option<(Polygon, Option<f64>)>, Halt> {
        let (noun, direction) = match action {
            Action::Go { reference, direction, frame, .. } => (reference.thing(), Some((*direction, *frame))),
            Action::Move { amount: Some(Amount::Until(what)), .. } => (what.thing(), None),
            _ => return Ok(None),
        };
        let Some(noun) = noun else { return Ok(None) };
        if references(&self.pilot.beliefs, noun, self.lexicon).is_empty() {
            self.pilot.sweep(SWEEP_RAD)?;
        }
        let here = self.pilot.pose();
        let off = |(i, _): &(usize, f64)| {
            let centre = self.pilot.beliefs.furniture[*i].centre();
            here.bearing_to(centre).abs() + 0.3 * here.distance_to(centre)
        };
        let nearest =
            references(&self.pilot.beliefs, noun, self.lexicon).into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let Some((index, _)) = nearest else {
            self.pilot.because(format!("no {} seen from here", noun.replace('_', " ")));
            return Ok(None);
        };
        let furniture = &self.pilot.beliefs.furniture[index];
        let place = Place { room, arrived: here };
        let towards =
            direction.and_then(|(direction, frame)| angle_of(direction, frame, place, furniture.detection().yaw));
        let result = (furniture.footprint().clone(), towards);
        let label = furniture.label();
        self.pilot.because(format!("by {label}"));
        Ok(Some(result))
    }
}

/// The actions errand by errand: each begins with a room to enter.
fn errands(actions: &[Action]) -> Vec<&[Action]> {
    let starts = (0..actions.len()).filter(|&at| at == 0 || matches!(actions[at], Action::Enter { .. }));
    let mut bounds: Vec<usize> = starts.collect();
    bounds.push(actions.len());
    bounds.windows(2).map(|pair| &actions[pair[0]..pair[1]]).collect()
}

/// What a robot without a camera has left undone.
fn without_camera(actions: &[Action]) -> String {
    let wanted = actions.iter().find_map(|action| match action {
        Action::Search { target: Some(target), .. } => Some(target.replace('_', " ")),
        Action::Find { object: Some(object) } => Some(object.replace('_', " ")),
        _ => None,
    });
    match wanted {
        Some(wanted) => format!("the moves are done; to look for the {wanted} a camera is needed (--camera FILE)"),
        None => "the moves are done".to_string(),
    }
}
