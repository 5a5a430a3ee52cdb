//! Bytes of the ARCOS protocol: packets, commands, and what the robot reports.
//!
//! Little-endian throughout, except the checksum.

mod command;
mod config;
mod extra;
mod fields;
mod packet;
mod sip;

pub use command::{Argument, Command, number};
pub use config::{CONFIG_PACKET, Config};
pub use extra::{ENCODER_PACKET, Encoder, GYRO_PACKET, Gyro, IO_PACKET, Io};
pub use packet::{Counters, Decoder, LONGEST_SENT, Packet, checksum};
pub use sip::{Flags, SIP_MOVING, SIP_STOPPED, Sip, SipTail};
