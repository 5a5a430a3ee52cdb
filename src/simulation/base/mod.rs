//! A simulated Pioneer 3-DX among the furniture of a scene.
//!
//! What it reports is what the executive may use. The truth – where it really
//! is, what it touched – is read from a [`Truth`] handle, which only a judge
//! and the simulated eyes hold.

mod ears;
mod obstacles;
mod orders;
mod simulated_base;
mod wheels;

pub use obstacles::Obstacles;
pub use simulated_base::{SimulatedBase, Truth};
