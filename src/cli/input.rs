//! Lines in: files or standard input, with the file and number of each line.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Diagnostic, Failure, Line, Source};
use crate::limits::LINE_BYTES;

/// Large enough that a batch keeps several threads busy, small enough to stay in cache.
const BUFFER_BYTES: usize = 1 << 18;

/// Larger files are not read once more to count their lines.
const COUNTED_BYTES: u64 = 1 << 28;

/// The lines of a file that hold more than their end.
fn count_lines(file: File) -> Option<u64> {
    let lines = BufReader::with_capacity(BUFFER_BYTES, file).split(b'\n');
    lines.map(|line| line.ok().map(|line| u64::from(!line.trim_ascii().is_empty()))).sum()
}

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
    /// Whether a file that cannot be read is told and passed over.
    keep_going: bool,
    checked: bool,
    lost: Vec<Diagnostic>,
}

struct OpenFile {
    file: Arc<str>,
    number: usize,
    reader: BufReader<Box<dyn Read + Send>>,
}

impl Inputs {
    /// The given files in order; none means standard input. Before the first line is read, all are looked at: one that
    /// is not there ends the run at its beginning, or is told and passed over when it shall `keep_going`.
    pub fn new(files: &[PathBuf], keep_going: bool) -> Self {
        let waiting =
            if files.is_empty() { VecDeque::from([PathBuf::from("-")]) } else { files.iter().cloned().collect() };
        Self { waiting, current: None, ordinal: 0, keep_going, checked: false, lost: Vec::new() }
    }

    /// The lines of one reader.
    pub fn of(name: &str, inner: Box<dyn Read + Send>) -> Self {
        let reader = BufReader::with_capacity(BUFFER_BYTES, inner);
        let current = Some(OpenFile { file: name.into(), number: 0, reader });
        Self { waiting: VecDeque::new(), current, ordinal: 0, keep_going: false, checked: true, lost: Vec::new() }
    }

    /// How many lines there are, where all of them lie in files.
    fn count(&self) -> Option<u64> {
        let lines = |path: &PathBuf| {
            let path = if path == Path::new("-") { Path::new("/dev/stdin") } else { path };
            let file = path.metadata().ok().filter(|found| found.is_file() && found.len() <= COUNTED_BYTES);
            file.and_then(|_| File::open(path).ok()).and_then(count_lines)
        };
        if self.current.is_some() { None } else { self.waiting.iter().map(lines).sum() }
    }

    fn has_line_ready(&self) -> bool {
        self.current.as_ref().is_some_and(|source| source.reader.buffer().contains(&b'\n'))
    }

    /// Names every file that cannot be opened before any is read.
    fn check(&mut self) -> Result<(), Failure> {
        self.checked = true;
        let wrong: Vec<(usize, Unreadable)> =
            self.waiting.iter().enumerate().filter_map(|(at, path)| Some((at, look_at(path).err()?))).collect();
        for (at, error) in wrong.into_iter().rev() {
            self.waiting.remove(at);
            self.pass_over(error)?;
        }
        self.lost.reverse();
        Ok(())
    }

    fn pass_over(&mut self, error: Unreadable) -> Result<(), Failure> {
        let Unreadable(file, error) = error;
        let mend = mend(&file, &error);
        if !self.keep_going {
            return Err(Failure::Failed(format!("{file}: {error}{mend}")));
        }
        self.lost.push(Diagnostic {
            place: file,
            id: None,
            message: format!("{error}{mend}; its records are left out"),
        });
        Ok(())
    }

    fn next_line(&mut self) -> Result<Option<Line>, Failure> {
        loop {
            let read = match (&mut self.current, self.waiting.front()) {
                (Some(source), _) => source.read_line(),
                (None, None) => return Ok(None),
                (None, Some(path)) => {
                    let opened = OpenFile::open(path);
                    self.waiting.pop_front();
                    match opened {
                        Ok(opened) => self.current = Some(opened),
                        Err(error) => self.pass_over(error)?,
                    }
                    continue;
                }
            };
            match (read, &self.current) {
                (Ok(Some((bytes, terminated))), Some(source)) => {
                    self.ordinal += 1;
                    let (file, number) = (source.file.clone(), source.number);
                    return Ok(Some(Line { file, number, ordinal: self.ordinal, bytes, terminated }));
                }
                (Ok(_), _) => self.current = None,
                (Err(error), _) => {
                    self.current = None;
                    self.pass_over(error)?;
                }
            }
        }
    }
}

