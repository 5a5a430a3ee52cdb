//! A conversation: one line after the other is taken, and each is answered or asked back about.

use std::sync::Arc;

use super::memory::{Memory, SeenObject, SeenPiece};
use super::utterance::Utterance;
use crate::behavior::MOST_PASSED_OVER;
use crate::geometry::{Vec2, vec2};
use crate::grounding::{Grounder, answer};
use crate::language::tokens::tokenize;
use crate::language::{Chunker, Role, units};
use crate::map::RoomMap;
use crate::planning::Planner;
use crate::record::{Action, Chunk, Destination, Grounding, Outcome, Plan, Record, Stage, StageError, Token, Trial};
use crate::recording::{Stories, Told};
use crate::simulation::{Driver, Home};

/// What the robot says to a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// It asks back: the next line is the answer.
    Question(String),
    /// It answers.
    Answer(String),
}

/// An errand as it was understood.
#[derive(Clone, Debug)]
struct Errand {
    text: String,
    grounding: Grounding,
}

/// The last errand, and how it went.
struct Last {
    errand: Errand,
    trial: Trial,
    told: Vec<String>,
    /// Where it looked in the end, metres.
    place: Option<Vec2>,
}

/// A person and a robot in a simulated home.
pub struct Session {
    driver: Driver,
    /// The rooms with the start at which the person is.
    map: RoomMap,
    planner: Planner,
    grounder: Grounder,
    memory: Memory,
    asked: Option<Errand>,
    last: Option<Last>,
    passed_over: Vec<Vec2>,
    /// The trials of this line, and of all lines for whoever wants a page.
    stories: Arc<Stories>,
    kept: Option<Arc<Stories>>,
}

impl Session {
    /// A conversation that begins; the driver keeps its outputs for every errand.
    pub fn new(mut driver: Driver, grounder: Grounder, memory: Memory) -> Self {
        let map = driver.home.map.clone();
        let stories: Arc<Stories> = Arc::default();
        let kept = driver.outputs.stories.replace(stories.clone());
        driver.settings.options.speaker = Some(map.start);
        let planner = Planner::new(map.clone());
        Self { driver, map, planner, grounder, memory, asked: None, last: None, passed_over: Vec::new(), stories, kept }
    }

    /// What is remembered by now.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// The home, for drawings.
    pub fn home(&self) -> &Home {
        &self.driver.home
    }

    /// Takes a line, drives what it asks for, and replies; the record gets what the stages add.
    ///
    /// # Errors
    /// When the record has no text, or what it leaves cannot be written.
    pub fn hear(&mut self, record: &mut Record) -> Result<Reply, StageError> {
        let text: String = record.require("text", "a line of a conversation needs what was said under this key")?;
        // Questions to the robot leave its own question open.
        match Utterance::of(&text) {
            Utterance::WhereAreYou => Ok(Reply::Answer(self.where_it_is())),
            Utterance::WhatDoYouSee => Ok(Reply::Answer(self.what_it_sees())),
            Utterance::Why => Ok(Reply::Answer(self.why())),
            what => self.heed(what, &text, record),
        }
    }

    /// Does what was said, with the question that waits for an answer.
    fn heed(&mut self, what: Utterance, text: &str, record: &mut Record) -> Result<Reply, StageError> {
        let asked = self.asked.take();
        match what {
            Utterance::Stop if asked.is_some() => Ok(said("All right, I leave it.")),
            Utterance::Stop => Ok(said("I am standing still.")),
            Utterance::OtherOne => self.the_other_one(asked, record),
            Utterance::ComeBack => {
                self.passed_over.clear();
                self.come_back(text, record)
            }
            _ => match asked {
                Some(errand) if !begins_an_errand(text, &self.grounder) => self.answered(errand, text, record),
                _ => self.errand(text, record),
            },
        }
    }

    /// A new errand: what was passed over belongs to the old one.
    fn errand(&mut self, text: &str, record: &mut Record) -> Result<Reply, StageError> {
        self.passed_over.clear();
        let errand = Errand { text: text.to_string(), grounding: self.understood(text)? };
        // Whoever has seen the thing need not ask where it is.
        if self.remembered(&errand.grounding).is_some() {
            return self.drive_remembering(errand, record);
        }
        let unsettled = errand.grounding.question.clone().filter(|_| !errand.grounding.readings.is_empty());
        if let Some(question) = unsettled {
            record.put(&errand.grounding);
            self.asked = Some(errand);
            return Ok(Reply::Question(question));
        }
        self.drive_remembering(errand, record)
    }

    fn understood(&self, text: &str) -> Result<Grounding, StageError> {
        let mut record = Record::from_text("errand", text);
        Chunker::default().run(&mut record)?;
        let tokens: Vec<Token> = record.part()?.unwrap_or_default();
        let chunks: Vec<Chunk> = record.part()?.unwrap_or_default();
        Ok(self.grounder.ground(text, &tokens, &chunks))
    }

