//! The grammar as data: `corpus/grammar/phrases.tsv`, one phrase a line, read once.
//!
//! A line has a kind, a cost, a meaning and a pattern over units. How patterns
//! are written stands in `corpus/grammar/README.md`.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::word_class::{Role, Roles};
use crate::record::Direction;

/// What a phrase is about, as the file says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum RuleKind {
    Turn,
    Go,
    Side,
    It,
    Part,
    Room,
    Leave,
    Related,
    Furniture,
    Held,
    Inverse,
    Object,
    To,
    View,
    Correction,
    Not,
    Aside,
}

const KINDS: [(&str, RuleKind); 17] = [
    ("turn", RuleKind::Turn),
    ("go", RuleKind::Go),
    ("side", RuleKind::Side),
    ("it", RuleKind::It),
    ("part", RuleKind::Part),
    ("room", RuleKind::Room),
    ("leave", RuleKind::Leave),
    ("related", RuleKind::Related),
    ("furniture", RuleKind::Furniture),
    ("held", RuleKind::Held),
    ("inverse", RuleKind::Inverse),
    ("object", RuleKind::Object),
    ("to", RuleKind::To),
    ("view", RuleKind::View),
    ("correction", RuleKind::Correction),
    ("not", RuleKind::Not),
    ("aside", RuleKind::Aside),
];

/// Where a direction of a meaning comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// The direction itself.
    Fixed(Direction),
    /// The last left or right within the phrase.
    Side,
    /// The part of the room.
    Zone,
    /// What stands before the noun: "the back wall".
    Noun,
    /// The relation.
    Relation,
}

/// What a phrase means.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meaning {
    /// The words of the meaning that are neither directions nor numbers: a reference, an act, a recipient.
    pub words: Vec<&'static str>,
    /// The directions, in order.
    pub directions: Vec<Source>,
    /// A share of the way.
    pub fraction: Option<f64>,
}

/// How often an element may stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeat {
    /// Once.
    One,
    /// Once or not at all.
    Optional,
    /// Any number of times.
    Many,
}

/// Whether an element takes units or only looks at them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// It takes them.
    Take,
    /// They must follow.
    Ahead,
    /// They must not follow.
    NotAhead,
    /// The unit before must fit.
    Behind,
}

/// What an element fits.
#[derive(Clone, Debug, PartialEq)]
pub enum Atom {
    /// One of some words, or a word of some roles; `pause` also fits a comma before.
    Set {
        /// Numbers of the words.
        ids: Vec<u16>,
        /// The roles.
        roles: Roles,
        /// A comma before it is enough.
        pause: bool,
    },
    /// A part that code reads, by its name.
    Part(Part),
    /// The begin of the words that lead to a place.
    InnerStart,
    /// Their end.
    InnerEnd,
}

/// Parts of patterns that code reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Part {
    Thing,
    Things,
    Objects,
    Furniture,
    List,
    Room,
    Opening,
    Sided,
    SideWall,
    Bare,
    Wall,
    Person,
    Relation,
    Zone,
    Possessor,
    Pace,
    Degrees,
    OnIt,
    Unknown,
    Name,
    Stumble,
    Noun,
    Fixed,
    End,
    End2,
    Place,
    To,
}

const PARTS: [(&str, Part); 27] = [
    ("thing", Part::Thing),
    ("things", Part::Things),
    ("objects", Part::Objects),
    ("furniture", Part::Furniture),
    ("list", Part::List),
    ("room", Part::Room),
    ("opening", Part::Opening),
    ("sided", Part::Sided),
    ("sidewall", Part::SideWall),
    ("bare", Part::Bare),
    ("wall", Part::Wall),
    ("person", Part::Person),
    ("rel", Part::Relation),
    ("zone", Part::Zone),
    ("poss", Part::Possessor),
    ("pace", Part::Pace),
    ("degrees", Part::Degrees),
    ("onit", Part::OnIt),
    ("unknown", Part::Unknown),
    ("name", Part::Name),
    ("stumble", Part::Stumble),
    ("noun", Part::Noun),
    ("fixed", Part::Fixed),
    ("end", Part::End),
    ("end2", Part::End2),
    ("place", Part::Place),
    ("to", Part::To),
];

/// One element of a pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// What it fits.
    pub atom: Atom,
    /// How often.
    pub repeat: Repeat,
    /// Whether it takes what it fits.
    pub look: Look,
}

/// One line of the file, or one of the patterns it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// What the phrase is about.
    pub kind: RuleKind,
    /// What it costs to read the words so.
    pub cost: f32,
    /// What it means.
    pub meaning: Meaning,
    /// The pattern as written, for those who ask why.
    pub written: &'static str,
    /// The pattern.
    pub elements: Vec<Element>,
}

