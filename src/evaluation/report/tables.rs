//! The paper's tables.

use super::html::escaped;
use crate::evaluation::paper::name_of;
use crate::evaluation::{Cell, Column, Paper, PaperTable, Row, Source};

/// All three, with what has to be known to read them.
pub(super) fn section(paper: &Paper) -> String {
    let notes: String =
        paper.notes.iter().map(|note| format!("<li>{}</li>\n", escaped(&note.replace('`', "\"")))).collect();
    let seeds = if paper.seeds == 1 { "one seed".to_string() } else { format!("{} seeds", paper.seeds) };
    let tables: String = paper.tables.iter().map(table).collect();
    format!(
        "<p>{} descriptions; {} of them mean something different from all before and are driven, under {} each; \
         perception: {}. Counts with Wilson 95 % intervals; shaded rows are the paper's.</p>\n{tables}<ul>\n{notes}</ul>\n",
        paper.descriptions, paper.unique, seeds, paper.perception
    )
}

fn table(table: &PaperTable) -> String {
    let title = escaped(&table.title);
    let headings: String =
        Column::ALL.iter().map(|column| format!(r#"<th scope="col">{}</th>"#, column.heading())).collect();
    let rows: String = table.rows.iter().map(row).collect();
    format!(
        "<h2>{title}</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{title}\"><table aria-label=\"{title}\">\n\
         <thead><tr><th scope=\"col\">run</th>{headings}<th scope=\"col\">SPL</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn row(row: &Row) -> String {
    let class = if row.source == Source::Paper { " class=\"published\"" } else { "" };
    let name = name_of(row);
    let cells: String = Column::ALL.iter().map(|column| format!("<td>{}</td>", cell(row.cells.get(column)))).collect();
    let spl = row.spl.map_or("–".to_string(), |spl| format!("{:.3}", spl.0));
    format!("<tr{class}><th scope=\"row\">{}</th>{cells}<td>{spl}</td></tr>\n", escaped(&name))
}

fn cell(cell: Option<&Cell>) -> String {
    let Some(cell) = cell else { return "–".to_string() };
    match cell.count {
        Some(rate) => {
            let (low, high) = rate.interval();
            let (hit, of) = (rate.hit, rate.of);
            format!("{:.1} %<small>{hit}/{of}, {:.1}–{:.1}</small>", cell.percent.0, 100.0 * low, 100.0 * high)
        }
        None => format!("{:.1} %", cell.percent.0),
    }
}
