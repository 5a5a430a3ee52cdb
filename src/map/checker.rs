//! What all checks of maps and scenes share: how they word what is wrong, naming the item and what mends it.

use std::collections::BTreeSet;

use super::error::WorldError;
use super::room_map::FORMAT_VERSION;
use crate::limits::Limit;

/// Furniture may come this near to a wall's line or stand this deep in another's outline: files are written by hand.
pub(crate) const TOLERANCE_M: f64 = 0.005;

/// Words what is wrong with a file.
pub(crate) struct Checker<'a> {
    pub(crate) file: &'a str,
}

impl Checker<'_> {
    pub(crate) fn wrong(&self, item: impl Into<String>, message: impl Into<String>) -> WorldError {
        WorldError::Wrong { file: self.file.to_string(), item: item.into(), message: message.into() }
    }

    pub(crate) fn require(&self, good: bool, item: &str, message: impl FnOnce() -> String) -> Result<(), WorldError> {
        if good { Ok(()) } else { Err(self.wrong(item, message())) }
    }

    /// No more than the limit.
    pub(crate) fn within(&self, limit: Limit, item: &str, found: usize) -> Result<(), WorldError> {
        limit.check(found).map_err(|message| self.wrong(item, message))
    }

    pub(crate) fn version(&self, found: u32) -> Result<(), WorldError> {
        if found == FORMAT_VERSION {
            return Ok(());
        }
        Err(WorldError::Version { file: self.file.to_string(), found, known: FORMAT_VERSION })
    }

    pub(crate) fn unique<'i>(&self, kind: &str, ids: impl Iterator<Item = &'i str>) -> Result<(), WorldError> {
        let mut seen = BTreeSet::new();
        for id in ids {
            self.require(!id.trim().is_empty(), kind, || "has an empty name; give it one".to_string())?;
            self.require(seen.insert(id), &format!("{kind} `{id}`"), || {
                "stands twice; give each its own name".to_string()
            })?;
        }
        Ok(())
    }
}

/// The name most like `wanted` among `known`, when any is near enough to be a slip.
pub(crate) fn nearest_name<'n>(wanted: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    const LIKE: f64 = 0.75;
    let scored = known.map(|name| (strsim::jaro_winkler(wanted, name), name));
    scored.filter(|(score, _)| *score >= LIKE).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}
