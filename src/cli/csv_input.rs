//! Descriptions in a table: comma-separated values (RFC 4180) as records, every other column kept.

use super::{Diagnostic, Failure, Inputs, Line, Source};

/// Keys that the stages add: a column of that name would be taken for theirs.
const STAGE_KEYS: [&str; 7] = ["text", "tokens", "chunks", "grounding", "plan", "trial", "detections"];
/// What stands between fields: of these, what the heading has most of.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// The rows of tables as lines that hold records: the column of descriptions is their `text`.
pub struct CsvLines {
    inputs: Inputs,
    column: String,
    heading: Option<Heading>,
    rows: usize,
    lost: Vec<Diagnostic>,
}

/// The names over a table.
struct Heading {
    keys: Vec<String>,
    separator: char,
}

impl CsvLines {
    /// Reads the descriptions of `column`.
    pub fn new(inputs: Inputs, column: &str) -> Self {
        Self { inputs, column: column.to_string(), heading: None, rows: 0, lost: Vec::new() }
    }

    /// The record of the row that begins with `line`; nothing of a heading, a blank line, or a row that does not fit.
    fn record(&mut self, mut line: Line) -> Result<Option<Line>, Failure> {
        while is_open(&line.bytes) {
            let Some(more) = self.inputs.next_batch(1)?.pop() else { break };
            line.bytes.push(b'\n');
            line.bytes.extend_from_slice(&more.bytes);
        }
        let not_utf8 = |_| {
            Failure::Failed(format!(
                "{}:{}: not UTF-8; convert the file, for example with iconv",
                line.file, line.number
            ))
        };
        let text = std::str::from_utf8(&line.bytes).map_err(not_utf8)?;
        if text.trim().is_empty() {
            return Ok(None);
        }
        let Some(heading) = self.heading.as_ref().filter(|_| line.number > 1) else {
            self.heading = Some(Heading::read(text, &self.column, &line.file)?);
            return Ok(None);
        };
        let fields = fields(text, heading.separator);
        if fields.len() != heading.keys.len() {
            let message =
                format!("{} fields under a heading of {}; the row is left out", fields.len(), heading.keys.len());
            self.lost.push(Diagnostic::at(&line, 0, None, message));
            return Ok(None);
        }
        self.rows += 1;
        let bytes = heading.record(&fields, self.rows).into_bytes();
        Ok(Some(Line { ordinal: self.rows, bytes, ..line }))
    }
}

impl Source<Line> for CsvLines {
    fn next_batch(&mut self, limit: usize) -> Result<Vec<Line>, Failure> {
        let mut batch = Vec::new();
        while batch.is_empty() {
            let lines = self.inputs.next_batch(limit)?;
            if lines.is_empty() {
                break;
            }
            let mut lines = std::collections::VecDeque::from(lines);
            while let Some(mut line) = lines.pop_front() {
                // A field in quotes goes on over the end of its line.
                while is_open(&line.bytes)
                    && let Some(more) = lines.pop_front()
                {
                    line.bytes.push(b'\n');
                    line.bytes.extend_from_slice(&more.bytes);
                }
                batch.extend(self.record(line)?);
            }
        }
        Ok(batch)
    }

    fn lost(&mut self) -> Vec<Diagnostic> {
        let mut lost = self.inputs.lost();
        lost.append(&mut self.lost);
        lost
    }

    fn total(&self) -> Option<u64> {
        self.inputs.total()
    }
}

