//! Furniture families: category and size → the solids a piece is composed of.
//!
//! Sizes without a source of their own are usual ones. Length is along the
//! item's front heading, width across it, metres.

use super::solid::{Color, Solid};
use crate::geometry::{Polygon, Pose, Vec2, vec2};

/// Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Along the front's heading.
    pub length: f64,
    /// Across it.
    pub width: f64,
    /// Above the floor.
    pub height: f64,
}

/// What a family looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
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

/// A furniture category: the noun by which detections call it, its shape, size and colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Category {
    /// What scene files call it.
    pub name: &'static str,
    /// What a detection calls it.
    pub noun: &'static str,
    /// How it is built.
    pub shape: Shape,
    /// Its usual size.
    pub size: Size,
    /// Its usual colour.
    pub color: Color,
    /// Shape words that hold for it.
    pub attributes: &'static [&'static str],
}

const fn size(length: f64, width: f64, height: f64) -> Size {
    Size { length, width, height }
}

const WOOD: Color = [150, 105, 65];
const DARK_WOOD: Color = [95, 62, 40];
const OAK: Color = [186, 148, 98];
const CLOTH: Color = [92, 110, 138];
const LINEN: Color = [214, 208, 196];
const WHITE: Color = [225, 225, 222];
const BLACK: Color = [40, 40, 44];

const fn item(
    name: &'static str,
    noun: &'static str,
    shape: Shape,
    size: Size,
    color: Color,
    attributes: &'static [&'static str],
) -> Category {
    Category { name, noun, shape, size, color, attributes }
}

/// All categories. The apartment's sizes are those of the paper's furniture; the others are usual ones.
pub const CATEGORIES: &[Category] = &[
    item("table", "table", Shape::Table, size(0.75, 1.2, 0.74), OAK, &["brown"]),
    item("round_table", "table", Shape::RoundTable, size(0.6, 0.6, 0.55), OAK, &["round", "small", "brown"]),
    item("hexagon_table", "table", Shape::HexagonTable, size(0.95, 0.82, 0.52), WOOD, &["hexagonal", "brown"]),
    item("coffee_table", "coffee_table", Shape::Table, size(0.71, 0.71, 0.51), DARK_WOOD, &["small", "dark"]),
    item("dinner_table", "dinner_table", Shape::Table, size(1.53, 0.79, 0.74), WOOD, &["large", "long", "brown"]),
    item("desk", "desk", Shape::Table, size(0.7, 1.4, 0.74), WHITE, &["white"]),
    item("nightstand", "nightstand", Shape::Cabinet, size(0.4, 0.45, 0.55), WOOD, &["small", "brown"]),
    item("end_table", "end_table", Shape::Table, size(0.5, 0.5, 0.55), WOOD, &["small", "brown"]),
    item("counter", "counter", Shape::Cabinet, size(0.6, 1.8, 0.9), WHITE, &["white"]),
    item("couch", "couch", Shape::Couch, size(0.73, 2.06, 0.92), CLOTH, &["blue"]),
    item("armchair", "armchair", Shape::Couch, size(0.75, 0.85, 0.9), CLOTH, &["blue"]),
    item("chair", "chair", Shape::Chair, size(0.44, 0.57, 0.82), WOOD, &["brown"]),
    item("stool", "stool", Shape::Stool, size(0.36, 0.36, 0.45), WOOD, &["small", "brown"]),
    item("bed", "bed", Shape::Bed, size(2.0, 1.1, 0.55), LINEN, &["white"]),
    item("dresser", "dresser", Shape::Cabinet, size(0.5, 1.2, 0.85), WOOD, &["brown"]),
    item("wardrobe", "wardrobe", Shape::Cabinet, size(0.6, 1.2, 1.95), OAK, &["tall", "brown"]),
    item("shelf", "shelf", Shape::Cabinet, size(0.35, 0.9, 1.8), WOOD, &["tall", "brown"]),
    item("cabinet", "cabinet", Shape::Cabinet, size(0.45, 0.9, 0.9), WOOD, &["brown"]),
    item("tv_stand", "tv_stand", Shape::Cabinet, size(0.45, 1.4, 0.5), BLACK, &["black", "low"]),
    item("lamp", "lamp", Shape::Lamp, size(0.4, 0.4, 1.5), WHITE, &["tall"]),
];

/// A small portable object: its size and colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallObject {
    /// Noun.
    pub name: &'static str,
    /// Its usual size.
    pub size: Size,
    /// Its usual colour.
    pub color: Color,
}

