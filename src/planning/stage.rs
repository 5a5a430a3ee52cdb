//! `plan` as a stage of the pipeline.

use super::actions::actions_for;
use super::nouns::misspelt;
use super::rooms::{RoomChoice, choose_room, names};
use crate::catalogue::usual_rooms;
use crate::language::Lexicon;
use crate::map::RoomMap;
use crate::record::{
    Action, Destination, Grounding, Motion, Note, Plan, Record, RoomSlot, Shade, Stage, StageError, doubts_of,
};

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

    /// The plan for what was understood: each errand in turn.
    pub fn plan(&self, grounding: &Grounding) -> Plan {
        let mut plan = Plan { map: self.map.name.clone(), problems: grounding.problems.clone(), ..Plan::default() };
        plan.room = self.errand(grounding, &mut plan);
        for next in &grounding.then {
            self.errand(next, &mut plan);
        }
        if is_empty(grounding) {
            plan.problems.push(
                "nothing was understood of where to go or what to find; name a room, a piece of furniture or an object"
                    .to_string(),
            );
            plan.actions.clear();
        }
        plan
    }

    /// Adds the actions of one errand, and what the map cannot satisfy; the room it begins in.
    fn errand(&self, grounding: &Grounding, plan: &mut Plan) -> Option<String> {
        let said = grounding.room.as_ref().map(|room| self.known_by_the_map(room));
        let mut choice = choose_room(said.as_ref(), &self.map);
        let not: Vec<String> = grounding.not.iter().map(|not| not.name.clone()).collect();
        if choice.room.is_none() {
            self.try_usual_rooms_first(&mut choice.candidates, grounding);
        }
        rule_out_rooms(&mut choice, &self.rooms_of(&not), &self.map);
        plan.problems.extend(choice.problem);
        plan.problems.extend(misspelt(grounding, self.lexicon));
        if choice.fatal || is_empty(grounding) {
            return choice.room;
        }
        plan.actions.push(Action::Enter { room: choice.room.clone(), candidates: choice.candidates });
        let goal = grounding.destination.as_ref();
        let mut objects: Vec<Option<String>> = vec![grounding.object.as_ref().map(|object| object.name.clone())];
        objects.extend(grounding.also.iter().map(|object| Some(object.name.clone())));
        // What is ruled out is not looked at, and neither is where the thing shall go.
        let furniture = not.into_iter().chain(goal.and_then(|goal| goal.target.clone()));
        let unsearched: Vec<String> = furniture.filter(|noun| self.lexicon.class_of(noun).is_some()).collect();
        plan.actions.extend(actions_for(&grounding.nodes, &objects, &unsearched, self.lexicon));
        if let Some(goal) = goal {
            self.deliver(objects.into_iter().flatten().collect(), goal, plan);
        }
        choice.room
    }

    /// Nobody said which room: a bed is looked for in the bedroom first. Rooms of the same rank stay as they are, the
    /// nearest first.
    fn try_usual_rooms_first(&self, candidates: &mut [String], grounding: &Grounding) {
        let targets = grounding.nodes.iter().rev().filter_map(|node| node.target.as_deref());
        let references = grounding.nodes.iter().flat_map(|node| &node.pairs).filter_map(|pair| pair.reference.thing());
        let rooms = targets.chain(references).flat_map(usual_rooms).flat_map(|name| self.map.rooms_called(name));
        let usual: Vec<String> = rooms.collect();
        candidates.sort_by_key(|room| usual.iter().position(|name| name == room).unwrap_or(usual.len()));
    }

    fn deliver(&self, objects: Vec<String>, goal: &Destination, plan: &mut Plan) {
        let mut to = goal.clone();
        if let Some(said) = &goal.room {
            let slot = RoomSlot { name: Some(said.clone()), ..RoomSlot::default() };
            let choice = choose_room(Some(&self.known_by_the_map(&slot)), &self.map);
            plan.problems.extend(choice.problem);
            to.room = choice.room;
        }
        let person = goal.recipient.as_ref().filter(|name| *name != "speaker");
        if let Some(person) = person.filter(|_| to.room.is_none() && to.target.is_none()) {
            let spoken = words(person);
            plan.problems.push(format!(
                "nobody said where `{spoken}` is; say the room, or it is brought to where the robot started"
            ));
        }
        if !to.is_empty() {
            plan.actions.push(Action::Deliver { objects, to });
        }
    }

    /// The room by the name that the map knows it under: a "den" is a living room where there is no den.
    fn known_by_the_map(&self, said: &RoomSlot) -> RoomSlot {
        let name = said.name.as_ref().map(|name| {
            let usual = self.lexicon.canonical(name).filter(|_| self.map.rooms_called(name).is_empty());
            usual.map_or_else(|| name.clone(), str::to_string)
        });
        RoomSlot { name, ..said.clone() }
    }

    fn rooms_of(&self, names: &[String]) -> Vec<String> {
        let known = |name: &String| {
            let slot = RoomSlot { name: Some(name.clone()), ..RoomSlot::default() };
            self.known_by_the_map(&slot).name.map(|name| self.map.rooms_called(&name)).unwrap_or_default()
        };
        names.iter().flat_map(known).collect()
    }
}

fn is_empty(grounding: &Grounding) -> bool {
    grounding.room.is_none()
        && grounding.object.is_none()
        && grounding.nodes.is_empty()
        && grounding.destination.is_none()
}

/// What was ruled out is not gone to, not even to look.
fn rule_out_rooms(choice: &mut RoomChoice, not: &[String], map: &RoomMap) {
    if not.is_empty() || choice.fatal {
        choice.candidates.retain(|room| !not.contains(room));
    }
    if choice.room.as_ref().is_some_and(|room| not.contains(room)) {
        choice.room = None;
    }
    if !not.is_empty() && !choice.fatal && choice.room.is_none() && choice.candidates.is_empty() {
        choice.fatal = true;
        choice.problem = Some(format!(
            "every room that could be meant was ruled out ({}); the map `{}` has {}",
            not.join(", "),
            map.name,
            names(map)
        ));
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
        lines.extend(plan.problems.iter().chain(&doubts_of(record)?).map(|problem| format!("  !  {problem}")));
        Ok(lines.join("\n"))
    }

    fn shade(&self, line: &str) -> Shade {
        if line.starts_with("  !  ") { Shade::Bad } else { Shade::Plain }
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
        Action::Deliver { objects, to } => {
            let what = if objects.is_empty() {
                "it".to_string()
            } else {
                objects.iter().map(|o| words(o)).collect::<Vec<_>>().join(" and ")
            };
            format!("bring {what} {}", to.phrase())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rooms(target: &str) -> Vec<String> {
        let grounding = format!(r#"{{"room":null,"object":null,"nodes":[{{"target":"{target}","pairs":[]}}]}}"#);
        let plan = Planner::new(RoomMap::apartment()).plan(&serde_json::from_str(&grounding).expect("a grounding"));
        match &plan.actions[0] {
            Action::Enter { candidates, .. } => candidates.clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn where_nobody_said_the_room_that_usually_has_the_furniture_is_tried_first() {
        assert_eq!(rooms("bed"), ["bedroom", "living_room"]);
        assert_eq!(rooms("couch"), ["living_room", "bedroom"]);
        assert_eq!(rooms("table"), ["living_room", "bedroom"]);
    }
}
