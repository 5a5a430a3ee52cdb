//! Framing: `FA FB`, a count, a number, data, and a checksum.

use std::collections::VecDeque;
use std::time::Duration;

/// Two bytes begin every packet. They may also occur inside data: there is no escape.
const HEADER: [u8; 2] = [0xFA, 0xFB];
/// Command number and checksum: what the count of an empty packet counts.
const LEAST_COUNT: usize = 3;
/// The longest packet a client may send, bytes in all (Operations Manual; ARIA).
pub const LONGEST_SENT: usize = 200;
/// A packet that has begun must be whole after this long (ARIA's receiver).
const WHOLE_WITHIN: Duration = Duration::from_millis(100);
/// From a slow line, so much longer for every byte of it that has come.
const A_BYTE: Duration = Duration::from_millis(6);

/// The checksum over number and data: big-endian words added, a byte left over taken in by exclusive or.
pub fn checksum(bytes: &[u8]) -> u16 {
    let words = bytes.chunks_exact(2);
    let last = words.remainder().first().copied().unwrap_or(0);
    let sum = words.fold(0_u16, |sum, word| sum.wrapping_add(u16::from_be_bytes([word[0], word[1]])));
    sum ^ u16::from(last)
}

/// One packet: a command's number or a report's type, and its data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    /// Command number (to the robot) or packet type (from it).
    pub kind: u8,
    /// At most [`Packet::MOST_DATA`] bytes.
    pub data: Vec<u8>,
}

impl Packet {
    /// What the one-byte count leaves for data.
    pub const MOST_DATA: usize = 255 - LEAST_COUNT;

    /// A packet; data beyond [`Packet::MOST_DATA`] is cut off.
    pub fn new(kind: u8, mut data: Vec<u8>) -> Self {
        data.truncate(Self::MOST_DATA);
        Self { kind, data }
    }

    /// The packet as it goes over the line.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.data.len() + 6);
        bytes.extend(HEADER);
        bytes.push((self.data.len() + LEAST_COUNT) as u8);
        bytes.push(self.kind);
        bytes.extend(&self.data);
        let sum = checksum(&bytes[3..]);
        bytes.extend(sum.to_be_bytes());
        bytes
    }
}

/// What came over a line, good and bad.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Packets with a right checksum.
    pub good: u64,
    /// Headers whose packet had a wrong checksum.
    pub bad_checksum: u64,
    /// Headers whose count cannot be.
    pub bad_count: u64,
    /// Packets that began and did not end in time.
    pub cut_short: u64,
    /// Bytes that belong to no packet.
    pub skipped: u64,
}

impl Counters {
    /// Everything that was not as it should be.
    pub fn faults(&self) -> u64 {
        self.bad_checksum + self.bad_count + self.cut_short + self.skipped
    }

    /// What has been added since `before`.
    pub fn since(&self, before: &Self) -> Self {
        Self {
            good: self.good - before.good,
            bad_checksum: self.bad_checksum - before.bad_checksum,
            bad_count: self.bad_count - before.bad_count,
            cut_short: self.cut_short - before.cut_short,
            skipped: self.skipped - before.skipped,
        }
    }
}

/// Finds packets in a stream of bytes.
///
/// After a bad header the search goes on from the very next byte, so that a
/// packet inside what a broken one seemed to hold is not lost.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    buffer: Vec<u8>,
    /// When the bytes of the buffer came: how many of them, and the time.
    arrivals: VecDeque<(usize, Duration)>,
    counters: Counters,
    /// Waits longer for a packet whose bytes come slowly.
    patient: bool,
}

impl Decoder {
    /// For reports that may come over a slow line, a few milliseconds a byte. A robot must not wait so long: a command
    /// to stop may lie behind what only looks like a packet.
    pub fn patient() -> Self {
        Self { patient: true, ..Self::default() }
    }

    /// Takes in bytes that arrived at `now`.
    pub fn push(&mut self, bytes: &[u8], now: Duration) {
        if !bytes.is_empty() {
            self.arrivals.push_back((bytes.len(), now));
            self.buffer.extend_from_slice(bytes);
        }
    }

