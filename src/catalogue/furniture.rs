//! Furniture categories.
//!
//! Sizes without a source of their own are usual ones. Length is along the
//! item's front heading, width across it, metres. The apartment's sizes are
//! those of the paper's furniture.

use super::{Color, Size, size};

/// What a scene composes a piece of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FurnitureShape {
    /// A rectangular top on four legs.
    Table,
    /// A round top on a column.
    RoundTable,
    /// A six-sided top on a column.
    HexagonTable,
    /// A closed body.
    Cabinet,
    /// A seat and a back on four legs.
    Chair,
    /// A seat with back and arms down to the floor.
    Couch,
    /// A mattress with a headboard at its rear.
    Bed,
    /// A seat on four legs.
    Stool,
    /// A foot, a pole and a shade.
    Lamp,
}

/// The six classes that must be told apart at least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FurnitureClass {
    /// People put small things on it.
    TableLike,
    /// One person sits on it; it has a front of its own.
    Seat,
    /// Several sit on it.
    Couch,
    /// Someone lies on it.
    Bed,
    /// Things are kept in it.
    Storage,
    /// It gives light.
    Lamp,
}

impl FurnitureClass {
    /// The name in tables and in the lexicon.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TableLike => "table_like",
            Self::Seat => "seat",
            Self::Couch => "couch",
            Self::Bed => "bed",
            Self::Storage => "storage",
            Self::Lamp => "lamp",
        }
    }
}

/// What of a piece's orientation can be told by its looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// It has a front.
    Facing,
    /// It has a long and a short side, and no front.
    ShortEdge,
    /// None.
    None,
}

/// Whether small things lie on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// They hardly do.
    Never,
    /// They may, and are looked for there.
    Possibly,
    /// They do: that is where people put them.
    Usually,
}

/// The words for its looks that the detector may use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// It may be round.
    pub round: bool,
    /// It may be long.
    pub long: bool,
    /// It may be small.
    pub small: bool,
    /// It may be tall.
    pub tall: bool,
}

/// A furniture category: everything that the program knows of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Category {
    /// What scene files call it.
    pub name: &'static str,
    /// What a detection calls it, and the canonical noun of the lexicon.
    pub noun: &'static str,
    /// Names that other data sets and detectors use for it.
    pub also_called: &'static [&'static str],
    /// Which of the six classes it is of; a seat is read by its own front.
    pub class: FurnitureClass,
    /// How a scene builds it.
    pub shape: FurnitureShape,
    /// Its usual size.
    pub size: Size,
    /// Its usual colour.
    pub color: Color,
    /// What can be said of its looks.
    pub attributes: &'static [&'static str],
    /// What of its orientation can be told.
    pub orientation: Orientation,
    /// Whether small things lie on it.
    pub holds: Holds,
    /// What a noisy sensor takes it for, itself among them; the more often named, the likelier.
    pub alike: &'static [&'static str],
    /// Whether the detector learns it, from the family of its name in `simulation::families`.
    pub family: bool,
    /// Words for its looks that a detection may bear.
    pub looks: Looks,
    /// How often each of a few small things lies on it in a training room.
    pub clutter: f64,
    /// How often a lamp stands on it in a training room.
    pub lamp: f64,
}

const WOOD: Color = [150, 105, 65];
const DARK_WOOD: Color = [95, 62, 40];
const OAK: Color = [186, 148, 98];
const CLOTH: Color = [92, 110, 138];
const LINEN: Color = [214, 208, 196];
const WHITE: Color = [225, 225, 222];
const BLACK: Color = [40, 40, 44];

/// A look that never has a word.
const PLAIN: Looks = Looks { round: false, long: false, small: false, tall: false };
const TALL: Looks = Looks { tall: true, ..PLAIN };

impl Category {
    /// What a category that is not known looks like; a scene with one is refused before anyone sees it.
    pub const UNKNOWN: Self =
        Self { name: "unknown", noun: "unknown", shape: FurnitureShape::Cabinet, color: [128; 3], ..ROW };
}

/// What every row starts from.
const ROW: Category = Category {
    name: "",
    noun: "",
    also_called: &[],
    class: FurnitureClass::TableLike,
    shape: FurnitureShape::Cabinet,
    size: size(0.5, 0.5, 0.5),
    color: WOOD,
    attributes: &[],
    orientation: Orientation::Facing,
    holds: Holds::Never,
    alike: &[],
    family: false,
    looks: PLAIN,
    clutter: 0.0,
    lamp: 0.0,
};

/// A table: a top without a front on which things lie.
const TABLE: Category = Category {
    shape: FurnitureShape::Table,
    orientation: Orientation::ShortEdge,
    holds: Holds::Usually,
    color: OAK,
    ..ROW
};
const SEAT: Category = Category { class: FurnitureClass::Seat, shape: FurnitureShape::Chair, ..ROW };
const STORAGE: Category = Category { class: FurnitureClass::Storage, ..ROW };

