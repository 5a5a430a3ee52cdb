//! Phrases → room, nodes, objects, destination: one assembler that knows where in the story it is.
//!
//! The story of an errand goes from the way to the room over the steps inside
//! it to the furniture and the object, and perhaps on to where the object
//! shall be brought. What a phrase adds depends on how far the story is.

use super::meaning::pair;
use super::phrase_pairs::pairs_of;
use crate::language::{
    Act, Article, Class, Errand, From, Kind, NounPhrase, Phrase, Reading, Recipient, Relation, Role, RoomPick,
    attributes_of, is_lead, name_of,
};
use crate::record::{Amount, Destination, Direction, Frame, Grounding, Node, ObjectSlot, Pair, RoomSlot, RuledOut};

/// What was understood of a reading: its first errand, and the others under `then`; and what the first errand's
/// object may be instead.
pub fn tell(reading: &Reading, errands: &[Errand]) -> (Grounding, Option<ObjectSlot>) {
    let mut told = errands.iter().map(|(range, pick)| {
        let mut story = Story::new(reading, &reading.phrases[range.clone()], pick.as_ref());
        story.run();
        story.end()
    });
    let (mut first, instead) = told.next().unwrap_or_default();
    for (mut next, _) in told {
        first.then.append(&mut next.then);
        let empty = next.object.is_none() && next.nodes.is_empty() && next.room.is_none() && next.destination.is_none();
        if !empty {
            first.then.push(Grounding { then: Vec::new(), ..next });
        }
    }
    (first, instead)
}

/// An object as heard, and how strongly it was asked for.
#[derive(Clone)]
struct Heard {
    slot: ObjectSlot,
    strength: u8,
    /// The node that was open when it was named.
    node: Option<usize>,
    /// It was told to be somewhere, not only mentioned.
    told: bool,
}

struct Story<'r> {
    reading: &'r Reading<'r>,
    phrases: &'r [Phrase],
    pick: Option<&'r RoomPick>,
    grounding: Grounding,
    heard: Vec<Heard>,
    /// Places said before the furniture that they help to find.
    waiting: Vec<Pair>,
    /// The furniture to whose node places are added.
    open: Option<usize>,
    /// The furniture or thing named last, for "it".
    last: Option<String>,
    /// What the clause does.
    act: Act,
    /// Places are those of the destination.
    delivering: bool,
    /// The furniture is itself what is asked for.
    asked: bool,
    destination: Destination,
    rooms: Vec<(String, bool)>,
    facing: bool,
}

impl<'r> Story<'r> {
    fn new(reading: &'r Reading<'r>, phrases: &'r [Phrase], pick: Option<&'r RoomPick>) -> Self {
        Self {
            reading,
            phrases,
            pick,
            grounding: Grounding::default(),
            heard: Vec::new(),
            waiting: Vec::new(),
            open: None,
            last: None,
            act: Act::None,
            delivering: false,
            asked: false,
            destination: Destination::default(),
            rooms: Vec::new(),
            facing: false,
        }
    }

    fn run(&mut self) {
        for at in 0..self.phrases.len() {
            let picks = self.pick.is_some_and(|pick| pick.covers(at));
            let led = self.pick.is_some_and(|pick| {
                at < pick.first && (is_lead(&self.phrases[at]) || pick.on_the_way.contains(&at))
                    || pick.restated.contains(&at)
            });
            let phrase = &self.phrases[at];
            match phrase.kind {
                Kind::Room => self.room(phrase),
                Kind::Leave => self.leave(phrase),
                _ if picks || led => {}
                Kind::Stop => self.stop(),
                Kind::Go | Kind::Turn => self.step(phrase),
                Kind::Side | Kind::Part | Kind::Landmark | Kind::ObjectMark => self.place(at),
                Kind::Target => self.target(at),
                Kind::Object => self.object(phrase),
                Kind::Recipient => self.recipient(phrase),
                Kind::Perspective => self.view(at),
                Kind::RuledOut => self.rule_out(phrase),
                Kind::Correction | Kind::Corrected | Kind::Not | Kind::Aside => {}
            }
        }
    }