/// All rules, found by what they may begin with.
#[derive(Clone, Debug, Default)]
pub struct Grammar {
    rules: Vec<Rule>,
    ids: HashMap<&'static str, u16>,
    by_word: Vec<Vec<u16>>,
    by_role: Vec<Vec<u16>>,
    by_noun: Vec<u16>,
    by_relation: Vec<u16>,
    anywhere: Vec<u16>,
}

impl Grammar {
    /// The grammar this program ships.
    pub fn embedded() -> &'static Self {
        static EMBEDDED: OnceLock<Grammar> = OnceLock::new();
        EMBEDDED.get_or_init(|| {
            let (grammar, wrong) = Self::read(include_str!("../../corpus/grammar/phrases.tsv"));
            // A grammar with holes would misread silently.
            assert!(wrong.is_empty(), "embedded: phrases.tsv: {}", wrong.join("; "));
            grammar
        })
    }

    /// Reads the file; the second value says what could not be read, line by line.
    pub fn read(text: &'static str) -> (Self, Vec<String>) {
        let mut grammar = Self { by_role: vec![Vec::new(); 64], ..Self::default() };
        let mut macros: HashMap<&str, Vec<&str>> = HashMap::new();
        let mut wrong = Vec::new();
        for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.is_empty() && !line.starts_with('#')) {
            if let Some((name, body)) = line.strip_prefix("= ").and_then(|rest| rest.split_once('\t')) {
                macros.insert(name, body.split(" / ").collect());
            } else if let Err(message) = grammar.add(line, &macros) {
                wrong.push(format!("line {}: {message}", number + 1));
            }
        }
        grammar.index();
        (grammar, wrong)
    }

    fn add(&mut self, line: &'static str, macros: &HashMap<&str, Vec<&'static str>>) -> Result<(), String> {
        let fields: Vec<&'static str> = line.split('\t').collect();
        let [kind, cost, meaning, pattern] = fields[..] else {
            return Err("a phrase needs a kind, a cost, a meaning and a pattern".to_string());
        };
        let kind = KINDS.iter().find(|(name, _)| *name == kind).map(|(_, kind)| *kind);
        let kind = kind.ok_or_else(|| "unknown kind".to_string())?;
        let cost: f32 = cost.parse().map_err(|_| "the cost is no number".to_string())?;
        let meaning = read_meaning(meaning);
        for pattern_ in pattern.split(" / ") {
            for tokens in expand(pattern_, macros)? {
                let elements = tokens.iter().map(|token| self.element(token)).collect::<Result<_, _>>()?;
                self.rules.push(Rule { kind, cost, meaning: meaning.clone(), written: pattern, elements });
            }
        }
        Ok(())
    }

    fn element(&mut self, token: &'static str) -> Result<Element, String> {
        let (look, rest) = match token.as_bytes() {
            [b'>', _, ..] => (Look::Ahead, &token[1..]),
            [b'!', _, ..] => (Look::NotAhead, &token[1..]),
            [b'<', _, ..] => (Look::Behind, &token[1..]),
            _ => (Look::Take, token),
        };
        let (repeat, rest) = match rest.as_bytes() {
            [_, .., b'?'] => (Repeat::Optional, &rest[..rest.len() - 1]),
            [_, .., b'*'] => (Repeat::Many, &rest[..rest.len() - 1]),
            _ => (Repeat::One, rest),
        };
        let atom = match rest {
            "[" => Atom::InnerStart,
            "]" => Atom::InnerEnd,
            _ => self.atom(rest, look)?,
        };
        Ok(Element { atom, repeat, look })
    }

    fn atom(&mut self, token: &'static str, look: Look) -> Result<Atom, String> {
        let bare = token.trim_start_matches('{').trim_end_matches('}');
        let part = PARTS.iter().find(|(name, _)| *name == bare).map(|(_, part)| *part);
        // Looking ahead, "noun", "end" and "place" need no braces.
        let looks = look != Look::Take && matches!(bare, "noun" | "fixed" | "end" | "end2" | "place" | "to" | "hand");
        if token.starts_with('{') || looks && part.is_some() {
            return part.map(Atom::Part).ok_or_else(|| format!("unknown part `{token}`"));
        }
        let (mut ids, mut roles, mut pause) = (Vec::new(), Roles::default(), false);
        for word in token.split('|') {
            match word.strip_prefix('@') {
                Some(role) => {
                    let role = Role::from_name(role).ok_or_else(|| format!("unknown role `{role}`"))?;
                    roles = roles.with(Roles::of(role));
                }
                None if word == "," => pause = true,
                None => {
                    let next = self.ids.len() as u16 + 1;
                    ids.push(*self.ids.entry(word).or_insert(next));
                }
            }
        }
        Ok(Atom::Set { ids, roles, pause })
    }

    fn index(&mut self) {
        self.by_word = vec![Vec::new(); self.ids.len() + 1];
        for number in 0..self.rules.len() {
            let rule = number as u16;
            let elements = std::mem::take(&mut self.rules[number].elements);
            for element in elements.iter().filter(|element| element.look == Look::Take) {
                match &element.atom {
                    Atom::InnerStart | Atom::InnerEnd => continue,
                    Atom::Set { ids, roles, .. } => {
                        ids.iter().for_each(|id| self.by_word[usize::from(*id)].push(rule));
                        for (bit, list) in self.by_role.iter_mut().enumerate() {
                            if roles.has_bit(bit) {
                                list.push(rule);
                            }
                        }
                    }
                    Atom::Part(Part::Relation) => self.by_relation.push(rule),
                    Atom::Part(Part::Zone | Part::Possessor | Part::Pace | Part::Degrees | Part::OnIt) => {
                        self.anywhere.push(rule);
                    }
                    Atom::Part(_) => self.by_noun.push(rule),
                }
                if element.repeat == Repeat::One {
                    break;
                }
            }
            self.rules[number].elements = elements;
        }
    }

    /// The number of a word that some pattern names; 0 for all others.
    pub fn id(&self, word: &str) -> u16 {
        self.ids.get(word).copied().unwrap_or(0)
    }

    /// A rule by its number.
    pub fn rule(&self, number: u16) -> &Rule {
        &self.rules[usize::from(number)]
    }

    /// How many rules there are.
    pub fn len(&self) -> usize {
        self.rules.len()
    }

    /// Calls `each` with every rule that may begin with such a unit; a rule may come more than once.
    pub fn beginning(&self, id: u16, roles: Roles, noun: bool, relation: bool, mut each: impl FnMut(u16)) {
        self.by_word[usize::from(id)].iter().for_each(|rule| each(*rule));
        for bit in roles.bits() {
            self.by_role[bit].iter().for_each(|rule| each(*rule));
        }
        if noun {
            self.by_noun.iter().for_each(|rule| each(*rule));
        }
        if relation {
            self.by_relation.iter().for_each(|rule| each(*rule));
        }
        self.anywhere.iter().for_each(|rule| each(*rule));
    }
}

