//! The meaning of one chunk of a tree from elsewhere: its words read by the grammar, as what the tree says they are.

use super::meaning::Meaning;
use super::phrase_pairs::pairs_of;
use super::words::ChunkWords;
use crate::language::{
    Class, From, Kind, Lexicon, NounPhrase, Phrase, Reading, Role, attributes_of, name_of, read_words,
};
use crate::record::{Direction, Pair, Tag};

/// What the own words of `chunk` mean. `continues_move`: it is joined to a move by "and" or "then".
pub fn meaning_of(chunk: &ChunkWords, lexicon: &Lexicon, continues_move: bool) -> Meaning {
    let (reading, nouns) = read_words(&chunk.words, lexicon);
    let words = Words { reading: &reading, nouns: &nouns };
    match chunk.tag {
        Tag::Ormtp | Tag::Ormrp => words.room(),
        Tag::Irmrp => words.place(continues_move),
        Tag::Furtp => words.target(),
        // "A table and two chairs": furniture that is only mentioned is no landmark.
        Tag::Furrp if chunk.children.is_empty() && words.only_mentions() => Meaning {
            score: 0.8,
            because: "furniture in company, without a relation".to_string(),
            ..Meaning::default()
        },
        Tag::Furrp => words.landmark(Class::is_furniture),
        Tag::Obrp => words.landmark(|_| true),
        Tag::Obtp => words.object(),
        Tag::Pers => words.view(),
        Tag::Conf => Meaning {
            side: words.side(),
            score: 1.0,
            because: "taken back by the speaker".to_string(),
            ..Meaning::default()
        },
    }
}

struct Words<'r> {
    reading: &'r Reading<'r>,
    nouns: &'r [NounPhrase],
}

