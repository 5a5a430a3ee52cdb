//! The words the robot knows: data in `corpus/lexicon/`, one line a word.

use std::collections::HashMap;
use std::path::Path;
use std::sync::OnceLock;

use super::morphology::singulars;
use super::relations::Relations;
use super::unit::NounUnit;
use super::vocabulary::{NounClass, Vocabulary, nearest};
use super::word_class::{Class, Role, Roles};

/// A noun: its name in lower_snake, its class, and the noun it is a kind of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Noun {
    /// Name in lower_snake.
    pub name: String,
    /// What kind of thing it names.
    pub class: Class,
    /// The noun whose other name it is: a `bureau` is a kind of `dresser`.
    pub kind_of: Option<String>,
}

/// A word that is no noun.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Part of speech.
    pub pos: String,
    /// How the grammar may use it.
    pub roles: Roles,
}

/// A line of a lexicon file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {message}")]
pub struct LexiconError {
    /// The file.
    pub file: String,
    /// 1-based.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// Nouns, other words, and the phrases that relate one thing to another.
#[derive(Clone, Debug, Default)]
pub struct Lexicon {
    nouns: Vec<Noun>,
    /// From the words of a name, joined by spaces, to its noun.
    names: HashMap<String, usize>,
    words: HashMap<String, Entry>,
    /// From the first word of names of several words to the number of words in the longest.
    starts: HashMap<String, usize>,
    /// What a word that is written otherwise means: one word or two.
    spellings: HashMap<String, String>,
    relations: Relations,
}

impl Lexicon {
    /// The lexicon this program ships.
    pub fn embedded() -> &'static Self {
        static EMBEDDED: OnceLock<Lexicon> = OnceLock::new();
        EMBEDDED.get_or_init(|| {
            let mut lexicon = Self { relations: Relations::embedded(), ..Self::default() };
            // A lexicon with holes would misread silently.
            lexicon
                .add_nouns(include_str!("../../corpus/lexicon/nouns.tsv"), "nouns.tsv")
                .and_then(|()| lexicon.add_words(include_str!("../../corpus/lexicon/words.tsv"), "words.tsv"))
                .and_then(|()| {
                    lexicon.add_spellings(include_str!("../../corpus/lexicon/spellings.tsv"), "spellings.tsv")
                })
                .unwrap_or_else(|error| panic!("embedded: {error}"));
            lexicon
        })
    }

    /// Adds nouns: lines of `name TAB class [TAB other spellings [TAB other names]]`; `#` begins a comment. A name that
    /// is known is refused.
    ///
    /// # Errors
    /// When a line is not of this form or its name is known, with the line.
    pub fn add_nouns(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        let known = self.nouns.len();
        for (line, fields) in lines(text) {
            self.read_noun(&fields, known, false).map_err(|message| wrong(file, line, message))?;
        }
        Ok(())
    }

    /// Adds a user's words, one a line: nouns as in [`Lexicon::add_nouns`], `word TAB role` with a role of
    /// `corpus/grammar/README.md`, or `phrase TAB relation TAB reading`. What is known from before gets the new meaning.
    ///
    /// # Errors
    /// When a line is of none of these forms, with the line.
    pub fn extend(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        let known = self.nouns.len();
        for (line, fields) in lines(text) {
            let second = fields.get(1).copied().unwrap_or("");
            let read = match (second, roles_of(second)) {
                ("relation", _) => self.relations.add(fields[0], fields.get(2).copied().unwrap_or("")),
                (_, Some(roles)) => {
                    self.words.insert(fields[0].to_string(), Entry { pos: "VB".to_string(), roles });
                    Ok(())
                }
                _ => self.read_noun(&fields, known, true),
            };
            read.map_err(|message| wrong(file, line, message))?;
        }
        Ok(())
    }

