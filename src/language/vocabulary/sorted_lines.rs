//! A table that is searched as it stands in its file: sorted lines under a head with their number and checksum.

use std::cmp::Ordering;

/// A table that is not as it was made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the vocabulary's table of {table} is damaged: {fault}; make it anew by corpus/vocabulary/build.py and build again"
)]
pub struct DamagedTable {
    table: &'static str,
    fault: String,
}

/// Lines `key[TAB value]`, sorted by the bytes of their keys.
#[derive(Clone, Copy, Debug)]
pub(super) struct SortedLines {
    body: &'static str,
}

impl SortedLines {
    /// The lines under the head `# TABLE LINES CRC-32`, once their checksum is found right.
    ///
    /// # Errors
    /// When the head is not of this kind or table, or the checksum differs.
    pub(super) fn open(text: &'static str, table: &'static str) -> Result<Self, DamagedTable> {
        let damaged = |fault: String| DamagedTable { table, fault };
        let (head, body) = text.split_once('\n').unwrap_or((text, ""));
        let said = head.strip_prefix("# ").and_then(|head| head.strip_prefix(table));
        let said = said.and_then(|rest| rest.rsplit_once(' ')).and_then(|(_, sum)| u32::from_str_radix(sum, 16).ok());
        let said = said.ok_or_else(|| damaged("its first line is no head".to_string()))?;
        let found = crc32fast::hash(body.as_bytes());
        if found != said {
            return Err(damaged(format!("its checksum is {found:08x}, not {said:08x}")));
        }
        Ok(Self { body })
    }

    /// The line of that key: the key, and what follows the tab.
    pub(super) fn find(&self, key: &str) -> Option<(&'static str, &'static str)> {
        let (mut low, mut high) = (0, self.body.len());
        while low < high {
            let start = self.line_start(low, low + (high - low) / 2);
            let line = self.line(start)?;
            let (found, value) = line.split_once('\t').unwrap_or((line, ""));
            match found.as_bytes().cmp(key.as_bytes()) {
                Ordering::Equal => return Some((found, value)),
                Ordering::Less => low = start + line.len() + 1,
                Ordering::Greater => high = start,
            }
        }
        None
    }

    /// Where the line begins that goes through `at`; lines begin at `low` at the earliest.
    fn line_start(&self, low: usize, at: usize) -> usize {
        let before = &self.body.as_bytes()[low..at];
        before.iter().rposition(|&byte| byte == b'\n').map_or(low, |newline| low + newline + 1)
    }

    fn line(&self, start: usize) -> Option<&'static str> {
        self.body.get(start..)?.split('\n').next()
    }

    /// All lines, in order.
    #[cfg(test)]
    pub(super) fn lines(&self) -> std::str::Lines<'static> {
        self.body.lines()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FEW: &str = "# few 3 94bc1816\nant\tanimal\nant_bear\tanimal\nbee\tanimal\n";

    #[test]
    fn every_line_is_found_and_nothing_between() {
        let lines = SortedLines::open(FEW, "few").expect("as it was made");
        for key in ["ant", "ant_bear", "bee"] {
            assert_eq!(lines.find(key), Some((key, "animal")));
        }
        for key in ["", "a", "ant_", "antb", "bed", "cow", "\n", "ant\tanimal"] {
            assert_eq!(lines.find(key), None, "{key:?}");
        }
    }

    #[test]
    fn a_damaged_table_is_named_and_says_what_mends_it() {
        let error = SortedLines::open("# few 1 00000000\nant\tanimal\n", "few").expect_err("another checksum");
        assert!(error.to_string().starts_with("the vocabulary's table of few is damaged: its checksum is "), "{error}");
        assert!(error.to_string().contains("build.py"), "{error}");
        let error = SortedLines::open("ant\tanimal\n", "few").expect_err("no head");
        assert!(error.to_string().contains("its first line is no head"), "{error}");
        assert!(SortedLines::open("", "few").is_err(), "an empty table");
    }
}