    fn stop(&mut self) {
        self.open = None;
        self.act = Act::None;
        self.delivering = false;
    }

    fn name(&self, noun: &NounPhrase) -> String {
        name_of(noun, &self.reading.units, false)
    }

    fn says(&self, phrase: &Phrase, words: &[&str]) -> bool {
        self.reading.units[phrase.first..phrase.past].iter().any(|unit| words.contains(&unit.lower.as_ref()))
    }

    // --- rooms

    /// The name of the room that a phrase is about; "the room" has none.
    fn room_name(&self, phrase: &Phrase) -> Option<String> {
        let noun = phrase.noun()?;
        if let Some(room) = noun.room {
            return self.reading.units[room].noun.map(|noun| noun.name.to_string());
        }
        let name = name_of(noun, &self.reading.units, false);
        let named = noun.class == Some(Class::Room) && !matches!(name.as_str(), "room" | "intersection");
        named.then_some(name)
    }

    fn room(&mut self, phrase: &Phrase) {
        let Some(name) = self.room_name(phrase) else { return };
        let source = self.says(phrase, &["from", "of"]) && !self.delivering;
        let into = self.says(phrase, &["to", "into", "in", "inside", "for", "at"]);
        // The hall is on the way unless the thing is there.
        if name.contains("hall") && self.says(phrase, &["down", "along", "through", "of", "from", "off", "across"]) {
            return;
        }
        let brings = self.act.delivers() && self.says(phrase, &["to", "into"]);
        let puts = self.act == Act::Put && into;
        let given = self.delivering && self.destination.recipient.is_some() && into;
        if !source && !phrase.is_moved(&self.reading.units) && (self.delivering && into || brings || puts || given) {
            if self.destination.room.is_none() {
                self.destination.room = Some(name);
            }
            return;
        }
        let passage = matches!(name.as_str(), "hallway" | "hall" | "corridor");
        self.rooms.push((name, passage));
    }

    /// A room that is left, or from which a thing is brought.
    fn leave(&mut self, phrase: &Phrase) {
        self.open = None;
        if self.act.delivers()
            && self.says(phrase, &["from"])
            && let Some(name) = self.room_name(phrase)
        {
            self.rooms.push((name, false));
        }
    }

    // --- steps and places

    fn step(&mut self, phrase: &Phrase) {
        self.flush();
        self.open = None;
        self.act = Act::None;
        self.delivering = false;
        let mut pairs = self.pairs(phrase);
        let turned = phrase.directions[0] != Some(Direction::Front);
        if let Some(pair) = pairs.first_mut() {
            // A quarter turn is what "turn" says anyway.
            let quarter = matches!(phrase.amount, Some(Amount::Degrees(degrees)) if degrees == 90.0);
            pair.amount =
                phrase.amount.clone().filter(|amount| !turned || matches!(amount, Amount::Degrees(_)) && !quarter);
        }
        self.push_node(pairs);
    }

    fn push_node(&mut self, pairs: Vec<Pair>) {
        if !pairs.is_empty() {
            self.grounding.nodes.push(Node { pairs, score: 0.9.into(), ..Node::default() });
        }
    }

    /// Places that waited for furniture which did not come.
    fn flush(&mut self) {
        let waiting = std::mem::take(&mut self.waiting);
        self.push_node(waiting);
    }

    /// References and directions of a phrase.
    fn pairs(&self, phrase: &Phrase) -> Vec<Pair> {
        pairs_of(phrase, &self.reading.units, self.last.as_deref())
    }

