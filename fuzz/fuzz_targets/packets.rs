//! Any bytes, in any pieces: the decoder takes them in without a panic, and what it finds is written and found again.
//!
//! Pieces are a length and as many bytes.
#![no_main]

use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use spatial_fetch::robot::arcos::codec::{Command, Decoder};

fuzz_target!(|data: &[u8]| {
    let mut decoder = Decoder::default();
    let (mut rest, mut at) = (data, Duration::ZERO);
    while let [length, following @ ..] = rest {
        let (piece, left) = following.split_at(following.len().min(usize::from(*length)));
        (rest, at) = (left, at + Duration::from_millis(30));
        decoder.push(piece, at);
        while let Some(packet) = decoder.next(at) {
            let bytes = packet.to_bytes();
            assert!(bytes.len() <= 258);
            let mut again = Decoder::default();
            again.push(&bytes, at);
            assert_eq!(again.next(at).as_ref(), Some(&packet));
            let command = Command::from_packet(&packet);
            let _ = command.to_string();
            assert_eq!(Command::from_packet(&command.to_packet()), command);
        }
    }
});
