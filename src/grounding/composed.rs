//! The meaning of a chunk from what its words mean: lexicon classes, head nouns, prepositions, verbs, modifiers.

use super::meaning::{Meaning, pair};
use super::words::ChunkWords;
use crate::language::{Class, Lexicon, Relation, Role, Unit, UnitKind, leading_relation, units};
use crate::record::{Amount, Direction, Grounding, Pair, Reference, Tag};

/// What the own words of `chunk` mean. `continues_move`: it is joined to a move by "and" or "then".
pub fn meaning_of(chunk: &ChunkWords, lexicon: &Lexicon, continues_move: bool) -> Meaning {
    let units = units(&chunk.words, lexicon);
    let words = Words { units: &units };
    match chunk.tag {
        Tag::Ormtp | Tag::Ormrp => words.room(),
        Tag::Irmrp if continues_move => words.as_move().unwrap_or_else(|| words.place()),
        Tag::Irmrp => words.place(),
        Tag::Furtp => words.target(),
        // "A table and two chairs": furniture that is only mentioned is no landmark.
        Tag::Furrp if chunk.children.is_empty() && words.only_mentions() => Meaning {
            score: 0.8,
            because: "furniture in company, without a relation".to_string(),
            ..Meaning::default()
        },
        Tag::Furrp => words.landmark(Class::is_furniture),
        Tag::Obrp => words.object_landmark(),
        Tag::Obtp => words.object(),
        Tag::Pers if words.has(&["face", "faces", "facing", "looking", "look", "looks"]) && words.side().is_none() => {
            Meaning {
                facing: true,
                score: 0.9,
                because: "seen by someone who faces it".to_string(),
                ..Meaning::default()
            }
        }
        Tag::Pers => words.side().map_or_else(Meaning::default, |side| Meaning::of_pair("robot", side, "whose side")),
        Tag::Conf => Meaning {
            side: words.side(),
            score: 1.0,
            because: "taken back by the speaker".to_string(),
            ..Meaning::default()
        },
    }
}

struct Words<'u> {
    units: &'u [Unit<'u>],
}