    /// The next whole packet. One that has begun and is not whole after 100 ms is given up, unless it is waited for with
    /// patience.
    pub fn next(&mut self, now: Duration) -> Option<Packet> {
        loop {
            self.skip_to_header();
            let count = usize::from(*self.buffer.get(2)?);
            if count < LEAST_COUNT {
                self.counters.bad_count += 1;
                self.reject();
                continue;
            }
            if self.buffer.len() < count + 3 {
                let begun = self.arrivals.front().map_or(now, |(_, time)| *time);
                let came = if self.patient { A_BYTE * self.buffer.len() as u32 } else { Duration::ZERO };
                if now.saturating_sub(begun) <= WHOLE_WITHIN + came {
                    return None;
                }
                self.counters.cut_short += 1;
                self.reject();
                continue;
            }
            let (body, sum) = (&self.buffer[3..count + 1], &self.buffer[count + 1..count + 3]);
            if checksum(body).to_be_bytes() != sum {
                self.counters.bad_checksum += 1;
                self.reject();
                continue;
            }
            let packet = Packet { kind: body[0], data: body[1..].to_vec() };
            self.consume(count + 3);
            self.counters.good += 1;
            return Some(packet);
        }
    }

    /// What came so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// Forgets a packet that has begun: the line is a new one.
    pub fn clear(&mut self) {
        self.consume(self.buffer.len());
    }

    /// Gives up the header at the front; what follows may hold another.
    fn reject(&mut self) {
        self.consume(1);
        self.counters.skipped += 1;
    }

    fn consume(&mut self, count: usize) {
        self.buffer.drain(..count);
        let mut left = count;
        while let Some((bytes, _)) = self.arrivals.front_mut().filter(|_| left > 0) {
            let taken = left.min(*bytes);
            *bytes -= taken;
            left -= taken;
            if *bytes == 0 {
                self.arrivals.pop_front();
            }
        }
    }

