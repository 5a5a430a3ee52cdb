//! The sheet of groundings: a row for each chunk.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use calamine::{Data, DataType, Reader, Xlsx, XlsxError};

use super::super::treebank::{TokenGrounding, tag_of};
use super::package;
use crate::limits::{IMPORT_FILE_BYTES, SHEET_CELLS};

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
    let bytes = IMPORT_FILE_BYTES.read(path).map_err(|error| error.to_string())?;
    package::check(&bytes)?;
    let mut rows = cells(bytes)?.into_iter();
    let (_, header) = rows.next().ok_or("is empty")?;
    let columns = columns(&header)?;
    let mut number = None;
    let mut found = Vec::new();
    for (row, cells) in rows {
        let cell = |column: usize| cells.get(&column).unwrap_or(&Data::Empty);
        number = number_in(cell(columns.number)).or(number);
        let Some(tag) = text_in(cell(columns.tag)) else { continue };
        let tag = tag_of(&tag).ok_or_else(|| format!("row {row}: `{tag}` is no chunk tag"))?;
        let number = number.ok_or_else(|| format!("row {row}: no sentence number above or in it"))?;
        let slot = |i: usize| columns.slots[i].and_then(|column| text_in(cell(column)));
        found.push(SheetRow {
            row,
            number,
            grounding: TokenGrounding {
                tag: tag.name().to_string(),
                text: columns.text.and_then(|column| text_in(cell(column))).unwrap_or_default(),
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

/// A row's cells that hold something, by their columns.
type Row = BTreeMap<usize, Data>;

/// The rows of the first sheet that hold something, by their 1-based numbers.
///
/// Only what is there is held: a stray cell far out makes no table of empty ones.
fn cells(bytes: Vec<u8>) -> Result<BTreeMap<usize, Row>, String> {
    let unreadable = |error: XlsxError| error.to_string();
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(unreadable)?;
    let name = book.sheet_names().first().cloned().ok_or("has no sheet")?;
    let mut reader = book.worksheet_cells_reader(&name).map_err(unreadable)?;
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    let mut count = 0;
    while let Some(cell) = reader.next_cell().map_err(unreadable)? {
        count += 1;
        SHEET_CELLS.check(count)?;
        let ((row, column), value) = (cell.get_position(), Data::from(cell.get_value().clone()));
        if value != Data::Empty {
            rows.entry(row as usize + 1).or_default().insert(column as usize, value);
        }
    }
    Ok(rows)
}

fn columns(header: &Row) -> Result<Columns, String> {
    let name = |(column, cell): (&usize, &Data)| (*column, text_in(cell).unwrap_or_default().to_lowercase());
    let names: Vec<(usize, String)> = header.iter().map(name).collect();
    let find = |any: &[&str]| names.iter().find(|(_, name)| any.contains(&name.as_str())).map(|(column, _)| *column);
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
    ((1.0..1e9).contains(&number) && number.fract() == 0.0).then_some(number as usize)
}
