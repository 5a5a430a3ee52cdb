//! Bringing what was found: back to the speaker, to a room, to a piece of furniture.

use super::Halt;
use super::executive::{Executive, SWEEP_RAD};
use super::motion::RoomFrame;
use super::relation::Place;
use super::search::{Wanted, rank};
use crate::record::{Action, Delivery, Destination};

impl Executive<'_> {
    /// All deliveries of an errand; says where to the last was.
    pub(super) fn deliver_all(&mut self, actions: &[Action]) -> Result<Option<String>, Halt> {
        let mut told = None;
        for action in actions {
            if let Action::Deliver { objects, to } = action {
                told = Some(self.deliver(objects, to)?);
            }
        }
        Ok(told)
    }

    fn deliver(&mut self, objects: &[String], to: &Destination) -> Result<String, Halt> {
        if let Some(room) = &to.room {
            self.enter(room)?;
        }
        self.pilot.begin("deliver");
        let place = match &to.target {
            Some(noun) => self.go_to_furniture(noun, to.room.as_deref())?,
            None if to.room.is_some() => None,
            // The speaker is where the robot started.
            None => {
                self.pilot.go_to_pose(self.start)?;
                None
            }
        };
        let what = if objects.is_empty() { "it".to_string() } else { objects.join(" and ").replace('_', " ") };
        if to.target.is_some() && place.is_none() {
            let why = format!(
                "no {} was found to bring {what} to",
                to.target.as_deref().unwrap_or("place").replace('_', " ")
            );
            self.pilot.end(&why);
            return Ok(why);
        }
        let pose = super::rounded(self.pilot.pose());
        self.delivered.push(Delivery { objects: objects.to_vec(), to: to.clone(), pose });
        let why = match place {
            Some(label) => format!("brought {what} to {label}"),
            None => format!("brought {what} {}", to.phrase()),
        };
        self.pilot.end(&why);
        Ok(why)
    }

    /// To the furniture of that noun: in the room that was said, else in the one the robot is in, else in any.
    fn go_to_furniture(&mut self, noun: &str, room: Option<&str>) -> Result<Option<String>, Halt> {
        let here = self.map.room_at(self.pilot.pose().position()).map(|room| room.name.clone());
        let mut rooms: Vec<String> = room.map(str::to_string).or(here).into_iter().collect();
        if room.is_none() {
            rooms.extend(self.map.rooms_by_distance());
        }
        let wanted = Wanted { target: Some(noun.to_string()), ..Wanted::default() };
        self.pilot.beliefs.search_anew();
        let mut tried: Vec<String> = Vec::new();
        for name in rooms {
            if tried.contains(&name) {
                continue;
            }
            let inside = self.map.room_at(self.pilot.pose().position()).is_some_and(|room| room.name == name);
            if !inside && let Some(entry) = self.map.entry_pose(&name) {
                self.pilot.go_to_pose(entry)?;
            }
            if let Some(label) = self.approach_one(&wanted, &name)? {
                return Ok(Some(label));
            }
            tried.push(name);
        }
        Ok(None)
    }

    fn approach_one(&mut self, wanted: &Wanted, room: &str) -> Result<Option<String>, Halt> {
        let frame = RoomFrame::of(self.map, room, self.pilot.pose());
        self.pilot.sweep(SWEEP_RAD)?;
        let place = Place { room: &frame, arrived: self.pilot.pose() };
        let ranked = rank(&self.pilot.beliefs, wanted, place, self.lexicon);
        for choice in ranked {
            let piece = self.pilot.beliefs.furniture[choice.index].clone();
            if !frame.outline.contains(piece.centre()) {
                continue;
            }
            for pose in self.pilot.ways().viewpoints(&piece) {
                match self.pilot.go_to_pose(pose) {
                    Ok(()) => return Ok(Some(piece.label())),
                    Err(Halt::Blocked(why)) => self.pilot.because(why),
                    Err(halt) => return Err(halt),
                }
            }
        }
        Ok(None)
    }
}
