//! What lies and stands about in homes and is no furniture: bags, cartons, plants, baskets, heaps of clothes, books.

use crate::catalogue::Orientation;
use crate::geometry::{Pose, vec2};
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum, Texture};
use crate::simulation::families::{Piece, gaudy, sided};

/// The category of such things; the detector has no name for them.
const CLUTTER: &str = "clutter";

/// A thing that stands on the floor, as high as small furniture.
pub(super) fn on_floor(dice: &mut Dice) -> Piece {
    let parts = match dice.whole(0, 3) {
        0 => carton(dice, (0.25, 0.6), (0.2, 0.6)),
        1 => plant(dice, (0.5, 1.8)),
        2 => basket(dice, (0.25, 0.45), (0.25, 0.65)),
        _ => bag(dice, (0.25, 0.6), (0.22, 0.5)),
    };
    Piece::new(CLUTTER, Orientation::None, parts)
}

/// A thing that lies on furniture.
pub(super) fn on_furniture(dice: &mut Dice) -> Piece {
    let parts = match dice.whole(0, 5) {
        0 => carton(dice, (0.1, 0.35), (0.05, 0.3)),
        1 => plant(dice, (0.15, 0.5)),
        2 => basket(dice, (0.15, 0.35), (0.08, 0.3)),
        3 | 4 => bag(dice, (0.2, 0.6), (0.06, 0.3)),
        _ => books(dice),
    };
    Piece::new(CLUTTER, Orientation::None, parts)
}

fn any_finish(dice: &mut Dice) -> Finish {
    let color = gaudy(dice).color;
    Finish::new(color, dice.pick(&[Texture::Plain, Texture::Cloth, Texture::Wood]))
}

fn solid(below: (f64, f64), above: (f64, f64), z: (f64, f64), finish: Finish) -> Frustum {
    let outline = |(x, y): (f64, f64)| crate::geometry::Polygon::rectangle(Pose::default(), x, y).corners().to_vec();
    Frustum { bottom: outline(below), top: outline(above), low: z.0, high: z.1, finish }
}

/// A round body about the middle, of diameters `below` and `above`.
fn round(sides: usize, below: f64, above: f64, z: (f64, f64), finish: Finish) -> Frustum {
    sided(sides, vec2(0.0, 0.0), (below, below), (above, above), z, finish)
}

fn carton(dice: &mut Dice, side: (f64, f64), height: (f64, f64)) -> Vec<Frustum> {
    let (x, y) = (dice.between(side.0, side.1), dice.between(side.0, side.1));
    vec![solid((x, y), (x, y), (0.0, dice.between(height.0, height.1)), any_finish(dice))]
}

fn basket(dice: &mut Dice, wide: (f64, f64), height: (f64, f64)) -> Vec<Frustum> {
    let wide = dice.between(wide.0, wide.1);
    let finish = any_finish(dice);
    let below = wide * dice.between(0.7, 1.0);
    vec![round(10, below, wide, (0.0, dice.between(height.0, height.1)), finish)]
}

/// A bag, a cushion, a heap of clothes: wide below, rounded off above.
fn bag(dice: &mut Dice, side: (f64, f64), height: (f64, f64)) -> Vec<Frustum> {
    let (x, y) = (dice.between(side.0, side.1), dice.between(0.6 * side.0, side.1));
    let (high, finish) = (dice.between(height.0, height.1), any_finish(dice));
    let (waist, slump) = (0.6 * high, dice.between(0.2, 0.8));
    vec![solid((x, y), (x, y), (0.0, waist), finish), solid((x, y), (x * slump, y * slump), (waist, high), finish)]
}

/// A pot, a stem and some balls of leaves.
fn plant(dice: &mut Dice, height: (f64, f64)) -> Vec<Frustum> {
    let high = dice.between(height.0, height.1);
    let pot = high * dice.between(0.2, 0.4);
    let wide = pot * dice.between(0.7, 1.1);
    let leaf = Finish::new([40, 70, 35].map(|c: u8| (f64::from(c) * dice.between(0.7, 1.6)) as u8), Texture::Cloth);
    let mut parts = vec![round(8, 0.75 * wide, wide, (0.0, pot), any_finish(dice))];
    let (crown, low) = (wide * dice.between(0.8, 1.8), pot + (high - pot) * dice.between(0.0, 0.5));
    parts.push(round(8, 0.03, 0.03, (pot, low + 0.02), leaf));
    let levels = dice.whole(1, 3);
    let step = (high - low) / levels as f64;
    for level in 0..levels {
        let (from, share) = (low + level as f64 * step, dice.between(0.5, 1.0));
        parts.push(round(8, crown * share, crown * share * 0.5, (from, from + step), leaf));
    }
    parts
}

fn books(dice: &mut Dice) -> Vec<Frustum> {
    let mut low = 0.0;
    let mut pile = Vec::new();
    for _ in 0..dice.whole(1, 5) {
        let (x, y, high) = (dice.between(0.12, 0.2), dice.between(0.18, 0.3), dice.between(0.015, 0.05));
        pile.push(solid((x, y), (x, y), (low, low + high), any_finish(dice)));
        low += high;
    }
    pile
}