impl Heading {
    fn read(text: &str, column: &str, file: &str) -> Result<Self, Failure> {
        let separators = SEPARATORS.map(|separator| (text.matches(separator).count(), separator));
        // Of equals the comma, which stands first.
        let separator =
            separators.iter().rev().max_by_key(|(count, _)| *count).map_or(',', |(_, separator)| *separator);
        let names = fields(text, separator);
        let wrong = |what: String| Failure::Usage(format!("{file}: {what}"));
        if !names.iter().any(|name| name == column) {
            return Err(wrong(format!("no column `{column}`; its columns are {}", names.join(", "))));
        }
        let keys: Vec<String> =
            names.iter().map(|name| if name == column { "text" } else { name }.to_string()).collect();
        for (i, (key, name)) in keys.iter().zip(&names).enumerate() {
            if keys[..i].contains(key) {
                return Err(wrong(format!("two columns would be `{key}`; rename one")));
            }
            if STAGE_KEYS.contains(&key.as_str()) && name != column {
                return Err(wrong(format!("the column `{name}` has the name of what a stage adds; rename it")));
            }
        }
        Ok(Self { keys, separator })
    }

    /// A row as a record; its number is its id where the table has no `id`.
    fn record(&self, fields: &[String], number: usize) -> String {
        // Strings always serialize.
        let quoted = |text: &str| serde_json::to_string(text).unwrap_or_default();
        let id = (!self.keys.iter().any(|key| key == "id")).then(|| format!("\"id\":\"{number}\""));
        let columns = self.keys.iter().zip(fields).map(|(key, field)| format!("{}:{}", quoted(key), quoted(field)));
        format!("{{{}}}", id.into_iter().chain(columns).collect::<Vec<_>>().join(","))
    }
}

/// Whether a field in quotes is not closed yet.
fn is_open(row: &[u8]) -> bool {
    row.iter().filter(|&&byte| byte == b'"').count() % 2 == 1
}

/// The fields of a row, without their quotes.
fn fields(row: &str, separator: char) -> Vec<String> {
    let mut fields = vec![String::new()];
    let (mut quoted, mut characters) = (false, row.chars().peekable());
    while let Some(c) = characters.next() {
        let last = fields.len() - 1;
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                fields[last].push('"');
            }
            '"' if quoted || fields[last].trim().is_empty() => quoted = !quoted,
            c if c == separator && !quoted => fields.push(String::new()),
            c => fields[last].push(c),
        }
    }
    fields.iter().map(|field| field.trim().to_string()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records(table: &'static str, column: &str) -> Result<(Vec<String>, usize), Failure> {
        let mut lines = CsvLines::new(Inputs::of("t.csv", Box::new(table.as_bytes())), column);
        let mut records = Vec::new();
        loop {
            let batch = lines.next_batch(2)?;
            if batch.is_empty() {
                return Ok((records, lines.lost().len()));
            }
            records.extend(batch.into_iter().map(|line| String::from_utf8(line.bytes).expect("UTF-8")));
        }
    }

    #[test]
    fn the_column_named_is_the_text_and_the_others_are_kept() {
        let (records, lost) =
            records("who,said\nAda,\"go left, then\nright\"\n,\"a \"\"b\"\"\"\n", "said").expect("read");
        assert_eq!(records[0], r#"{"id":"1","who":"Ada","text":"go left, then\nright"}"#);
        assert_eq!(records[1], r#"{"id":"2","who":"","text":"a \"b\""}"#);
        assert_eq!(lost, 0);
    }

    #[test]
    fn semicolons_and_tabs_part_fields_as_well_and_an_id_is_the_tables_own() {
        let (records, _) = records("id;said\n7;go left\n", "said").expect("read");
        assert_eq!(records, [r#"{"id":"7","text":"go left"}"#]);
    }

    #[test]
    fn a_column_that_is_not_there_lists_those_that_are() {
        let error = records("id,said\n", "text").expect_err("no such column").to_string();
        assert_eq!(error, "t.csv: no column `text`; its columns are id, said");
    }

    #[test]
    fn a_column_with_a_name_of_ours_and_one_that_stands_twice_are_refused() {
        assert!(records("plan,said\n", "said").expect_err("ours").to_string().contains("`plan` has the name"));
        assert!(records("a,a,said\n", "said").expect_err("twice").to_string().contains("two columns would be `a`"));
    }

    #[test]
    fn a_row_with_too_few_fields_is_left_out_and_said() {
        assert_eq!(records("id,said\n1\n2,go\n", "said").expect("read").1, 1);
    }
}
