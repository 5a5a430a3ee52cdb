//! The words the robot knows: data in `corpus/lexicon/`, one line a word.

use std::collections::{HashMap, HashSet};
use std::path::Path;
use std::sync::OnceLock;

use super::word_class::{Class, Role};

/// A noun: its canonical name in lower_snake, and its class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Noun {
    /// Canonical name.
    pub name: String,
    /// What kind of thing it names.
    pub class: Class,
}

/// Shorter words are too near to too many others to be taken for misspelt.
const LETTERS_FOR_ONE_EDIT: usize = 5;
const LETTERS_FOR_TWO_EDITS: usize = 9;

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

/// Nouns and other words.
#[derive(Clone, Debug, Default)]
pub struct Lexicon {
    nouns: Vec<Noun>,
    /// From the words of a name, joined by spaces, to its noun.
    names: HashMap<String, usize>,
    words: HashMap<String, (String, Role)>,
    /// From the first word of names of several words to the number of words in the longest.
    starts: HashMap<String, usize>,
    /// What a word that is written otherwise means.
    spellings: HashMap<String, String>,
    /// What looks like a misspelt noun and is none.
    apart: HashSet<String>,
}

impl Lexicon {
    /// The lexicon this program ships.
    pub fn embedded() -> &'static Self {
        static EMBEDDED: OnceLock<Lexicon> = OnceLock::new();
        EMBEDDED.get_or_init(|| {
            let mut lexicon = Self::default();
            // A lexicon with holes would misread silently.
            lexicon
                .add_nouns(include_str!("../../corpus/lexicon/nouns.tsv"), "nouns.tsv")
                .and_then(|()| lexicon.add_words(include_str!("../../corpus/lexicon/words.tsv"), "words.tsv"))
                .and_then(|()| {
                    lexicon.add_spellings(include_str!("../../corpus/lexicon/spellings.tsv"), "spellings.tsv")
                })
                .unwrap_or_else(|error| panic!("embedded: {error}"));
            lexicon.apart =
                lines(include_str!("../../corpus/lexicon/apart.txt")).map(|(_, word)| word.concat()).collect();
            lexicon
        })
    }

    /// Adds nouns: lines of `name TAB class [TAB other, names]`; `#` begins a comment. A name that is known is refused.
    pub fn add_nouns(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        self.read_nouns(text, file, false)
    }

    /// Adds a user's nouns: the same lines, and a name that is known from before gets the new meaning.
    pub fn extend_nouns(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        self.read_nouns(text, file, true)
    }

    fn read_nouns(&mut self, text: &str, file: &str, replace: bool) -> Result<(), LexiconError> {
        let known = self.nouns.len();
        for (line, fields) in lines(text) {
            let wrong = |message: String| LexiconError { file: file.to_string(), line, message };
            let (Some(name), Some(class)) = (fields.first(), fields.get(1)) else {
                return Err(wrong("a noun needs a name, a tab and a class".to_string()));
            };
            let class = Class::from_name(class).ok_or_else(|| wrong(format!("unknown class `{class}`")))?;
            // "wall" is a structure with rules of its own.
            let class = if *name == "wall" { Class::Wall } else { class };
            let index = self.nouns.len();
            self.nouns.push(Noun { name: (*name).to_string(), class });
            let others = fields.get(2).map_or("", |others| *others).split(',').map(str::trim);
            for other in others.filter(|other| !other.is_empty()).chain([name.replace('_', " ").as_str()]) {
                let old = self.names.insert(other.to_string(), index).filter(|old| *old != index);
                if old.is_some_and(|old| !replace || old >= known) {
                    return Err(wrong(format!("`{other}` already names another noun")));
                }
                self.note_start(other);
            }
        }
        Ok(())
    }

    /// Whether a thing is read by its own front before all else: what one person sits on, and what has a screen
    /// (Huo et al. 2014, section IV, for chairs).
    pub fn has_own_front(&self, noun: &str) -> bool {
        const OBJECTS_WITH_A_SCREEN: [&str; 3] = ["computer", "monitor", "laptop"];
        matches!(self.class_of(noun), Some(Class::Seat | Class::Screen)) || OBJECTS_WITH_A_SCREEN.contains(&noun)
    }

    fn note_start(&mut self, name: &str) {
        if let Some((start, rest)) = name.split_once(' ') {
            let longest = self.starts.entry(start.to_string()).or_default();
            *longest = (*longest).max(1 + rest.split(' ').count());
        }
    }

    /// Adds other words: lines of `word TAB part of speech TAB role`.
    pub fn add_words(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        for (line, fields) in lines(text) {
            let wrong = |message: String| LexiconError { file: file.to_string(), line, message };
            let [word, pos, role] = fields[..] else {
                return Err(wrong("a word needs a part of speech and a role, separated by tabs".to_string()));
            };
            let role = Role::from_name(role).ok_or_else(|| wrong(format!("unknown role `{role}`")))?;
            if self.words.insert(word.to_string(), (pos.to_string(), role)).is_some() {
                return Err(wrong(format!("`{word}` stands twice")));
            }
        }
        Ok(())
    }

    /// Adds spellings: lines of `written TAB meant`; only a word that means nothing as written is read otherwise.
    pub fn add_spellings(&mut self, text: &str, file: &str) -> Result<(), LexiconError> {
        for (line, fields) in lines(text) {
            let wrong = |message: String| LexiconError { file: file.to_string(), line, message };
            let [written, meant] = fields[..] else {
                return Err(wrong("a spelling needs what is written, a tab and what is meant".to_string()));
            };
            if self.word(meant).is_none() && self.noun(meant).is_none() {
                return Err(wrong(format!("`{meant}` is no word of the lexicon")));
            }
            self.spellings.insert(written.to_string(), meant.to_string());
        }
        Ok(())
    }

    /// What a word means that is written otherwise.
    pub fn spelling(&self, written: &str) -> Option<&str> {
        self.spellings.get(written).map(String::as_str)
    }

    /// The class of a noun given in lower_snake or as words.
    pub fn class_of(&self, noun: &str) -> Option<Class> {
        self.noun(&noun.replace('_', " ")).map(|noun| noun.class).or_else(|| self.class_of_head(noun))
    }

    /// "drum_table" is a table: an unknown compound is what its last word is.
    fn class_of_head(&self, noun: &str) -> Option<Class> {
        let (_, head) = noun.rsplit_once('_')?;
        self.noun(head).map(|noun| noun.class)
    }

    /// The canonical name of a noun given as words.
    pub fn canonical(&self, words: &str) -> Option<&str> {
        self.noun(words).map(|noun| noun.name.as_str())
    }

    /// The noun of that name, words separated by spaces.
    pub fn noun(&self, words: &str) -> Option<&Noun> {
        self.names.get(words).map(|&index| &self.nouns[index])
    }

    /// Part of speech and role of a word that is no noun.
    pub fn word(&self, lower: &str) -> Option<(&str, Role)> {
        self.words.get(lower).map(|(pos, role)| (pos.as_str(), *role))
    }

    /// Words in the longest name that begins with this word; 1 when none of several words does.
    pub fn longest_name_from(&self, start: &str) -> usize {
        self.starts.get(start).copied().unwrap_or(1)
    }

    /// The noun that a word misspells: one edit away, or two for a long word; the same first letter; the nearest,
    /// then the first in the alphabet. Linear in the lexicon, so only for words nothing else explains.
    pub fn nearest_noun(&self, word: &str) -> Option<&Noun> {
        let most = if word.chars().count() < LETTERS_FOR_TWO_EDITS { 1 } else { 2 };
        let first = word.chars().next()?;
        let too_short = word.chars().count() < LETTERS_FOR_ONE_EDIT;
        if too_short || !word.chars().all(char::is_alphabetic) || self.apart.contains(word) {
            return None;
        }
        let near = self.names.keys().filter(|name| name.starts_with(first) && name.len().abs_diff(word.len()) <= most);
        let near = near.map(|name| (strsim::osa_distance(word, name), name)).filter(|(distance, _)| *distance <= most);
        near.min().and_then(|(_, name)| self.noun(name))
    }

    /// Names of rooms: canonical name and every way to say it, in the order of the file.
    pub fn rooms(&self) -> Vec<(&str, Vec<&str>)> {
        let rooms = self.nouns.iter().enumerate().filter(|(_, noun)| noun.class == Class::Room);
        let spoken = |index: usize| {
            let mut names: Vec<&str> =
                self.names.iter().filter(|(_, i)| **i == index).map(|(name, _)| name.as_str()).collect();
            names.sort_unstable();
            names
        };
        rooms.map(|(index, noun)| (noun.name.as_str(), spoken(index))).collect()
    }

    /// All nouns.
    pub fn nouns(&self) -> &[Noun] {
        &self.nouns
    }
}

