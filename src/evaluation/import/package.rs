//! A spreadsheet file before it is read: its parts are small, and what they claim is possible.
//!
//! The reader takes memory for as many strings as a file says it holds, and
//! counts the letters of a cell's name without an end.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use crate::limits::{SHEET_CELLS, SHEET_PART_BYTES};

/// Letters and digits of the last cell that a sheet can have, XFD1048576.
const LONGEST_CELL: (usize, usize) = (3, 7);

/// Refuses a file that unpacks to too much, or claims what no sheet has.
pub(super) fn check(bytes: &[u8]) -> Result<(), String> {
    let unreadable = |error: zip::result::ZipError| format!("not a spreadsheet (.xlsx) that can be read: {error}");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(unreadable)?;
    let mut unpacked = 0;
    for index in 0..archive.len() {
        let part = archive.by_index(index).map_err(unreadable)?;
        let name = part.name().map(|name| name.into_owned()).unwrap_or_default();
        let mut text = Vec::new();
        part.take(SHEET_PART_BYTES.value + 1).read_to_end(&mut text).map_err(|e| format!("`{name}`: {e}"))?;
        unpacked += text.len();
        SHEET_PART_BYTES.check(unpacked)?;
        check_part(&text).map_err(|what| format!("`{name}`: {what}"))?;
    }
    Ok(())
}

fn check_part(text: &[u8]) -> Result<(), String> {
    for name in ["uniqueCount", "count"] {
        for value in values(text, name) {
            let count = str::from_utf8(value).ok().and_then(|digits| digits.trim().parse::<u64>().ok());
            if count.is_some_and(|count| count > SHEET_CELLS.value) {
                return Err(SHEET_CELLS.exceeded(&String::from_utf8_lossy(value)));
            }
        }
    }
    for name in ["r", "ref"] {
        for cell in values(text, name).flat_map(|value| value.split(|byte| *byte == b':')) {
            let letters = cell.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
            let digits = cell[letters..].iter().take_while(|byte| byte.is_ascii_digit()).count();
            if letters > LONGEST_CELL.0 || digits > LONGEST_CELL.1 {
                let shown: String = String::from_utf8_lossy(cell).chars().take(24).collect();
                return Err(format!("`{shown}` is no cell; the last of a sheet is XFD1048576"));
            }
        }
    }
    Ok(())
}

/// What stands in the quotes behind an attribute's name, wherever it stands.
fn values<'t>(text: &'t [u8], name: &str) -> impl Iterator<Item = &'t [u8]> {
    let name = name.as_bytes().to_vec();
    text.split(u8::is_ascii_whitespace).filter_map(move |word| {
        let quoted = word.strip_prefix(name.as_slice())?.strip_prefix(b"=")?;
        let (quote, rest) = quoted.split_first()?;
        let end = rest.iter().position(|byte| byte == quote).unwrap_or(rest.len());
        Some(&rest[..end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_of_millions_of_strings_and_cells_without_an_end_are_refused() {
        let error = |text: &str| check_part(text.as_bytes()).expect_err("no sheet");
        assert!(error(r#"<sst count="1" uniqueCount="4000000000">"#).contains("4000000000 cells are more than"));
        assert!(error(r#"<c r="AAAAAAAAAAAAAAAAAAAA1" t="s">"#).contains("`AAAAAAAAAAAAAAAAAAAA1` is no cell"));
        assert!(error(r#"<dimension ref="A1:B99999999999"/>"#).contains("is no cell"));
        assert_eq!(check_part(br#"<row r="12"><c r="XFD1048576" s="1"><v>7</v></c></row>"#), Ok(()));
    }
}