    fn read_noun(&mut self, fields: &[&str], known: usize, replace: bool) -> Result<(), String> {
        let (Some(name), Some(class)) = (fields.first(), fields.get(1)) else {
            return Err("a noun needs a name, a tab and a class".to_string());
        };
        let class = Class::from_name(class).ok_or_else(|| format!("unknown class `{class}`"))?;
        // "wall" is a structure with rules of its own.
        let class = if *name == "wall" { Class::Wall } else { class };
        self.name_noun(name, class, None, split(fields.get(2)).chain([name.replace('_', " ")]), known, replace)?;
        for other in split(fields.get(3)) {
            let own = other.replace([' ', '-'], "_");
            self.name_noun(&own, class, Some((*name).to_string()), [other].into_iter(), known, replace)?;
        }
        Ok(())
    }

    fn name_noun(
        &mut self,
        name: &str,
        class: Class,
        kind_of: Option<String>,
        ways: impl Iterator<Item = String>,
        known: usize,
        replace: bool,
    ) -> Result<(), String> {
        let index = self.nouns.len();
        self.nouns.push(Noun { name: name.to_string(), class, kind_of });
        for way in ways {
            let old = self.names.insert(way.clone(), index).filter(|old| *old != index);
            if old.is_some_and(|old| !replace || old >= known) {
                return Err(format!("`{way}` already names another noun"));
            }
            if let Some((start, rest)) = way.split_once(' ') {
                let longest = self.starts.entry(start.to_string()).or_default();
                *longest = (*longest).max(1 + rest.split(' ').count());
            }
        }
        Ok(())
    }

    /// Adds other words: lines of `word TAB part of speech TAB roles`, roles separated by commas.
    ///
    /// # Errors
    /// When a line is not of this form, with the line.
    pub fn add_words(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        for (line, fields) in lines(text) {
            let [word, pos, roles] = fields[..] else {
                let message = "a word needs a part of speech and a role, separated by tabs".to_string();
                return Err(wrong(file, line, message));
            };
            let roles = roles_of(roles).ok_or_else(|| wrong(file, line, format!("unknown role in `{roles}`")))?;
            if self.words.insert(word.to_string(), Entry { pos: pos.to_string(), roles }).is_some() {
                return Err(wrong(file, line, format!("`{word}` stands twice")));
            }
        }
        Ok(())
    }

    /// Adds spellings: lines of `written TAB meant`; only a word that means nothing as written is read otherwise.
    ///
    /// # Errors
    /// When a line is not of this form, with the line.
    pub fn add_spellings(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        for (line, fields) in lines(text) {
            let [written, meant] = fields[..] else {
                let message = "a spelling needs what is written, a tab and what is meant".to_string();
                return Err(wrong(file, line, message));
            };
            if let Some(word) = meant.split(' ').find(|word| self.word(word).is_none() && self.noun(word).is_none()) {
                return Err(wrong(file, line, format!("`{word}` is no word of the lexicon")));
            }
            self.spellings.insert(written.to_string(), meant.to_string());
        }
        Ok(())
    }

    /// What a word means that is written otherwise: one word, or two with a space between.
    pub fn spelling(&self, written: &str) -> Option<&str> {
        self.spellings.get(written).map(String::as_str)
    }

    /// The class of a noun given in lower_snake or as words: its own, else that of its last word.
    pub fn class_of(&self, noun: &str) -> Option<Class> {
        let words = noun.replace('_', " ");
        let own = self.any_number(&words).map(|(noun, _)| noun.class);
        own.or_else(|| words.rsplit_once(' ').and_then(|(_, head)| self.any_number(head)).map(|(noun, _)| noun.class))
    }

    /// Whether a thing is read by its own front before all else: what one person sits on, and what has a screen
    /// (Huo et al. 2014, section IV, for chairs).
    pub fn has_own_front(&self, noun: &str) -> bool {
        const OBJECTS_WITH_A_SCREEN: [&str; 3] = ["computer", "monitor", "laptop"];
        matches!(self.class_of(noun), Some(Class::Seat | Class::Screen)) || OBJECTS_WITH_A_SCREEN.contains(&noun)
    }

