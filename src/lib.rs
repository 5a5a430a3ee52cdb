//! Tell a robot in ordinary words where something is, and send it there
//! through furniture it has never seen.
//!
//! The library behind seven Unix filters. A module uses only modules below it
//! in this list, which a test checks. So code that steers a robot cannot name
//! what is true: [`simulation`] stands above it.
//!
//! | module | what it is for | binary |
//! |---|---|---|
//! | [`cli`] | arguments, JSON lines in and out, diagnostics, exit codes | all |
//! | [`evaluation`] | experiments, metrics, tables | `evaluate` |
//! | [`conversation`] | errand after errand with a person: questions, answers, what was seen before | `drive --talk` |
//! | [`simulation`] | the truth: scene, camera, simulated base and eyes, homes made at random, the judge | `drive` |
//! | [`field`] | the real robot: its trial, its camera | `drive --robot` |
//! | [`recording`] | MCAP in and out; live over a WebSocket; what a trial leaves beside its record | |
//! | [`drawing`] | plots of rooms, furniture and paths | |
//! | [`behavior`] | the executive: runs a plan on a robot | `drive` |
//! | [`planning`] | RDT nodes and room map → actions | `plan` |
//! | [`perception`] | RGB-D frame → furniture with pose | `perceive` |
//! | [`robot`] | a mobile base and its body; the ARCOS protocol | |
//! | [`grounding`] | chunk tree → room, RDT nodes, object | `ground` |
//! | [`language`] | text → tokens → tags → chunk tree | `chunk` |
//! | [`force`] | histogram of forces, degrees of truth | `hof` |
//! | [`map`] | the room map: all that a robot may know of a home | |
//! | [`catalogue`] | one row a furniture category | |
//! | [`frame`] | one RGB-D frame: colour, depth, camera and its pose | |
//! | [`record`] | the record that grows from stage to stage | |
//! | [`geometry`] | pose, polygon, grid | |
//! | [`escape`] | text where it could do harm: on a terminal, in markup, as a file name | |
//! | [`files`] | files that appear whole or not at all | |
//! | [`limits`] | the most that is taken of anything from outside, and why | |

pub mod behavior;
pub mod catalogue;
pub mod cli;
pub mod conversation;
pub mod drawing;
pub mod escape;
pub mod evaluation;
pub mod field;
pub mod files;
pub mod force;
pub mod frame;
pub mod geometry;
pub mod grounding;
pub mod language;
pub mod limits;
pub mod map;
pub mod perception;
pub mod planning;
pub mod record;
pub mod recording;
pub mod robot;
pub mod simulation;
