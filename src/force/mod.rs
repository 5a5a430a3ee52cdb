//! Histogram of forces and the spatial descriptions built on it. Knows nothing of robots or language.
