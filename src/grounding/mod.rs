//! Chunk tree → room, RDT nodes and object. Never sees a map.
