//! Any bytes, in any pieces: the decoder takes them in without a panic, and loses none of what it does not use.
#![no_main]

use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use spatial_fetch::robot::arcos::codec::{Command, Decoder};

fuzz_target!(|pieces: Vec<Vec<u8>>| {
    let mut decoder = Decoder::default();
    for (piece, at) in pieces.iter().zip((0..).map(|i| Duration::from_millis(i * 30))) {
        decoder.push(piece, at);
        while let Some(packet) = decoder.next(at) {
            assert!(packet.to_bytes().len() <= 258);
            let command = Command::from_packet(&packet);
            let _ = command.to_string();
            let _ = command.to_packet();
        }
    }
});
