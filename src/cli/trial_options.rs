//! The options that decide what becomes of a simulated trial: the one list of what a log may choose.
//!
//! Whoever wrote a log may be a stranger. What stands here is taken from it as
//! typed values, each in its range; a name that does not stand here – an
//! output, a robot, a server – is refused, and a home is one of those shipped:
//! a log chooses no file.

use std::ops::RangeInclusive;

use serde::de::{Deserializer, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::eyes::{DEPTH_LOSS, DEPTH_NOISE, LIGHT};
use super::number::in_range;
use crate::map::SHIPPED_MAPS;
use crate::simulation::{NoiseLevel, Perception};

/// Seconds of robot time that a trial may take.
pub const TIME_LIMIT_S: RangeInclusive<f64> = 0.0..=1e6;

/// Seconds after which the simulated robot does what it is told, and so many more at most.
pub const DEAD_TIME_S: RangeInclusive<f64> = 0.0..=1.5;
/// See there.
pub const JITTER_S: RangeInclusive<f64> = 0.0..=0.5;

/// They bear the names of the command line, with `_` for `-`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct TrialOptions {
    /// A shipped home by its name; what else stands here was a file, and is named for people only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub world: Option<String>,
    /// The same of the room map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<String>,
    pub noise: NoiseLevel,
    /// Seconds, where they are not those of the noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dead_time: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub jitter: Option<f64>,
    pub perception: Perception,
    pub depth_noise: f64,
    pub depth_loss: f64,
    pub light: f64,
    pub blind: bool,
    pub one_frame: bool,
    pub first_pair_only: bool,
    pub no_fallback: bool,
    pub no_glance: bool,
    pub no_localization: bool,
    pub time_limit: f64,
    pub seed: u64,
}

