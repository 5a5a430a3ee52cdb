//! The room map (what a robot may know) and the scene (what is true), and what sensors see of it.