    fn place(&mut self, at: usize) {
        let phrase = &self.phrases[at];
        if self.is_put_beside(phrase) {
            return;
        }
        if phrase.kind == Kind::ObjectMark
            && !matches!(phrase.relation, Some(Relation::Landmark(_)) | None)
            && self.holds(phrase)
        {
            return;
        }
        self.note_room(phrase);
        // "As soon as you walk in, turn left" says when; "just as you walk in on the table" says where.
        let next = self.phrases[at + 1..].iter().find(|next| next.kind != Kind::Aside);
        if phrase.entering && next.is_none_or(|next| matches!(next.kind, Kind::Turn | Kind::Go | Kind::Room)) {
            return;
        }
        if phrase.from == From::It && self.is_under_it(at) {
            return;
        }
        let pairs = self.pairs(phrase);
        self.remember(phrase);
        self.take_held(phrase);
        if phrase.is_reached() {
            self.open = None;
        }
        self.attach(at, pairs);
    }

    /// "At the back of the office" and "at the bedroom door" say which room.
    fn note_room(&mut self, phrase: &Phrase) {
        if phrase.kind == Kind::Part
            && let Some(name) = self.room_name(phrase)
        {
            let passage = matches!(name.as_str(), "hallway" | "hall" | "corridor");
            self.rooms.push((name, passage));
        }
    }

    /// "There's a bench and the glove is under it": the bench holds nothing, it only says where.
    fn is_under_it(&mut self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        let told = at > 0 && self.phrases[at - 1].kind == Kind::Object && self.phrases[at - 1].past == phrase.first;
        let nodes = &mut self.grounding.nodes;
        let Some(node) = nodes.iter_mut().rev().find(|node| node.target.is_some()) else { return false };
        if !told || node.target != self.last {
            return false;
        }
        let Some(direction) = phrase.directions[0] else { return false };
        if let Some(own) = node.target.take() {
            node.pairs.push(pair(&own, direction));
        }
        self.open = None;
        true
    }

    /// "Put it in the box": the box is where it goes.
    fn holds(&mut self, phrase: &Phrase) -> bool {
        let goes =
            (self.act == Act::Put || self.delivering || self.act.delivers() && phrase.relation == Some(Relation::To))
                && phrase.relation != Some(Relation::From);
        if goes
            && self.destination.target.is_none()
            && let Some(noun) = phrase.noun()
        {
            self.destination.target = Some(self.name(noun));
            self.open = None;
            return true;
        }
        false
    }

    /// "Put it next to you" says nothing that helps to find it.
    fn is_put_beside(&self, phrase: &Phrase) -> bool {
        phrase.from == From::Robot && phrase.directions[0] == Some(Direction::Side)
    }

    fn remember(&mut self, phrase: &Phrase) {
        if let Some(noun) = phrase.nouns.last().filter(|noun| !noun.generic) {
            self.last = Some(self.name(noun));
        }
    }

    /// "There's a stand with my dentures on it": what it holds may be what is asked for.
    fn take_held(&mut self, phrase: &Phrase) {
        let Some(noun) = phrase.noun().filter(|noun| phrase.held && !noun.generic) else { return };
        let units = &self.reading.units;
        let mine = units[noun.first..noun.head].iter().any(|unit| unit.has(Role::Hearer));
        let told = self
            .phrases
            .iter()
            .rev()
            .filter(|other| other.first < phrase.first)
            .find(|other| other.kind == Kind::Target);
        let brought_in = told.is_none_or(|target| !matches!(target.relation, Some(Relation::On | Relation::In)));
        let told_there = told.is_some_and(|target| target.act == Act::There);
        match noun.article {
            _ if noun.is_furniture() => {}
            Article::Definite if mine || brought_in => self.hear(noun, 2),
            // "There's a dresser with a humidifier on top", and nothing else is named.
            Article::Indefinite if told_there => self.hear(noun, 0),
            _ => {}
        }
    }

