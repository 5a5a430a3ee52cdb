//! The tables as comma-separated values, one figure a line.

use super::{Paper, Source};
use crate::record::csv_line;

/// A heading and a line for each figure of each table.
pub fn paper_csv(paper: &Paper) -> String {
    let mut lines = vec!["table,source,row,measure,column,percent,hit,of,low,high,spl".to_string()];
    for table in &paper.tables {
        let name = table.title.split(':').next().unwrap_or_default();
        for row in &table.rows {
            let source = if row.source == Source::Paper { "paper" } else { "ours" };
            for (column, cell) in &row.cells {
                let count = cell.count.map_or(",,,".to_string(), |rate| {
                    let (low, high) = rate.interval();
                    format!("{},{},{:.4},{:.4}", rate.hit, rate.of, low, high)
                });
                let spl = row.spl.map_or(String::new(), |spl| spl.value().to_string());
                let head = csv_line([name, source, &row.name, &row.measure, column.heading()]);
                lines.push(format!("{head},{:.2},{count},{spl}", cell.percent.0));
            }
        }
    }
    lines.join("\n")
}
