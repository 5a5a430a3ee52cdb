//! One record as it travels: an ordered list of keys whose values stay unparsed until someone asks.
//!
//! Keeping the raw bytes of each value is what makes pass-through exact (key
//! order, number spelling, unknown keys) and cheap (a stage parses only the
//! keys it reads).

use std::borrow::Cow;
use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::value::RawValue;

use crate::escape::for_file_name;

use super::Part;

/// A record: keys in their order, values as raw JSON.
#[derive(Debug, Default)]
pub struct Record<'line> {
    line: &'line str,
    /// Where it stands in the input, counted from 1; 0 where it comes from no input.
    ordinal: usize,
    fields: Vec<(Cow<'line, str>, Cow<'line, RawValue>)>,
}

/// A value of a record that is not what its key promises.
#[derive(Debug, thiserror::Error)]
#[error("`{key}`: {message}")]
pub struct FieldError {
    /// The key.
    pub key: String,
    /// What is wrong with its value.
    pub message: String,
    /// Bytes from the start of the line to the place, when the value came from a line.
    pub offset: Option<usize>,
}

impl<'line> Record<'line> {
    /// Parses one line.
    ///
    /// # Errors
    /// When the line is no JSON object, with the column.
    pub fn parse(line: &'line str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(line).map(|record| Self { line, ..record })
    }

    /// A record that holds `text` under the given id.
    pub fn from_text(id: &str, text: &str) -> Self {
        let mut record = Self::default();
        record.set("id", &id);
        record.set("text", &text);
        record
    }

    /// The line it was parsed from, byte for byte; empty when it was not.
    pub fn line(&self) -> &'line str {
        self.line
    }

    /// The same record without some of its keys: as it was before the stages that added them.
    pub fn without(&self, keys: &[&str]) -> Self {
        let fields = self.fields.iter().filter(|(key, _)| !keys.contains(&key.as_ref()));
        Self { line: self.line, ordinal: self.ordinal, fields: fields.cloned().collect() }
    }

    /// The raw JSON under `key`.
    pub fn raw(&self, key: &str) -> Option<&RawValue> {
        self.fields.iter().find(|(k, _)| k == key).map(|(_, v)| v.as_ref())
    }

    /// The value under `key`, or nothing when the key is absent.
    ///
    /// # Errors
    /// When the value is not of that type.
    pub fn get<'a, T: Deserialize<'a>>(&'a self, key: &str) -> Result<Option<T>, FieldError> {
        let Some(raw) = self.raw(key) else { return Ok(None) };
        serde_json::from_str(raw.get()).map(Some).map_err(|error| FieldError {
            key: key.to_string(),
            message: message_without_position(&error),
            offset: self.offset_of(raw.get()).map(|start| start + error.column().saturating_sub(1)),
        })
    }

    /// The value under `key`; its absence is an error that says which stage adds it.
    ///
    /// # Errors
    /// When the key is absent, or its value not of that type.
    pub fn require<'a, T: Deserialize<'a>>(&'a self, key: &str, added_by: &str) -> Result<T, FieldError> {
        self.get(key)?.ok_or_else(|| FieldError {
            key: key.to_string(),
            message: format!("missing; {added_by}"),
            offset: None,
        })
    }

    /// Sets `key`, in place when the record has it, else at the end.
    pub fn set<T: Serialize + ?Sized>(&mut self, key: &str, value: &T) {
        // Only a map with keys that are not strings can fail here, and no type of the contract has one.
        let Ok(raw) = serde_json::value::to_raw_value(value) else { return };
        match self.fields.iter_mut().find(|(k, _)| k == key) {
            Some(field) => field.1 = Cow::Owned(raw),
            None => self.fields.push((Cow::Owned(key.to_string()), Cow::Owned(raw))),
        }
    }

    /// What a stage has added, or nothing where it has not run.
    ///
    /// # Errors
    /// When the value is not what the stage writes.
    pub fn part<'a, T: Part + Deserialize<'a>>(&'a self) -> Result<Option<T>, FieldError> {
        self.get(T::KEY)
    }

    /// What a stage has added; its absence is an error that says which stage adds it.
    ///
    /// # Errors
    /// When the key is absent, or its value not what the stage writes.
    pub fn require_part<'a, T: Part + Deserialize<'a>>(&'a self, added_by: &str) -> Result<T, FieldError> {
        self.require(T::KEY, added_by)
    }

    /// Adds what a stage has made, in place where the record has it, else at the end.
    pub fn put<T: Part + Serialize>(&mut self, part: &T) {
        self.set(T::KEY, part);
    }

    /// The record's id as text, when it has one that is a string or a number.
    pub fn id(&self) -> Option<String> {
        let raw = self.raw("id")?.get();
        if raw.starts_with('"') { serde_json::from_str(raw).ok() } else { Some(raw.to_string()) }
    }

    /// The same record, as the one that stands there in the input.
    pub fn at(self, ordinal: usize) -> Self {
        Self { ordinal, ..self }
    }

    /// What files of this record are called: after its id; without one, after its place in the input.
    pub fn file_name(&self) -> String {
        match self.id() {
            Some(id) => for_file_name(&id),
            None if self.ordinal > 0 => format!("%line-{}", self.ordinal),
            None => "record".to_string(),
        }
    }

    /// The keys whose values are texts, numbers, truth values or null, with the values as text; null is empty.
    pub fn scalars(&self) -> impl Iterator<Item = (&str, String)> {
        self.fields.iter().filter_map(|(key, raw)| match raw.get() {
            "null" => Some((key.as_ref(), String::new())),
            text if text.starts_with('"') => Some((key.as_ref(), serde_json::from_str(text).ok()?)),
            other if other.starts_with(['{', '[']) => None,
            other => Some((key.as_ref(), other.to_string())),
        })
    }

    /// Bytes from the start of the line to `value`, when it is a slice of the line.
    fn offset_of(&self, value: &str) -> Option<usize> {
        let offset = (value.as_ptr() as usize).checked_sub(self.line.as_ptr() as usize)?;
        (offset < self.line.len()).then_some(offset)
    }
}