/// All categories. Those with a family come first: a model file keeps their order.
pub const CATEGORIES: &[Category] = &[
    Category {
        name: "table",
        noun: "table",
        also_called: &["stand", "bedstand", "kitchen_table"],
        size: size(0.75, 1.2, 0.74),
        attributes: &["brown"],
        alike: &["table", "dinner_table", "desk", "coffee_table", "nightstand"],
        family: true,
        looks: Looks { round: true, long: true, small: true, tall: false },
        clutter: 0.35,
        lamp: 0.15,
        ..TABLE
    },
    Category {
        name: "coffee_table",
        noun: "coffee_table",
        size: size(0.71, 0.71, 0.51),
        color: DARK_WOOD,
        attributes: &["small", "dark"],
        alike: &["table", "dinner_table", "desk", "coffee_table", "nightstand", "coffee_table", "stool", "bed"],
        family: true,
        looks: Looks { round: true, long: true, small: true, tall: false },
        clutter: 0.35,
        lamp: 0.15,
        ..TABLE
    },
    Category {
        name: "desk",
        noun: "desk",
        size: size(0.7, 1.4, 0.74),
        color: WHITE,
        attributes: &["white"],
        alike: &["table", "dinner_table", "desk", "coffee_table", "nightstand"],
        family: true,
        looks: Looks { long: true, ..PLAIN },
        clutter: 0.35,
        lamp: 0.15,
        ..TABLE
    },
    Category {
        name: "nightstand",
        noun: "nightstand",
        also_called: &["night_stand", "bedside_table"],
        size: size(0.4, 0.45, 0.55),
        attributes: &["small", "brown"],
        holds: Holds::Usually,
        alike: &["table", "dinner_table", "desk", "coffee_table", "nightstand"],
        family: true,
        clutter: 0.12,
        lamp: 0.5,
        ..ROW
    },
    Category {
        name: "chair",
        noun: "chair",
        also_called: &["folding_chair", "deck_chair", "rocking_chair", "highchair"],
        size: size(0.44, 0.57, 0.82),
        attributes: &["brown"],
        alike: &["chair", "armchair", "stool"],
        family: true,
        clutter: 0.12,
        ..SEAT
    },
    Category {
        name: "armchair",
        noun: "armchair",
        also_called: &["recliner"],
        shape: FurnitureShape::Couch,
        size: size(0.75, 0.85, 0.9),
        color: CLOTH,
        attributes: &["blue"],
        alike: &["couch", "armchair", "bed", "chair", "armchair", "stool"],
        family: true,
        clutter: 0.12,
        ..SEAT
    },
    Category {
        name: "stool",
        noun: "stool",
        also_called: &["ottoman", "footstool", "music_stool", "step_stool", "bench"],
        shape: FurnitureShape::Stool,
        size: size(0.36, 0.36, 0.45),
        attributes: &["small", "brown"],
        orientation: Orientation::None,
        holds: Holds::Possibly,
        alike: &["chair", "armchair", "stool", "coffee_table", "stool", "bed"],
        family: true,
        looks: Looks { round: true, ..PLAIN },
        ..SEAT
    },
    Category {
        name: "couch",
        noun: "couch",
        also_called: &["sofa", "sofa_bed", "futon", "chaise_longue", "loveseat"],
        class: FurnitureClass::Couch,
        shape: FurnitureShape::Couch,
        size: size(0.73, 2.06, 0.92),
        color: CLOTH,
        attributes: &["blue"],
        alike: &["couch", "armchair", "bed"],
        family: true,
        clutter: 0.35,
        ..ROW
    },
    Category {
        name: "bed",
        noun: "bed",
        also_called: &["bunk_bed"],
        class: FurnitureClass::Bed,
        shape: FurnitureShape::Bed,
        size: size(2.0, 1.1, 0.55),
        color: LINEN,
        attributes: &["white"],
        alike: &["couch", "armchair", "bed", "coffee_table", "stool", "bed"],
        family: true,
        clutter: 0.35,
        ..ROW
    },
    Category {
        name: "wardrobe",
        noun: "wardrobe",
        size: size(0.6, 1.2, 1.95),
        color: OAK,
        attributes: &["tall", "brown"],
        alike: &["wardrobe", "bookshelf", "shelf"],
        family: true,
        looks: TALL,
        ..STORAGE
    },
    Category {
        name: "dresser",
        noun: "dresser",
        also_called: &["dresser_mirror", "chest_of_drawers"],
        size: size(0.5, 1.2, 0.85),
        attributes: &["brown"],
        holds: Holds::Possibly,
        alike: &["dresser", "cabinet", "tv_stand"],
        family: true,
        clutter: 0.35,
        lamp: 0.15,
        ..STORAGE
    },
    Category {
        name: "bookshelf",
        noun: "bookshelf",
        also_called: &["bookcase"],
        size: size(0.3, 0.8, 1.8),
        attributes: &["tall", "brown"],
        alike: &["wardrobe", "bookshelf", "shelf"],
        family: true,
        looks: TALL,
        ..STORAGE
    },
    Category {
        name: "shelf",
        noun: "shelf",
        size: size(0.35, 0.9, 1.8),
        attributes: &["tall", "brown"],
        alike: &["wardrobe", "bookshelf", "shelf"],
        family: true,
        looks: TALL,
        clutter: 0.12,
        ..STORAGE
    },
    Category {
        name: "cabinet",
        noun: "cabinet",
        also_called: &["cupboard", "file_cabinet"],
        size: size(0.45, 0.9, 0.9),
        attributes: &["brown"],
        holds: Holds::Possibly,
        alike: &["dresser", "cabinet", "tv_stand"],
        family: true,
        clutter: 0.35,
        ..STORAGE
    },
    Category {
        name: "tv_stand",
        noun: "tv_stand",
        also_called: &["television_stand"],
        size: size(0.45, 1.4, 0.5),
        color: BLACK,
        attributes: &["black", "low"],
        holds: Holds::Possibly,
        alike: &["dresser", "cabinet", "tv_stand"],
        family: true,
        clutter: 0.12,
        ..STORAGE
    },
    Category {
        name: "lamp",
        noun: "lamp",
        also_called: &["table_lamp", "floor_lamp"],
        class: FurnitureClass::Lamp,
        shape: FurnitureShape::Lamp,
        size: size(0.4, 0.4, 1.5),
        color: WHITE,
        attributes: &["tall"],
        orientation: Orientation::None,
        family: true,
        looks: TALL,
        ..ROW
    },
    Category {
        name: "round_table",
        noun: "table",
        shape: FurnitureShape::RoundTable,
        size: size(0.6, 0.6, 0.55),
        attributes: &["round", "small", "brown"],
        ..TABLE
    },
    Category {
        name: "hexagon_table",
        noun: "table",
        shape: FurnitureShape::HexagonTable,
        size: size(0.95, 0.82, 0.52),
        color: WOOD,
        attributes: &["hexagonal", "brown"],
        ..TABLE
    },
    Category {
        name: "dinner_table",
        noun: "dinner_table",
        also_called: &["dining_table"],
        size: size(1.53, 0.79, 0.74),
        color: WOOD,
        attributes: &["large", "long", "brown"],
        alike: &["table", "dinner_table", "desk", "coffee_table", "nightstand"],
        ..TABLE
    },
    Category {
        name: "end_table",
        noun: "end_table",
        also_called: &["side_table"],
        size: size(0.5, 0.5, 0.55),
        color: WOOD,
        attributes: &["small", "brown"],
        ..TABLE
    },
    Category {
        name: "counter",
        noun: "counter",
        size: size(0.6, 1.8, 0.9),
        color: WHITE,
        attributes: &["white"],
        holds: Holds::Usually,
        ..ROW
    },
];

