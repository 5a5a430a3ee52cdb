//! `plan` as a stage of the pipeline.

use super::actions::actions_for;
use super::rooms::choose_room;
use crate::language::Lexicon;
use crate::map::RoomMap;
use crate::record::{Action, Grounding, Motion, Note, Plan, Record, Stage, StageError};

/// Makes plans for one room map.
#[derive(Debug)]
pub struct Planner {
    map: RoomMap,
    lexicon: &'static Lexicon,
}

impl Planner {
    /// A planner for `map`.
    pub fn new(map: RoomMap) -> Self {
        Self { map, lexicon: Lexicon::embedded() }
    }

    /// The plan for what was understood.
    pub fn plan(&self, grounding: &Grounding) -> Plan {
        let choice = choose_room(grounding.room.as_ref(), &self.map);
        let mut problems: Vec<String> = choice.problem.into_iter().chain(grounding.problems.iter().cloned()).collect();
        let mut actions = Vec::new();
        if !choice.fatal {
            actions.push(Action::Enter { room: choice.room.clone(), candidates: choice.candidates });
            let object = grounding.object.as_ref().map(|object| object.name.as_str());
            actions.extend(actions_for(&grounding.nodes, object, self.lexicon));
        }
        if grounding.room.is_none() && grounding.object.is_none() && grounding.nodes.is_empty() {
            problems.push(
                "nothing was understood of where to go or what to find; name a room, a piece of furniture or an object"
                    .to_string(),
            );
            actions.clear();
        }
        Plan { map: self.map.name.clone(), room: choice.room, actions, problems }
    }
}

impl Stage for Planner {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let grounding: Grounding = record.require_part("pipe the record through `ground` first")?;
        let plan = self.plan(&grounding);
        record.put(&plan);
        Ok(if plan.actions.is_empty() { Note::Lossy(plan.problems.join("; ")) } else { Note::Done })
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let plan: Plan = record.require_part("it is what `plan` adds")?;
        let mut lines = Vec::new();
        if let Some(text) = record.get::<String>("text")? {
            lines.push(text);
        }
        lines.extend(plan.actions.iter().enumerate().map(|(i, action)| format!("{:3}. {}", i + 1, sentence(action))));
        lines.extend(plan.problems.iter().map(|problem| format!("  !  {problem}")));
        Ok(lines.join("\n"))
    }
}

/// An action in words.
fn sentence(action: &Action) -> String {
    match action {
        Action::Enter { room: Some(room), candidates } if candidates.is_empty() => format!("enter the {}", words(room)),
        Action::Enter { room: Some(room), candidates } => {
            format!("enter the {}, then try {}", words(room), list(candidates))
        }
        Action::Enter { room: None, candidates } => format!("try the rooms in turn: {}", list(candidates)),
        Action::Move { motion, amount } => {
            let verb = match motion {
                Motion::Ahead => "go forward",
                Motion::TurnLeft => "turn left",
                Motion::TurnRight => "turn right",
                Motion::TurnRound => "turn around",
            };
            amount.as_ref().map_or(verb.to_string(), |amount| format!("{verb}, {}", amount.phrase()))
        }
        Action::Go { reference, direction, frame, .. } => {
            format!("go to the {} of the {} ({} frame)", direction.name(), reference.words(), frame.name())
        }
        Action::Search { target, attributes, pairs, .. } => {
            let target = target.as_deref().map_or("any table-like furniture".to_string(), words);
            let pairs: Vec<String> = pairs.iter().map(|p| p.pair.phrase()).collect();
            let place = if pairs.is_empty() { String::new() } else { format!(": {}", pairs.join(", then ")) };
            format!("search {}{target}{place}", attributes.iter().map(|a| format!("{a} ")).collect::<String>())
        }
        Action::Find { object } => {
            format!("find {}", object.as_deref().map_or("any portable object".to_string(), words))
        }
    }
}

fn list(rooms: &[String]) -> String {
    rooms.iter().map(|room| words(room)).collect::<Vec<_>>().join(", ")
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}