/// The patterns that a pattern with names of parts stands for.
fn expand(pattern: &'static str, macros: &HashMap<&str, Vec<&'static str>>) -> Result<Vec<Vec<&'static str>>, String> {
    let mut all: Vec<Vec<&'static str>> = vec![Vec::new()];
    for token in pattern.split_whitespace() {
        let Some(name) = token.trim_start_matches(['<', '>', '!']).strip_prefix('%') else {
            all.iter_mut().for_each(|tokens| tokens.push(token));
            continue;
        };
        let bare = name.trim_end_matches(['?', '*']);
        let bodies = macros.get(bare).ok_or_else(|| format!("unknown name `%{bare}`"))?;
        let repeat = &name[bare.len()..];
        let mut next = Vec::new();
        for body in bodies {
            let parts: Vec<Vec<&'static str>> = expand(body, macros)?;
            for part in &parts {
                // A name for one set takes the marks of its use: "%tw*".
                let marked: Vec<&'static str> = match part[..] {
                    [one] if !repeat.is_empty() => vec![leak(format!("{one}{repeat}"))],
                    _ => part.clone(),
                };
                next.extend(all.iter().map(|tokens| [tokens.as_slice(), &marked].concat()));
            }
        }
        all = next;
    }
    Ok(all)
}

/// Patterns live as long as the program: they are read once.
fn leak(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

fn read_meaning(text: &'static str) -> Meaning {
    let mut meaning = Meaning::default();
    for (place, word) in text.split_whitespace().filter(|word| *word != "-").enumerate() {
        let source = match word {
            "$" => Some(Source::Side),
            "zone" => Some(Source::Zone),
            "rel" => Some(Source::Relation),
            "np" if place > 0 => Some(Source::Noun),
            _ => Direction::from_name(word).map(Source::Fixed),
        };
        match (source, word.parse()) {
            (Some(source), _) => meaning.directions.push(source),
            (None, Ok(share)) => meaning.fraction = Some(share),
            _ => meaning.words.push(word),
        }
    }
    meaning
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_grammar_is_read() {
        let (grammar, wrong) = Grammar::read(include_str!("../../corpus/grammar/phrases.tsv"));
        assert_eq!(wrong, Vec::<String>::new());
        assert!(grammar.len() > 150 && grammar.len() < 3000, "{}", grammar.len());
    }

    #[test]
    fn a_bad_line_is_named() {
        let (_, wrong) = Grammar::read("turn\t1\tmove $\t@turn %nothing\nspin\t1\t-\tspin\n");
        assert_eq!(wrong, ["line 1: unknown name `%nothing`", "line 2: unknown kind"]);
    }
}