    /// The answer to the question, or the question once more.
    fn answered(&mut self, mut errand: Errand, reply: &str, record: &mut Record) -> Result<Reply, StageError> {
        let question = errand.grounding.question.clone().unwrap_or_default();
        if answer(&mut errand.grounding, reply, self.grounder.lexicon()) {
            return self.drive_remembering(errand, record);
        }
        self.asked = Some(errand);
        Ok(Reply::Question(format!("I did not understand \"{reply}\". {question}")))
    }

    /// Where nobody said where a thing is, it is looked for where it was last; and everywhere, if it is not there.
    fn drive_remembering(&mut self, errand: Errand, record: &mut Record) -> Result<Reply, StageError> {
        let Some(seen) = self.remembered(&errand.grounding) else { return self.drive(errand, record) };
        let text = format!("{}: {}", errand.text, seen.description);
        let there = Errand { text, grounding: self.understood(&seen.description)? };
        let reply = self.drive(there, record)?;
        if self.last.as_ref().is_some_and(|last| last.trial.outcome == Outcome::Found) {
            self.last.iter_mut().for_each(|last| last.errand = errand.clone());
            return Ok(reply);
        }
        self.memory.forget(&seen.name);
        let lost = format!("It is no longer where I saw it ({}).", seen.description.trim_end_matches('.'));
        Ok(preceded(&lost, self.drive(errand, record)?))
    }

    fn remembered(&self, grounding: &Grounding) -> Option<SeenObject> {
        let says_where = grounding.room.is_some() || !grounding.nodes.is_empty() || !grounding.not.is_empty();
        let is_more = !grounding.also.is_empty() || !grounding.then.is_empty() || grounding.destination.is_some();
        let object = grounding.object.as_ref().filter(|_| !says_where && !is_more)?;
        self.memory.object(&object.name).filter(|_| self.passed_over.is_empty()).cloned()
    }

    /// The reading that was not chosen, or the piece that was not gone to.
    fn the_other_one(&mut self, asked: Option<Errand>, record: &mut Record) -> Result<Reply, StageError> {
        if let Some(mut errand) = asked {
            let Some(other) = errand.grounding.readings.first().cloned() else { return self.drive(errand, record) };
            (errand.grounding.room, errand.grounding.object, errand.grounding.nodes) =
                (other.room, other.object, other.nodes);
            return self.drive(errand, record);
        }
        let Some(last) = self.last.take() else { return Ok(said("I have not gone to anything yet.")) };
        let Some(place) = last.place else { return Ok(said("I went to no piece of furniture the last time.")) };
        if let Some(object) = &last.errand.grounding.object {
            self.memory.forget(&object.name);
        }
        if self.passed_over.len() == MOST_PASSED_OVER {
            self.passed_over.remove(0);
        }
        self.passed_over.push(place);
        self.drive(last.errand, record)
    }

    /// To where the person is.
    fn come_back(&mut self, text: &str, record: &mut Record) -> Result<Reply, StageError> {
        let to = Destination { recipient: Some("speaker".to_string()), ..Destination::default() };
        let actions = vec![Action::Deliver { objects: Vec::new(), to: to.clone() }];
        let plan = Plan { map: self.map.name.clone(), actions, ..Plan::default() };
        let grounding = Grounding { destination: Some(to), ..Grounding::default() };
        let reply = self.follow(&plan, Errand { text: text.to_string(), grounding }, record)?;
        let is_there = self.last.as_ref().is_some_and(|last| last.trial.outcome == Outcome::Arrived);
        Ok(if is_there { said("Here I am.") } else { reply })
    }

    fn drive(&mut self, errand: Errand, record: &mut Record) -> Result<Reply, StageError> {
        let plan = self.planner.plan(&errand.grounding);
        self.follow(&plan, errand, record)
    }

    fn follow(&mut self, plan: &Plan, errand: Errand, record: &mut Record) -> Result<Reply, StageError> {
        record.put(&errand.grounding);
        record.put(plan);
        if plan.actions.is_empty() {
            return Ok(Reply::Answer(format!("I cannot do that: {}.", plan.problems.join("; "))));
        }
        for (slot, place) in (0..MOST_PASSED_OVER).map(|at| (at, self.passed_over.get(at).copied())) {
            self.driver.settings.options.passed_over[slot] = place;
        }
        self.driver.run(record)?;
        let mut moved = Vec::new();
        for told in self.stories.take() {
            moved.extend(self.take_in(&errand, &told));
            self.kept.iter().for_each(|kept| kept.tell(told.clone()));
        }
        let Some(last) = &self.last else { return Ok(said("I have nothing to tell of it.")) };
        let ending = ending(&last.trial);
        Ok(Reply::Answer(std::iter::once(ending).chain(moved).collect::<Vec<_>>().join(" ")))
    }