/// Why the options of a log are not taken.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum OptionsError {
    /// Not what a recording holds.
    #[error("the recorded options cannot be read: {0}")]
    Malformed(String),
    /// Names that no log may choose.
    #[error(
        "refused: the log asks for {0}, which a log may not choose; it may say how a simulated trial is run and nothing else"
    )]
    Refused(String),
    /// A value that cannot be.
    #[error("the recorded `{0}` {1}")]
    Value(&'static str, String),
    /// A home of the writer's own.
    #[error("recorded in `{1}`, which is no shipped home, and a log may not choose a file: give it by --{0}")]
    File(&'static str, String),
    /// A file that would be taken for the shipped home.
    #[error("recorded in the shipped home `{1}`, but a file of that name stands here; name the one you mean by --{0}")]
    Hidden(&'static str, String),
}

/// Options for a replay, and what has to be said of them.
#[derive(Debug)]
pub struct Replayed {
    /// The recorded ones, overridden by those given.
    pub options: TrialOptions,
    /// For people.
    pub remarks: Vec<String>,
}

impl TrialOptions {
    /// As they stand in a recording: one JSON line.
    pub fn line(&self) -> String {
        // Numbers, names and truth values always serialize.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Those of a recorded line, overridden by those of `self` whose name `given` knows; `usual` are those of a
    /// program told nothing.
    ///
    /// # Errors
    /// When the line holds a name that is not on the list, or a value that cannot be.
    pub fn replaying(&self, line: &[u8], usual: &Self, given: impl Fn(&str) -> bool) -> Result<Replayed, OptionsError> {
        let malformed = |error: serde_json::Error| OptionsError::Malformed(error.to_string());
        let recorded: Map<String, Value> = serde_json::from_slice(line).map_err(malformed)?;
        let strange: Vec<String> =
            recorded.keys().filter(|name| !is_on_the_list(name)).map(|n| asked(n, &recorded)).collect();
        if !strange.is_empty() {
            return Err(OptionsError::Refused(strange.join(", ")));
        }
        let (own, usual) = (named(self), named(usual));
        let mut before = usual.clone();
        before.extend(recorded.clone());
        let mut both = before.clone();
        both.extend(own.into_iter().filter(|(name, _)| given(name)));
        let options: Self = serde_json::from_value(Value::Object(both.clone())).map_err(malformed)?;
        options.check(&given)?;
        Ok(Replayed { options, remarks: remarks(&usual, &recorded, &before, &both) })
    }

    fn check(&self, given: impl Fn(&str) -> bool) -> Result<(), OptionsError> {
        let numbers = [
            ("depth_noise", self.depth_noise, DEPTH_NOISE),
            ("depth_loss", self.depth_loss, DEPTH_LOSS),
            ("light", self.light, LIGHT),
            ("time_limit", self.time_limit, TIME_LIMIT_S),
            ("dead_time", self.dead_time.unwrap_or(0.0), DEAD_TIME_S),
            ("jitter", self.jitter.unwrap_or(0.0), JITTER_S),
        ];
        for (name, value, range) in numbers {
            in_range(value, &range).map_err(|why| OptionsError::Value(name, why))?;
        }
        for (name, home) in [("world", &self.world), ("map", &self.map)] {
            let Some(home) = home.as_ref().filter(|_| !given(name)) else { continue };
            if !SHIPPED_MAPS.iter().any(|shipped| shipped.name == home) {
                return Err(OptionsError::File(name, home.clone()));
            }
            if std::path::Path::new(home).exists() {
                return Err(OptionsError::Hidden(name, home.clone()));
            }
        }
        Ok(())
    }
}

/// Every name that may stand in a log: the fields of `TrialOptions`, as they tell them to whoever reads one.
fn names() -> &'static [&'static str] {
    struct Listener<'a>(&'a mut &'static [&'static str]);

    impl<'de> Deserializer<'de> for Listener<'_> {
        type Error = serde::de::value::Error;

        fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
            Err(serde::de::Error::custom("only the names are asked for"))
        }

        fn deserialize_struct<V: Visitor<'de>>(
            self,
            _: &'static str,
            fields: &'static [&'static str],
            visitor: V,
        ) -> Result<V::Value, Self::Error> {
            *self.0 = fields;
            self.deserialize_any(visitor)
        }

        serde::forward_to_deserialize_any! {
            bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct
            newtype_struct seq tuple tuple_struct map enum identifier ignored_any
        }
    }

    let mut names: &'static [&'static str] = &[];
    let _no_options = TrialOptions::deserialize(Listener(&mut names));
    names
}

fn is_on_the_list(name: &str) -> bool {
    names().contains(&name)
}

/// What a strange name asks for; a list of words is a command line.
fn asked(name: &str, recorded: &Map<String, Value>) -> String {
    match recorded.get(name) {
        Some(Value::Array(words)) => {
            let words: Vec<String> =
                words.iter().map(|word| word.as_str().map_or(word.to_string(), str::to_string)).collect();
            format!("a command line (`{}`)", words.join(" "))
        }
        _ => format!("`{name}`"),
    }
}

fn named(options: &TrialOptions) -> Map<String, Value> {
    match serde_json::to_value(options) {
        Ok(Value::Object(map)) => map,
        // A struct serializes as an object.
        _ => Map::new(),
    }
}

/// What differs from a program told nothing, and what was given against the recording.
fn remarks(
    usual: &Map<String, Value>,
    recorded: &Map<String, Value>,
    before: &Map<String, Value>,
    both: &Map<String, Value>,
) -> Vec<String> {
    let sorted = |map: &Map<String, Value>| {
        let mut pairs: Vec<(String, Value)> = map.iter().map(|(name, value)| (name.clone(), value.clone())).collect();
        pairs.sort_by(|a, b| a.0.cmp(&b.0));
        pairs
    };
    let unusual = sorted(recorded).into_iter().filter(|(name, value)| usual.get(name) != Some(value));
    let unusual: Vec<String> = unusual.map(|(name, value)| option(&name, &value)).collect();
    let mut remarks = Vec::new();
    if !unusual.is_empty() {
        remarks.push(format!("as recorded: {}", unusual.join(" ")));
    }
    for (name, value) in sorted(both) {
        match before.get(&name) {
            Some(was) if *was == value => {}
            Some(was) => remarks.push(format!("{} instead of {}, as recorded", option(&name, &value), plain(was))),
            None => remarks.push(format!("{}, which was not recorded", option(&name, &value))),
        }
    }
    remarks
}

