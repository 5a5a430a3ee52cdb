//! Any data as a CONFIG, encoder, IO or gyro packet: read without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::robot::arcos::codec::{
    CONFIG_PACKET, Config, ENCODER_PACKET, Encoder, GYRO_PACKET, Gyro, IO_PACKET, Io, Packet,
};

fuzz_target!(|data: &[u8]| {
    let packet = |kind| Packet::new(kind, data.to_vec());
    if let Some(config) = Config::from_packet(&packet(CONFIG_PACKET)) {
        let _ = config.to_packet();
    }
    let _ = Encoder::from_packet(&packet(ENCODER_PACKET));
    if let Some(io) = Io::from_packet(&packet(IO_PACKET)) {
        assert_eq!(Io::from_packet(&io.to_packet()), Some(io));
    }
    if let Some(gyro) = Gyro::from_packet(&packet(GYRO_PACKET)) {
        assert_eq!(Gyro::from_packet(&gyro.to_packet()), Some(gyro));
    }
});
