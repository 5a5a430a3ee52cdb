//! The tables for the terminal.

use super::{Cell, Column, Paper, PaperTable, Row, Source};

/// All three tables, each figure with its count, and Wilson intervals in the column of all.
pub fn paper_text(paper: &Paper) -> String {
    let mut lines = vec![format!(
        "{}: {} descriptions, {} unique instructions × {} seeds, perception {}",
        paper.corpus, paper.descriptions, paper.unique, paper.seeds, paper.perception
    )];
    paper.tables.iter().for_each(|table| lines.extend(table_lines(table)));
    lines.push(String::new());
    lines.extend(paper.notes.iter().map(|note| format!("- {note}")));
    lines.join("\n")
}

fn table_lines(table: &PaperTable) -> Vec<String> {
    let headings = Column::ALL.map(|column| match column {
        Column::All => format!("{:>33}", "all, 95 % interval"),
        other => format!("{:>18}", other.heading()),
    });
    let mut lines = vec![String::new(), table.title.clone()];
    let names: Vec<String> = table.rows.iter().map(name_of).collect();
    let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    lines.push(format!("{:width$}{}{:>7}", "", headings.concat(), "SPL").trim_end().to_string());
    lines.extend(table.rows.iter().zip(&names).map(|(row, name)| row_line(row, name, width)));
    lines
}

/// Whose figures a row holds, and of what.
pub(in crate::evaluation) fn name_of(row: &Row) -> String {
    match row.source {
        Source::Paper => format!("paper: {}", row.name),
        Source::Ours => format!("{}: {}", row.name, row.measure),
    }
}

fn row_line(row: &Row, name: &str, width: usize) -> String {
    let cells = Column::ALL.map(|column| match (column, row.cells.get(&column)) {
        (Column::All, cell) => format!("{:>33}", cell.map(whole).unwrap_or_default()),
        (_, cell) => format!("{:>18}", cell.map(short).unwrap_or_default()),
    });
    let spl = row.spl.map_or(String::new(), |spl| format!("{:>7.3}", spl.0));
    format!("{name:width$}{}{spl}", cells.concat()).trim_end().to_string()
}

/// Percentage and count.
pub(in crate::evaluation) fn short(cell: &Cell) -> String {
    match cell.count {
        Some(rate) => format!("{:.1} % {}/{}", cell.percent.0, rate.hit, rate.of),
        None => format!("{:.1} %", cell.percent.0),
    }
}

/// Percentage, count and interval.
pub(in crate::evaluation) fn whole(cell: &Cell) -> String {
    match cell.count {
        Some(rate) => {
            let (low, high) = rate.interval();
            format!("{} ({:.1}–{:.1})", short(cell), 100.0 * low, 100.0 * high)
        }
        None => short(cell),
    }
}
