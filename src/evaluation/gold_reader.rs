//! Gold descriptions from files: the project's own format, and the JSON lines of corpora with tokens, chunks and
//! groundings.

use serde::Deserialize;

use super::brackets::brackets_of;
use super::gold::{Gold, GoldError};
use super::labelled::parse_tree;
use super::meaning_gold::MeaningEntry;
use super::model::{in_order, label_of};
use super::treebank::TokenEntry;
use crate::record::{Grounding, Node, ObjectSlot, RoomSlot};

#[derive(Deserialize)]
#[serde(untagged)]
enum Entry {
    Own(Box<OwnEntry>),
    Tokens(Box<TokenEntry>),
    Meaning(Box<MeaningEntry>),
}

/// The project's own format.
#[derive(Deserialize)]
struct OwnEntry {
    id: String,
    text: String,
    tree: String,
    grounding: OwnGrounding,
    #[serde(default)]
    expect: Vec<String>,
}

#[derive(Deserialize)]
struct OwnGrounding {
    room: Option<RoomSlot>,
    object: Option<ObjectSlot>,
    nodes: Vec<Node>,
}

/// Reads gold descriptions, one JSON object a line; `file` is named in errors.
///
/// # Errors
/// When a line is no gold description or an id stands twice, with the line.
pub fn read_gold(text: &str, file: &str) -> Result<Vec<Gold>, GoldError> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(i, line)| {
            let wrong = |message: String| GoldError { file: file.to_string(), line: i + 1, message };
            let entry = serde_json::from_str(line).map_err(|error| {
                wrong(format!("no gold description ({error}); it needs id, text, and tree with grounding, or tokens with chunks; or id, object, room and pairs"))
            })?;
            match entry {
                Entry::Own(own) => from_own(*own).map_err(wrong),
                Entry::Tokens(tokens) => Ok(tokens.into_gold()),
                Entry::Meaning(meaning) => Ok(meaning.into_gold()),
            }
        })
        .collect()
}

fn from_own(entry: OwnEntry) -> Result<Gold, String> {
    let tree = parse_tree(&entry.tree).map_err(|error| error.to_string())?;
    if tree.text != entry.text {
        return Err("`tree` and `text` have different words".to_string());
    }
    let chunks: Vec<_> = tree.chunks.iter().map(|chunk| chunk.to_chunk()).collect();
    let OwnGrounding { room, object, nodes } = entry.grounding;
    let grounding =
        Grounding { room: room.clone(), object: object.clone(), nodes: nodes.clone(), ..Grounding::default() };
    let mut pairs: Vec<_> =
        nodes.iter().flat_map(|node| &node.pairs).map(|pair| (pair.reference.to_string(), pair.direction)).collect();
    pairs.sort();
    let room = room.unwrap_or_default();
    Ok(Gold {
        brackets: brackets_of(&entry.text, &chunks),
        id: entry.id,
        text: entry.text,
        side: room.side,
        room: room.name,
        object: object.map(|object| object.name),
        has_target: nodes.iter().any(|node| node.target.is_some()),
        target: nodes.iter().rev().find_map(|node| node.target.clone()),
        pairs,
        labels: in_order(&tree.chunks).into_iter().map(label_of).collect(),
        chunks,
        grounding: Some(grounding),
        expect: entry.expect,
        ..Gold::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    use crate::evaluation::labelled::LabelledChunk;
    use crate::evaluation::model::in_order;
    use crate::grounding::{Meaning, assemble, chunk_words, meaning_of_label};
    use crate::record::Tag;
    use crate::simulation::Scene;

    fn corpora() -> [(&'static str, &'static str); 2] {
        [
            ("templates.jsonl", include_str!("../../corpus/templates.jsonl")),
            ("speech.jsonl", include_str!("../../corpus/speech.jsonl")),
        ]
    }

    #[test]
    fn the_own_corpus_is_sound_and_its_furniture_exists() {
        let scene = Scene::apartment();
        let mut ids = BTreeSet::new();
        for (file, text) in corpora() {
            for gold in read_gold(text, file).expect("a sound corpus") {
                assert!(ids.insert(gold.id.clone()), "{} stands twice", gold.id);
                assert!(gold.expect.iter().all(|id| scene.item(id).is_some()), "{}", gold.id);
                assert!(file == "speech.jsonl" || !gold.expect.is_empty(), "{}", gold.id);
            }
        }
    }

    #[test]
    fn the_corpus_is_as_large_as_it_says() {
        let sizes = corpora().map(|(file, text)| read_gold(text, file).expect("a sound corpus").len());
        assert!(sizes[0] >= 149 && sizes[1] >= 200, "{sizes:?}");
    }

    #[test]
    fn the_speech_has_every_tag_and_every_direction() {
        let gold = read_gold(corpora()[1].1, "speech.jsonl").expect("a sound corpus");
        for tag in Tag::ALL {
            assert!(gold.iter().any(|g| g.brackets.iter().any(|(t, _, _)| *t == tag)), "{tag:?}");
        }
        for direction in ["front", "back", "left", "right", "central", "side", "between"] {
            assert!(gold.iter().any(|g| g.pairs.iter().any(|(_, d)| d.name() == direction)), "{direction}");
        }
    }

    #[test]
    fn the_templates_cover_every_cell() {
        let gold = read_gold(corpora()[0].1, "templates.jsonl").expect("a sound corpus");
        for object in ["fork", "glasses_case", "laptop", "statue", "monitor", "mug"] {
            for form in ["how", "where"] {
                for names in ["none", "table only", "other"] {
                    let cell =
                        |g: &&Gold| g.object.as_deref() == Some(object) && g.form() == form && g.names() == names;
                    assert!(gold.iter().any(|g| cell(&g)), "no {form} sentence for the {object} naming {names}");
                }
            }
        }
    }

    #[test]
    fn the_labels_in_the_trees_assemble_to_the_gold_pairs() {
        for (file, text) in corpora() {
            for (line, gold) in text.lines().zip(read_gold(text, file).expect("a sound corpus")) {
                let entry: serde_json::Value = serde_json::from_str(line).expect("JSON");
                let tree = parse_tree(entry["tree"].as_str().unwrap_or_default()).expect("a tree");
                let chunks: Vec<_> = tree.chunks.iter().map(|c| c.to_chunk()).collect();
                let meaning = |c: &LabelledChunk| meaning_of_label(c.tag, c.label.as_deref());
                let meanings: Vec<Meaning> = in_order(&tree.chunks).into_iter().map(meaning).collect();
                let grounding = assemble(&chunk_words(&tree.text, &chunks), &meanings);
                let mut pairs: Vec<_> = grounding
                    .nodes
                    .iter()
                    .flat_map(|n| &n.pairs)
                    .map(|p| (p.reference.to_string(), p.direction))
                    .collect();
                pairs.sort();
                assert_eq!(pairs, gold.pairs, "{file}: {}", gold.id);
            }
        }
    }

    #[test]
    fn a_bad_line_is_named() {
        let error = read_gold("\n{\"id\":1}\n", "my.jsonl").expect_err("no gold");
        assert!(error.to_string().starts_with("my.jsonl:2: no gold description"), "{error}");
    }
}