    /// Into the node of the furniture said before, or to wait for the furniture said next, or as a step of its own.
    fn attach(&mut self, at: usize, pairs: Vec<Pair>) {
        let reached = self.phrases[at].is_reached();
        match self.open {
            Some(node) if !reached => {
                let known = &mut self.grounding.nodes[node].pairs;
                // "By the purse uh by the black purse": said twice in one breath, meant once.
                let before = at.checked_sub(1).map(|before| &self.phrases[before]);
                let breath = before.is_some_and(|before| {
                    before.past == self.phrases[at].first
                        && matches!(before.kind, Kind::Side | Kind::Part | Kind::Landmark | Kind::ObjectMark)
                });
                let again = breath && pairs.len() == 1 && known.last() == pairs.first();
                known.extend(pairs.into_iter().filter(|_| !again));
            }
            _ if self.target_follows(at) && !reached => self.waiting.extend(pairs),
            _ => {
                self.flush();
                self.push_node(pairs);
            }
        }
    }

    /// Whether the very next phrase that is no place brings in furniture.
    fn target_follows(&self, at: usize) -> bool {
        for next in &self.phrases[at + 1..] {
            match next.kind {
                Kind::Side | Kind::Part | Kind::Landmark | Kind::ObjectMark | Kind::Perspective
                    if !next.is_reached() => {}
                Kind::Aside | Kind::Room | Kind::RuledOut | Kind::Not | Kind::Corrected => {}
                Kind::Object if matches!(next.act, Act::State | Act::There | Act::Find) => {}
                Kind::Target => return !next.is_reached() || self.says(next, &["see", "find"]),
                _ => return false,
            }
        }
        false
    }

    // --- furniture

    fn target(&mut self, at: usize) {
        let phrase = &self.phrases[at];
        // "Until it reaches the table or the desk": the last.
        let either = phrase.nouns.len() > 1 && self.says(phrase, &["or"]);
        let Some(noun) = (if either { phrase.nouns.last() } else { phrase.noun() }).copied() else { return };
        if phrase.act != Act::None {
            self.act = phrase.act;
        }
        if self.is_destination(at, &noun) {
            self.destination.target = Some(self.name(&noun));
            self.add_destination_room(&noun);
            self.open = None;
            self.delivering = true;
            return;
        }
        if self.is_landmark(at, &noun) {
            let mut pairs = vec![pair(&self.name(&noun), Direction::Side)];
            pairs[0].ordinal = noun.ordinal;
            self.last = Some(self.name(&noun));
            return self.attach(at, pairs);
        }
        if let Some(room) = noun.room {
            let name = self.reading.units[room].noun.map_or(String::new(), |noun| noun.name.to_string());
            self.rooms.push((name, false));
        }
        let first = self.heard.is_empty() && self.waiting.is_empty() && self.grounding.nodes.is_empty();
        self.asked |= first
            && self.rooms.is_empty()
            && self.pick.is_none()
            && phrase.relation.is_none()
            && phrase.act != Act::There
            && !phrase.is_reached()
            && noun.article != Article::Indefinite;
        if phrase.recipient == Some(Recipient::Speaker) {
            self.destination.recipient = Some("speaker".to_string());
        }
        self.push_target(phrase, &noun);
        self.several_places(phrase);
    }

    fn add_destination_room(&mut self, noun: &NounPhrase) {
        if let Some(room) = noun.room {
            self.destination.room = self.reading.units[room].noun.map(|noun| noun.name.to_string());
        }
    }

    /// Whether a thing that is carried shall go there.
    fn is_destination(&self, at: usize, _noun: &NounPhrase) -> bool {
        let phrase = &self.phrases[at];
        if phrase.relation == Some(Relation::From) || phrase.relation.is_none() || self.destination.target.is_some() {
            return false;
        }
        let moved = phrase.is_reached() || self.says(phrase, &["see", "find", "look", "check"]);
        let to = phrase.relation == Some(Relation::To);
        let goes_on = self.says_to_later(at);
        match self.act {
            Act::Put => !moved && (to || !goes_on) && !self.is_source(at),
            Act::Fetch | Act::Give => !moved && (to || self.delivering),
            Act::Other => !moved && to && !self.heard.is_empty(),
            _ => self.delivering && !moved,
        }
    }