    /// The usual name of a noun given as words or in lower_snake: "bureau" → "dresser", "cell phone" → "cellphone".
    pub fn canonical(&self, words: &str) -> Option<&str> {
        let spaced = words.replace('_', " ");
        let (noun, _) = self.any_number(&spaced)?;
        Some(noun.kind_of.as_deref().unwrap_or(&noun.name))
    }

    /// The noun of that name, words separated by spaces, as it stands in the files.
    pub fn noun(&self, words: &str) -> Option<&Noun> {
        self.names.get(words).map(|&index| &self.nouns[index])
    }

    /// The noun of that name or of which it is the regular plural, and whether it is.
    pub fn any_number(&self, words: &str) -> Option<(&Noun, bool)> {
        if let Some(noun) = self.noun(words) {
            return Some((noun, words.ends_with('s') && !noun.name.ends_with('s')));
        }
        let (before, last) = words.rsplit_once(' ').map_or(("", words), |(before, last)| (before, last));
        singulars(last).find_map(|stem| {
            let whole = if before.is_empty() { stem } else { format!("{before} {stem}") };
            self.noun(&whole).map(|noun| (noun, true))
        })
    }

    /// Part of speech and roles of a word that is no noun.
    pub fn word(&self, lower: &str) -> Option<&Entry> {
        self.words.get(lower)
    }

    /// Words in the longest name that begins with this word; 1 when none of several words does.
    pub fn longest_name_from(&self, start: &str) -> usize {
        self.starts.get(start).copied().unwrap_or(1)
    }

    /// The noun that a word misspells: the nearest, then the first of the file. A word of English misspells nothing.
    /// Linear in the lexicon, so only for words nothing else explains.
    pub fn mended(&self, word: &str) -> Option<&Noun> {
        if Vocabulary::embedded().is_english(word) {
            return None;
        }
        let names = self.names.iter().map(|(name, index)| (name.as_str(), *index));
        nearest(word, names).map(|index| &self.nouns[index])
    }

    /// What an English noun that the lexicon lacks most likely names.
    pub fn inferred(&self, lower: &str) -> Option<NounUnit<'static>> {
        if !lower.as_bytes().first().is_some_and(u8::is_ascii_lowercase) {
            return None;
        }
        let noun = Vocabulary::embedded().noun(lower)?;
        let class = match noun.class {
            NounClass::BodyPart => return None,
            NounClass::Person => Class::Person,
            other => other.class()?,
        };
        Some(NounUnit { name: noun.singular, class, plural: noun.singular != lower, inferred: true })
    }

    /// The phrases that relate one thing to another.
    pub fn relations(&self) -> &Relations {
        &self.relations
    }

    /// Names of rooms: canonical name and every way to say it, in the order of the file.
    pub fn rooms(&self) -> Vec<(&str, Vec<&str>)> {
        let rooms = self.nouns.iter().filter(|noun| noun.class == Class::Room && noun.kind_of.is_none());
        let is = |noun: &Noun, index: usize| {
            let other = &self.nouns[index];
            other.name == noun.name || other.kind_of.as_ref() == Some(&noun.name)
        };
        let spoken = |noun: &Noun| {
            let ways = self.names.iter().filter(|(_, index)| is(noun, **index)).map(|(name, _)| name.as_str());
            let mut names: Vec<&str> = ways.collect();
            names.sort_unstable();
            names
        };
        rooms.map(|noun| (noun.name.as_str(), spoken(noun))).collect()
    }

    /// All nouns.
    pub fn nouns(&self) -> &[Noun] {
        &self.nouns
    }
}

fn roles_of(names: &str) -> Option<Roles> {
    let mut roles = Roles::default();
    for name in names.split(',') {
        roles = roles.with(Roles::of(Role::from_name(name)?));
    }
    Some(roles)
}

