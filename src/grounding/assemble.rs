//! Meanings of chunks → room, nodes, object: the paper's RDT assembly.

use super::meaning::{Meaning, pair};
use super::words::ChunkWords;
use crate::record::{Direction, Frame, Grounding, Node, ObjectSlot, Pair, Reference, RoomSlot, Tag};

/// Puts the chunks' meanings together, in pre-order.
///
/// References inside or beside a target's phrase are that node's pairs; moves
/// and places on their own make nodes of their own; a target said again
/// without anything new adds none.
pub fn assemble(chunks: &[ChunkWords], meanings: &[Meaning]) -> Grounding {
    let mut grounding =
        Grounding { room: room_of(chunks, meanings), object: object_of(chunks, meanings), ..Grounding::default() };
    let mut waiting: Vec<Pair> = Vec::new();
    for (i, (chunk, meaning)) in chunks.iter().zip(meanings).enumerate() {
        let in_target = chunk.parent.is_some_and(|parent| is_group(chunks[parent].tag));
        match chunk.tag {
            Tag::Furtp => {
                let mut node = target_node(i, chunks, meanings);
                node.pairs.splice(0..0, waiting.drain(..));
                push_target(&mut grounding.nodes, node);
            }
            Tag::Irmrp | Tag::Furrp | Tag::Obrp | Tag::Pers if !in_target => {
                let pairs = with_children(i, chunks, meanings);
                if pairs.is_empty() {
                    continue;
                }
                // "behind the couch, on a table": a place right before a target helps to find it.
                if leads_to_target(i, chunks) && is_static(meaning) {
                    waiting.extend(pairs);
                } else {
                    let score = meaning.score.into();
                    grounding.nodes.push(Node { pairs, score, ..Node::default() });
                }
            }
            _ => {}
        }
    }
    if meanings.iter().any(|meaning| meaning.facing) {
        face(&mut grounding);
    }
    take_held(&mut grounding, chunks, meanings);
    add_company(&mut grounding, chunks, meanings);
    if !waiting.is_empty() {
        grounding.nodes.push(Node { pairs: waiting, score: 0.8.into(), ..Node::default() });
    }
    grounding
}

/// "To the left of the bed as you face it": left and right of furniture are read by that person.
fn face(grounding: &mut Grounding) {
    let pairs = grounding.nodes.iter_mut().flat_map(|node| &mut node.pairs);
    for pair in pairs.filter(|pair| matches!(pair.frame, Frame::Viewer | Frame::Intrinsic)) {
        let furniture = !pair.reference.is_of_building();
        if furniture && matches!(pair.direction, Direction::Left | Direction::Right) {
            pair.frame = Frame::Facing;
        }
    }
}

/// "The table with the phone on it", and no other object: the phone is what is asked for.
fn take_held(grounding: &mut Grounding, chunks: &[ChunkWords], meanings: &[Meaning]) {
    // A word the lexicon lacks is a guess, and what is held is not.
    if grounding.object.as_ref().is_some_and(|object| object.score.0 > 0.7) {
        return;
    }
    let held = chunks.iter().zip(meanings).filter(|(chunk, _)| chunk.tag == Tag::Obrp);
    let Some(name) = held.filter_map(|(_, meaning)| meaning.object.as_ref()).next_back() else { return };
    for node in &mut grounding.nodes {
        node.pairs.retain(|pair| pair.reference.name() != *name);
    }
    grounding.object = Some(ObjectSlot { name: name.clone(), score: 0.8.into(), ..ObjectSlot::default() });
}

/// "There is a vase and the mug": other objects on the same support are landmarks.
fn add_company(grounding: &mut Grounding, chunks: &[ChunkWords], meanings: &[Meaning]) {
    let Some(object) = grounding.object.as_ref() else { return };
    let last = grounding.nodes.len().checked_sub(1);
    let Some(at) = grounding.nodes.iter().rposition(|node| node.target.is_some()).or(last) else { return };
    let node = &mut grounding.nodes[at];
    let others = chunks.iter().zip(meanings).filter(|(chunk, _)| chunk.tag == Tag::Obtp);
    for (_, meaning) in others {
        if let Some(other) = meaning.object.as_ref().filter(|other| **other != object.name && meaning.indefinite) {
            node.pairs.push(pair(other, Direction::Side));
        }
    }
}

/// Chunks whose inner references belong to them.
fn is_group(tag: Tag) -> bool {
    matches!(tag, Tag::Furtp | Tag::Furrp)
}

fn is_static(meaning: &Meaning) -> bool {
    meaning.pairs.iter().all(|pair| pair.reference != Reference::Move)
}

/// Whether the next chunk of the same parent that is no place is a target, within a clause about the object.
fn leads_to_target(index: usize, chunks: &[ChunkWords]) -> bool {
    if chunks[index].parent.is_none() {
        return brings_in_target(index, chunks);
    }
    let Some(parent) = chunks[index].parent.filter(|&parent| chunks[parent].tag == Tag::Obtp) else { return false };
    let after = chunks[parent].children.iter().filter(|&&child| child > index);
    after.map(|&child| chunks[child].tag).find(|tag| !matches!(tag, Tag::Irmrp | Tag::Furrp | Tag::Obrp | Tag::Pers))
        == Some(Tag::Furtp)
}