    /// Drops what cannot begin a packet. A last `FA` may be half a header.
    fn skip_to_header(&mut self) {
        let starts = |i: &usize| self.buffer[*i] == HEADER[0] && self.buffer.get(i + 1).is_none_or(|b| *b == HEADER[1]);
        let at = (0..self.buffer.len()).find(starts).unwrap_or(self.buffer.len());
        self.counters.skipped += at as u64;
        self.consume(at);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const NOW: Duration = Duration::ZERO;
    const LATER: Duration = Duration::from_millis(101);

    fn decode(bytes: &[u8]) -> (Vec<Packet>, Counters) {
        let mut decoder = Decoder::default();
        decoder.push(bytes, NOW);
        let packets = std::iter::from_fn(|| decoder.next(NOW)).collect();
        (packets, decoder.counters())
    }

    /// Whether the first bytes are a packet with a right checksum that is longer than `least`.
    fn begins_packet_to_beyond(bytes: &[u8], least: usize) -> bool {
        let whole = |count: &u8| bytes.get(3..usize::from(*count) + 3).filter(|_| *count >= 3);
        let [0xFA, 0xFB, count, ..] = bytes else { return false };
        let Some((body, sum)) = whole(count).and_then(|rest| rest.split_at_checked(rest.len() - 2)) else {
            return false;
        };
        checksum(body).to_be_bytes() == sum && bytes.len().min(usize::from(*count) + 3) > least
    }

    #[test]
    fn a_left_over_byte_is_exclusive_ored_not_added() {
        assert_eq!(checksum(&[0x00, 0xFF, 0x01]), 0x00FE);
    }

    #[test]
    fn the_checksum_goes_high_byte_first() {
        let bytes = Packet::new(0x0B, vec![0x3B, 0x2C, 0x01]).to_bytes();
        assert_eq!(bytes, [0xFA, 0xFB, 0x06, 0x0B, 0x3B, 0x2C, 0x01, 0x37, 0x3C]);
    }

    #[test]
    fn a_packet_inside_a_broken_one_is_found() {
        let mut bytes = vec![0xFA, 0xFB, 9, 50];
        bytes.extend(Packet::new(1, vec![7]).to_bytes());
        bytes.extend([0, 0, 0]);
        let (packets, counters) = decode(&bytes);
        assert_eq!(packets, [Packet::new(1, vec![7])]);
        assert_eq!((counters.bad_checksum, counters.skipped), (1, 4 + 3));
    }

    #[test]
    fn a_count_below_three_is_no_packet() {
        let (packets, counters) = decode(&[0xFA, 0xFB, 2, 0, 0, 0]);
        assert!(packets.is_empty() && counters.bad_count == 1);
    }

    #[test]
    fn a_packet_that_does_not_end_in_time_is_given_up() {
        let mut decoder = Decoder::default();
        decoder.push(&[0xFA, 0xFB, 200, 50], NOW);
        decoder.push(&Packet::new(1, vec![]).to_bytes(), NOW);
        assert_eq!(decoder.next(NOW), None);
        assert_eq!(decoder.next(LATER), Some(Packet::new(1, vec![])));
        assert_eq!(decoder.counters().cut_short, 1);
    }

    #[test]
    fn a_header_cut_in_two_by_the_line_is_put_together() {
        let bytes = Packet::new(50, vec![1, 2, 3]).to_bytes();
        let mut decoder = Decoder::default();
        for byte in &bytes[..bytes.len() - 1] {
            decoder.push(&[*byte], NOW);
            assert_eq!(decoder.next(NOW), None);
        }
        decoder.push(&bytes[bytes.len() - 1..], NOW);
        assert_eq!(decoder.next(NOW), Some(Packet::new(50, vec![1, 2, 3])));
        assert_eq!(decoder.counters().faults(), 0);
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(kind: u8, data in prop::collection::vec(any::<u8>(), 0..=Packet::MOST_DATA)) {
            let packet = Packet::new(kind, data);
            prop_assert_eq!(decode(&packet.to_bytes()).0, vec![packet]);
        }

        #[test]
        fn after_any_garbage_the_next_packets_are_found(
            // Without a header: one may swallow what follows until it is given up.
            garbage in prop::collection::vec(any::<u8>().prop_map(|b| if b == 0xFB { 0xFA } else { b }), 0..300),
            data in prop::collection::vec(any::<u8>(), 0..100),
        ) {
            let packet = Packet::new(50, data);
            let mut bytes = garbage;
            bytes.extend(packet.to_bytes());
            prop_assert_eq!(decode(&bytes).0, vec![packet]);
        }

        #[test]
        fn any_bytes_with_headers_among_them_are_survived_and_a_packet_after_them_is_found(
            garbage in prop::collection::vec(prop_oneof![Just(0xFA_u8), Just(0xFB), any::<u8>()], 0..300),
            data in prop::collection::vec(any::<u8>(), 0..60),
        ) {
            let packet = Packet::new(50, data);
            let bytes = [garbage.as_slice(), &packet.to_bytes()].concat();
            let mut decoder = Decoder::default();
            decoder.push(&bytes, NOW);
            let mut found = Vec::new();
            for tick in 0..garbage.len() as u32 + 1 {
                found.extend(std::iter::from_fn(|| decoder.next(tick * LATER)));
            }
            // One header in 65,536 has a right checksum by chance: no receiver can tell that packet from a true one.
            let swallowed = (0..garbage.len()).any(|at| begins_packet_to_beyond(&bytes[at..], garbage.len() - at));
            prop_assert!(swallowed || found.last() == Some(&packet));
        }

        #[test]
        fn a_byte_that_flips_is_noticed(data in prop::collection::vec(any::<u8>(), 0..60), at: prop::sample::Index, flip in 1..=255_u8) {
            let packet = Packet::new(50, data);
            let mut bytes = packet.to_bytes();
            let at = at.index(bytes.len());
            bytes[at] ^= flip;
            let (packets, _) = decode(&bytes);
            prop_assert!(packets.iter().all(|found| *found != packet));
        }
    }
}