    /// "Put the glass on the mantel in the dishwasher": of two places after the thing the first is where it is.
    fn is_source(&self, at: usize) -> bool {
        let named = at > 0
            && self.phrases[at - 1].kind == Kind::Object
            && self.phrases[at - 1].noun().is_some_and(|noun| !noun.generic);
        let next = self.phrases.get(at + 1).filter(|next| next.first == self.phrases[at].past);
        named
            && next.is_some_and(|next| {
                next.kind == Kind::Target && matches!(next.relation, Some(Relation::In | Relation::On))
            })
    }

    /// "Move the book on the desk to the shelf": where it goes is said later in the clause.
    fn says_to_later(&self, at: usize) -> bool {
        for next in &self.phrases[at + 1..] {
            match next.kind {
                Kind::Target | Kind::ObjectMark => {
                    return matches!(next.relation, Some(Relation::To)) && !next.is_reached();
                }
                Kind::Room => return self.says(next, &["to", "into"]) && !next.is_moved(&self.reading.units),
                Kind::Recipient => return true,
                Kind::Side | Kind::Part | Kind::Landmark | Kind::Aside => {}
                _ => return false,
            }
        }
        false
    }

    /// Furniture that is only a way-point, or the place of the furniture asked for.
    fn is_landmark(&self, at: usize, noun: &NounPhrase) -> bool {
        let phrase = &self.phrases[at];
        let name = self.name(noun);
        if matches!(name.as_str(), "floor" | "ground" | "ceiling") && phrase.relation.is_some() {
            return true;
        }
        let stairs =
            matches!(name.as_str(), "stairs" | "staircase" | "stair" | "step") && self.says(phrase, &["up", "down"]);
        // "The cabinet sitting on the floor", "the laptop on the table": where the thing asked for itself stands.
        let again = self.grounding.nodes.iter().any(|node| same_target(node.target.as_deref(), Some(&name)));
        let of_asked = self.asked
            && !again
            && matches!(phrase.relation, Some(Relation::On | Relation::In | Relation::At))
            && !phrase.is_reached()
            && self.heard.is_empty();
        stairs || of_asked || self.is_waypoint(at)
    }

    /// Furniture that is gone to, or turned at, and not the last.
    fn is_waypoint(&self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        let turned_at = at > 0
            && phrase.relation == Some(Relation::At)
            && self.phrases[at - 1].kind == Kind::Turn
            && self.phrases[at - 1].past == phrase.first;
        if !phrase.is_reached() && !turned_at {
            return false;
        }
        let either = phrase.nouns.len() > 1 && self.says(phrase, &["or"]);
        let own = if either { phrase.nouns.last() } else { phrase.noun() };
        let own = own.map(|noun| self.name(noun));
        let rest = &self.phrases[at + 1..];
        let other = |next: &&Phrase| {
            next.kind == Kind::Target
                && next.noun().map(|noun| self.name(noun)).is_some_and(|name| {
                    !same_target(own.as_deref(), Some(&name)) && !matches!(name.as_str(), "floor" | "ground")
                })
        };
        let again = rest
            .iter()
            .filter(|next| next.kind == Kind::Target)
            .any(|next| next.noun().is_some_and(|noun| same_target(own.as_deref(), Some(&self.name(noun)))));
        if rest.iter().any(|next| other(&next)) && !again {
            return true;
        }
        let turns = rest
            .iter()
            .find(|next| !matches!(next.kind, Kind::Aside | Kind::Stop))
            .is_some_and(|next| next.kind == Kind::Turn);
        let until = self.says(phrase, &["until", "til", "till", "reach", "when", "untill"]);
        turns && until && !again && !rest.iter().any(|next| next.kind == Kind::Object && next.act == Act::LookDown)
    }

