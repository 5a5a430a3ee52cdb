//! Text → tokens → part-of-speech tags → chunk tree. Never sees a map.
