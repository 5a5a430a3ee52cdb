//! The upper tier: enter the room, navigate inside it, find the object.

use std::f64::consts::PI;

use super::approach::{better_view, viewpoints};
use super::motion::{Landmark, RoomFrame, Step, step_for};
use super::pilot::Pilot;
use super::regions::lookouts;
use super::relation::{Place, angle_of};
use super::search::{Ranked, Wanted, rank, references};
use super::{Halt, Journal, Watcher};
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::language::Lexicon;
use crate::perception::{Eyes, ObjectSighting};
use crate::record::{Action, Amount, Outcome, Plan};
use crate::robot::MobileBase;
use crate::world::RoomMap;

/// Half of the turn in which the robot looks for its target.
const SWEEP_RAD: f64 = 2.0 * PI / 3.0;
/// A best candidate below this is a guess: look further before going there.
const PLAUSIBLE: f64 = 0.12;

/// How often the robot moves to tell for sure what it sees.
const MOST_SETTLING: usize = 3;

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
    /// Seconds of robot time a trial may take.
    pub time_limit_s: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            blind: false,
            one_frame: false,
            first_pair_only: false,
            no_fallback: false,
            no_glance: false,
            time_limit_s: 900.0,
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
    /// What was done and why.
    pub journal: Journal,
}

/// Runs plans on a robot it knows only by its sensors.
pub struct Executive<'a> {
    map: &'a RoomMap,
    pilot: Pilot<'a>,
    options: Options,
    lexicon: &'static Lexicon,
    approached: Vec<Vec2>,
    found_at: Option<Vec2>,
}

