//! Where the messages of a log file lie and of which time they are, without reading them.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

use mcap::records::op;

/// What is logged later but stands earlier by more than this is out of order, nanoseconds.
const DISORDER_NS: u64 = 500_000_000;
/// A chunk begins with the times of its first and last message; a message has its own after channel and number, bytes.
const CHUNK_TIMES: usize = 16;
const MESSAGE_TIME: usize = 14;

/// A chunk, or a message outside chunks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) at_byte: u64,
    pub(super) first_ns: u64,
    pub(super) last_ns: u64,
}

/// What a file holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Survey {
    pub(super) entries: Vec<Entry>,
    /// Where schemas and channels stand outside chunks.
    pub(super) links: Vec<u64>,
}

impl Survey {
    /// Reads the heads of a file's records, up to its end or to where it is cut off.
    pub(super) fn of(file: &File) -> io::Result<Self> {
        let length = file.metadata()?.len();
        let mut source = BufReader::new(file);
        source.seek(SeekFrom::Start(mcap::MAGIC.len() as u64))?;
        let (mut found, mut at) = (Self::default(), mcap::MAGIC.len() as u64);
        loop {
            let mut head = [0; 9 + CHUNK_TIMES];
            let got = fill(&mut source, &mut head)?;
            let size = u64::from_le_bytes(eight(&head, 1));
            let next = at.saturating_add(9).saturating_add(size);
            if got < 9 || next > length || head[0] == op::FOOTER {
                return Ok(found);
            }
            found.take(head[0], at, &head, got);
            source.seek_relative(next as i64 - (at as i64 + got as i64))?;
            at = next;
        }
    }

    fn take(&mut self, opcode: u8, at_byte: u64, head: &[u8], got: usize) {
        match opcode {
            op::SCHEMA | op::CHANNEL => self.links.push(at_byte),
            op::CHUNK if got >= 9 + CHUNK_TIMES => {
                let [first_ns, last_ns] = [9, 17].map(|from| u64::from_le_bytes(eight(head, from)));
                self.entries.push(Entry { at_byte, first_ns, last_ns });
            }
            op::MESSAGE if got >= 9 + MESSAGE_TIME => {
                let time = u64::from_le_bytes(eight(head, 9 + 6));
                self.entries.push(Entry { at_byte, first_ns: time, last_ns: time });
            }
            _ => {}
        }
    }

    /// Whether what stands earlier was logged earlier, or nearly.
    pub(super) fn is_in_order(&self) -> bool {
        let mut latest = 0;
        self.entries.iter().filter(|entry| entry.last_ns > 0).all(|entry| {
            let behind = entry.first_ns.saturating_add(DISORDER_NS) < latest;
            latest = latest.max(entry.last_ns);
            !behind
        })
    }

    /// The times of the first and the last message.
    pub(super) fn span(&self) -> Option<(u64, u64)> {
        let held = || self.entries.iter().filter(|entry| entry.last_ns > 0);
        Some((held().map(|entry| entry.first_ns).min()?, held().map(|entry| entry.last_ns).max()?))
    }
}

fn eight(bytes: &[u8], from: usize) -> [u8; 8] {
    std::array::from_fn(|i| bytes[from + i])
}

fn fill(source: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut got = 0;
    while got < buffer.len() {
        match source.read(&mut buffer[got..]) {
            Ok(0) => break,
            Ok(n) => got += n,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(got)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survey(times: &[(u64, u64)]) -> Survey {
        let entry = |&(first, last): &(u64, u64)| Entry {
            at_byte: 0,
            first_ns: first * 1_000_000_000,
            last_ns: last * 1_000_000_000,
        };
        Survey { entries: times.iter().map(entry).collect(), links: Vec::new() }
    }

    #[test]
    fn topic_after_topic_is_out_of_order_and_chunks_that_overlap_a_little_are_not() {
        assert!(survey(&[(1, 2), (2, 4), (0, 0), (4, 5)]).is_in_order());
        assert!(!survey(&[(1, 9), (1, 9)]).is_in_order());
    }
}
