//! The figures of the paper (Huo, Alexenko & Skubic, IROS 2014), Tables I to III.
//!
//! Its columns are by what a landmark is for: at the goal, on the path, or
//! none. Where only a percentage is printed, no count is given here; the
//! counts of the robot's trials are the only small whole numbers that give
//! the percentages printed.

use super::{Cell, Column, Row, Source};

fn row(name: &str, cells: [(Column, Cell); 4]) -> Row {
    Row {
        name: name.to_string(),
        source: Source::Paper,
        measure: String::new(),
        cells: cells.into_iter().collect(),
        spl: None,
    }
}

/// Table I: commands grounded, of 149.
pub(super) fn table_one() -> Row {
    row(
        "grounding of gold trees",
        [
            (Column::All, Cell::of(131, 149)),
            (Column::None, Cell::of(60, 60)),
            (Column::Path, Cell::of(37, 51)),
            (Column::Goal, Cell::of(34, 38)),
        ],
    )
}

/// Table II: the furniture as it was.
pub(super) fn table_two() -> Vec<Row> {
    let simulation = [
        (Column::All, Cell::percent(90.1)),
        (Column::None, Cell::percent(98.0)),
        (Column::Path, Cell::percent(86.0)),
        (Column::Goal, Cell::percent(89.5)),
    ];
    let mut previous = row("simulation, previous system", simulation.clone());
    previous.cells.retain(|column, _| *column == Column::All);
    previous.cells.insert(Column::All, Cell::percent(84.6));
    let robot = [
        (Column::All, Cell::of(26, 32)),
        (Column::None, Cell::of(12, 12)),
        (Column::Path, Cell::of(11, 14)),
        (Column::Goal, Cell::of(3, 6)),
    ];
    vec![row("simulation, gold instructions", simulation), previous, row("robot", robot)]
}

/// Table III: the furniture moved.
pub(super) fn table_three() -> Vec<Row> {
    vec![row(
        "robot",
        [
            (Column::All, Cell::of(25, 32)),
            (Column::None, Cell::of(12, 12)),
            (Column::Path, Cell::of(11, 14)),
            (Column::Goal, Cell::of(2, 6)),
        ],
    )]
}