/// The parts of a plan.
struct Task<'p> {
    rooms: Vec<&'p str>,
    steps: Vec<&'p Action>,
    wanted: Wanted,
    object: Option<&'p str>,
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
        let pilot = Pilot::new(map, base, eyes, watcher, options.time_limit_s);
        Self { map, pilot, options, lexicon: Lexicon::embedded(), approached: Vec::new(), found_at: None }
    }

    /// Runs the plan to its end.
    pub fn run(mut self, plan: &Plan) -> Report {
        let (outcome, why) = match self.fetch(plan) {
            Ok(ending) => ending,
            Err(Halt::Blocked(why)) => (Outcome::Blocked, why),
            Err(Halt::Timeout) => (Outcome::Timeout, format!("not found within {} s", self.options.time_limit_s)),
            Err(Halt::Stopped) => (Outcome::Stopped, "told to stop".to_string()),
            Err(Halt::Held(why)) => (Outcome::Stopped, why),
            Err(Halt::LinkLost(why)) => (Outcome::LinkLost, why),
        };
        self.pilot.end(&why);
        Report { outcome, why, approached: self.approached, found_at: self.found_at, journal: self.pilot.journal }
    }

    fn fetch(&mut self, plan: &Plan) -> Result<(Outcome, String), Halt> {
        if plan.actions.is_empty() {
            let problems = plan.problems.join("; ");
            return Ok((Outcome::NotFound, format!("nothing to do: {problems}")));
        }
        let task = self.task_of(plan);
        let mut why = String::new();
        for (i, room) in task.rooms.iter().enumerate() {
            if let Err(halt) = self.enter(room) {
                match halt {
                    Halt::Blocked(reason) if i + 1 < task.rooms.len() => self.pilot.end(&format!("blocked: {reason}")),
                    halt => return Err(halt),
                }
                continue;
            }
            let frame = self.frame_of(room);
            for action in &task.steps {
                self.step(action, &frame)?;
            }
            if !self.pilot.can_see() {
                return Ok((Outcome::Arrived, without_camera(plan)));
            }
            match self.search(&task, &frame)? {
                Ok(found) => return Ok((Outcome::Found, found)),
                Err(reason) => why = reason,
            }
        }
        Ok((Outcome::NotFound, why))
    }

    fn task_of<'p>(&self, plan: &'p Plan) -> Task<'p> {
        let mut task = Task { rooms: Vec::new(), steps: Vec::new(), wanted: Wanted::default(), object: None };
        for action in &plan.actions {
            match action {
                Action::Enter { room, candidates } => {
                    task.rooms = room.iter().chain(candidates).map(String::as_str).collect();
                }
                Action::Search { target, attributes, ordinal, pairs } if !self.options.blind => {
                    task.wanted = Wanted {
                        target: target.clone(),
                        attributes: attributes.clone(),
                        ordinal: *ordinal,
                        pairs: pairs.clone(),
                        one_frame: self.options.one_frame,
                        nearest_first: false,
                    };
                }
                Action::Find { object } => task.object = object.as_deref(),
                Action::Search { .. } => task.wanted.nearest_first = true,
                step if !self.options.blind => task.steps.push(step),
                _ => {}
            }
        }
        if self.options.first_pair_only {
            task.wanted.pairs.truncate(1);
        }
        task
    }

    fn frame_of(&self, room: &str) -> RoomFrame {
        let here = self.pilot.pose();
        let outline = self.map.room(room).map(|room| room.polygon());
        let entry = self.map.entry_pose(room).unwrap_or(here);
        RoomFrame { outline: outline.unwrap_or_else(|| Polygon::rectangle(here, 1.0, 1.0)), entry }
    }

    fn enter(&mut self, room: &str) -> Result<(), Halt> {
        self.pilot.begin("enter");
        let Some(entry) = self.map.entry_pose(room) else {
            return Err(Halt::Blocked(format!("the map has no way into the room `{room}`")));
        };
        if self.map.room(room).is_some_and(|room| room.polygon().contains(self.pilot.pose().position())) {
            self.pilot.because("already there");
        } else {
            self.pilot.because(format!(
                "the {} is entered at ({:.1}, {:.1})",
                room.replace('_', " "),
                entry.x,
                entry.y
            ));
            self.pilot.go_to_pose(entry)?;
        }
        self.pilot.end(&format!("in the {}", room.replace('_', " ")));
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
            Action::Go { reference, direction, frame, .. } => (reference, Some((*direction, *frame))),
            Action::Move { amount: Some(Amount::Until(noun)), .. } if noun != "wall" => (noun, None),
            _ => return Ok(None),
        };
        if matches!(noun.as_str(), "room" | "wall" | "door") {
            return Ok(None);
        }
        if references(&self.pilot.beliefs, noun, self.lexicon).is_empty() {
            self.pilot.sweep(SWEEP_RAD)?;
        }
        let here = self.pilot.pose();
        let off = |i: &usize| {
            let centre = self.pilot.beliefs.furniture[*i].centre();
            here.bearing_to(centre).abs() + 0.3 * here.distance_to(centre)
        };
        let nearest =
            references(&self.pilot.beliefs, noun, self.lexicon).into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let Some(index) = nearest else {
            self.pilot.because(format!("no {} seen from here", noun.replace('_', " ")));
            return Ok(None);
        };
        let furniture = &self.pilot.beliefs.furniture[index];
        let place = Place { room, arrived: here };
        let towards =
            direction.and_then(|(direction, frame)| angle_of(direction, frame, place, furniture.detection.yaw));
        let result = (furniture.footprint.clone(), towards);
        let label = furniture.label();
        self.pilot.because(format!("by {label}"));
        Ok(Some(result))
    }

    /// The static tier. `Ok` says at what the object was found, `Err` why it was not.
    fn search(&mut self, task: &Task, room: &RoomFrame) -> Result<Result<String, String>, Halt> {
        self.pilot.begin("search");
        let arrived = self.pilot.pose();
        self.pilot.sweep(SWEEP_RAD)?;
        self.look_further(task, room, arrived)?;
        if let Some(found) = self.try_candidates(task, room, arrived, &task.wanted)? {
            return Ok(Ok(found));
        }
        if !self.options.no_fallback {
            self.pilot.because("nothing the words fit holds it; trying all other table-like furniture, nearest first");
            if let Some(found) = self.try_candidates(task, room, self.pilot.pose(), &Wanted::default())? {
                return Ok(Ok(found));
            }
            for lookout in lookouts(self.pilot.grid(), room, self.pilot.pose().position()) {
                self.look_round_at(lookout)?;
                if let Some(found) = self.try_candidates(task, room, self.pilot.pose(), &Wanted::default())? {
                    return Ok(Ok(found));
                }
            }
        }
        let object = task.object.unwrap_or("any portable object").replace('_', " ");
        let why = format!("no {object} on any of {} pieces of furniture looked at", self.approached.len());
        self.pilot.end(&why);
        Ok(Err(why))
    }

    /// While the best candidate is a guess, or a landmark that was named has not been seen, looks from elsewhere.
    fn look_further(&mut self, task: &Task, room: &RoomFrame, arrived: Pose) -> Result<(), Halt> {
        for lookout in lookouts(self.pilot.grid(), room, arrived.position()) {
            let place = Place { room, arrived };
            let best = rank(&self.pilot.beliefs, &task.wanted, place, self.lexicon).first().map_or(0.0, |r| r.score);
            let missing = self.missing_reference(&task.wanted);
            if best >= PLAUSIBLE && missing.is_none() {
                return Ok(());
            }
            let reason =
                missing.map_or("nothing here fits the words well".to_string(), |noun| format!("no {noun} seen yet"));
            self.pilot.because(format!("{reason}; looking from ({:.1}, {:.1})", lookout.x, lookout.y));
            self.look_round_at(lookout)?;
        }
        Ok(())
    }

    fn missing_reference(&self, wanted: &Wanted) -> Option<String> {
        let unseen = |noun: &str| {
            let is_furniture = self.lexicon.class_of(noun).is_some_and(|class| class != crate::language::Class::Object);
            let is_place = matches!(noun, "robot" | "move" | "room" | "wall" | "door");
            is_furniture && !is_place && references(&self.pilot.beliefs, noun, self.lexicon).is_empty()
        };
        let nouns = wanted.pairs.iter().map(|pair| pair.pair.reference.as_str());
        nouns.into_iter().find(|noun| unseen(noun)).map(|noun| noun.replace('_', " "))
    }

    fn look_round_at(&mut self, lookout: Vec2) -> Result<(), Halt> {
        match self.pilot.go_to(lookout) {
            Ok(()) => self.pilot.sweep(PI),
            Err(Halt::Blocked(_)) => Ok(()),
            Err(halt) => Err(halt),
        }
    }

    fn try_candidates(
        &mut self,
        task: &Task,
        room: &RoomFrame,
        arrived: Pose,
        wanted: &Wanted,
    ) -> Result<Option<String>, Halt> {
        loop {
            let here = if self.options.blind { self.pilot.pose() } else { arrived };
            let ranked = rank(&self.pilot.beliefs, wanted, Place { room, arrived: here }, self.lexicon);
            let inside = |r: &&Ranked| room.outline.contains(self.pilot.beliefs.furniture[r.index].centre());
            let ranked: Vec<&Ranked> = ranked.iter().filter(inside).collect();
            let Some(choice) = self.choose(task, &ranked) else { return Ok(None) };
            if let Some(found) = self.check(choice, task.object)? {
                return Ok(Some(found));
            }
        }
    }

    /// The furniture on which the object was seen in passing, else the best ranked.
    fn choose(&mut self, task: &Task, ranked: &[&Ranked]) -> Option<usize> {
        let glances = !self.options.blind && !self.options.no_glance;
        let seen = task.object.filter(|_| glances).and_then(|name| self.pilot.beliefs.sighting(Some(name)));
        if let Some(index) = seen.and_then(|sighting| self.pilot.beliefs.under(vec2(sighting.x, sighting.y)))
            && !self.pilot.beliefs.furniture[index].searched
        {
            let label = self.pilot.beliefs.furniture[index].label();
            self.pilot.because(format!("{label}: the object was seen on it in passing"));
            return Some(index);
        }
        let best = ranked.first()?;
        let describe =
            |r: &Ranked| format!("{} {:.2} ({})", self.pilot.beliefs.furniture[r.index].label(), r.score, r.reading);
        let mut reason = describe(best);
        if let Some(next) = ranked.get(1) {
            reason = format!("{reason} before {}", describe(next));
        }
        self.pilot.because(reason);
        Some(best.index)
    }

    /// Goes where the furniture's top can be seen, and looks for the object.
    fn check(&mut self, index: usize, object: Option<&str>) -> Result<Option<String>, Halt> {
        let furniture = self.pilot.beliefs.furniture[index].clone();
        self.pilot.beliefs.furniture[index].searched = true;
        let poses = viewpoints(self.pilot.grid(), self.pilot.rooms(), self.pilot.pose().position(), &furniture);
        let mut reached = false;
        for pose in poses {
            match self.pilot.go_to_pose(pose) {
                Err(Halt::Blocked(_)) => continue,
                other => other?,
            }
            if !reached {
                self.approached.push(furniture.centre());
                reached = true;
            }
            if let Some(sighting) = self.settle_on(&furniture.footprint, object)? {
                self.found_at = Some(vec2(sighting.x, sighting.y));
                return Ok(Some(format!("the {} is on {}", sighting.name.replace('_', " "), furniture.label())));
            }
        }
        let object = object.unwrap_or("portable object").replace('_', " ");
        self.pilot.because(if reached {
            format!("no {object} on {}", furniture.label())
        } else {
            format!("no place from which {} can be looked at", furniture.label())
        });
        Ok(None)
    }

    /// Faces the object; when it is in the picture but cannot be told for sure, looks from a better place.
    fn settle_on(&mut self, footprint: &Polygon, object: Option<&str>) -> Result<Option<ObjectSighting>, Halt> {
        for _ in 0..MOST_SETTLING {
            let Some(sighting) = self.sighted(footprint, object) else { return Ok(None) };
            self.pilot.turn_to(bearing(self.pilot.pose(), &sighting))?;
            self.pilot.look();
            match self.sighted(footprint, object) {
                Some(facing) if facing.recognisable => return Ok(Some(facing)),
                _ => {}
            }
            let here = self.pilot.pose().position();
            let Some(better) = better_view(self.pilot.grid(), self.pilot.rooms(), here, vec2(sighting.x, sighting.y))
            else {
                return Ok(None);
            };
            self.pilot.because("something is there that cannot be told from here; looking from a better place");
            match self.pilot.go_to_pose(better) {
                Err(Halt::Blocked(_)) => return Ok(None),
                other => other?,
            }
        }
        Ok(self.sighted(footprint, object).filter(|sighting| sighting.recognisable))
    }

    /// The object in the present picture: the named one, or any on the furniture when none is named.
    fn sighted(&self, footprint: &Polygon, object: Option<&str>) -> Option<ObjectSighting> {
        let on_it = |s: &&ObjectSighting| object.is_some() || footprint.distance_to(vec2(s.x, s.y)) < 0.1;
        let named = |s: &&ObjectSighting| object.is_none_or(|name| s.name == name);
        let seen = || self.pilot.view().objects.iter().filter(named).filter(on_it);
        seen().find(|s| s.recognisable).or_else(|| seen().next()).cloned()
    }
}

/// What a robot without a camera has left undone.
fn without_camera(plan: &Plan) -> String {
    let wanted = plan.actions.iter().find_map(|action| match action {
        Action::Search { target: Some(target), .. } => Some(target.replace('_', " ")),
        Action::Find { object: Some(object) } => Some(object.replace('_', " ")),
        _ => None,
    });
    match wanted {
        Some(wanted) => format!("the moves are done; to look for the {wanted} a camera is needed (--camera FILE)"),
        None => "the moves are done".to_string(),
    }
}

fn bearing(pose: Pose, sighting: &ObjectSighting) -> f64 {
    let away = vec2(sighting.x, sighting.y) - pose.position();
    away.y.atan2(away.x)
}
