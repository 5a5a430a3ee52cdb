//! Gold trees of corpora that label chunks by token.

use super::token_gold::{TokenChunk, tag_of};
use crate::record::Chunk;

/// The tree over the words of `text`, chunks given in pre-order; what does not nest is left out.
pub(super) fn tree_of(text: &str, chunks: &[TokenChunk]) -> Vec<Chunk> {
    let words: Vec<(usize, usize)> = text
        .split_whitespace()
        .map(|word| {
            let start = word.as_ptr() as usize - text.as_ptr() as usize;
            (start, start + word.len())
        })
        .collect();
    let mut roots: Vec<Chunk> = Vec::new();
    for chunk in chunks {
        let span = words.get(chunk.start).zip(chunk.end.checked_sub(1).and_then(|last| words.get(last)));
        let (Some(tag), Some((&(start, _), &(_, end)))) = (tag_of(&chunk.tag), span) else { continue };
        if start < end {
            nest(&mut roots, Chunk { tag, start, end, rule: None, chunks: Vec::new() });
        }
    }
    roots
}

/// Into the last chunk that holds it, or after it.
fn nest(level: &mut Vec<Chunk>, chunk: Chunk) {
    match level.last_mut() {
        Some(last) if last.start <= chunk.start && chunk.end <= last.end => nest(&mut last.chunks, chunk),
        Some(last) if chunk.start < last.end => {}
        _ => level.push(chunk),
    }
}

#[cfg(test)]
mod tests {
    use crate::evaluation::read_gold;
    use crate::record::Direction;

    const LINE: &str = r#"{"id":"a","text":"turn left and the mug is on the desk by the bed","chunks":[{"tag":"ORMTP","start":0,"end":2,"depth":0},{"tag":"ORMRP","start":0,"end":2,"depth":1},{"tag":"OBTP","start":3,"end":12,"depth":0},{"tag":"FURTP","start":6,"end":12,"depth":1},{"tag":"FURRP","start":9,"end":12,"depth":2}],"groundings":[{},{"room":"bedroom"},{"object":"mug"},{"target":"table"},{"reference":"bed","direction":"beside"}]}"#;

    #[test]
    fn a_tree_by_token_becomes_one_by_byte_and_its_labels_a_meaning() {
        let gold = &read_gold(LINE, "treebank.jsonl").expect("gold")[0];
        let object = &gold.chunks[1];
        assert_eq!(&gold.text[object.start..object.end], "the mug is on the desk by the bed");
        let reference = &object.chunks[0].chunks[0];
        assert_eq!(&gold.text[reference.start..reference.end], "by the bed");
        let meaning = gold.grounding.as_ref().expect("labelled");
        assert_eq!(meaning.nodes.len(), 1);
        assert_eq!(meaning.nodes[0].pairs[0].direction, Direction::Side);
        assert_eq!(meaning.room.as_ref().and_then(|room| room.side), Some(Direction::Left));
    }
}