/// The embedded lexicon with the nouns of a file added; a noun of the file goes before the embedded one.
pub fn lexicon_with(path: &Path) -> Result<Lexicon, LexiconError> {
    let file = path.display().to_string();
    let text = std::fs::read_to_string(path);
    let text = text.map_err(|error| LexiconError { file: file.clone(), line: 0, message: error.to_string() })?;
    let mut lexicon = Lexicon::embedded().clone();
    lexicon.extend_nouns(&text, &file)?;
    Ok(lexicon)
}

/// Numbered lines without comments, split at tabs.
fn lines(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
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
        assert_eq!(lexicon.class_of("coffee_table"), Some(Class::TableLike));
        assert_eq!(lexicon.class_of("drum_table"), Some(Class::TableLike));
        assert_eq!(lexicon.class_of("xyzzy"), None);
    }

    #[test]
    fn a_word_that_names_something_else_is_no_misspelling() {
        let lexicon = Lexicon::embedded();
        let nearest = |word| lexicon.nearest_noun(word).map(|noun| noun.name.as_str());
        assert_eq!([nearest("laddder"), nearest("larder")], [Some("ladder"), None]);
        for word in &lexicon.apart {
            assert!(lexicon.noun(word).is_none() && lexicon.word(word).is_none(), "`{word}` is a word of the lexicon");
        }
    }

    #[test]
    fn a_bad_line_is_named() {
        let error = Lexicon::default().add_nouns("# mine\nthrone\troyal\n", "my.tsv").expect_err("unknown class");
        assert_eq!(error.to_string(), "my.tsv:2: unknown class `royal`");
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
