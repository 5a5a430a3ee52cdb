//! Plots of rooms, furniture and paths as SVG. Takes plain values; decides nothing.

mod plot;

pub use plot::{Outline, Plot};
