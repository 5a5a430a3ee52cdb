//! Lines in: files or standard input, with the file and number of each line.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Failure, Line, Source};

/// Large enough that a batch keeps several threads busy, small enough to stay in cache.
const BUFFER_BYTES: usize = 1 << 18;

/// The text of a file.
///
/// # Errors
/// When the file cannot be read or is not UTF-8.
pub fn read_file(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))
}

/// All input files, one after another.
pub struct Inputs {
    waiting: VecDeque<PathBuf>,
    current: Option<OpenFile>,
    ordinal: usize,
}

struct OpenFile {
    file: Arc<str>,
    number: usize,
    reader: BufReader<Box<dyn Read + Send>>,
}

impl Inputs {
    /// The given files in order; none means standard input.
    pub fn new(files: &[PathBuf]) -> Self {
        let waiting =
            if files.is_empty() { VecDeque::from([PathBuf::from("-")]) } else { files.iter().cloned().collect() };
        Self { waiting, current: None, ordinal: 0 }
    }

    /// The lines of one reader.
    pub fn of(name: &str, inner: Box<dyn Read + Send>) -> Self {
        let reader = BufReader::with_capacity(BUFFER_BYTES, inner);
        let current = Some(OpenFile { file: name.into(), number: 0, reader });
        Self { waiting: VecDeque::new(), current, ordinal: 0 }
    }

    fn has_line_ready(&self) -> bool {
        self.current.as_ref().is_some_and(|source| source.reader.buffer().contains(&b'\n'))
    }

    fn next_line(&mut self) -> Result<Option<Line>, Failure> {
        loop {
            if self.current.is_none() {
                let Some(path) = self.waiting.pop_front() else { return Ok(None) };
                self.current = Some(OpenFile::open(&path)?);
            }
            if let Some(source) = &mut self.current
                && let Some((bytes, terminated)) = source.read_line()?
            {
                self.ordinal += 1;
                let (file, number) = (source.file.clone(), source.number);
                return Ok(Some(Line { file, number, ordinal: self.ordinal, bytes, terminated }));
            }
            self.current = None;
        }
    }
}

impl Source<Line> for Inputs {
    /// A batch ends where the input pauses, so that a person who types a line gets the answer before the next.
    fn next_batch(&mut self, limit: usize) -> Result<Vec<Line>, Failure> {
        let mut batch = Vec::new();
        while batch.len() < limit {
            if !batch.is_empty() && !self.has_line_ready() {
                break;
            }
            match self.next_line()? {
                Some(line) => batch.push(line),
                None => break,
            }
        }
        Ok(batch)
    }
}

impl OpenFile {
    fn open(path: &Path) -> Result<Self, Failure> {
        let (file, inner): (Arc<str>, Box<dyn Read + Send>) = if path == Path::new("-") {
            ("<stdin>".into(), Box::new(io::stdin()))
        } else {
            let opened = File::open(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
            (path.display().to_string().into(), Box::new(opened))
        };
        Ok(Self { file, number: 0, reader: BufReader::with_capacity(BUFFER_BYTES, inner) })
    }

    fn read_line(&mut self) -> Result<Option<(Vec<u8>, bool)>, Failure> {
        let mut bytes = Vec::new();
        let read = self.reader.read_until(b'\n', &mut bytes);
        if read.map_err(|e| Failure::Failed(format!("{}: {e}", self.file)))? == 0 {
            return Ok(None);
        }
        self.number += 1;
        let terminated = bytes.last() == Some(&b'\n');
        if terminated {
            bytes.pop();
        }
        if bytes.last() == Some(&b'\r') {
            bytes.pop();
        }
        if self.number == 1 && bytes.starts_with(b"\xef\xbb\xbf") {
            bytes.drain(..3);
        }
        Ok(Some((bytes, terminated)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs(contents: &[u8]) -> (tempfile::TempDir, Inputs) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("in.jsonl");
        std::fs::write(&path, contents).expect("written");
        (folder, Inputs::new(&[path]))
    }

    #[test]
    fn line_ends_of_both_kinds_and_a_byte_order_mark_are_taken_off() {
        let (_folder, mut inputs) = inputs(b"\xef\xbb\xbfa\r\nb\nc");
        let lines = inputs.next_batch(10).expect("readable");
        let texts: Vec<_> = lines.iter().map(|l| String::from_utf8_lossy(&l.bytes).to_string()).collect();
        // The last line has no end, so it is not known to be complete until the input ends.
        assert_eq!(texts, ["a", "b"]);
        let last = inputs.next_batch(10).expect("readable").remove(0);
        assert_eq!((last.bytes.as_slice(), last.terminated, last.number), (b"c".as_slice(), false, 3));
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Inputs::new(&[PathBuf::from("no/such.jsonl")]).next_batch(1).expect_err("missing");
        assert!(error.to_string().starts_with("no/such.jsonl: "), "{error}");
    }
}
