//! The Pioneer 3-DX and its ARCOS protocol, from both ends of the line.
//!
//! [`codec`] is the bytes: packets, commands, information packets. [`mod@line`] carries
//! them: serial, TCP, memory. [`client`] drives a robot; the other end, made of the
//! simulated base, is `simulation::arcos`. Sources: the Pioneer 3 Operations Manual, and the published
//! behaviour of ARIA, Player and AMRISim where the manual is silent.

pub mod client;
pub mod codec;
pub mod line;
pub mod parameters;
pub mod standby;
