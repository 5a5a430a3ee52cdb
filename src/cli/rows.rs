//! Rows out: comma-separated values (RFC 4180) under one heading.

use crate::record::{Row, csv_line};

/// A table that is written row by row. Its columns are those of the first row: a column that only a later row has is
/// left out, so that every line has as many fields as the heading.
#[derive(Debug, Default)]
pub(super) struct Rows {
    columns: Option<Vec<String>>,
}

impl Rows {
    /// The lines that a row adds: before the first, the heading.
    pub fn lines(&mut self, row: &Row) -> String {
        let mut heading = String::new();
        let columns = self.columns.get_or_insert_with(|| {
            let columns: Vec<String> = row.iter().map(|(column, _)| column.clone()).collect();
            heading = csv_line(columns.iter().map(String::as_str)) + "\n";
            columns
        });
        let value = |column: &String| row.iter().find(|(name, _)| name == column).map_or("", |(_, value)| value);
        heading + &csv_line(columns.iter().map(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(fields: &[(&str, &str)]) -> Row {
        fields.iter().map(|(column, value)| ((*column).to_string(), (*value).to_string())).collect()
    }

    #[test]
    fn the_heading_comes_once_and_every_line_has_its_fields() {
        let mut rows = Rows::default();
        assert_eq!(rows.lines(&row(&[("id", "1"), ("text", "go, \"left\"")])), "id,text\n1,\"go, \"\"left\"\"\"");
        assert_eq!(rows.lines(&row(&[("text", "x"), ("more", "y")])), ",x");
    }
}