impl Words<'_> {
    fn name(&self, noun: &NounPhrase, counted: bool) -> String {
        name_of(noun, &self.reading.units, counted)
    }

    fn has(&self, role: Role) -> bool {
        self.reading.units.iter().any(|unit| unit.has(role))
    }

    fn says(&self, words: &[&str]) -> bool {
        self.reading.units.iter().any(|unit| words.contains(&unit.lower.as_ref()))
    }

    /// The last side said: "left or … right" has been corrected.
    fn side(&self) -> Option<Direction> {
        self.reading.units.iter().rev().filter(|unit| unit.has(Role::Side)).find_map(|unit| match unit.lower.as_ref() {
            "left" => Some(Direction::Left),
            "right" => Some(Direction::Right),
            _ => None,
        })
    }

    /// No word says how: "two chairs".
    fn only_mentions(&self) -> bool {
        self.reading.phrases.iter().all(|phrase| phrase.relation.is_none())
            && self.nouns.iter().any(NounPhrase::is_furniture)
            && !self.has(Role::Preposition)
            && !self.has(Role::Motion)
    }

    fn room(&self) -> Meaning {
        let named = |noun: &&NounPhrase| noun.class == Some(Class::Room);
        let names = self.nouns.iter().filter(named).map(|noun| self.name(noun, false));
        let room = names.into_iter().find(|name| !matches!(name.as_str(), "room" | "hallway" | "intersection"));
        let side = self.side();
        let because = match (&room, side) {
            (Some(room), Some(side)) => format!("names `{room}`, on the {}", side.name()),
            (Some(room), None) => format!("names `{room}`"),
            (None, Some(side)) => format!("says {}", side.name()),
            (None, None) => "says neither name nor side".to_string(),
        };
        let score = if room.is_some() || side.is_some() { 0.95 } else { 0.5 };
        let ordinal = self.nouns.iter().find_map(|noun| noun.ordinal);
        Meaning { room, side, ordinal, score, because, ..Meaning::default() }
    }

    /// The first phrase that means a place or a move.
    fn place(&self, continues_move: bool) -> Meaning {
        let placed = |phrase: &&Phrase| {
            matches!(phrase.kind, Kind::Go | Kind::Turn | Kind::Side | Kind::Part | Kind::Landmark | Kind::ObjectMark)
        };
        let phrases: Vec<&Phrase> = self.reading.phrases.iter().filter(placed).collect();
        // A move that leads to a place says less than the place.
        let best = phrases.iter().find(|phrase| phrase.from != From::Move).or(phrases.first());
        let Some(best) = best.filter(|phrase| !phrase.entering || phrases.len() == 1) else { return self.bare_side() };
        let mut pairs = pairs_of(best, &self.reading.units, None);
        let sided = matches!(best.directions[0], Some(Direction::Left | Direction::Right | Direction::Front));
        if continues_move && best.from == From::Robot && sided && !self.says(&["on", "in"]) {
            pairs = best.directions[0].map(|direction| super::meaning::pair("move", direction)).into_iter().collect();
        }
        if let (Some(pair), From::Move) = (pairs.first_mut(), best.from) {
            pair.amount.clone_from(&best.amount);
        }
        self.of_pairs(pairs, best)
    }

    fn of_pairs(&self, pairs: Vec<Pair>, phrase: &Phrase) -> Meaning {
        let because = format!("read as `{}`", phrase.rule);
        Meaning { pairs, score: 0.9, because, ..Meaning::default() }
    }

    /// "Left again", "to the right" in a piece too small for a phrase.
    fn bare_side(&self) -> Meaning {
        match self.side() {
            Some(side) if self.has(Role::Preposition) => Meaning::of_pair("robot", side, "a side of the hearer"),
            Some(side) => Meaning::of_pair("move", side, "a turn"),
            None => Meaning { because: "no place or move in these words".to_string(), ..Meaning::default() },
        }
    }

    fn target(&self) -> Meaning {
        let Some(noun) = self.nouns.iter().rev().find(|noun| noun.is_furniture()) else {
            return Meaning { because: "no furniture in these words".to_string(), ..Meaning::default() };
        };
        let name = self.name(noun, false);
        let mut meaning = Meaning {
            because: format!("names `{name}`"),
            target: Some(name),
            attributes: attributes_of(noun, &self.reading.units),
            ordinal: noun.ordinal,
            score: 0.95,
            ..Meaning::default()
        };
        if noun.part == Some(Direction::Back) {
            meaning.pairs.push(super::meaning::pair("room", Direction::Back));
            meaning.because.push_str(", the far one");
        }
        meaning
    }

    fn landmark(&self, fits: impl Fn(Class) -> bool + Copy) -> Meaning {
        let related = |phrase: &&Phrase| phrase.from == From::Nouns && !phrase.nouns.is_empty();
        if let Some(phrase) = self.reading.phrases.iter().find(related) {
            let mut pairs = pairs_of(phrase, &self.reading.units, None);
            if let Some(side) = self.side().filter(|_| phrase.directions[0].is_none()) {
                pairs.iter_mut().for_each(|pair| pair.direction = side);
            }
            return self.of_pairs(pairs, phrase);
        }
        let known = self.nouns.iter().find(|noun| noun.class.is_some_and(fits));
        match known.or(self.nouns.last()) {
            Some(noun) => {
                let direction = self.side().unwrap_or(Direction::Side);
                Meaning::of_pair(&self.name(noun, false), direction, "a landmark")
            }
            None => Meaning { because: "no landmark in these words".to_string(), ..Meaning::default() },
        }
    }

    fn object(&self) -> Meaning {
        let object = |noun: &&NounPhrase| noun.class == Some(Class::Object) && !noun.inferred;
        let known = self.nouns.iter().rev().find(object);
        let other = || self.nouns.iter().rev().find(|noun| noun.is_furniture());
        let unknown = || {
            self.nouns.iter().rev().find(|noun| !noun.generic && noun.class.is_none_or(|class| class == Class::Object))
        };
        let (noun, score) = match known {
            Some(noun) => (Some(noun), 0.97),
            None => other().map_or_else(|| (unknown(), 0.6), |noun| (Some(noun), 0.85)),
        };
        let Some(noun) = noun else {
            return Meaning { score: 0.6, because: "names no object".to_string(), ..Meaning::default() };
        };
        let indefinite = noun.article == crate::language::Article::Indefinite && score > 0.9;
        let name = self.name(noun, true);
        Meaning {
            because: format!("names `{name}`"),
            object: Some(name),
            indefinite,
            attributes: attributes_of(noun, &self.reading.units),
            score: if indefinite { 0.8 } else { score },
            ..Meaning::default()
        }
    }

    fn view(&self) -> Meaning {
        match self.side() {
            Some(side) => Meaning::of_pair("robot", side, "whose side"),
            None if self.has(Role::Look) => Meaning {
                facing: true,
                score: 0.9,
                because: "seen by someone who faces it".to_string(),
                ..Meaning::default()
            },
            None => Meaning::default(),
        }
    }
}