impl Words<'_> {
    fn has(&self, words: &[&str]) -> bool {
        self.units.iter().any(|unit| words.contains(&unit.lower.as_ref()))
    }

    /// No word says how: "two chairs".
    fn only_mentions(&self) -> bool {
        let mentions = |unit: &Unit| {
            matches!(unit.role(), Some(Role::Determiner | Role::Number | Role::Adjective | Role::Conjunction))
                || unit.class().is_some()
        };
        leading_relation(self.units).is_none() && self.units.iter().all(mentions)
    }

    fn has_role(&self, role: Role) -> bool {
        self.units.iter().any(|unit| unit.role() == Some(role))
    }

    fn noun(&self, fits: impl Fn(Class) -> bool) -> Option<&str> {
        self.nouns(fits).next()
    }

    fn nouns(&self, fits: impl Fn(Class) -> bool) -> impl Iterator<Item = &str> {
        self.units.iter().filter_map(move |unit| match unit.kind {
            UnitKind::Noun(name, class) if fits(class) => Some(name),
            _ => None,
        })
    }

    /// The last side said: "left or … right" has been corrected.
    fn side(&self) -> Option<Direction> {
        self.units.iter().rev().find_map(|unit| match (unit.role(), unit.lower.as_ref()) {
            (Some(Role::Side), "left") => Some(Direction::Left),
            (Some(Role::Side), "right") => Some(Direction::Right),
            _ => None,
        })
    }

    fn ordinal(&self) -> Option<u32> {
        let names = ["first", "second", "third", "fourth"];
        self.units.iter().find_map(|unit| names.iter().position(|name| *name == unit.lower)).map(|at| at as u32 + 1)
    }

    fn attributes(&self) -> Vec<String> {
        let told = self.units.iter().filter(|unit| unit.role() == Some(Role::Adjective));
        told.map(|unit| unit.lower.to_string()).filter(|word| !matches!(word.as_str(), "other" | "same")).collect()
    }

    /// "three steps", "2 m", "forty five degrees".
    fn amount(&self) -> Option<Amount> {
        let unit_at = self.units.iter().position(|unit| {
            matches!(unit.role(), Some(Role::Step | Role::FootUnit | Role::MetreUnit | Role::DegreeUnit))
                || unit.lower == "step"
        })?;
        let number = self.units[..unit_at].iter().rev().find_map(|unit| number(&unit.lower))?;
        Some(match self.units[unit_at].role() {
            Some(Role::FootUnit) => Amount::Meters((number * 0.3048 * 100.0).round() / 100.0),
            Some(Role::MetreUnit) => Amount::Meters(number),
            Some(Role::DegreeUnit) => Amount::Degrees(number),
            _ => Amount::Steps(number),
        })
    }

    fn room(&self) -> Meaning {
        let room = self
            .noun(|class| class == Class::Room)
            .filter(|name| !matches!(*name, "room" | "hallway" | "intersection"));
        let side = self.side();
        let because = match (room, side) {
            (Some(room), Some(side)) => format!("names `{room}`, on the {}", side.name()),
            (Some(room), None) => format!("names `{room}`"),
            (None, Some(side)) => format!("says {}", side.name()),
            (None, None) => "says neither name nor side".to_string(),
        };
        let score = if room.is_some() || side.is_some() { 0.95 } else { 0.5 };
        Meaning { room: room.map(str::to_string), side, ordinal: self.ordinal(), score, because, ..Meaning::default() }
    }

    /// "(Go forward) and then to the right", "and straight ahead".
    fn as_move(&self) -> Option<Meaning> {
        let place =
            self.units.iter().any(|unit| unit.class().is_some()) || self.has(&["on", "in", "end", "back", "far"]);
        let direction = self.side().or_else(|| self.has_role(Role::Ahead).then_some(Direction::Front))?;
        (!place).then(|| Meaning::of_pair("move", direction, "goes on from the move before"))
    }

    /// A place or a move inside the room.
    fn place(&self) -> Meaning {
        self.wall()
            .or_else(|| self.door())
            .or_else(|| self.part_of_room())
            .or_else(|| self.motion())
            .or_else(|| self.hearer())
            .unwrap_or(Meaning { because: "no place or move in these words".to_string(), ..Meaning::default() })
    }

    fn moves(&self) -> bool {
        [Role::Motion, Role::Turn, Role::Reach, Role::Look].into_iter().any(|role| self.has_role(role))
            || self.has(&["step"])
    }

    fn wall(&self) -> Option<Meaning> {
        self.noun(|class| class == Class::Wall)?;
        let direction = match self.side() {
            Some(side) => side,
            None if self.has(&["back", "far", "rear", "end", "opposite", "other"]) => Direction::Back,
            None if self.has(&["front"]) => Direction::Front,
            None => Direction::Side,
        };
        Some(Meaning::of_pair("wall", direction, "a wall"))
    }

    fn door(&self) -> Option<Meaning> {
        let beginning = self.has(&["beginning"])
            || self.units.first().is_some_and(|unit| unit.role() == Some(Role::Adverb))
                && (self.has(&["as", "when", "after", "once"]) || self.units.len() == 2 && self.has(&["inside"]));
        if self.noun(|class| class == Class::Opening).is_none() && !beginning {
            return None;
        }
        let direction = match leading_relation(self.units) {
            Some(Relation::Landmark(direction)) => direction,
            _ => Direction::Side,
        };
        Some(Meaning::of_pair("door", direction, "the door"))
    }

    fn part_of_room(&self) -> Option<Meaning> {
        if self.has(&["where", "you", "him", "he"]) && self.has(&["across", "opposite"]) {
            return None;
        }
        let far = self.has(&["far", "farther", "further", "furthest", "farthest"]);
        let corner = self.noun(|class| class == Class::Part).is_some();
        if corner
            && (far || self.has(&["back"]))
            && let Some(side) = self.side()
        {
            let pairs = vec![pair("room", side), pair("room", Direction::Back)];
            return Some(Meaning { pairs, score: 0.9, because: "a far corner".to_string(), ..Meaning::default() });
        }
        if self.has(&["halfway", "half"]) {
            return Some(
                Meaning::of_pair("room", Direction::Central, "halfway in").with_amount(Some(Amount::Fraction(0.5))),
            );
        }
        if self.has(&["middle", "center", "centre"]) {
            return Some(Meaning::of_pair("room", Direction::Central, "the middle of the room"));
        }
        let of_room = self.noun(|class| class == Class::Room).is_some();
        if (far || of_room || self.has(&["end"]))
            && !self.has_role(Role::Turn)
            && let Some(side) = self.side()
        {
            return Some(Meaning::of_pair("room", side, "a side of the room"));
        }
        if far || self.has(&["end", "rear", "opposite", "across", "cross", "crosses", "other"]) || self.names_back() {
            return Some(Meaning::of_pair("room", Direction::Back, "the far end of the room"));
        }
        if corner {
            return Some(Meaning::of_pair("room", Direction::Side, "a corner"));
        }
        let front = self.has(&["front"]) && of_room;
        front.then(|| Meaning::of_pair("room", Direction::Front, "the front of the room"))
    }

    /// "The back", "in back"; not "go back to".
    fn names_back(&self) -> bool {
        let named = |before: &Unit| {
            matches!(before.role(), Some(Role::Determiner | Role::Hearer | Role::Adjective | Role::Part))
                || matches!(before.lower.as_ref(), "in" | "at" | "very")
        };
        self.units.windows(2).any(|pair| pair[1].lower == "back" && named(&pair[0]))
    }

    fn motion(&self) -> Option<Meaning> {
        if self.has_role(Role::Look) && self.has(&["around"]) {
            return Some(Meaning { score: 0.8, because: "looks around".to_string(), ..Meaning::default() });
        }
        if self.has(&["around", "back"]) && self.moves() && self.side().is_none() {
            return Some(Meaning::of_pair("move", Direction::Back, "turn round"));
        }
        let bare = self.units.first().is_some_and(|unit| unit.role() == Some(Role::Side));
        if let Some(side) = self.side() {
            let turned = self.moves() || self.has_role(Role::Again) || bare;
            let amount = self.amount().filter(|amount| matches!(amount, Amount::Degrees(d) if *d != 90.0));
            return turned.then(|| Meaning::of_pair("move", side, "a turn").with_amount(amount));
        }
        let forward = self.has(&["forward", "forwards", "straight"]) && !self.has(&["ahead"]);
        (self.moves() || forward)
            .then(|| Meaning::of_pair("move", Direction::Front, "a move ahead").with_amount(self.amount()))
    }

    fn hearer(&self) -> Option<Meaning> {
        let direction = match self.side() {
            Some(side) => side,
            None if self.has(&["behind"]) => Direction::Back,
            None if self.has(&["ahead", "straight"]) => Direction::Front,
            None if self.has(&["front"]) && self.has(&["in"]) => Direction::Front,
            None if self.has(&["across", "opposite"]) => Direction::Front,
            None => return None,
        };
        Some(Meaning::of_pair("robot", direction, "a side of the hearer"))
    }

    fn target(&self) -> Meaning {
        let Some(noun) = self.nouns(Class::is_furniture).last() else {
            return Meaning { because: "no furniture in these words".to_string(), ..Meaning::default() };
        };
        let mut meaning = Meaning {
            target: Some(noun.to_string()),
            attributes: self.attributes(),
            ordinal: self.ordinal(),
            score: 0.95,
            because: format!("names `{noun}`"),
            ..Meaning::default()
        };
        let before_noun = |words: &[&str]| {
            let at = self.units.iter().position(|unit| unit.class().is_some()).unwrap_or(0);
            self.units[..at].iter().skip(1).any(|unit| words.contains(&unit.lower.as_ref()))
                && !self.has(&["of", "middle", "edge", "top"])
        };
        if before_noun(&["back", "far"]) {
            meaning.pairs.push(pair("room", Direction::Back));
            meaning.because.push_str(", the far one");
        }
        meaning
    }

    fn landmark(&self, fits: impl Fn(Class) -> bool + Copy) -> Meaning {
        let mut nouns: Vec<String> = self.nouns(fits).map(str::to_string).collect();
        if nouns.is_empty() {
            nouns.extend(self.last_unknown());
        }
        let Some(reference) = nouns.first() else {
            return Meaning { because: "no landmark in these words".to_string(), ..Meaning::default() };
        };
        let direction = match leading_relation(self.units) {
            Some(Relation::Landmark(direction)) => direction,
            _ => self.side().unwrap_or(Direction::Side),
        };
        let mut pairs = vec![pair(reference, direction)];
        pairs[0].ordinal = self.ordinal();
        if let Some(second) = nouns.get(1).filter(|second| *second != reference) {
            if direction == Direction::Between {
                pairs[0].and = Some(Reference::of(second));
            }
            pairs.push(pair(second, direction));
        }
        // The second reference of "between" is told within the pair as well; scoring wants both named.
        let because = format!("`{reference}` as landmark, {}", direction.name());
        Meaning { pairs, score: 0.9, because, ..Meaning::default() }
    }

    /// An object as landmark; one that "the table has on it" may be the very object.
    fn object_landmark(&self) -> Meaning {
        let meaning = self.landmark(|_| true);
        let on_it = self.has(&["with", "has", "had", "have"]) && self.has(&["on"]) && self.has(&["the", "my", "your"]);
        let object = self.noun(|class| class == Class::Object).filter(|_| on_it).map(str::to_string);
        Meaning { object, ..meaning }
    }

    fn object(&self) -> Meaning {
        let known = self.nouns(|class| class == Class::Object).last().map(str::to_string);
        let indefinite = known.is_some() && self.has(&["a", "an", "some"]) && !self.has(&["the"]);
        let (object, score) = match known {
            Some(name) if indefinite => (Some(name), 0.8),
            Some(name) => (Some(name), 0.97),
            None => match self.furniture_asked_for() {
                Some(name) => (Some(name), 0.85),
                None => (self.unknown_noun(), 0.6),
            },
        };
        let because = object.as_ref().map_or("names no object".to_string(), |name| format!("names `{name}`"));
        Meaning { object, indefinite, attributes: self.attributes(), score, because, ..Meaning::default() }
    }

    /// "The lamp is (on the desk)": furniture that stands on furniture.
    fn furniture_asked_for(&self) -> Option<String> {
        self.noun(Class::is_furniture).map(str::to_string)
    }

    fn last_unknown(&self) -> Option<String> {
        let word = self.units.iter().rev().find(|unit| unit.kind == UnitKind::Unknown)?.lower.replace('-', "_");
        Some(singular(&word).to_string())
    }

    /// The last word the lexicon does not have, before the clause's verb: "the widget is".
    fn unknown_noun(&self) -> Option<String> {
        let clause = self.units.iter().position(|unit| matches!(unit.role(), Some(Role::Copula | Role::Modal)));
        let before = &self.units[..clause.filter(|at| *at > 0).unwrap_or(self.units.len())];
        let article = |unit: &Unit| matches!(unit.role(), Some(Role::Determiner | Role::Hearer));
        before.iter().any(article).then_some(())?;
        // "The squeaky thing" names nothing.
        let head = before.iter().rev().find(|u| u.kind == UnitKind::Unknown || u.role() == Some(Role::Generic))?;
        (head.kind == UnitKind::Unknown).then(|| head.lower.replace('-', "_"))
    }
}