    fn push_target(&mut self, phrase: &Phrase, noun: &NounPhrase) {
        let name = self.name(noun);
        let mut pairs: Vec<Pair> = std::mem::take(&mut self.waiting);
        if phrase.is_reached() && self.reading.units[phrase.first].has(Role::Motion) {
            pairs.insert(0, pair("move", Direction::Front));
        }
        // "Until you reach the end, a table": the far one.
        if noun.part == Some(Direction::Back) {
            pairs.push(pair("room", Direction::Back));
        }
        if let Some(side) = noun.side {
            pairs.push(pair("robot", side));
        }
        self.last = Some(name.clone());
        let node = Node {
            target: Some(name),
            attributes: attributes_of(noun, &self.reading.units),
            ordinal: noun.ordinal,
            pairs,
            score: if noun.class.is_some() { 0.95 } else { 0.6 }.into(),
        };
        let nodes = &mut self.grounding.nodes;
        let again = nodes.iter().rposition(|known| same_target(known.target.as_deref(), node.target.as_deref()));
        match again {
            Some(known) => {
                nodes[known].attributes.extend(node.attributes);
                nodes[known].pairs.extend(node.pairs);
                // The furniture named last is the one that holds the thing.
                let last = nodes.iter().rposition(|node| node.target.is_some());
                if last != Some(known) {
                    let own = nodes.remove(known);
                    nodes.push(own);
                }
                self.open = nodes.iter().rposition(|node| node.target.is_some());
            }
            None => {
                nodes.push(node);
                self.open = Some(nodes.len() - 1);
            }
        }
    }

    /// "Go to the table and the counter": one after the other.
    fn several_places(&mut self, phrase: &Phrase) {
        if !matches!(phrase.relation, Some(Relation::To)) {
            return;
        }
        for noun in phrase.nouns.iter().skip(1).filter(|noun| noun.is_furniture()) {
            let node = Node { target: Some(self.name(noun)), score: 0.9.into(), ..Node::default() };
            self.grounding.then.push(Grounding { nodes: vec![node], ..Grounding::default() });
        }
    }

    // --- objects

    fn object(&mut self, phrase: &Phrase) {
        self.act = phrase.act;
        match phrase.recipient {
            Some(Recipient::Speaker) => self.destination.recipient = Some("speaker".to_string()),
            Some(Recipient::Person(unit)) => self.destination.recipient = Some(self.person(unit)),
            None => {}
        }
        let strength = match phrase.act {
            Act::Find | Act::Fetch | Act::Give | Act::Put => 4,
            Act::Other => 2,
            _ => 3,
        };
        for (index, noun) in phrase.nouns.iter().enumerate() {
            if noun.generic
                || noun.is_furniture() && index > 0 && phrase.nouns[0].class == Some(Class::Object) && strength < 4
            {
                continue;
            }
            let one_of_others = noun.article == Article::Indefinite && matches!(phrase.act, Act::State | Act::There);
            self.hear(noun, if one_of_others { 1 } else { strength });
            let alone = phrase.act == Act::State && noun.past == phrase.past && phrase.first == noun.first;
            if let Some(heard) = self.heard.last_mut() {
                heard.told = !alone;
            }
        }
        if phrase.noun().is_some_and(|noun| !noun.generic) {
            self.last = phrase.noun().map(|noun| self.name(noun));
        }
        let names = phrase.noun().is_some_and(|noun| !noun.generic);
        // A new thing is told of: places before it are not its own; "it" goes on.
        if names && phrase.act != Act::State && phrase.act != Act::There {
            self.open = None;
        }
        if phrase.act == Act::State || phrase.act == Act::There {
            // "Bring it to Dad, he's on the balcony": that is where it goes.
            let told_of = matches!(self.reading.units[phrase.first].lower.as_ref(), "he" | "she" | "they");
            let person = self.destination.recipient.as_ref().is_some_and(|name| name != "speaker");
            self.delivering = told_of && person && !names;
            if names {
                self.open = self.open.filter(|_| self.target_goes_on(phrase));
            }
        }
        self.delivering =
            phrase.act == Act::Put && !self.heard.is_empty() && !names || self.delivering && phrase.act.delivers();
        self.asked = self.asked && !names;
    }

