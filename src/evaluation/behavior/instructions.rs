//! What the robot is told: plans from gold groundings or from the text, all of a corpus or each instruction once.

use std::collections::BTreeSet;

use crate::evaluation::Gold;
use crate::grounding::{Grounder, Method};
use crate::language::chunk_text;
use crate::map::RoomMap;
use crate::planning::Planner;
use crate::record::{Grounding, Plan};

/// Where the instructions come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Source {
    /// The labels of the corpus, as in the paper's Experiments 2 and 3
    #[default]
    Gold,
    /// The text, read by `chunk` and `ground`
    Text,
}

/// Which of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Selection {
    /// Every description
    #[default]
    All,
    /// Each room, object and nodes once
    Unique,
    /// The same, a target without a place not counting
    UniquePlaces,
}

/// One instruction.
#[derive(Clone, Debug)]
pub struct Instruction {
    /// Id of the first description that says so.
    pub id: String,
    /// Its text.
    pub text: String,
    /// The furniture it names: `none`, `table only`, `other`.
    pub names: &'static str,
    /// What the robot shall do.
    pub plan: Plan,
}

/// The instructions of a corpus for a home, in the corpus's order; a description without labels gives none of gold.
pub fn instructions(gold: &[Gold], map: &RoomMap, source: Source, selection: Selection) -> Vec<Instruction> {
    let planner = Planner::new(map.clone());
    let grounder = Grounder::new(Method::Composed, true);
    let mut seen = BTreeSet::new();
    let labelled = gold.iter().filter_map(|gold| Some((gold, gold.grounding.as_ref()?)));
    let chosen = labelled.filter(|(_, label)| match selection {
        Selection::All => true,
        Selection::Unique => seen.insert(key(label, true)),
        Selection::UniquePlaces => seen.insert(key(label, false)),
    });
    chosen
        .map(|(gold, label)| {
            let plan = match source {
                Source::Gold => planner.plan(label),
                Source::Text => {
                    let (tokens, chunks) = chunk_text(&gold.text);
                    planner.plan(&grounder.ground(&gold.text, &tokens, &chunks))
                }
            };
            Instruction { id: gold.id.clone(), text: gold.text.clone(), names: gold.names(), plan }
        })
        .collect()
}

/// Room, nodes and object as one text.
fn key(grounding: &Grounding, bare_targets: bool) -> String {
    let room = grounding.room.as_ref().map(|room| (&room.name, room.side));
    let object = grounding.object.as_ref().map(|object| &object.name);
    let nodes = grounding.nodes.iter().filter(|node| bare_targets || !node.pairs.is_empty());
    let nodes: Vec<_> = nodes
        .map(|node| {
            let pairs: Vec<_> = node.pairs.iter().map(|pair| (&pair.reference, pair.direction)).collect();
            (&node.target, pairs)
        })
        .collect();
    format!("{room:?} {nodes:?} {object:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::read_gold;

    #[test]
    fn an_instruction_said_twice_is_one() {
        let line = |id: &str, tree: &str, text: &str, nodes: &str| {
            format!(
                r#"{{"id":"{id}","text":"{text}","tree":"{tree}","grounding":{{"room":null,"object":null,"nodes":{nodes}}}}}"#
            )
        };
        let nothing = line("a", "[OBTP it is there]", "it is there", "[]");
        let again = line("b", "[OBTP there it is]", "there it is", "[]");
        let table = line(
            "c",
            "[FURTP=table on a table]",
            "on a table",
            r#"[{"target":"table","attributes":[],"pairs":[],"score":1}]"#,
        );
        let gold = read_gold(&[nothing, again, table].join("\n"), "gold").expect("gold");
        let map = RoomMap::apartment();
        let count = |selection| instructions(&gold, &map, Source::Gold, selection).len();
        assert_eq!((count(Selection::All), count(Selection::Unique), count(Selection::UniquePlaces)), (3, 2, 1));
    }
}