/// "Behind the bed there is a desk": a place without a verb, and the very next clause names the target there.
fn brings_in_target(index: usize, chunks: &[ChunkWords]) -> bool {
    const PLACES: [&str; 14] = [
        "behind", "in", "on", "at", "next", "by", "beside", "between", "near", "against", "to", "past", "across",
        "close",
    ];
    let place = chunks[index].words.first().is_some_and(|word| PLACES.contains(&word.lower.as_ref()));
    let next = chunks[index + 1..].iter().find(|chunk| chunk.parent.is_none());
    let bare = |chunk: &ChunkWords| !chunk.children.iter().any(|&child| chunks[child].tag == Tag::Irmrp);
    place && bare(&chunks[index]) && next.is_some_and(|chunk| chunk.tag == Tag::Furtp && bare(chunk))
}

/// The pairs of a chunk and of the chunks in it, in the order spoken.
fn with_children(index: usize, chunks: &[ChunkWords], meanings: &[Meaning]) -> Vec<Pair> {
    let mut parts: Vec<(usize, usize)> = vec![(own_place(&chunks[index]), index)];
    parts.extend(
        chunks[index]
            .children
            .iter()
            .filter(|&&child| !matches!(chunks[child].tag, Tag::Furtp | Tag::Obtp))
            .map(|&child| (chunks[child].start, child)),
    );
    parts.sort_unstable();
    let mut pairs: Vec<Pair> = Vec::new();
    for (_, part) in parts {
        let said = if part == index { meanings[part].pairs.clone() } else { with_children(part, chunks, meanings) };
        // "By the purse uh by the black purse": said twice in one breath, meant once.
        pairs.extend(said.into_iter().filter(|pair| pairs.last() != Some(pair)).collect::<Vec<_>>());
    }
    pairs
}

/// Where a chunk's own words begin.
fn own_place(chunk: &ChunkWords) -> usize {
    chunk.words.first().map_or(chunk.start, |word| word.start)
}

fn target_node(index: usize, chunks: &[ChunkWords], meanings: &[Meaning]) -> Node {
    let meaning = &meanings[index];
    Node {
        target: meaning.target.clone(),
        attributes: meaning.attributes.clone(),
        ordinal: meaning.ordinal,
        pairs: with_children(index, chunks, meanings),
        score: meaning.score.into(),
    }
}

/// "The computer desk … that desk": the head noun alone means the compound said before.
fn same_target(known: Option<&str>, said: Option<&str>) -> bool {
    let (Some(known), Some(said)) = (known, said) else { return false };
    known == said || known.strip_suffix(said).is_some_and(|rest| rest.ends_with('_'))
}

/// A target without anything of its own that was just said is no new node: "… on that table".
fn push_target(nodes: &mut Vec<Node>, node: Node) {
    let bare = node.pairs.is_empty();
    if node.target.is_none() && bare {
        return;
    }
    let again = nodes.iter_mut().rev().find(|known| same_target(known.target.as_deref(), node.target.as_deref()));
    match again {
        Some(known) if bare => known.attributes.extend(node.attributes),
        _ => nodes.push(node),
    }
}

/// The first side said picks the room; the first name names it.
fn room_of(chunks: &[ChunkWords], meanings: &[Meaning]) -> Option<RoomSlot> {
    let rooms = || {
        chunks.iter().zip(meanings).filter(|(chunk, _)| matches!(chunk.tag, Tag::Ormtp | Tag::Ormrp)).map(|(_, m)| m)
    };
    let name = rooms().find_map(|meaning| meaning.room.clone());
    let side = rooms().find_map(|meaning| meaning.side);
    let ordinal = rooms().find_map(|meaning| meaning.ordinal);
    let score = rooms().filter(|m| m.room.is_some() || m.side.is_some()).map(|m| m.score).fold(1.0, f64::min);
    (name.is_some() || side.is_some()).then(|| RoomSlot { name, side, ordinal, score: score.into() })
}

/// The best-scored object; the last of equals: what stands beside it is said first.
fn object_of(chunks: &[ChunkWords], meanings: &[Meaning]) -> Option<ObjectSlot> {
    let named = chunks
        .iter()
        .zip(meanings)
        .filter(|(chunk, _)| chunk.tag == Tag::Obtp)
        .filter_map(|(_, m)| Some((m.object.as_ref()?, m)));
    let best = named.fold(None, |best: Option<(&String, &Meaning)>, next| match best {
        Some(known) if known.1.score > next.1.score => Some(known),
        _ => Some(next),
    });
    best.map(|(name, meaning)| ObjectSlot {
        name: name.clone(),
        attributes: meaning.attributes.clone(),
        score: meaning.score.into(),
    })
}
