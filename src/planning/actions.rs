//! Nodes → the actions inside the room.

use super::frames_to_try;
use crate::language::Lexicon;
use crate::record::{Action, Amount, Direction, Frame, Motion, Node, Pair, Reference, SearchPair};

/// The actions for the nodes, ending in exactly one search with the object's search behind it.
pub fn actions_for(nodes: &[Node], objects: &[Option<String>], not: &[String], lexicon: &Lexicon) -> Vec<Action> {
    let nodes = merge_repeated_targets(nodes, lexicon);
    let last_search = nodes.iter().rposition(|node| node.target.is_some());
    let mut actions = Vec::new();
    for (i, node) in nodes.iter().enumerate() {
        let is_last = last_search.is_none_or(|last| i >= last);
        actions.extend(actions_of_node(node, is_last, i + 1 == nodes.len(), lexicon));
    }
    gather_searches(&mut actions, not);
    actions.extend(objects.iter().map(|object| Action::Find { object: object.clone() }));
    actions
}

/// "… to the table at the back … the laptop on the table": the same target said again adds its pairs to the first.
fn merge_repeated_targets(nodes: &[Node], lexicon: &Lexicon) -> Vec<Node> {
    let mut merged: Vec<Node> = Vec::new();
    for node in nodes {
        let same = |other: &Node| same_kind(other.target.as_deref(), node.target.as_deref(), lexicon);
        match merged.last_mut() {
            Some(last)
                if node.target.is_some() && same(last) && node.pairs.iter().all(|p| p.reference != Reference::Move) =>
            {
                last.pairs.extend(node.pairs.iter().filter(|p| !last.pairs.contains(p)).cloned().collect::<Vec<_>>());
                last.attributes.extend(node.attributes.iter().cloned());
            }
            _ => merged.push(node.clone()),
        }
    }
    merged
}

fn same_kind(a: Option<&str>, b: Option<&str>, lexicon: &Lexicon) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => a == b || lexicon.class_of(a).is_some_and(|class| Some(class) == lexicon.class_of(b)),
        _ => false,
    }
}

/// Moves and places first, then what is left as the search for the node's target.
fn actions_of_node(node: &Node, is_last: bool, ends_here: bool, lexicon: &Lexicon) -> Vec<Action> {
    let mut actions = Vec::new();
    let mut searched = Vec::new();
    for pair in &node.pairs {
        match motion(pair, node.target.is_some(), ends_here && is_last, lexicon) {
            Some(action) => actions.push(action),
            None => searched.push(search_pair(pair, lexicon)),
        }
    }
    // On the way to a target the last "go forward" ends at the target itself.
    if node.target.is_some() && is_last {
        while matches!(actions.last(), Some(Action::Move { motion: Motion::Ahead, amount: None })) {
            actions.pop();
        }
    }
    match &node.target {
        Some(target) if !is_last => actions.push(waypoint(target, lexicon)),
        target if target.is_some() || !searched.is_empty() => actions.push(Action::Search {
            target: target.clone(),
            attributes: node.attributes.clone(),
            ordinal: node.ordinal,
            pairs: searched,
            not: Vec::new(),
        }),
        _ => {}
    }
    actions
}

/// The motion a pair asks for, or nothing when it says where the target is.
fn motion(pair: &Pair, has_target: bool, ends_here: bool, lexicon: &Lexicon) -> Option<Action> {
    match (&pair.reference, pair.direction) {
        (Reference::Move, direction) => {
            let motion = Motion::from_direction(direction)?;
            Some(Action::Move { motion, amount: pair.amount.clone() })
        }
        (Reference::Robot, _) => None,
        _ if has_target => None,
        (Reference::Wall, Direction::Side) => {
            Some(Action::Move { motion: Motion::Ahead, amount: Some(Amount::Until(Reference::Wall)) })
        }
        // The last place said is where to look; one said before other steps is gone to.
        _ if ends_here => None,
        _ => Some(go(pair, lexicon)),
    }
}

fn go(pair: &Pair, lexicon: &Lexicon) -> Action {
    let (reference, direction, frame) = (pair.reference.clone(), pair.direction, pair.frame);
    Action::Go { reference, direction, frame, frames: frames_to_try(pair, lexicon) }
}