fn wrong(file: &str, line: usize, message: String) -> LexiconError {
    LexiconError { file: file.to_string(), line, message }
}

fn split(field: Option<&&str>) -> impl Iterator<Item = String> {
    let names = field.map_or("", |names| *names).split(',').map(str::trim);
    names.filter(|name| !name.is_empty()).map(str::to_string).collect::<Vec<_>>().into_iter()
}

/// The embedded lexicon with the words of a file added; a word of the file goes before the embedded one.
///
/// # Errors
/// When the file cannot be read, or a line of it adds nothing.
pub fn lexicon_with(path: &Path) -> Result<Lexicon, LexiconError> {
    let file = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| wrong(&file, 0, error.to_string()))?;
    let mut lexicon = Lexicon::embedded().clone();
    lexicon.extend(&text, &file)?;
    Ok(lexicon)
}

/// Numbered lines without comments, split at tabs.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    text.lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_end()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .map(|(number, line)| (number, line.split('\t').collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_lexicon_is_consistent() {
        let mut lexicon = Lexicon::default();
        lexicon.add_nouns(include_str!("../../corpus/lexicon/nouns.tsv"), "nouns.tsv").expect("good nouns");
        lexicon.add_words(include_str!("../../corpus/lexicon/words.tsv"), "words.tsv").expect("good words");
        let spellings = include_str!("../../corpus/lexicon/spellings.tsv");
        lexicon.add_spellings(spellings, "spellings.tsv").expect("good spellings");
        let count = |fits: fn(Class) -> bool| lexicon.nouns().iter().filter(|noun| fits(noun.class)).count();
        assert!(count(|class| class != Class::Object && class != Class::Room) >= 150, "furniture and structure");
        assert!(count(|class| class == Class::Object) >= 300, "portable objects");
    }

    #[test]
    fn names_of_several_words_lead_to_their_noun() {
        let lexicon = Lexicon::embedded();
        assert_eq!(lexicon.canonical("cell phone"), Some("cellphone"));
        assert_eq!(lexicon.canonical("bureau"), Some("dresser"));
        assert_eq!(lexicon.noun("bureau").map(|noun| noun.name.as_str()), Some("bureau"));
        assert_eq!(lexicon.class_of("coffee_table"), Some(Class::TableLike));
        assert_eq!(lexicon.class_of("drum_table"), Some(Class::TableLike));
        assert_eq!(lexicon.class_of("bookshelves"), Some(Class::Storage));
        assert_eq!(lexicon.class_of("xyzzy"), None);
    }

    #[test]
    fn a_bad_line_is_named() {
        let error = Lexicon::default().add_nouns("# mine\nthrone\troyal\n", "my.tsv").expect_err("unknown class");
        assert_eq!(error.to_string(), "my.tsv:2: unknown class `royal`");
    }

    #[test]
    fn a_noun_a_verb_and_a_relation_are_one_line_each() {
        let mut lexicon = Lexicon::embedded().clone();
        let mine = "throne\tseat\ttrone\nschlep\tbring\nkitty-corner from\trelation\tside\n";
        lexicon.extend(mine, "my.tsv").expect("good lines");
        assert_eq!(lexicon.class_of("throne"), Some(Class::Seat));
        assert!(lexicon.word("schlep").is_some_and(|entry| entry.roles.has(Role::Bring)));
        let error = lexicon.extend("near by\trelation\tsideways\n", "my.tsv").expect_err("unknown reading");
        assert!(error.to_string().contains("sideways"), "{error}");
    }

    #[test]
    fn every_furniture_and_object_of_the_worlds_is_known() {
        let lexicon = Lexicon::embedded();
        for category in crate::catalogue::CATEGORIES {
            assert!(lexicon.class_of(category.noun).is_some_and(Class::is_furniture), "{}", category.noun);
        }
        for object in crate::catalogue::OBJECTS {
            assert_eq!(lexicon.class_of(object.name), Some(Class::Object), "{}", object.name);
        }
    }
}