const fn small(name: &'static str, length: f64, width: f64, height: f64, color: Color) -> SmallObject {
    SmallObject { name, size: size(length, width, height), color }
}

/// Portable objects with usual sizes.
pub const OBJECTS: &[SmallObject] = &[
    small("fork", 0.19, 0.03, 0.02, [205, 205, 210]),
    small("glasses_case", 0.16, 0.07, 0.05, [170, 40, 45]),
    small("laptop", 0.26, 0.36, 0.22, [60, 62, 70]),
    small("statue", 0.12, 0.12, 0.3, [190, 180, 150]),
    small("monitor", 0.2, 0.5, 0.42, [30, 30, 34]),
    small("mug", 0.09, 0.09, 0.1, [200, 60, 50]),
    small("cup", 0.08, 0.08, 0.09, [240, 240, 235]),
    small("keys", 0.08, 0.05, 0.015, [200, 170, 80]),
    small("book", 0.24, 0.17, 0.03, [50, 110, 70]),
    small("wallet", 0.11, 0.09, 0.02, [80, 50, 30]),
    small("cellphone", 0.15, 0.07, 0.01, [30, 30, 35]),
    small("letter", 0.22, 0.11, 0.005, [245, 245, 240]),
    small("notepad", 0.21, 0.15, 0.015, [240, 220, 90]),
    small("remote", 0.18, 0.05, 0.02, [35, 35, 38]),
    small("bottle", 0.07, 0.07, 0.25, [60, 130, 80]),
    small("vase", 0.14, 0.14, 0.28, [90, 130, 190]),
    small("tablet", 0.25, 0.17, 0.01, [40, 40, 45]),
];

/// The category of that name in scene files.
pub fn category(name: &str) -> Option<&'static Category> {
    CATEGORIES.iter().find(|category| category.name == name)
}

/// The small object of that name.
pub fn object(name: &str) -> Option<&'static SmallObject> {
    OBJECTS.iter().find(|object| object.name == name)
}

/// The outline of a piece on the floor.
pub(super) fn footprint(shape: Shape, pose: Pose, size: Size) -> Polygon {
    match shape {
        Shape::RoundTable | Shape::Lamp => Polygon::ellipse(pose, size.length, size.width, 16),
        Shape::HexagonTable => hexagon(pose, size),
        _ => Polygon::rectangle(pose, size.length, size.width),
    }
}

/// Six corners in a box of the given length and width.
fn hexagon(pose: Pose, size: Size) -> Polygon {
    let (l, w) = (size.length / 2.0, size.width / 2.0);
    let corners: [Vec2; 6] =
        [vec2(l, 0.0), vec2(l / 2.0, w), vec2(-l / 2.0, w), vec2(-l, 0.0), vec2(-l / 2.0, -w), vec2(l / 2.0, -w)];
    Polygon::new(corners.map(|corner| pose.to_world(corner)).to_vec())
}

/// The solids of a piece of furniture.
pub(super) fn solids(shape: Shape, pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let h = size.height;
    match shape {
        Shape::Table => [vec![top(shape, pose, size, color)], legs(pose, size, h - 0.04, color)].concat(),
        Shape::RoundTable | Shape::HexagonTable => pedestal(shape, pose, size, color),
        Shape::Cabinet => vec![Solid::new(footprint(shape, pose, size), 0.0, h, color)],
        Shape::Stool => [vec![top(shape, pose, size, color)], legs(pose, size, h - 0.04, color)].concat(),
        Shape::Chair => chair(pose, size, color),
        Shape::Couch => couch(pose, size, color),
        Shape::Bed => bed(pose, size, color),
        Shape::Lamp => lamp(pose, size, color),
    }
}

fn top(shape: Shape, pose: Pose, size: Size, color: Color) -> Solid {
    Solid::new(footprint(shape, pose, size), size.height - 0.04, size.height, color)
}

fn legs(pose: Pose, size: Size, height: f64, color: Color) -> Vec<Solid> {
    const THICK: f64 = 0.05;
    let (l, w) = (size.length / 2.0, size.width / 2.0);
    let shade = darker(color);
    [(-l, -w), (l - THICK, -w), (l - THICK, w - THICK), (-l, w - THICK)]
        .map(|(x, y)| Solid::block(pose, (x, x + THICK), (y, y + THICK), (0.0, height), shade))
        .to_vec()
}

