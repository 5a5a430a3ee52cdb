//! Phrases nested under the nine tags.

use super::phrases::{Kind, Phrase};
use super::tokens::Word;
use super::units::Unit;
use crate::record::{Chunk, Tag};

/// A chunk in units.
#[derive(Clone, Debug)]
struct Node {
    tag: Tag,
    first: usize,
    past: usize,
    rule: &'static str,
    children: Vec<Node>,
}

impl Node {
    fn new(tag: Tag, phrase: &Phrase) -> Self {
        Self { tag, first: phrase.first, past: phrase.past, rule: phrase.rule, children: Vec::new() }
    }

    fn with_child(mut self, tag: Tag, span: Option<(usize, usize)>) -> Self {
        if let Some((first, past)) = span {
            self.children.push(Self { tag, first, past, rule: self.rule, children: Vec::new() });
        }
        self
    }

    fn adopt(&mut self, child: Self) {
        self.past = self.past.max(child.past);
        self.children.push(child);
    }
}

/// The chunk tree of a description.
pub fn build(phrases: &[Phrase], units: &[Unit], words: &[Word]) -> Vec<Chunk> {
    let mut builder = Builder { roots: Vec::new(), object: None, target: None };
    let room = pick_room(phrases);
    for (i, phrase) in phrases.iter().enumerate() {
        match room {
            Some(ref pick) if i < pick.first || i > pick.first && i <= pick.last => {
                if i < pick.first && !is_lead(phrase) {
                    builder.add(phrase);
                }
            }
            Some(ref pick) if i == pick.first => builder.add_room(pick, phrases),
            _ => builder.add(phrase),
        }
    }
    builder.finish().into_iter().map(|node| chunk(node, units, words)).collect()
}

/// The phrases that pick the room.
struct RoomPick {
    /// The phrase that says which.
    first: usize,
    /// The last phrase that still belongs to it: "… into the room".
    last: usize,
}

fn is_lead(phrase: &Phrase) -> bool {
    matches!(phrase.kind, Kind::Go | Kind::Turn)
}

/// Which phrase picks the room: a room named with its side; else the last turn before a room is entered; else the
/// first turn or side said at all.
fn pick_room(phrases: &[Phrase]) -> Option<RoomPick> {
    let inside =
        phrases.iter().position(|p| matches!(p.kind, Kind::Target | Kind::Landmark | Kind::Part | Kind::ObjectMark));
    let before_inside = |i: &usize| inside.is_none_or(|limit| *i < limit);
    let turns_to = |p: &Phrase| matches!(p.kind, Kind::Turn | Kind::Side);
    let room = (0..phrases.len()).filter(before_inside).find(|&i| phrases[i].kind == Kind::Room);
    let sided =
        (0..phrases.len()).filter(before_inside).find(|&i| phrases[i].kind == Kind::Room && phrases[i].inner.is_some());
    let first_turn = (0..phrases.len()).find(|&i| turns_to(&phrases[i]));
    let with_rooms = |first: usize| {
        let last = (first + 1..phrases.len()).take_while(|&i| phrases[i].kind == Kind::Room).last().unwrap_or(first);
        Some(RoomPick { first, last })
    };
    if let Some(first) = sided.filter(|&s| room.is_some_and(|r| (r..s).all(|i| !turns_to(&phrases[i]) || i < r))) {
        return with_rooms(first);
    }
    if let Some(room) = room {
        let turn = (0..room).rev().find(|&i| turns_to(&phrases[i]));
        return match turn {
            Some(turn)
                if phrases[turn..room]
                    .iter()
                    .all(|p| matches!(p.kind, Kind::Turn | Kind::Side | Kind::Go | Kind::Stop)) =>
            {
                let adjacent = turn + 1 == room;
                if adjacent { with_rooms(turn) } else { Some(RoomPick { first: turn, last: turn }) }
            }
            _ if phrases[room].inner.is_none() => named_then_side(phrases, room).or_else(|| with_rooms(room)),
            _ => with_rooms(room),
        };
    }
    let turn = first_turn?;
    // "on the table to the right": beside furniture a side is a place, unless nothing else picks the room.
    let beside = phrases[..turn].iter().any(|p| matches!(p.kind, Kind::Target | Kind::Landmark));
    if phrases[turn].kind == Kind::Side && beside { None } else { with_rooms(turn) }
}

