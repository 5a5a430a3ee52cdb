//! MCAP in and out.
