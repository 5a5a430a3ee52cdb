//! Any data as a server information packet: read without a panic, and what is read is written and read alike.
#![no_main]

use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use spatial_fetch::robot::arcos::client::Odometry;
use spatial_fetch::robot::arcos::codec::{Packet, SIP_STOPPED, Sip};
use spatial_fetch::robot::arcos::parameters::Parameters;

fuzz_target!(|data: &[u8]| {
    let mut odometry = Odometry::new(Parameters::P3DX_SH, 0.3);
    let (mut rest, mut at) = (data, Duration::ZERO);
    // Packets are a length and as many bytes.
    while let [length, following @ ..] = rest {
        let (packet, left) = following.split_at(following.len().min(usize::from(*length)));
        (rest, at) = (left, at + Duration::from_millis(100));
        let Some(sip) = Sip::from_packet(&Packet::new(SIP_STOPPED, packet.to_vec())) else { continue };
        assert_eq!(Sip::from_packet(&sip.to_packet()).as_ref(), Some(&sip));
        odometry.take(&sip, at);
        assert!(odometry.pose().x.is_finite() && odometry.distance_m() >= 0.0);
    }
});