/// Furniture on the way: it is passed, not searched.
fn waypoint(target: &str, lexicon: &Lexicon) -> Action {
    let (reference, direction) = (Reference::of(target), Direction::Side);
    go(&Pair { reference, direction, frame: Frame::Viewer, and: None, amount: None, ordinal: None }, lexicon)
}

fn search_pair(pair: &Pair, lexicon: &Lexicon) -> SearchPair {
    SearchPair { pair: pair.clone(), frames: frames_to_try(pair, lexicon) }
}

/// One search at the end: hints said before the target ("on the right, on the table") join the target's own pairs.
fn gather_searches(actions: &mut Vec<Action>, not: &[String]) {
    let mut gathered: Vec<SearchPair> = Vec::new();
    let mut wanted: (Option<String>, Vec<String>, Option<u32>) = (None, Vec::new(), None);
    actions.retain(|action| match action {
        Action::Search { target, attributes, ordinal, pairs, .. } => {
            gathered.extend(pairs.iter().cloned());
            if target.is_some() {
                wanted = (target.clone(), attributes.clone(), *ordinal);
            }
            false
        }
        _ => true,
    });
    let (target, attributes, ordinal) = wanted;
    actions.push(Action::Search { target, attributes, ordinal, pairs: gathered, not: not.to_vec() });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(reference: &str, direction: Direction) -> Pair {
        let frame = if matches!(reference, "move" | "robot") { Frame::Robot } else { Frame::Viewer };
        Pair { reference: Reference::of(reference), direction, frame, and: None, amount: None, ordinal: None }
    }

    fn node(target: Option<&str>, pairs: Vec<Pair>) -> Node {
        Node { target: target.map(str::to_string), pairs, ..Node::default() }
    }

    fn names(nodes: &[Node]) -> Vec<&'static str> {
        let name = |action: &Action| match action {
            Action::Enter { .. } => "enter",
            Action::Move { .. } => "move",
            Action::Go { .. } => "go",
            Action::Search { .. } => "search",
            Action::Find { .. } => "find",
            Action::Deliver { .. } => "deliver",
        };
        actions_for(nodes, &[Some("mug".to_string())], &[], Lexicon::embedded()).iter().map(name).collect()
    }

    #[test]
    fn going_forward_to_a_table_ends_at_the_table() {
        let nodes = [node(Some("table"), vec![pair("move", Direction::Front)])];
        assert_eq!(names(&nodes), ["search", "find"]);
    }

    #[test]
    fn a_place_before_the_target_is_gone_to_and_a_hint_joins_the_search() {
        let nodes = [
            node(None, vec![pair("room", Direction::Central)]),
            node(None, vec![pair("robot", Direction::Right)]),
            node(Some("table"), vec![pair("couch", Direction::Back)]),
        ];
        assert_eq!(names(&nodes), ["go", "search", "find"]);
        let actions = actions_for(&nodes, &[None], &[], Lexicon::embedded());
        assert!(matches!(&actions[1], Action::Search { target: Some(_), pairs, .. } if pairs.len() == 2));
    }

    #[test]
    fn hitting_the_wall_is_a_move_and_a_wall_beside_the_target_is_a_hint() {
        assert_eq!(names(&[node(None, vec![pair("wall", Direction::Side)])]), ["move", "search", "find"]);
        assert_eq!(names(&[node(Some("table"), vec![pair("wall", Direction::Side)])]), ["search", "find"]);
    }

    #[test]
    fn furniture_on_the_way_is_passed() {
        let nodes = [node(None, vec![pair("couch", Direction::Side)]), node(None, vec![pair("move", Direction::Left)])];
        assert_eq!(names(&nodes), ["go", "move", "search", "find"]);
    }

    #[test]
    fn a_target_said_twice_is_searched_once() {
        let nodes = [node(Some("table"), vec![pair("room", Direction::Back)]), node(Some("table"), vec![])];
        assert_eq!(names(&nodes), ["search", "find"]);
    }

    #[test]
    fn with_nothing_said_of_the_place_the_room_is_searched() {
        assert_eq!(names(&[]), ["search", "find"]);
    }
}
