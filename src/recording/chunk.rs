//! One chunk of a log: unpacked, checked, its messages in order of time.

use std::io::Read;

use mcap::Message;
use mcap::read::ChannelAccumulator;
use mcap::records::op;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::link::link;
use crate::limits::MCAP_RECORD_BYTES;

/// What a chunk held.
pub(super) struct Unpacked {
    pub(super) messages: Vec<Message<'static>>,
    /// What is wrong with it.
    pub(super) damage: Option<String>,
}

/// Unpacks a chunk record whose header promises `length` bytes, of which `body` are there.
///
/// When `checked`, nothing comes out of a chunk that fails its checksum.
pub(super) fn unpack(length: u64, body: &[u8], links: &mut ChannelAccumulator<'static>, checked: bool) -> Unpacked {
    let options = LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_validate_chunk_crcs(checked)
        .with_prevalidate_chunk_crcs(checked)
        .with_record_length_limit(MCAP_RECORD_BYTES.count());
    let body = before_overrun(body);
    let mut reader = LinearReader::new_with_options(options);
    let mut head = [op::CHUNK; 9];
    head[1..].copy_from_slice(&length.to_le_bytes());
    let mut bytes = head.as_slice().chain(body);
    let mut unpacked = Unpacked { messages: Vec::new(), damage: None };
    while let Some(event) = reader.next_event() {
        let step = match event {
            Ok(LinearReadEvent::ReadRequest(need)) => {
                let need = need.min(body.len() + head.len());
                // Reading from memory cannot fail.
                let read = bytes.read(reader.insert(need)).unwrap_or(0);
                reader.notify_read(read);
                Ok(None)
            }
            Ok(LinearReadEvent::Record { data, opcode: opcode @ (op::SCHEMA | op::CHANNEL | op::MESSAGE) }) => {
                link(opcode, data, links)
            }
            Ok(LinearReadEvent::Record { .. }) => Ok(None),
            Err(error) => Err(error),
        };
        match step {
            Ok(message) => unpacked.messages.extend(message),
            Err(error) => {
                unpacked.damage = Some(error.to_string());
                break;
            }
        }
    }
    if checked && unpacked.damage.is_some() {
        unpacked.messages.clear();
    }
    unpacked.messages.sort_by_key(|message| message.log_time);
    unpacked
}

/// An uncompressed chunk up to the first record that claims to reach beyond its end.
///
/// There the library's count of what is left goes below zero; cut off before it, the chunk just ends too soon.
fn before_overrun(body: &[u8]) -> &[u8] {
    // Two times, a size and a checksum come before the name of the compression, which is empty here.
    const NAME: usize = 28;
    let number = |at: usize| Some(u64::from_le_bytes(body.get(at..at.checked_add(8)?)?.try_into().ok()?));
    let is_plain = body.get(NAME..NAME + 4) == Some(&[0; 4]);
    let Some(size) = number(NAME + 4).filter(|_| is_plain) else { return body };
    let mut at = NAME + 12;
    let end = (at as u64).saturating_add(size);
    while (at as u64) < end {
        let Some(length) = number(at + 1) else { return body };
        let next = length.saturating_add(at as u64 + 9);
        if next > end {
            return &body[..at];
        }
        let Ok(next) = usize::try_from(next) else { return body };
        at = next;
    }
    body
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An uncompressed chunk of `size` bytes of records, the last of which says it is 100 bytes long.
    fn chunk(size: u64) -> Vec<u8> {
        let mut body = vec![0; 32];
        body.extend(size.to_le_bytes());
        for length in [3_u64, 100] {
            body.push(op::DATA_END);
            body.extend(length.to_le_bytes());
            body.extend(vec![0; length as usize]);
        }
        body
    }

    #[test]
    fn a_record_that_reaches_beyond_its_chunk_is_damage() {
        assert_eq!(before_overrun(&chunk(12 + 109)).len(), 40 + 12 + 109);
        let cut = chunk(12 + 20);
        assert_eq!(before_overrun(&cut).len(), 40 + 12);
        let unpacked = unpack(cut.len() as u64, &cut, &mut ChannelAccumulator::default(), false);
        assert!(unpacked.damage.is_some() && unpacked.messages.is_empty());
    }
}