    /// "… there is a table and the keys are next to the lamp": places of the thing are places of its table.
    fn target_goes_on(&self, _phrase: &Phrase) -> bool {
        true
    }

    fn hear(&mut self, noun: &NounPhrase, strength: u8) {
        let units = &self.reading.units;
        if let Some(room) = noun.room {
            self.rooms.push((units[room].noun.map_or(String::new(), |noun| noun.name.to_string()), false));
        }
        let known = if noun.class.is_some() && !noun.inferred { 0.97 } else { 0.6 };
        let slot = ObjectSlot {
            name: name_of(noun, units, true),
            attributes: attributes_of(noun, units),
            score: known.into(),
        };
        self.heard.push(Heard { slot, strength, node: self.open, told: true });
    }

    fn person(&self, unit: usize) -> String {
        let name = self.reading.units[unit].lower.replace(['.', ','], "").replace([' ', '-'], "_");
        if matches!(name.as_str(), "me" | "us") { "speaker".to_string() } else { name }
    }

    fn recipient(&mut self, phrase: &Phrase) {
        self.open = None;
        let name = match phrase.recipient {
            Some(Recipient::Person(unit)) => self.person(unit),
            _ => "speaker".to_string(),
        };
        let asked = self.heard.iter().any(|heard| heard.strength >= 2) || self.act.delivers();
        if asked || self.grounding.nodes.iter().any(|node| node.target.is_some()) {
            self.delivering = name != "speaker";
            self.destination.recipient = Some(name);
        }
    }

    fn view(&mut self, at: usize) {
        let phrase = &self.phrases[at];
        match phrase.from {
            From::Nouns => {
                let pairs = self.pairs(phrase);
                self.attach(at, pairs);
            }
            _ => self.facing = true,
        }
    }

    fn rule_out(&mut self, phrase: &Phrase) {
        for noun in &phrase.nouns {
            let name = match noun.class {
                Some(Class::Room) => match self.room_name(phrase) {
                    Some(name) => name,
                    None => continue,
                },
                _ if noun.generic || noun.class == Some(Class::Opening) => continue,
                _ => name_of(noun, &self.reading.units, false),
            };
            // "A table, well, not a table, a nightstand": it is taken back.
            let nodes = &mut self.grounding.nodes;
            if let Some(at) = nodes.iter().rposition(|node| node.target.as_deref() == Some(name.as_str())) {
                nodes[at].target = None;
                if nodes[at].pairs.is_empty() {
                    nodes.remove(at);
                }
                self.open = None;
                continue;
            }
            if !self.grounding.not.iter().any(|known| known.name == name) {
                self.grounding.not.push(RuledOut { name });
            }
        }
    }

    // --- the end

    fn end(mut self) -> (Grounding, Option<ObjectSlot>) {
        self.flush();
        let heard: Vec<ObjectSlot> =
            self.heard.iter().filter(|heard| heard.strength > 1).map(|heard| heard.slot.clone()).collect();
        self.settle_objects();
        let chosen = self.grounding.object.as_ref().map(|object| head_of(&object.name));
        let also = |slot: &ObjectSlot| self.grounding.also.iter().any(|known| known.name == slot.name);
        let instead = heard.into_iter().find(|slot| Some(head_of(&slot.name)) != chosen && !also(slot));
        self.settle_room();
        if self.facing {
            face(&mut self.grounding);
        }
        self.grounding.destination = (!self.destination.is_empty()).then_some(self.destination);
        (self.grounding, instead)
    }