impl Source<Line> for Inputs {
    fn total(&self) -> Option<u64> {
        self.count()
    }

    /// A batch ends where the input pauses, so that a person who types a line gets the answer before the next.
    fn next_batch(&mut self, limit: usize) -> Result<Vec<Line>, Failure> {
        let mut batch = Vec::new();
        if !self.checked {
            self.check()?;
        }
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

    fn lost(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.lost)
    }
}

/// A file, and why it cannot be read.
struct Unreadable(String, io::Error);

fn unreadable(path: &Path, error: io::Error) -> Unreadable {
    Unreadable(path.display().to_string(), error)
}

/// Whether a file can be opened, without taking anything from a pipe.
fn look_at(path: &Path) -> Result<(), Unreadable> {
    if path == Path::new("-") {
        return Ok(());
    }
    let found = path.metadata().map_err(|error| unreadable(path, error))?;
    if found.is_dir() {
        return Err(unreadable(path, io::ErrorKind::IsADirectory.into()));
    }
    if found.is_file() { File::open(path).map(drop).map_err(|error| unreadable(path, error)) } else { Ok(()) }
}

/// What mends it: a sentence in the place of a file's name is told where it belongs.
fn mend(name: &str, error: &io::Error) -> String {
    let is_said = error.kind() == io::ErrorKind::NotFound && name.contains(' ') && !name.contains(['/', '.']);
    if is_said { format!("; what is said comes through a pipe: echo '{name}' | chunk") } else { String::new() }
}

impl OpenFile {
    fn open(path: &Path) -> Result<Self, Unreadable> {
        let (file, inner): (Arc<str>, Box<dyn Read + Send>) = if path == Path::new("-") {
            ("<stdin>".into(), Box::new(io::stdin()))
        } else {
            let opened = File::open(path).map_err(|error| unreadable(path, error))?;
            (path.display().to_string().into(), Box::new(opened))
        };
        Ok(Self { file, number: 0, reader: BufReader::with_capacity(BUFFER_BYTES, inner) })
    }

    fn read_line(&mut self) -> Result<Option<(Vec<u8>, bool)>, Unreadable> {
        let mut bytes = Vec::new();
        let read = self.reader.by_ref().take(LINE_BYTES.value + 1).read_until(b'\n', &mut bytes);
        if read.map_err(|error| Unreadable(self.file.to_string(), error))? == 0 {
            return Ok(None);
        }
        self.number += 1;
        if bytes.len() as u64 > LINE_BYTES.value {
            let most = LINE_BYTES.value;
            let what = format!("longer than the {most} bytes that are taken of {}", LINE_BYTES.name);
            let file = format!("{}:{}", self.file, self.number);
            return Err(Unreadable(file, io::Error::new(io::ErrorKind::FileTooLarge, what)));
        }
        let terminated = bytes.last() == Some(&b'\n');
        if terminated {
            bytes.pop();
        }
        if bytes.last() == Some(&b'\r') {
            bytes.pop();
        }
        // Files joined by `cat` have such marks in the middle; no line begins with one on purpose.
        if bytes.starts_with(b"\xef\xbb\xbf") {
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
        (folder, Inputs::new(&[path], false))
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
    fn lines_in_files_are_counted_before_they_are_read_and_blank_ones_are_none() {
        let (_folder, inputs) = inputs(b"a\n\nb\n  \nc");
        assert_eq!(inputs.total(), Some(3));
        assert_eq!(Inputs::of("<stdin>", Box::new(io::empty())).total(), None);
    }

    #[test]
    fn a_byte_order_mark_is_taken_off_in_the_middle_as_well() {
        let (_folder, mut inputs) = inputs(b"\xef\xbb\xbfa\n\xef\xbb\xbfb\n");
        let texts: Vec<_> = inputs.next_batch(10).expect("readable").into_iter().map(|line| line.bytes).collect();
        assert_eq!(texts, [b"a", b"b"]);
    }

    #[test]
    fn a_line_without_an_end_is_refused() {
        let endless = Box::new(io::repeat(b'a'));
        let error = Inputs::of("endless", endless).next_batch(1).expect_err("too long").to_string();
        assert!(error.starts_with("endless:1: longer than the 67108864 bytes"), "{error}");
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Inputs::new(&[PathBuf::from("no/such.jsonl")], false).next_batch(1).expect_err("missing");
        assert!(error.to_string().starts_with("no/such.jsonl: "), "{error}");
    }
}
