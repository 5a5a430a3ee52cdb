//! What was seen on earlier errands, kept from run to run where that is asked for.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::files::{FileError, write_file};
use crate::geometry::{Vec2, vec2};

/// What stands farther from where it stood has moved, metres: more than looks at one piece disagree.
const MOVED_M: f64 = 0.5;

/// Furniture and objects seen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// The name of the map on which places are told.
    pub map: String,
    /// Furniture by its name.
    pub furniture: Vec<SeenPiece>,
    /// Objects by their nouns.
    pub objects: Vec<SeenObject>,
}

/// A piece of furniture and where its middle was, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenPiece {
    /// What it is called.
    pub name: String,
    /// The room it stands in.
    pub room: String,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
}

/// An object and where it was found, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenObject {
    /// Its noun.
    pub name: String,
    /// Where, as a person would say it: a sentence that leads there again.
    pub description: String,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
}

impl Memory {
    /// The memory in a file; an empty one where there is no such file.
    ///
    /// # Errors
    /// When the file cannot be read, holds no memory, or one of another home.
    pub fn load(path: &Path, map: &str) -> Result<Self, String> {
        let new = Self { map: map.to_string(), ..Self::default() };
        let bytes = match crate::limits::MEMORY_BYTES.read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(new),
            Err(error) => return Err(format!("{}: {error}", path.display())),
        };
        let memory: Self = serde_json::from_slice(&bytes)
            .map_err(|error| format!("{}: no memory of `drive --remember`: {error}", path.display()))?;
        if memory.map == map {
            return Ok(memory);
        }
        let (file, theirs) = (path.display(), &memory.map);
        Err(format!("{file}: remembers the home `{theirs}`, the robot is in `{map}`; name another file"))
    }

    /// Writes it, in place of what was there.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), FileError> {
        // Numbers and strings always make JSON.
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        write_file(path, format!("{text}\n").as_bytes(), true)
    }

    /// The object of that noun.
    pub fn object(&self, name: &str) -> Option<&SeenObject> {
        self.objects.iter().find(|object| object.name == name)
    }

    /// It is not where it was.
    pub fn forget(&mut self, name: &str) {
        self.objects.retain(|object| object.name != name);
    }

    /// Takes in where an object is; where it was, when that is elsewhere.
    pub fn see_object(&mut self, seen: SeenObject) -> Option<SeenObject> {
        let before = self.object(&seen.name).cloned();
        self.forget(&seen.name);
        let at = vec2(seen.x, seen.y);
        self.objects.push(seen);
        before.filter(|before| has_moved(vec2(before.x, before.y), at))
    }

    /// Takes in where a piece stands; true when it stood elsewhere.
    pub fn see_piece(&mut self, seen: SeenPiece) -> bool {
        let known = self.furniture.iter_mut().find(|piece| piece.name == seen.name);
        let Some(known) = known else {
            self.furniture.push(seen);
            return false;
        };
        let moved = has_moved(vec2(known.x, known.y), vec2(seen.x, seen.y));
        *known = seen;
        moved
    }
}

fn has_moved(before: Vec2, after: Vec2) -> bool {
    (before - after).norm() > MOVED_M
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_that_stands_elsewhere_has_moved_and_one_seen_a_little_aside_has_not() {
        let piece = |x: f64| SeenPiece { name: "couch".into(), room: "bedroom".into(), x, y: 0.0 };
        let mut memory = Memory::default();
        assert!(!memory.see_piece(piece(1.0)) && !memory.see_piece(piece(1.2)));
        assert!(memory.see_piece(piece(3.0)));
        assert_eq!(memory.furniture, [piece(3.0)]);
    }

    #[test]
    fn an_object_is_remembered_where_it_was_last_and_told_where_it_was_before() {
        let mug = |x: f64| SeenObject { name: "mug".into(), description: format!("at {x}"), x, y: 0.0 };
        let mut memory = Memory::default();
        assert_eq!(memory.see_object(mug(0.0)), None);
        assert_eq!(memory.see_object(mug(4.0)), Some(mug(0.0)));
        assert_eq!(memory.objects, [mug(4.0)]);
    }
}