/// The categories that the detector learns, in the order of a model file: those with a family.
pub const FAMILIES: [&str; count_families()] = families();

const fn count_families() -> usize {
    let (mut count, mut row) = (0, 0);
    while row < CATEGORIES.len() {
        if CATEGORIES[row].family {
            count += 1;
        }
        row += 1;
    }
    count
}

const fn families() -> [&'static str; count_families()] {
    let mut names = [""; count_families()];
    let (mut count, mut row) = (0, 0);
    while row < CATEGORIES.len() {
        if CATEGORIES[row].family {
            names[count] = CATEGORIES[row].name;
            count += 1;
        }
        row += 1;
    }
    names
}

/// The category of that name in scene files.
pub fn category(name: &str) -> Option<&'static Category> {
    CATEGORIES.iter().find(|category| category.name == name)
}

/// The class of what bears that name here, in a detection, or in another data set; nothing for what is no furniture.
pub fn class_of(name: &str) -> Option<FurnitureClass> {
    let is_called =
        |category: &&Category| category.name == name || category.noun == name || category.also_called.contains(&name);
    CATEGORIES.iter().find(is_called).map(|category| category.class)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn a_name_means_one_category() {
        let names: Vec<&str> =
            CATEGORIES.iter().flat_map(|c| [c.name].into_iter().chain(c.also_called.iter().copied())).collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    }

    #[test]
    fn what_has_a_family_is_called_by_its_own_name() {
        assert!(CATEGORIES.iter().filter(|c| c.family).all(|c| c.name == c.noun));
        assert_eq!((FAMILIES[0], FAMILIES.len()), ("table", 16));
    }

    #[test]
    fn names_of_other_data_sets_have_a_class() {
        assert_eq!(class_of("night_stand"), Some(FurnitureClass::TableLike));
        assert_eq!(class_of("sofa"), Some(FurnitureClass::Couch));
        assert_eq!(class_of("curtain"), None);
    }
}
