//! The shipped homes that are not the paper's, each with descriptions of its own.

use crate::evaluation::{Gold, GoldError, read_gold};
use crate::simulation::ShippedHome;
use crate::simulation::{Home, SHIPPED_HOMES};

/// Corpora of the other homes, by the home's name.
const CORPORA: [(&str, &str); 3] = [
    ("studio", include_str!("../../../corpus/homes/studio.jsonl")),
    ("flat", include_str!("../../../corpus/homes/flat.jsonl")),
    ("l-shaped", include_str!("../../../corpus/homes/l-shaped.jsonl")),
];

/// A home with its descriptions.
#[derive(Clone, Debug)]
pub struct OwnHome {
    /// The home's name.
    pub name: &'static str,
    /// The home.
    pub home: Home,
    /// What people say in it.
    pub gold: Vec<Gold>,
}

/// The other shipped homes.
///
/// # Errors
/// When the descriptions of a shipped home are no gold, or a home of theirs is not shipped.
pub fn own_homes() -> Result<Vec<OwnHome>, GoldError> {
    let embedded = |name: &'static str, text: &str| {
        let gold = read_gold(text, &format!("{name}.jsonl"))?;
        let home = SHIPPED_HOMES.iter().find(|home| home.map.name == name);
        let (map, scene) = home.map(ShippedHome::load).ok_or_else(|| GoldError {
            file: format!("{name}.jsonl"),
            line: 1,
            message: "no shipped home of that name".to_string(),
        })?;
        Ok(OwnHome { name, home: Home::new(map, scene), gold })
    };
    CORPORA.iter().map(|(name, text)| embedded(name, text)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planning::Planner;
    use crate::record::{Grounding, RoomSlot};

    #[test]
    fn the_descriptions_name_furniture_and_objects_of_their_homes() {
        for OwnHome { name, home, gold } in own_homes().expect("sound corpora") {
            assert!(gold.len() >= 15, "{name}");
            for g in gold {
                let object = g.object.as_deref().expect("an object");
                let holders: Vec<&str> = home.scene.holders_of(object).iter().map(|item| item.id.as_str()).collect();
                assert!(!g.expect.is_empty() && g.expect.iter().all(|id| holders.contains(&id.as_str())), "{}", g.id);
            }
        }
    }

    #[test]
    fn the_rooms_that_are_said_resolve_to_the_room_of_the_object() {
        for OwnHome { home, gold, .. } in own_homes().expect("sound corpora") {
            for g in gold {
                let room = RoomSlot { name: g.room.clone(), side: g.side, ..RoomSlot::default() };
                let grounding = Grounding { room: Some(room), ..Grounding::default() };
                let plan = Planner::new(home.map.clone()).plan(&grounding);
                let item = home.scene.item(&g.expect[0]).expect("there");
                let there = home.map.room_at(item.pose().position()).map(|room| room.name.clone());
                let crate::record::Action::Enter { room, candidates } = &plan.actions[0] else { panic!("no entry") };
                assert!(room.iter().chain(candidates).any(|room| Some(room) == there.as_ref()), "{}: {plan:?}", g.id);
                assert!(plan.problems.is_empty(), "{}: {:?}", g.id, plan.problems);
            }
        }
    }
}