/// "in the room … (it is) on the left": a lone side right after a room without one.
fn named_then_side(phrases: &[Phrase], room: usize) -> Option<RoomPick> {
    (phrases.get(room + 1)?.kind == Kind::Side).then_some(RoomPick { first: room, last: room + 1 })
}

struct Builder {
    roots: Vec<Node>,
    object: Option<Node>,
    target: Option<Node>,
}

impl Builder {
    fn add(&mut self, phrase: &Phrase) {
        match phrase.kind {
            Kind::Stop => self.close_object(),
            Kind::Go | Kind::Turn => {
                self.close_object();
                self.roots.push(Node::new(Tag::Irmrp, phrase));
            }
            Kind::Side | Kind::Part => self.attach(Node::new(Tag::Irmrp, phrase)),
            Kind::Target => self.open_target(phrase),
            Kind::Landmark => {
                let node = Node::new(Tag::Furrp, phrase).with_child(Tag::Irmrp, phrase.inner);
                if phrase.inner.is_some() {
                    self.close_object();
                }
                self.attach(node);
            }
            Kind::ObjectMark => self.attach(Node::new(Tag::Obrp, phrase)),
            Kind::Object => {
                self.close_object();
                self.object = Some(Node::new(Tag::Obtp, phrase));
            }
            Kind::Room => self.attach(Node::new(Tag::Ormtp, phrase).with_child(Tag::Ormrp, phrase.inner)),
            Kind::Corrected => self.attach(Node::new(Tag::Conf, phrase)),
            Kind::Correction => {}
        }
    }

    /// The room phrase with the moves that lead to it.
    fn add_room(&mut self, pick: &RoomPick, phrases: &[Phrase]) {
        let phrase = &phrases[pick.first];
        let mut node = Node::new(Tag::Ormtp, phrase);
        node = match phrase.kind {
            Kind::Room => node.with_child(Tag::Ormrp, phrase.inner),
            _ => node.with_child(Tag::Ormrp, Some((phrase.first, phrase.past))),
        };
        for extra in &phrases[pick.first + 1..=pick.last] {
            node.past = node.past.max(extra.past);
            let side = if extra.kind == Kind::Side { Some((extra.first, extra.past)) } else { extra.inner };
            node = node.with_child(Tag::Ormrp, side);
        }
        if self.object.is_none() && self.target.is_none() {
            let leads = phrases[..pick.first].iter().rev().take_while(|p| is_lead(p));
            node.first = leads.map(|p| p.first).last().unwrap_or(node.first);
        }
        self.close_target();
        self.attach(node);
    }

    fn open_target(&mut self, phrase: &Phrase) {
        if phrase.inner.is_some() {
            self.close_object();
        } else {
            self.close_target();
        }
        self.target = Some(Node::new(Tag::Furtp, phrase).with_child(Tag::Irmrp, phrase.inner));
    }

    /// Into the innermost open phrase.
    fn attach(&mut self, node: Node) {
        match (&mut self.target, &mut self.object) {
            (Some(target), _) => target.adopt(node),
            (None, Some(object)) => object.adopt(node),
            (None, None) => self.roots.push(node),
        }
    }

    fn close_target(&mut self) {
        if let Some(target) = self.target.take() {
            match &mut self.object {
                Some(object) => object.adopt(target),
                None => self.roots.push(target),
            }
        }
    }

    fn close_object(&mut self) {
        self.close_target();
        if let Some(object) = self.object.take() {
            self.roots.push(object);
        }
    }

    fn finish(mut self) -> Vec<Node> {
        self.close_object();
        self.roots
    }
}

fn chunk(node: Node, units: &[Unit], words: &[Word]) -> Chunk {
    let (first, past) = (units[node.first].first, units[node.past - 1].past);
    Chunk {
        tag: node.tag,
        start: words[first].start,
        end: words[past - 1].end,
        rule: Some(node.rule.to_string()),
        chunks: node.children.into_iter().map(|child| chunk(child, units, words)).collect(),
    }
}
