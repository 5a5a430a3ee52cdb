//! Tables of all shapes and heights.

use super::finishes::{metal, shade, wooden};
use super::parts::{Span, bar, block, legs, round, sided};
use crate::geometry::vec2;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// The outline of a top.
#[derive(Clone, Copy, PartialEq)]
enum Outline {
    Rectangle,
    Round,
    Hexagon,
}

/// A dining, kitchen, side or bar table.
pub fn table(dice: &mut Dice) -> Vec<Frustum> {
    match dice.whole(0, 9) {
        0..=5 => dining_table(dice),
        6..=8 => side_table(dice),
        _ => {
            let side = dice.between(0.55, 0.8);
            let height = dice.between(0.9, 1.08);
            let outline = dice.pick(&[Outline::Round, Outline::Rectangle]);
            of_size(dice, outline, (side, side), height)
        }
    }
}

fn dining_table(dice: &mut Dice) -> Vec<Frustum> {
    let height = dice.between(0.7, 0.78);
    match dice.whole(0, 9) {
        0..=5 => {
            let (length, width) = (dice.between(1.05, 2.2), dice.between(0.68, 1.05));
            of_size(dice, Outline::Rectangle, (width.min(length), length), height)
        }
        6 => {
            let side = dice.between(0.65, 1.0);
            let other = side * dice.between(0.95, 1.05);
            of_size(dice, Outline::Rectangle, (side, other), height)
        }
        7 | 8 => {
            let width = dice.between(0.7, 1.35);
            let longer = if dice.chance(0.3) { dice.between(1.1, 1.6) } else { 1.0 };
            of_size(dice, Outline::Round, (width, width * longer), height)
        }
        _ => {
            let side = dice.between(0.8, 1.2);
            let height = dice.between(0.5, 0.77);
            of_size(dice, Outline::Hexagon, (side, 0.866 * side), height)
        }
    }
}

fn side_table(dice: &mut Dice) -> Vec<Frustum> {
    let side = dice.between(0.35, 0.7);
    let height = dice.between(0.45, 0.66);
    let outline = dice.pick(&[Outline::Round, Outline::Rectangle, Outline::Round]);
    let longer = if outline == Outline::Rectangle { dice.between(0.85, 1.3) } else { 1.0 };
    of_size(dice, outline, (side, side * longer), height)
}

/// A low table before a couch.
pub fn coffee_table(dice: &mut Dice) -> Vec<Frustum> {
    let height = dice.about(0.3, 0.54);
    if dice.chance(0.25) {
        let width = dice.between(0.6, 1.05);
        return of_size(dice, Outline::Round, (width, width), height);
    }
    let (length, width) = (dice.between(0.6, 1.35), dice.between(0.45, 0.8));
    let mut parts = of_size(dice, Outline::Rectangle, (width.min(length), length), height);
    if dice.chance(0.4) {
        let finish = parts[0].finish;
        let (l, w) = (width.min(length) / 2.0 - 0.04, length / 2.0 - 0.04);
        let low = dice.between(0.08, 0.16);
        parts.push(block((-l, l), (-w, w), (low, low + 0.02), finish));
    }
    parts
}

/// A top of `size` (along x, along y) at `height`, on a support that suits it.
fn of_size(dice: &mut Dice, outline: Outline, size: (f64, f64), height: f64) -> Vec<Frustum> {
    let finish = wooden(dice);
    let thick = dice.between(0.015, 0.05);
    let top = match outline {
        Outline::Rectangle => {
            block((-size.0 / 2.0, size.0 / 2.0), (-size.1 / 2.0, size.1 / 2.0), (height - thick, height), finish)
        }
        Outline::Round => round(vec2(0.0, 0.0), size, size, (height - thick, height), finish),
        Outline::Hexagon => sided(6, vec2(0.0, 0.0), size, size, (height - thick, height), finish),
    };
    let mut parts = vec![top];
    let under = height - thick;
    match (outline, dice.whole(0, 9)) {
        (Outline::Rectangle, 0..=5) => parts.extend(four_legs(dice, size, under, 1.0)),
        (Outline::Rectangle, 6 | 7) => parts.extend(trestles(dice, size, under, finish)),
        (Outline::Rectangle, 8) if height < 0.6 => parts.push(box_body(size, under, finish)),
        (Outline::Round | Outline::Hexagon, 0..=4) => parts.extend(four_legs(dice, size, under, 0.72)),
        _ => parts.extend(pedestal(dice, size, under)),
    }
    parts
}

