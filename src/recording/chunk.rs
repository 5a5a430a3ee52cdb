//! One chunk of a log: unpacked, checked, its messages in order of time.

use std::collections::VecDeque;
use std::io::Read;
use std::ops::Range;

use mcap::Message;
use mcap::read::{ChannelAccumulator, parse_record};
use mcap::records::{Record, op};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::link::link;
use crate::limits::{
    MCAP_CHUNK_BYTES, MCAP_CHUNK_RATIO, MCAP_PACKED_WELL_BYTES, MCAP_PACKED_WELL_MESSAGES, MCAP_RECORD_BYTES,
};

/// What a chunk held.
#[derive(Default)]
pub(super) struct Unpacked {
    pub(super) messages: Messages,
    /// What is wrong with it.
    pub(super) damage: Option<String>,
}

/// The messages of a chunk in order of time. They lie side by side in memory and are made one by one: small ones are
/// many times as large once they stand on their own.
#[derive(Default)]
pub(super) struct Messages {
    bodies: Vec<u8>,
    /// When each was logged, and where it lies.
    order: VecDeque<(u64, Range<usize>)>,
}

impl Messages {
    pub(super) fn count(&self) -> usize {
        self.order.len()
    }

    /// The next message.
    pub(super) fn next(&mut self, links: &mut ChannelAccumulator<'static>) -> Option<Message<'static>> {
        let (_, place) = self.order.pop_front()?;
        // Its channel was there when the chunk was unpacked, so it is now.
        let message = link(op::MESSAGE, &self.bodies[place], links).ok().flatten();
        if self.order.is_empty() {
            // The next chunk may need the room.
            self.bodies = Vec::new();
        }
        message.or_else(|| self.next(links))
    }

    /// When the next message was logged, nanoseconds.
    pub(super) fn next_ns(&self) -> Option<u64> {
        self.order.front().map(|&(log_time, _)| log_time)
    }

    fn push(&mut self, body: &[u8], links: &ChannelAccumulator<'static>) -> mcap::McapResult<()> {
        if let Record::Message { header, .. } = parse_record(op::MESSAGE, body)? {
            if links.get(header.channel_id).is_none() {
                return Err(mcap::McapError::UnknownChannel(header.sequence, header.channel_id));
            }
            let from = self.bodies.len();
            self.bodies.extend_from_slice(body);
            self.order.push_back((header.log_time, from..self.bodies.len()));
        }
        Ok(())
    }
}

/// What the chunks of one log may yet unpack to beyond their ratio, all together, bytes: a picture of nothing, or one
/// map of zeros, packs well and is sound, and a log of nothing else is none.
pub(super) struct Allowance {
    bytes: u64,
    messages: u64,
}

impl Default for Allowance {
    fn default() -> Self {
        Self { bytes: MCAP_PACKED_WELL_BYTES.value, messages: MCAP_PACKED_WELL_MESSAGES.value }
    }
}

impl Allowance {
    /// Whether the size that a chunk's head says it unpacks to is beyond the ratio.
    ///
    /// # Errors
    /// What is wrong with that size.
    fn draw_upon(&mut self, body: &[u8]) -> Result<bool, String> {
        let size = body.get(16..24).and_then(|bytes| bytes.try_into().ok()).map_or(0, u64::from_le_bytes);
        if size > MCAP_CHUNK_BYTES.value {
            return Err(MCAP_CHUNK_BYTES.exceeded(&size.to_string()));
        }
        let ratio = size / (body.len() as u64).max(1);
        if ratio <= MCAP_CHUNK_RATIO.value {
            return Ok(false);
        }
        self.bytes = self.bytes.checked_sub(size).ok_or_else(|| MCAP_CHUNK_RATIO.exceeded(&ratio.to_string()))?;
        Ok(true)
    }

