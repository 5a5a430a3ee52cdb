//! Plans as someone would make them who sees the home: the right room, each relation in one frame.

use crate::record::{Action, Frame, Plan};
use crate::simulation::Home;

/// The plans that read all relations to furniture in one frame, in the room of the wanted furniture.
pub(super) fn plans(home: &Home, plan: &Plan, wanted: &[String]) -> Vec<Plan> {
    let room =
        wanted.first().and_then(|id| home.scene.item(id)).and_then(|item| home.map.room_at(item.pose().position()));
    let room = room.map(|room| room.name.clone());
    [Frame::Viewer, Frame::Intrinsic, Frame::Facing].map(|frame| in_frame(plan, room.as_deref(), frame)).to_vec()
}

fn in_frame(plan: &Plan, room: Option<&str>, frame: Frame) -> Plan {
    let mut plan = plan.clone();
    for action in &mut plan.actions {
        match action {
            Action::Enter { room: entered, candidates } if room.is_some() => {
                *entered = room.map(str::to_string);
                candidates.clear();
            }
            Action::Search { pairs, .. } => {
                for pair in pairs.iter_mut().filter(|pair| !pair.frames.is_empty()) {
                    pair.pair.frame = frame;
                    pair.frames = vec![frame];
                }
            }
            Action::Go { frame: read, frames, .. } if !frames.is_empty() => {
                *read = frame;
                *frames = vec![frame];
            }
            _ => {}
        }
    }
    plan.room = room.map(str::to_string).or(plan.room);
    plan
}
