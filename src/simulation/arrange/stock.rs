//! What stands in rooms of each kind, and what lies on it.

/// A piece with what goes with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// The main piece.
    pub main: &'static str,
    /// Whether it stands with its back to a wall.
    pub at_wall: bool,
    /// Pieces beside it: category, direction from its front in degrees, gap in metres, heading against its own in degrees.
    pub with: &'static [(&'static str, f64, f64, f64)],
}

const fn group(main: &'static str, at_wall: bool, with: &'static [(&'static str, f64, f64, f64)]) -> Group {
    Group { main, at_wall, with }
}

const BEDROOM: &[Group] = &[
    group("bed", true, &[("nightstand", 125.0, 0.1, 0.0), ("nightstand", -125.0, 0.1, 0.0)]),
    group("desk", true, &[("chair", 0.0, 0.15, 180.0)]),
    group("dresser", true, &[]),
    group("wardrobe", true, &[]),
    group("armchair", true, &[("end_table", 90.0, 0.15, 0.0)]),
];
const LIVING_ROOM: &[Group] = &[
    group("couch", false, &[("coffee_table", 0.0, 0.5, 0.0), ("end_table", 90.0, 0.15, 0.0)]),
    group("dinner_table", false, &[("chair", 90.0, 0.15, -90.0), ("chair", -90.0, 0.15, 90.0)]),
    group("tv_stand", true, &[]),
    group("armchair", true, &[("lamp", -90.0, 0.15, 0.0)]),
    group("shelf", true, &[]),
];
const KITCHEN: &[Group] = &[
    group("counter", true, &[]),
    group("round_table", false, &[("chair", 0.0, 0.15, 180.0), ("chair", 180.0, 0.15, 0.0)]),
    group("cabinet", true, &[]),
    group("stool", true, &[]),
];
const OFFICE: &[Group] = &[
    group("desk", true, &[("chair", 0.0, 0.15, 180.0)]),
    group("table", false, &[("chair", 0.0, 0.15, 180.0)]),
    group("shelf", true, &[]),
    group("cabinet", true, &[]),
];

/// The kinds of room that are furnished, with the groups in each, the most typical first.
pub(super) const ROOMS: &[(&str, &[Group])] =
    &[("living_room", LIVING_ROOM), ("bedroom", BEDROOM), ("kitchen", KITCHEN), ("office", OFFICE)];

/// What may lie there.
pub(super) const PORTABLE: &[&str] = &[
    "fork",
    "glasses_case",
    "laptop",
    "statue",
    "mug",
    "cup",
    "keys",
    "book",
    "wallet",
    "cellphone",
    "letter",
    "notepad",
    "remote",
    "bottle",
    "vase",
    "tablet",
];
