//! ROS 1: XML-RPC with the master and between nodes, TCPROS for what is said.
//!
//! On plain sockets and threads: messages are little-endian, one length before
//! each (wiki.ros.org/ROS/TCPROS, ROS/Master_API, ROS/Slave_API).

mod codec;
mod master;
mod node;
mod publishing;
mod subscribing;
mod tcpros;
mod xml_rpc;

pub use codec::{CodecError, decode, encode, sum};
pub use node::Ros1;
pub use subscribing::Raw;
