//! Any data as a server information packet: read without a panic, and what is read is written and read alike.
#![no_main]

use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use spatial_fetch::robot::arcos::client::Odometry;
use spatial_fetch::robot::arcos::codec::{Packet, SIP_STOPPED, Sip};
use spatial_fetch::robot::arcos::parameters::Parameters;

fuzz_target!(|packets: Vec<Vec<u8>>| {
    let mut odometry = Odometry::new(Parameters::P3DX_SH, 0.3);
    for (data, at) in packets.into_iter().zip((0..).map(|i| Duration::from_millis(i * 100))) {
        let Some(sip) = Sip::from_packet(&Packet::new(SIP_STOPPED, data)) else { continue };
        assert_eq!(Sip::from_packet(&sip.to_packet()).as_ref(), Some(&sip));
        odometry.take(&sip, at);
        assert!(odometry.pose().x.is_finite() && odometry.distance_m() >= 0.0);
    }
});
