//! One chunk of a log: unpacked, checked, its messages in order of time.

use std::io::Read;

use mcap::Message;
use mcap::read::ChannelAccumulator;
use mcap::records::op;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::log_reader::{LONGEST_RECORD, link};

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
        .with_record_length_limit(LONGEST_RECORD as usize);
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
