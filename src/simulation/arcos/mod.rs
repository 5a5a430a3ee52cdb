//! A served robot: the simulated base behind the ARCOS protocol, as a p3dx-sh.
//!
//! [`Server`] does no input or output of its own: bytes in, time on, bytes out.
//! [`serve`] connects it to real lines and the wall clock.

mod dry_line;
mod extras;
mod memory_line;
mod motion;
mod reports;
mod serve;
mod session;

pub use dry_line::DryLine;
pub use memory_line::MemoryLine;
pub use serve::{Place, ServeAddress, serve, serve_at};
pub use session::{Heard, Server, ServerSettings};