/// Words of relation mark a landmark; a description that names no target but a table as landmark means that table.
pub fn settle_target(grounding: &mut Grounding, lexicon: &Lexicon) {
    if grounding.nodes.iter().any(|node| node.target.is_some()) {
        return;
    }
    let holds = |pair: &Pair| {
        pair.direction == Direction::Side && lexicon.class_of(pair.reference.name()) == Some(Class::TableLike)
    };
    for node in &mut grounding.nodes {
        if let Some(at) = node.pairs.iter().position(holds) {
            let table = node.pairs.remove(at);
            node.target = Some(table.reference.to_string());
            node.ordinal = table.ordinal;
            node.score = 0.7.into();
            return;
        }
    }
}

/// "terrariums" → "terrarium"; "glass" stays.
fn singular(word: &str) -> &str {
    word.strip_suffix('s').filter(|stem| stem.len() > 2 && !stem.ends_with('s')).unwrap_or(word)
}

fn number(word: &str) -> Option<f64> {
    let named = [
        ("one", 1.0),
        ("a", 1.0),
        ("couple", 2.0),
        ("two", 2.0),
        ("three", 3.0),
        ("few", 3.0),
        ("four", 4.0),
        ("five", 5.0),
        ("six", 6.0),
        ("seven", 7.0),
        ("eight", 8.0),
        ("nine", 9.0),
        ("ten", 10.0),
        ("twelve", 12.0),
        ("forty", 45.0),
        ("ninety", 90.0),
        ("ninty", 90.0),
    ];
    named.iter().find(|(name, _)| *name == word).map(|(_, value)| *value).or_else(|| word.parse().ok())
}