    /// One more message of a chunk beyond the ratio.
    fn draw_message(&mut self) -> Result<(), String> {
        let left = self.messages.checked_sub(1);
        self.messages = left.ok_or_else(|| {
            let one_more = MCAP_PACKED_WELL_MESSAGES.value + 1;
            MCAP_PACKED_WELL_MESSAGES.exceeded(&format!("{one_more} or more"))
        })?;
        Ok(())
    }
}

/// Unpacks a chunk record whose header promises `length` bytes, of which `body` are there.
///
/// When `checked`, nothing comes out of a chunk that fails its checksum.
pub(super) fn unpack(
    length: u64,
    body: &[u8],
    links: &mut ChannelAccumulator<'static>,
    allowance: &mut Allowance,
    checked: bool,
) -> Unpacked {
    let options = LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_validate_chunk_crcs(checked)
        .with_prevalidate_chunk_crcs(checked)
        .with_record_length_limit(MCAP_RECORD_BYTES.count());
    let packed_well = match allowance.draw_upon(body) {
        Ok(packed_well) => packed_well,
        Err(damage) => return Unpacked { damage: Some(damage), ..Unpacked::default() },
    };
    let body = before_overrun(body);
    let mut reader = LinearReader::new_with_options(options);
    let mut head = [op::CHUNK; 9];
    head[1..].copy_from_slice(&length.to_le_bytes());
    let mut bytes = head.as_slice().chain(body);
    let mut unpacked = Unpacked::default();
    while let Some(event) = reader.next_event() {
        let step = match event {
            Ok(LinearReadEvent::ReadRequest(need)) => {
                let need = need.min(body.len() + head.len());
                // Reading from memory cannot fail.
                let read = bytes.read(reader.insert(need)).unwrap_or(0);
                reader.notify_read(read);
                Ok(())
            }
            Ok(LinearReadEvent::Record { data, opcode: op::MESSAGE }) => {
                if packed_well && let Err(damage) = allowance.draw_message() {
                    unpacked.damage = Some(damage);
                    break;
                }
                unpacked.messages.push(data, links)
            }
            Ok(LinearReadEvent::Record { data, opcode: opcode @ (op::SCHEMA | op::CHANNEL) }) => {
                link(opcode, data, links).map(|_| ())
            }
            Ok(LinearReadEvent::Record { .. }) => Ok(()),
            Err(error) => Err(error),
        };
        if let Err(error) = step {
            unpacked.damage = Some(error.to_string());
            break;
        }
    }
    if checked && unpacked.damage.is_some() {
        unpacked.messages = Messages::default();
    }
    unpacked.messages.order.make_contiguous().sort_by_key(|(log_time, _)| *log_time);
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

    fn unpacked(body: &[u8], allowance: &mut Allowance) -> Unpacked {
        unpack(body.len() as u64, body, &mut ChannelAccumulator::default(), allowance, false)
    }

    #[test]
    fn the_messages_of_chunks_beyond_the_ratio_are_counted_all_together() {
        let mut allowance = Allowance::default();
        (0..MCAP_PACKED_WELL_MESSAGES.value)
            .for_each(|_| allowance.draw_message().expect("one of those that are taken"));
        let damage = allowance.draw_message().expect_err("one more");
        assert!(damage.contains("messages are more than the 100000"), "{damage}");
    }

    #[test]
    fn a_log_of_chunks_that_say_they_unpack_to_far_more_than_they_are_is_not_unpacked_beyond_its_allowance() {
        let mut allowance = Allowance::default();
        let mut claiming = |size: u64, packed: usize| {
            let mut body = vec![0; packed];
            body[16..24].copy_from_slice(&size.to_le_bytes());
            unpacked(&body, &mut allowance).damage.unwrap_or_default()
        };
        assert!(claiming(1 << 40, 100).contains("bytes are more than the 402653184"));
        assert!(!claiming(300_000_000, 152_000).contains("more than"), "one such chunk may be sound");
        assert!(
            claiming(300_000_000, 152_000).contains("1973 unpacked bytes for each packed one are more than the 200")
        );
        assert!(!claiming(300_000_000, 1_600_000).contains("more than"), "what packs less well is not counted");
    }

    #[test]
    fn a_record_that_reaches_beyond_its_chunk_is_damage() {
        assert_eq!(before_overrun(&chunk(12 + 109)).len(), 40 + 12 + 109);
        let cut = chunk(12 + 20);
        assert_eq!(before_overrun(&cut).len(), 40 + 12);
        let unpacked = unpacked(&cut, &mut Allowance::default());
        assert!(unpacked.damage.is_some() && unpacked.messages.count() == 0);
    }
}
