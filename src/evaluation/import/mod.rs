//! The authors' public files → this project's JSON lines.
//!
//! Their repositories carry no licence, so their files are not shipped and not
//! at hand here; what is read is what their papers and readers tell of them:
//!
//! - a treebank in XML whose items are `S` (sentences) or `Note`s. An item
//!   holds either a bracketed tree as text, `(S (OBTP the/DT mug/NN is/VBZ))`,
//!   or the tree as nested elements named by their tags, with the words as
//!   text (`mug/NN`) or as elements named by their parts of speech;
//! - a sheet (.xlsx) with a row for each chunk in pre-order: the number of its
//!   sentence, tag, words, and columns `room`, `object`, `reference`,
//!   `direction`, `target` (found by their names in the first row).
//!
//! Numbers in the sheet that do not lead to a tree with the same tags are
//! slips, and say so: the tree beside it that fits is taken.

mod bracketed;
mod package;
mod sheet;
mod treebank_xml;

use std::path::Path;

use super::treebank::{TokenEntry, TokenGrounding};
use crate::limits::IMPORT_FILE_BYTES;
use sheet::SheetRow;

/// Descriptions in this project's format, and what was odd about the files.
#[derive(Clone, Debug, Default)]
pub struct Imported {
    /// One JSON object a line.
    pub lines: Vec<String>,
    /// What was mended, and what could not be.
    pub remarks: Vec<String>,
}

/// A file that cannot be read: `FILE: message`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {message}")]
pub struct ImportError {
    /// The file.
    pub file: String,
    /// What is wrong, and what mends it.
    pub message: String,
}

/// Reads a treebank and, where there is one, the sheet of groundings; ids are `prefix-0001` and so on.
///
/// # Errors
/// When a file cannot be read, or is no treebank or no sheet of groundings, with the place.
pub fn import(treebank: &Path, groundings: Option<&Path>, prefix: &str) -> Result<Imported, ImportError> {
    let file = treebank.display().to_string();
    let xml = IMPORT_FILE_BYTES
        .read_text(treebank)
        .map_err(|error| ImportError { file: file.clone(), message: error.to_string() })?;
    let mut entries = treebank_xml::read(&xml).map_err(|message| ImportError { file: file.clone(), message })?;
    if entries.is_empty() {
        return Err(ImportError { file, message: "has no `S` or `Note` items; is this the treebank?".to_string() });
    }
    for (i, entry) in entries.iter_mut().enumerate() {
        entry.id = format!("{prefix}-{:04}", i + 1);
    }
    let mut imported = Imported::default();
    if let Some(path) = groundings {
        let file = path.display().to_string();
        let rows = sheet::read(path).map_err(|message| ImportError { file, message })?;
        attach(&mut entries, rows, &mut imported.remarks);
    }
    let line = |entry: &TokenEntry| serde_json::to_string(entry).unwrap_or_default();
    imported.lines = entries.iter().map(line).collect();
    Ok(imported)
}

/// Gives each tree the rows of its number, or of the number beside it when only that one has the same tags.
fn attach(entries: &mut [TokenEntry], rows: Vec<SheetRow>, remarks: &mut Vec<String>) {
    for group in rows.chunk_by(|a, b| a.number == b.number) {
        let number = group[0].number;
        // Nearest first: the slips known are by one.
        let near = [number, number + 1, number.wrapping_sub(1), number + 2, number.wrapping_sub(2)];
        let fits = |n: &usize| {
            let entry = n.checked_sub(1).and_then(|at| entries.get(at));
            entry.is_some_and(|entry| entry.groundings.is_empty() && same_tags(entry, group))
        };
        let Some(found) = near.into_iter().find(fits) else {
            let tags: Vec<&str> = group.iter().map(|row| row.grounding.tag.as_str()).collect();
            remarks.push(format!(
                "row {}: sentence {number} has no tree with the chunks {}; its groundings are left out",
                group[0].row,
                tags.join(" ")
            ));
            continue;
        };
        if found != number {
            remarks.push(format!(
                "row {}: sentence {number} is a slip of the numbering; the chunks are those of sentence {found}",
                group[0].row
            ));
        }
        entries[found - 1].groundings = group.iter().map(|row| renamed(row.grounding.clone())).collect();
    }
    let bare: Vec<&str> = entries.iter().filter(|e| e.groundings.is_empty()).map(|e| e.id.as_str()).collect();
    if !bare.is_empty() {
        remarks.push(format!("{} trees have no groundings: {}", bare.len(), bare.join(", ")));
    }
}

fn same_tags(entry: &TokenEntry, rows: &[SheetRow]) -> bool {
    entry.chunks.len() == rows.len() && entry.chunks.iter().zip(rows).all(|(chunk, row)| chunk.tag == row.grounding.tag)
}

/// The paper's words for directions, instead of the files'.
fn renamed(mut grounding: TokenGrounding) -> TokenGrounding {
    let paper = |direction: String| match direction.as_str() {
        "center" | "centre" => "central".to_string(),
        "beside" => "side".to_string(),
        _ => direction,
    };
    grounding.direction = grounding.direction.map(paper);
    grounding
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::treebank::TokenChunk;

    fn entry(tags: &[&str]) -> TokenEntry {
        let chunk = |tag: &&str| TokenChunk { tag: (*tag).to_string(), ..TokenChunk::default() };
        TokenEntry { chunks: tags.iter().map(chunk).collect(), ..TokenEntry::default() }
    }

    fn row(row: usize, number: usize, tag: &str, direction: &str) -> SheetRow {
        let direction = (!direction.is_empty()).then(|| direction.to_string());
        SheetRow {
            row,
            number,
            grounding: TokenGrounding { tag: tag.to_string(), direction, ..TokenGrounding::default() },
        }
    }

    #[test]
    fn directions_get_the_papers_names() {
        let mut entries = [entry(&["IRMRP", "FURRP"])];
        let mut remarks = Vec::new();
        attach(&mut entries, vec![row(2, 1, "IRMRP", "center"), row(3, 1, "FURRP", "beside")], &mut remarks);
        let directions: Vec<_> = entries[0].groundings.iter().filter_map(|g| g.direction.as_deref()).collect();
        assert_eq!(directions, ["central", "side"]);
        assert!(remarks.is_empty());
    }

    #[test]
    fn a_slip_of_the_numbering_is_mended_and_told() {
        let mut entries = [entry(&["OBTP"]), entry(&["ORMTP", "ORMRP"])];
        let mut remarks = Vec::new();
        let rows = vec![row(2, 1, "OBTP", ""), row(3, 3, "ORMTP", ""), row(4, 3, "ORMRP", "")];
        attach(&mut entries, rows, &mut remarks);
        assert_eq!(entries[1].groundings.len(), 2);
        assert_eq!(remarks, ["row 3: sentence 3 is a slip of the numbering; the chunks are those of sentence 2"]);
    }

    #[test]
    fn rows_that_fit_no_tree_are_told_and_so_are_trees_without_rows() {
        let mut entries = [entry(&["OBTP"])];
        entries[0].id = "x-0001".to_string();
        let mut remarks = Vec::new();
        attach(&mut entries, vec![row(2, 1, "FURTP", "")], &mut remarks);
        assert!(remarks[0].starts_with("row 2: sentence 1 has no tree with the chunks FURTP"), "{remarks:?}");
        assert_eq!(remarks[1], "1 trees have no groundings: x-0001");
    }
}
