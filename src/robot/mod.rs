//! One small trait for a mobile base, and the bases that have it.