    /// Remembers what an errand showed; what is not where it was, in words.
    fn take_in(&mut self, errand: &Errand, told: &Told) -> Vec<String> {
        let mut moved = Vec::new();
        let believed = told.story.believed.last().map(|(_, pieces)| pieces.as_slice()).unwrap_or_default();
        for (name, corners) in
            believed.iter().filter(|(name, corners)| !name.starts_with("supposed") && !corners.is_empty())
        {
            let at = corners.iter().fold(Vec2::zeros(), |sum, corner| sum + corner) / corners.len() as f64;
            let room = self.map.room_at(at).map(|room| room.name.clone()).unwrap_or_default();
            let seen = SeenPiece { name: name.clone(), room, x: at.x, y: at.y };
            if self.memory.see_piece(seen) {
                moved.push(format!("The {name} has moved."));
            }
        }
        let run = &told.run;
        let found = run.found_at.filter(|_| run.trial.outcome == Outcome::Found);
        if let (Some(at), Some(name), Some(description)) = (found, &run.sought, &run.trial.description) {
            let seen = SeenObject { name: name.clone(), description: description.clone(), x: at.x, y: at.y };
            let before = self.memory.see_object(seen);
            moved.extend(before.map(|before| format!("It has moved; before, I saw it here: {}", before.description)));
        }
        let place = run.found_at.or_else(|| self.last_piece(&run.trial));
        let told = told.story.told.iter().map(|(_, text)| text.clone()).collect();
        self.last = Some(Last { errand: errand.clone(), trial: run.trial.clone(), told, place });
        // Another errand begins where this one ended.
        let home = &self.driver.home;
        let mut map = home.map.clone();
        map.start = run.final_pose;
        self.driver.home = Home::new(map, home.scene.clone());
        moved
    }

    /// The middle of the piece gone to last.
    fn last_piece(&self, trial: &Trial) -> Option<Vec2> {
        let id = trial.approached.last()?;
        let name = id.replace(['-', '_'], " ");
        let piece = self.memory.furniture.iter().find(|piece| piece.name == name)?;
        Some(vec2(piece.x, piece.y))
    }

    fn where_it_is(&self) -> String {
        let here = self.driver.home.map.start.position();
        let room = self.map.room_at(here).map(|room| spoken(&room.name));
        let far = |piece: &&SeenPiece| (vec2(piece.x, piece.y) - here).norm();
        let nearest =
            self.memory.furniture.iter().min_by(|a, b| far(a).total_cmp(&far(b))).filter(|piece| far(piece) < 2.0);
        match (room, nearest) {
            (Some(room), Some(piece)) => format!("I am in the {room}, near the {}.", piece.name),
            (Some(room), None) => format!("I am in the {room}."),
            (None, _) => "I am in a doorway.".to_string(),
        }
    }

    fn what_it_sees(&self) -> String {
        if self.memory.furniture.is_empty() {
            return "I have seen nothing yet.".to_string();
        }
        let mut rooms: Vec<&str> = self.memory.furniture.iter().map(|piece| piece.room.as_str()).collect();
        rooms.sort_unstable();
        rooms.dedup();
        let in_room = |room: &&str| {
            let pieces = self.memory.furniture.iter().filter(|piece| piece.room == **room);
            let names: Vec<String> = pieces.map(|piece| piece.name.clone()).collect();
            let place = if room.is_empty() { "elsewhere".to_string() } else { format!("in the {}", spoken(room)) };
            format!("{place}: {}", names.join(", "))
        };
        let furniture = rooms.iter().map(in_room).collect::<Vec<_>>().join("; ");
        let objects: Vec<&str> = self.memory.objects.iter().map(|object| object.description.as_str()).collect();
        format!("I have seen {furniture}. {}", objects.join(" ")).trim_end().to_string()
    }

    fn why(&self) -> String {
        let Some(last) = &self.last else { return "I have done nothing yet.".to_string() };
        let decisions = last.told.iter().filter(|told| told.contains("going to") || told.contains("going into"));
        let decisions: Vec<&str> = decisions.map(String::as_str).collect();
        let ended = format!("it ended {}: {}.", last.trial.outcome.phrase(), last.trial.why);
        let first = format!("You said \"{}\"", last.errand.text);
        std::iter::once(first.as_str()).chain(decisions).chain([ended.as_str()]).collect::<Vec<_>>().join("; ")
    }
}

/// Whether a line begins anew in place of answering: it says what to do.
fn begins_an_errand(text: &str, grounder: &Grounder) -> bool {
    const DOING: [Role; 6] = [Role::Motion, Role::Find, Role::Bring, Role::Give, Role::Put, Role::Enter];
    let words = tokenize(text);
    units(&words, grounder.lexicon()).first().is_some_and(|unit| DOING.iter().any(|role| unit.has(*role)))
}

/// How an errand ended, to a person.
fn ending(trial: &Trial) -> String {
    match (trial.outcome, &trial.description) {
        (Outcome::Found, Some(description)) => description.clone(),
        (Outcome::Found, None) => format!("Found: {}.", trial.why),
        (Outcome::Arrived, _) => format!("I am there: {}.", trial.why),
        (outcome, _) => format!("Sorry, {}: {}.", outcome.phrase(), trial.why),
    }
}

fn said(text: &str) -> Reply {
    Reply::Answer(text.to_string())
}

fn preceded(first: &str, reply: Reply) -> Reply {
    match reply {
        Reply::Question(text) => Reply::Question(format!("{first} {text}")),
        Reply::Answer(text) => Reply::Answer(format!("{first} {text}")),
    }
}

fn spoken(name: &str) -> String {
    name.replace('_', " ")
}
