//! Tell a robot in ordinary words where something is, and send it there
//! through furniture it has never seen.
//!
//! The library behind seven Unix filters. Data flows down this list, and a
//! module uses only modules below it:
//!
//! | module | what it is for | binary |
//! |---|---|---|
//! | [`cli`] | arguments, JSON lines in and out, diagnostics, exit codes | all |
//! | [`evaluation`] | experiments, metrics, tables | `evaluate` |
//! | [`trial`] | a plan run on the simulated robot in a scene, and judged by the truth | `drive` |
//! | [`behavior`] | the executive: runs a plan on a robot | `drive` |
//! | [`planning`] | RDT nodes and room map → actions | `plan` |
//! | [`grounding`] | chunk tree → room, RDT nodes, object | `ground` |
//! | [`language`] | text → tokens → tags → chunk tree | `chunk` |
//! | [`perception`] | RGB-D frame → furniture with pose | `perceive` |
//! | [`robot`] | a mobile base, real or simulated | |
//! | [`drawing`] | plots of rooms, furniture and paths | |
//! | [`recording`] | MCAP in and out; live over a WebSocket | |
//! | [`world`] | room map, furniture models, scene, what sensors see of it | |
//! | [`frame`] | one RGB-D frame: colour, depth, intrinsics, camera pose | |
//! | [`force`] | histogram of forces, degrees of truth | `hof` |
//! | [`geometry`] | pose, polygon, grid | |
//! | [`files`] | files that appear whole or not at all | |
//! | [`record`] | the record that grows from stage to stage | |

pub mod behavior;
pub mod cli;
pub mod drawing;
pub mod evaluation;
pub mod files;
pub mod force;
pub mod frame;
pub mod geometry;
pub mod grounding;
pub mod language;
pub mod perception;
pub mod planning;
pub mod record;
pub mod recording;
pub mod robot;
pub mod trial;
pub mod world;