fn option(name: &str, value: &Value) -> String {
    let name = name.replace('_', "-");
    if *value == Value::Bool(true) { format!("--{name}") } else { format!("--{name} {}", plain(value)) }
}

fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_string)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usual() -> TrialOptions {
        TrialOptions {
            world: None,
            map: None,
            noise: NoiseLevel::Default,
            dead_time: None,
            jitter: None,
            perception: Perception::Truth,
            depth_noise: 1.0,
            depth_loss: 0.02,
            light: 1.0,
            blind: false,
            one_frame: false,
            first_pair_only: false,
            no_fallback: false,
            no_glance: false,
            no_localization: false,
            time_limit: 900.0,
            seed: 0,
        }
    }

    fn replaying(line: &str) -> Result<Replayed, OptionsError> {
        usual().replaying(line.as_bytes(), &usual(), |_| false)
    }

    #[test]
    fn the_list_is_that_of_the_fields() {
        let all = TrialOptions { world: Some(String::new()), map: Some(String::new()), ..usual() };
        let all = TrialOptions { dead_time: Some(0.1), jitter: Some(0.0), ..all };
        assert_eq!(named(&all).keys().collect::<Vec<_>>(), names().iter().collect::<Vec<_>>());
    }

    #[test]
    fn what_was_recorded_comes_back_unless_told_otherwise() {
        let first = TrialOptions { world: Some("studio".into()), noise: NoiseLevel::Double, seed: u64::MAX, ..usual() };
        let again = usual().replaying(first.line().as_bytes(), &usual(), |_| false).expect("taken");
        assert_eq!(again.options, first);
        let own = TrialOptions { seed: 8, ..usual() };
        let told = own.replaying(first.line().as_bytes(), &usual(), |name| name == "seed").expect("taken");
        assert_eq!(told.options, TrialOptions { seed: 8, ..first });
        assert!(told.remarks.iter().any(|text| text.starts_with("--seed 8 instead of ")), "{:?}", told.remarks);
    }

    #[test]
    fn a_log_chooses_no_file_no_output_and_no_robot() {
        for strange in ["output", "force", "robot", "serve", "camera_out", "plot", "record", "lexicon", "model", "from"]
        {
            let error = replaying(&format!(r#"{{"{strange}":"x","seed":1}}"#)).expect_err(strange);
            assert!(error.to_string().contains(&format!("asks for `{strange}`")), "{error}");
        }
        for path in ["/dev/zero", "../other.json", "studio.json", "", "no-home"] {
            let error = replaying(&format!(r#"{{"world":"{path}"}}"#)).expect_err(path);
            assert_eq!(error, OptionsError::File("world", path.to_string()));
        }
    }

    #[test]
    fn a_command_line_in_a_log_is_shown_and_refused() {
        let error = replaying(r#"{"options":["--output","victim","--force"]}"#).expect_err("argv").to_string();
        assert!(error.contains("a command line (`--output victim --force`)"), "{error}");
    }

    #[test]
    fn a_value_that_cannot_be_is_named() {
        for line in [
            r#"{"time_limit":-1}"#,
            r#"{"light":3}"#,
            r#"{"noise":"loud"}"#,
            r#"{"seed":-1}"#,
            r#"{"blind":"yes"}"#,
            "[]",
            "7",
        ] {
            assert!(matches!(replaying(line), Err(OptionsError::Value(..) | OptionsError::Malformed(_))), "{line}");
        }
    }
}
