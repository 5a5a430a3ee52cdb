//! The solids that a piece of furniture in a scene is composed of, by its shape.

use super::solid::Solid;
use crate::catalogue::{Color, FurnitureShape, Size};
use crate::geometry::{Polygon, Pose, Vec2, vec2};

/// A bed's frame.
const WOOD: Color = [150, 105, 65];
/// A lamp's foot and pole.
const BLACK: Color = [40, 40, 44];

/// The outline of a piece on the floor.
pub(super) fn footprint(shape: FurnitureShape, pose: Pose, size: Size) -> Polygon {
    match shape {
        FurnitureShape::RoundTable | FurnitureShape::Lamp => Polygon::ellipse(pose, size.length, size.width, 16),
        FurnitureShape::HexagonTable => hexagon(pose, size),
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
pub(super) fn solids(shape: FurnitureShape, pose: Pose, size: Size, color: Color) -> Vec<Solid> {
    let h = size.height;
    match shape {
        FurnitureShape::Table => [vec![top(shape, pose, size, color)], legs(pose, size, h - 0.04, color)].concat(),
        FurnitureShape::RoundTable | FurnitureShape::HexagonTable => pedestal(shape, pose, size, color),
        FurnitureShape::Cabinet => vec![Solid::new(footprint(shape, pose, size), 0.0, h, color)],
        FurnitureShape::Stool => [vec![top(shape, pose, size, color)], legs(pose, size, h - 0.04, color)].concat(),
        FurnitureShape::Chair => chair(pose, size, color),
        FurnitureShape::Couch => couch(pose, size, color),
        FurnitureShape::Bed => bed(pose, size, color),
        FurnitureShape::Lamp => lamp(pose, size, color),
    }
}

fn top(shape: FurnitureShape, pose: Pose, size: Size, color: Color) -> Solid {
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

fn pedestal(shape: FurnitureShape, pose: Pose, size: Size, color: Color) -> Vec<Solid> {
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
        Solid::new(footprint(FurnitureShape::Lamp, pose, size), h - 0.3, h, color),
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