/// Four legs, sometimes with an apron under the top; `share` of the top's size apart.
fn four_legs(dice: &mut Dice, size: (f64, f64), under: f64, share: f64) -> Vec<Frustum> {
    let finish = if dice.chance(0.3) { metal(dice) } else { wooden(dice) };
    let inset = if dice.chance(0.4) { dice.between(0.02, 0.1) } else { 0.0 };
    let (l, w) = (share * size.0 / 2.0 - inset, share * size.1 / 2.0 - inset);
    let thick = dice.between(0.025, 0.09);
    let taper = if dice.chance(0.4) { 0.5 } else { 1.0 };
    let splay = if dice.chance(0.2) { dice.between(0.02, 0.08) } else { 0.0 };
    let mut parts = legs((-l, l), (-w, w), under, (thick * taper, thick), splay, finish);
    if dice.chance(0.5) {
        let deep = dice.between(0.05, 0.12);
        let (l, w) = (l - splay - thick / 2.0, w - splay - thick / 2.0);
        let z: Span = (under - deep, under);
        for side in [-1.0, 1.0] {
            parts.push(block((side * l - 0.01, side * l + 0.01), (-w, w), z, finish));
            parts.push(block((-l, l), (side * w - 0.01, side * w + 0.01), z, finish));
        }
    }
    parts
}

/// A panel or a trestle near either end.
fn trestles(dice: &mut Dice, size: (f64, f64), under: f64, finish: Finish) -> Vec<Frustum> {
    let deep = size.0 * dice.between(0.5, 0.95) / 2.0;
    let at = size.1 / 2.0 * dice.between(0.6, 0.95);
    let thick = dice.between(0.02, 0.08);
    let mut parts: Vec<Frustum> = [-1.0, 1.0]
        .map(|side| block((-deep, deep), (side * at - thick / 2.0, side * at + thick / 2.0), (0.0, under), finish))
        .to_vec();
    if dice.chance(0.5) {
        parts.push(block((-0.02, 0.02), (-at, at), (0.2 * under, 0.35 * under), shade(finish, 0.85)));
    }
    parts
}

fn box_body(size: (f64, f64), under: f64, finish: Finish) -> Frustum {
    let (l, w) = (size.0 / 2.0 - 0.03, size.1 / 2.0 - 0.03);
    block((-l, l), (-w, w), (0.0, under), shade(finish, 0.85))
}

/// A column on a foot or on a cross.
fn pedestal(dice: &mut Dice, size: (f64, f64), under: f64) -> Vec<Frustum> {
    let finish = if dice.chance(0.5) { metal(dice) } else { wooden(dice) };
    let (origin, small) = (vec2(0.0, 0.0), size.0.min(size.1));
    let thick = dice.between(0.05, 0.14);
    let spread = small * dice.between(0.4, 0.7);
    let mut parts = vec![round(origin, (thick, thick), (thick, thick), (0.02, under), finish)];
    if dice.chance(0.6) {
        parts.push(round(origin, (spread, spread), (0.6 * spread, 0.6 * spread), (0.0, 0.04), finish));
    } else {
        for end in [vec2(spread, 0.0), vec2(-spread, 0.0), vec2(0.0, spread), vec2(0.0, -spread)] {
            parts.push(bar(end * 0.55, origin, (0.05, 0.06), (0.0, 0.25 * under), finish));
        }
    }
    parts
}
