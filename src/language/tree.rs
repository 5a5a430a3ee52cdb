//! Phrases nested under the nine tags.

use std::ops::Range;

use super::phrase::{Kind, Phrase};
use super::room_pick::{RoomPick, is_lead};
use super::tokens::Word;
use super::unit::Unit;
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

/// The chunk tree of a description: each errand with the phrases that pick its room.
pub fn build(
    errands: &[(Range<usize>, Option<RoomPick>)],
    phrases: &[Phrase],
    units: &[Unit],
    words: &[Word],
) -> Vec<Chunk> {
    let mut builder = Builder { roots: Vec::new(), object: None, target: None };
    for (range, picked) in errands {
        builder.add_errand(&phrases[range.clone()], picked.as_ref());
    }
    builder.finish().into_iter().map(|node| chunk(node, units, words)).collect()
}

struct Builder {
    roots: Vec<Node>,
    object: Option<Node>,
    target: Option<Node>,
}

impl Builder {
    fn add_errand(&mut self, phrases: &[Phrase], picked: Option<&RoomPick>) {
        for (i, phrase) in phrases.iter().enumerate() {
            match picked {
                Some(pick) if i == pick.first => self.add_room(pick, phrases),
                Some(pick) if pick.covers(i) => {}
                // Motions before the room is entered lead to it and make nothing of their own.
                Some(pick) if i < pick.first && (is_lead(phrase) || pick.on_the_way.contains(&i)) => {}
                Some(pick) if pick.restated.contains(&i) => self.restate_room(phrase),
                _ => self.add(phrase),
            }
        }
    }

    fn add(&mut self, phrase: &Phrase) {
        match phrase.kind {
            Kind::Stop => self.close_object(),
            Kind::Go | Kind::Turn => {
                self.close_object();
                self.roots.push(Node::new(Tag::Irmrp, phrase));
            }
            Kind::Part if phrase.is_reached() => {
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
            Kind::ObjectMark => {
                if phrase.inner.is_some() {
                    self.close_object();
                }
                self.attach(Node::new(Tag::Obrp, phrase).with_child(Tag::Irmrp, phrase.inner));
            }
            Kind::Object => {
                self.close_object();
                self.object = Some(Node::new(Tag::Obtp, phrase));
            }
            Kind::Room => self.attach(Node::new(Tag::Ormtp, phrase).with_child(Tag::Ormrp, phrase.inner)),
            Kind::Corrected | Kind::RuledOut => self.attach(Node::new(Tag::Conf, phrase)),
            Kind::Perspective => self.attach(Node::new(Tag::Pers, phrase)),
            Kind::Correction | Kind::Not | Kind::Aside | Kind::Leave | Kind::Recipient => {}
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

    /// The room said once more: "… on your right. So take a right into the room".
    fn restate_room(&mut self, phrase: &Phrase) {
        let inner = if phrase.kind == Kind::Room { phrase.inner } else { Some((phrase.first, phrase.past)) };
        self.attach(Node::new(Tag::Ormtp, phrase).with_child(Tag::Ormrp, inner));
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