/// The message of a JSON error without its "at line 1 column 7", which counts within the value: the caller knows better.
pub fn message_without_position(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rfind(" at line ").map_or(text.clone(), |cut| text[..cut].to_string())
}

impl Serialize for Record<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.fields.len()))?;
        for (key, value) in &self.fields {
            map.serialize_entry(key.as_ref(), value.as_ref())?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Record<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RecordVisitor)
    }
}

struct RecordVisitor;

impl<'de> Visitor<'de> for RecordVisitor {
    type Value = Record<'de>;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a record, that is, a JSON object on one line")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Record<'de>, A::Error> {
        let mut fields: Vec<(Cow<'de, str>, Cow<'de, RawValue>)> = Vec::with_capacity(8);
        while let Some(Key(key)) = map.next_key::<Key<'de>>()? {
            if fields.iter().any(|(k, _)| *k == key) {
                return Err(serde::de::Error::custom(format!("the key `{key}` stands twice; keep one of them")));
            }
            fields.push((key, Cow::Borrowed(map.next_value::<&'de RawValue>()?)));
        }
        Ok(Record { line: "", ordinal: 0, fields })
    }
}

/// A key, borrowed from the line unless it holds escapes.
#[derive(Deserialize)]
struct Key<'a>(#[serde(borrow)] Cow<'a, str>);

#[cfg(test)]
mod tests {
    use super::*;

    const ODD: &str = r#"{"z":1.0,"a":{"k":[1e3,-0]},"id":7,"text":"x","größe":"\u00e4"}"#;

    #[test]
    fn unknown_keys_come_out_byte_for_byte_in_their_order() {
        let record = Record::parse(ODD).expect("valid JSON");
        assert_eq!(serde_json::to_string(&record).expect("serializes"), ODD);
    }

    #[test]
    fn a_new_key_goes_to_the_end_and_an_old_one_stays_in_place() {
        let mut record = Record::parse(r#"{"id":"1","plan":null,"x":0}"#).expect("valid JSON");
        record.set("plan", &1);
        record.set("trial", &2);
        assert_eq!(serde_json::to_string(&record).expect("serializes"), r#"{"id":"1","plan":1,"x":0,"trial":2}"#);
    }

    #[test]
    fn a_key_that_stands_twice_is_refused_by_name() {
        let error = Record::parse(r#"{"id":1,"id":2}"#).expect_err("a duplicate key");
        assert!(error.to_string().contains("`id` stands twice"), "{error}");
    }

    #[test]
    fn without_the_keys_of_later_stages_a_record_is_as_it_was() {
        let record = Record::parse(r#"{"id":"1","mine":1.0,"plan":{},"trial":{}}"#).expect("valid JSON");
        let before = record.without(&["plan", "trial"]);
        assert_eq!(serde_json::to_string(&before).expect("serializes"), r#"{"id":"1","mine":1.0}"#);
    }

    #[test]
    fn an_array_is_no_record() {
        let error = Record::parse("[1,2]").expect_err("an array");
        assert!(error.to_string().contains("expected a record"), "{error}");
    }

    #[test]
    fn a_value_of_the_wrong_kind_is_located_within_the_line() {
        let record = Record::parse(r#"{"id":"1","text": 12}"#).expect("valid JSON");
        let error = record.get::<&str>("text").expect_err("a number is no text");
        assert_eq!(error.offset, Some(19));
        assert!(error.to_string().starts_with("`text`: invalid type: integer"), "{error}");
    }

    #[test]
    fn ids_may_be_numbers() {
        assert_eq!(Record::parse(ODD).expect("valid JSON").id().as_deref(), Some("7"));
    }
}