fn pedestal(shape: Shape, pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let foot = Polygon::ellipse(pose, 0.5 * size.length, 0.5 * size.width, 12);
    let column = Polygon::ellipse(pose, 0.12, 0.12, 8);
    let shade = darker(color);
    vec![
        top(shape, pose, size, color),
        Solid::new(column, 0.0, size.height - 0.04, shade),
        Solid::new(foot, 0.0, 0.03, shade),
    ]
}

fn chair(pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let (l, w) = (size.length / 2.0, size.width / 2.0);
    let seat = 0.45;
    let mut solids = legs(pose, size, seat - 0.04, color);
    solids.push(Solid::block(pose, (-l, l), (-w, w), (seat - 0.04, seat), color));
    solids.push(Solid::block(pose, (-l, -l + 0.05), (-w, w), (seat, size.height), color));
    solids
}

fn couch(pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let (l, w) = (size.length / 2.0, size.width / 2.0);
    let (seat, arm, back) = (0.42_f64, 0.62_f64.min(size.height), 0.2);
    let shade = darker(color);
    vec![
        Solid::block(pose, (-l + back, l), (-w + 0.16, w - 0.16), (0.0, seat), color),
        Solid::block(pose, (-l, -l + back), (-w, w), (0.0, size.height), shade),
        Solid::block(pose, (-l + back, l), (-w, -w + 0.16), (0.0, arm), shade),
        Solid::block(pose, (-l + back, l), (w - 0.16, w), (0.0, arm), shade),
    ]
}

fn bed(pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let (l, w) = (size.length / 2.0, size.width / 2.0);
    let pillow = [245, 245, 245];
    vec![
        Solid::block(pose, (-l + 0.05, l), (-w, w), (0.0, 0.3), darker(WOOD)),
        Solid::block(pose, (-l + 0.05, l), (-w, w), (0.3, size.height), color),
        Solid::block(pose, (-l, -l + 0.05), (-w, w), (0.0, 1.0), WOOD),
        Solid::block(pose, (-l + 0.12, -l + 0.5), (-0.7 * w, 0.7 * w), (size.height, size.height + 0.1), pillow),
    ]
}

fn lamp(pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let h = size.height;
    vec![
        Solid::new(Polygon::ellipse(pose, 0.28, 0.28, 12), 0.0, 0.03, BLACK),
        Solid::new(Polygon::ellipse(pose, 0.04, 0.04, 6), 0.03, h - 0.3, BLACK),
        Solid::new(footprint(Shape::Lamp, pose, size), h - 0.3, h, color),
    ]
}

fn darker(color: Color) -> Color {
    color.map(|c| (f64::from(c) * 0.75) as u8)
}

/// The solids of a small object whose bottom is at `height`.
pub(super) fn object_solids(name: &str, pose: Pose, size: Size, height: f64, color: Color) -> Vec<Solid> {
    let (l, w, h) = (size.length / 2.0, size.width / 2.0, size.height);
    let block = |x, y, z: (f64, f64), color| Solid::block(pose, x, y, (height + z.0, height + z.1), color);
    match name {
        "laptop" => vec![
            block((-l, l), (-w, w), (0.0, 0.025), color),
            block((-l, -l + 0.02), (-w, w), (0.025, h), [120, 150, 190]),
        ],
        "monitor" => vec![
            block((-l, l), (-0.4 * w, 0.4 * w), (0.0, 0.02), color),
            block((-0.02, 0.02), (-0.04, 0.04), (0.02, 0.12), color),
            block((-0.03, 0.03), (-w, w), (0.1, h), color),
        ],
        "statue" => vec![
            Solid::new(Polygon::ellipse(pose, size.length, size.width, 10), height, height + 0.3 * h, darker(color)),
            Solid::new(
                Polygon::ellipse(pose, 0.5 * size.length, 0.5 * size.width, 10),
                height + 0.3 * h,
                height + 0.8 * h,
                color,
            ),
            Solid::new(
                Polygon::ellipse(pose, 0.65 * size.length, 0.65 * size.width, 10),
                height + 0.8 * h,
                height + h,
                color,
            ),
        ],
        "mug" | "cup" | "bottle" | "vase" => vec![
            Solid::new(Polygon::ellipse(pose, size.length, size.width, 12), height, height + h, color),
            block((l, l + 0.03), (-0.01, 0.01), (0.25 * h, 0.75 * h), darker(color)),
        ],
        _ => vec![block((-l, l), (-w, w), (0.0, h), color)],
    }
}
