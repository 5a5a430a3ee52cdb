//! Experiments, metrics and tables.
