//! The sheet of groundings: a row for each chunk.

use std::path::Path;

use calamine::{Data, DataType, Reader, Xlsx, open_workbook};

use super::super::treebank::{TokenGrounding, tag_of};

/// A row that labels a chunk.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SheetRow {
    /// 1-based row of the sheet.
    pub row: usize,
    /// Number of the sentence, from 1.
    pub number: usize,
    /// The label.
    pub grounding: TokenGrounding,
}

/// Where each column stands.
struct Columns {
    number: usize,
    tag: usize,
    text: Option<usize>,
    slots: [Option<usize>; 5],
}

/// All rows of the first sheet with a tag; a sentence's number may stand in its first row only.
pub(super) fn read(path: &Path) -> Result<Vec<SheetRow>, String> {
    let mut book: Xlsx<_> = open_workbook(path).map_err(|error: calamine::XlsxError| error.to_string())?;
    let range = book.worksheet_range_at(0).ok_or("has no sheet")?.map_err(|error| error.to_string())?;
    let first = range.start().map_or(0, |(row, _)| row as usize);
    let mut rows = range.rows().enumerate().map(|(i, row)| (first + i + 1, row));
    let (_, header) = rows.next().ok_or("is empty")?;
    let columns = columns(header)?;
    let mut number = None;
    let mut found = Vec::new();
    for (row, cells) in rows {
        number = number_in(&cells[columns.number]).or(number);
        let Some(tag) = text_in(&cells[columns.tag]) else { continue };
        let tag = tag_of(&tag).ok_or_else(|| format!("row {row}: `{tag}` is no chunk tag"))?;
        let number = number.ok_or_else(|| format!("row {row}: no sentence number above or in it"))?;
        let slot = |i: usize| columns.slots[i].and_then(|column| text_in(&cells[column]));
        found.push(SheetRow {
            row,
            number,
            grounding: TokenGrounding {
                tag: tag.name().to_string(),
                text: columns.text.and_then(|column| text_in(&cells[column])).unwrap_or_default(),
                room: slot(0),
                object: slot(1),
                reference: slot(2),
                direction: slot(3),
                target: slot(4),
            },
        });
    }
    Ok(found)
}

fn columns(header: &[Data]) -> Result<Columns, String> {
    let names: Vec<String> = header.iter().map(|cell| text_in(cell).unwrap_or_default().to_lowercase()).collect();
    let find = |any: &[&str]| names.iter().position(|name| any.contains(&name.as_str()));
    let need = |any: &[&str]| {
        find(any).ok_or_else(|| format!("row 1: no column `{}`; the first row has to name the columns", any[0]))
    };
    Ok(Columns {
        number: need(&["sentence", "number", "no", "id", "index"])?,
        tag: need(&["tag", "chunk", "label"])?,
        text: find(&["text", "words", "phrase"]),
        slots: ["room", "object", "reference", "direction", "target"].map(|name| find(&[name])),
    })
}

/// Text that says something: empty cells, dashes and "null" do not.
fn text_in(cell: &Data) -> Option<String> {
    let text = cell.as_string()?.trim().to_string();
    (!matches!(text.as_str(), "" | "-" | "null" | "none" | "None")).then_some(text)
}

fn number_in(cell: &Data) -> Option<usize> {
    let number = cell.as_f64().or_else(|| cell.as_string()?.trim().parse().ok())?;
    (number >= 1.0 && number.fract() == 0.0).then_some(number as usize)
}