    /// Of the things heard, the one asked for, the ones asked for beside it, and those that only lie near by.
    fn settle_objects(&mut self) {
        let Some(most) = self.heard.iter().map(|heard| heard.strength).max() else { return };
        // What only lies with other things is no company of itself.
        self.heard.retain(|heard| heard.strength > 0 || most == 0);
        let requested = most >= 4;
        let best = |heard: &&Heard| heard.strength == most;
        let chosen =
            if requested { self.heard.iter().find(best).cloned() } else { self.heard.iter().rev().find(best).cloned() };
        let Some(chosen) = chosen else { return };
        // What is asked for is no landmark of its own.
        for node in &mut self.grounding.nodes {
            node.pairs.retain(|pair| pair.reference.name() != chosen.slot.name || pair.direction != Direction::Side);
        }
        let same = |slot: &ObjectSlot, other: &ObjectSlot| head_of(&slot.name) == head_of(&other.name);
        let heard = std::mem::take(&mut self.heard);
        for other in heard.iter().filter(|other| !same(&other.slot, &chosen.slot)) {
            let listed = self.grounding.also.iter().any(|known| same(known, &other.slot));
            let together = requested && other.strength == most
                || !requested && most == 3 && self.are_told_together(&other.slot, &chosen.slot);
            if together && !listed {
                self.grounding.also.push(other.slot.clone());
            } else if !requested && most > 1 && other.told {
                self.add_company(other);
            }
        }
        if !requested && !self.grounding.also.is_empty() {
            // "The mug and the spoon are …": the first is named first.
            let first = self.grounding.also.remove(0);
            self.grounding.also.push(chosen.slot);
            self.grounding.object = Some(first);
        } else {
            self.grounding.object = Some(chosen.slot);
        }
    }

    /// Whether one phrase names both as its subjects.
    fn are_told_together(&self, one: &ObjectSlot, other: &ObjectSlot) -> bool {
        self.phrases.iter().any(|phrase| {
            let definite = phrase.nouns.iter().all(|noun| noun.article != Article::Indefinite);
            let named = |slot: &ObjectSlot| {
                phrase.nouns.iter().any(|noun| name_of(noun, &self.reading.units, true) == slot.name)
            };
            phrase.kind == Kind::Object && phrase.act == Act::State && definite && named(one) && named(other)
        })
    }

    /// Other things on the same support are landmarks.
    fn add_company(&mut self, other: &Heard) {
        let nodes = &mut self.grounding.nodes;
        let last = nodes.iter().rposition(|node| node.target.is_some());
        let Some(at) = last.or(nodes.len().checked_sub(1)).or(other.node) else { return };
        let own = pair(&other.slot.name, Direction::Side);
        if !nodes.iter().any(|node| node.pairs.iter().any(|pair| pair.reference == own.reference)) {
            nodes[at].pairs.push(own);
        }
    }

    /// The side that picks the room, and the room to be entered last.
    fn settle_room(&mut self) {
        let picked = self.pick.map(|pick| &self.phrases[pick.first..=pick.last]);
        let side = picked.and_then(|phrases| {
            phrases.iter().find_map(|phrase| match phrase.kind {
                Kind::Turn | Kind::Side => phrase.directions[0],
                _ => phrase.side,
            })
        });
        // "The bathroom, the one on the left".
        let side = side
            .or_else(|| self.phrases.iter().filter(|phrase| phrase.kind == Kind::Room).find_map(|phrase| phrase.side));
        let ordinal = picked.and_then(|phrases| phrases.iter().find_map(|p| p.noun().and_then(|noun| noun.ordinal)));
        let entered = self.rooms.iter().rev().find(|(_, passage)| !passage).or(self.rooms.last());
        let name = entered.map(|(name, _)| name.clone());
        if name.is_some() || side.is_some() {
            self.grounding.room = Some(RoomSlot { name, side, ordinal, score: 0.95.into() });
        }
    }
}

fn head_of(name: &str) -> &str {
    let head = name.rsplit('_').next().unwrap_or(name);
    head.strip_suffix('s').unwrap_or(head)
}

/// "The computer desk … that desk": the head noun alone means the compound said before.
fn same_target(known: Option<&str>, said: Option<&str>) -> bool {
    let (Some(known), Some(said)) = (known, said) else { return false };
    known == said || known.strip_suffix(said).is_some_and(|rest| rest.ends_with('_'))
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
