//! What a direction is told from: a move, the hearer, a part of the building, or a thing by its noun.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The reference of a pair. In JSON a string: `move`, `robot`, `room`, `wall`, `door`, or a noun in lower_snake.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reference {
    /// A motion inside the room.
    Move,
    /// The hearer.
    Robot,
    /// The room itself: its parts.
    Room,
    /// A wall of the room.
    Wall,
    /// The door through which the room is entered.
    Door,
    /// Furniture or an object, by its noun.
    Thing(String),
}

impl Reference {
    /// All but things.
    pub const PLACES: [Self; 5] = [Self::Move, Self::Robot, Self::Room, Self::Wall, Self::Door];

    /// What a word of a lexicon or a label names: one of the five, else a thing.
    pub fn of(name: &str) -> Self {
        let place = Self::PLACES.into_iter().find(|place| place.name() == name);
        place.unwrap_or_else(|| Self::Thing(name.to_string()))
    }

    /// The name as it stands in records.
    pub fn name(&self) -> &str {
        match self {
            Self::Move => "move",
            Self::Robot => "robot",
            Self::Room => "room",
            Self::Wall => "wall",
            Self::Door => "door",
            Self::Thing(noun) => noun,
        }
    }

    /// The noun of a thing; nothing for a move, the hearer and parts of the building.
    pub fn thing(&self) -> Option<&str> {
        match self {
            Self::Thing(noun) => Some(noun),
            _ => None,
        }
    }

    /// Whether it is a part of the building: the room, a wall, the door.
    pub fn is_of_building(&self) -> bool {
        matches!(self, Self::Room | Self::Wall | Self::Door)
    }

    /// For people: "coffee table".
    pub fn words(&self) -> String {
        self.name().replace('_', " ")
    }

    /// Reads a name as it stands in a record: one of the five, or a noun in lower_snake.
    ///
    /// # Errors
    /// For what is neither, with what was meant as far as it can be told.
    pub fn parse(name: &str) -> Result<Self, String> {
        let is_noun =
            !name.is_empty() && !name.contains(|c: char| c.is_uppercase() || c.is_whitespace() || c.is_control());
        if is_noun {
            return Ok(Self::of(name));
        }
        let lower = name.trim().to_lowercase().replace(' ', "_");
        let meant = if lower.is_empty() { String::new() } else { format!("; did you mean `{lower}`?") };
        Err(format!("`{name}` is no reference: move, robot, room, wall, door, or a noun in lower_snake{meant}"))
    }
}

impl fmt::Display for Reference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Reference {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Reference {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = Cow::<str>::deserialize(deserializer)?;
        Self::parse(&name).map_err(serde::de::Error::custom)
    }
}

impl JsonSchema for Reference {
    fn schema_name() -> Cow<'static, str> {
        "Reference".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "`move`, `robot`, `room`, `wall`, `door`, or a noun in lower_snake.",
            "type": "string",
            "pattern": "^[^A-Z\\s]+$"
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reference_is_read_as_it_is_written() {
        for reference in Reference::PLACES.into_iter().chain([Reference::Thing("coffee_table".to_string())]) {
            let json = serde_json::to_string(&reference).expect("a string");
            assert_eq!(serde_json::from_str::<Reference>(&json).expect("read"), reference);
        }
    }

    #[test]
    fn a_place_in_capitals_is_refused_with_what_was_meant() {
        let error = Reference::parse("Wall").expect_err("refused");
        assert!(error.contains("`Wall` is no reference") && error.contains("did you mean `wall`?"), "{error}");
        assert!(Reference::parse("coffee table").expect_err("refused").contains("did you mean `coffee_table`?"));
        assert!(Reference::parse("").is_err());
    }
}
