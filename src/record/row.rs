//! A record as a row of a table: comma-separated values (RFC 4180).

/// Columns, and what stands in them.
pub type Row = Vec<(String, String)>;

/// A line of a table, its fields quoted where they have to be.
pub fn csv_line<'a>(fields: impl IntoIterator<Item = &'a str>) -> String {
    fields.into_iter().map(quoted).collect::<Vec<_>>().join(",")
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_string() }
}
