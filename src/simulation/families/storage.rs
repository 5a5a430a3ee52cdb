//! Wardrobes, dressers, shelves, cabinets, tv stands and nightstands.

use super::drawers::fronts;
use super::finishes::{gaudy, metal, shade, wooden};
use super::parts::{Span, block, legs};
use super::vanity;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// Half a length, half a width, and the height of a body.
struct Body {
    l: f64,
    w: f64,
    top: f64,
}

fn body(dice: &mut Dice, length: Span, width: Span, height: Span) -> Body {
    Body {
        l: dice.between(length.0, length.1) / 2.0,
        w: dice.between(width.0, width.1) / 2.0,
        top: dice.between(height.0, height.1),
    }
}

/// A wardrobe with doors.
pub fn wardrobe(dice: &mut Dice) -> Vec<Frustum> {
    let size = body(dice, (0.5, 0.68), (0.6, 2.5), (1.7, 2.4));
    let finish = wooden(dice);
    let mut parts = vec![block((-size.l, size.l), (-size.w, size.w), (0.0, size.top), finish)];
    let doors = ((2.0 * size.w / 0.5).round() as usize).max(1);
    parts.extend(doors_on(dice, size.l, (-size.w, size.w), (0.05, size.top - 0.04), doors, finish));
    if dice.chance(0.25) {
        let over = dice.between(0.02, 0.06);
        let crown = (-size.l, size.l + over);
        parts.push(block(crown, (-size.w - over, size.w + over), (size.top - 0.06, size.top), shade(finish, 0.9)));
    }
    parts
}

/// A chest of drawers, with or without a mirror, or a dressing table.
pub fn dresser(dice: &mut Dice) -> Vec<Frustum> {
    if dice.chance(0.25) {
        return vanity::dressing_table(dice);
    }
    let size = body(dice, (0.38, 0.56), (0.6, 1.65), (0.68, 1.22));
    let mut parts = drawered(dice, &size);
    if dice.chance(0.15) {
        parts.extend(vanity::mirror(dice, size.l, size.w, size.top));
    }
    parts
}

/// A small chest or table beside a bed.
pub fn nightstand(dice: &mut Dice) -> Vec<Frustum> {
    let wide = if dice.chance(0.15) { (0.6, 0.9) } else { (0.34, 0.62) };
    let size = body(dice, (0.28, 0.5), wide, (0.4, 0.76));
    if dice.chance(0.7) {
        return drawered(dice, &size);
    }
    let finish = wooden(dice);
    let (l, w, top) = (size.l, size.w, size.top);
    let drawer = dice.between(0.1, 0.22);
    let mut parts = legs((-l, l), (-w, w), top - drawer, (0.03, 0.04), 0.0, finish);
    parts.push(block((-l, l), (-w, w), (top - drawer, top), finish));
    parts.extend(fronts(dice, l, (-w, w), (top - drawer, top - 0.02), finish));
    if dice.chance(0.5) {
        parts.push(block((-l, l), (-w, w), (0.12, 0.14), finish));
    }
    parts
}

/// A closed body on the floor, a plinth or feet, with drawers, and a top that may stand out.
fn drawered(dice: &mut Dice, size: &Body) -> Vec<Frustum> {
    let finish = wooden(dice);
    let (l, w, top) = (size.l, size.w, size.top);
    let low = if dice.chance(0.45) { dice.between(0.06, 0.2) } else { 0.0 };
    let over = if dice.chance(0.4) { 0.02 } else { 0.0 };
    let mut parts = vec![
        block((-l, l), (-w, w), (low, top - 0.02), finish),
        block((-l, l + over), (-w - over, w + over), (top - 0.025, top), shade(finish, 1.05)),
    ];
    if low > 0.0 {
        let feet = if dice.chance(0.3) { metal(dice) } else { finish };
        parts.extend(legs((-l, l), (-w, w), low, (0.03, 0.05), 0.0, feet));
    }
    parts.extend(fronts(dice, l, (-w, w), (low + 0.02, top - 0.03), finish));
    parts
}

/// Doors side by side on the face at x.
fn doors_on(dice: &mut Dice, x: f64, y: Span, z: Span, count: usize, finish: Finish) -> Vec<Frustum> {
    let face = shade(finish, dice.pick(&[0.94, 1.0, 1.06]));
    let knob = metal(dice);
    let wide = (y.1 - y.0) / count as f64;
    (0..count)
        .flat_map(|i| {
            let (from, to) = (y.0 + i as f64 * wide + 0.006, y.0 + (i + 1) as f64 * wide - 0.006);
            let handle = if i % 2 == 0 { to - 0.05 } else { from + 0.05 };
            let level = z.0 + 0.5 * (z.1 - z.0);
            [
                block((x, x + 0.018), (from, to), z, face),
                block((x + 0.018, x + 0.04), (handle - 0.01, handle + 0.01), (level - 0.08, level + 0.08), knob),
            ]
        })
        .collect()
}

/// A bookcase with books.
pub fn bookshelf(dice: &mut Dice) -> Vec<Frustum> {
    let size = body(dice, (0.24, 0.42), (0.4, 1.5), (1.1, 2.25));
    let full = dice.between(0.4, 1.0);
    open_case(dice, &size, true, full)
}

/// An open shelf with little in it.
pub fn shelf(dice: &mut Dice) -> Vec<Frustum> {
    let size = body(dice, (0.25, 0.45), (0.4, 1.6), (0.7, 2.0));
    let backed = dice.chance(0.4);
    let full = dice.between(0.0, 0.4);
    open_case(dice, &size, backed, full)
}

fn open_case(dice: &mut Dice, size: &Body, backed: bool, full: f64) -> Vec<Frustum> {
    let finish = wooden(dice);
    let (l, w, top) = (size.l, size.w, size.top);
    let board = dice.between(0.016, 0.035);
    let mut parts =
        vec![block((-l, l), (-w, -w + board), (0.0, top), finish), block((-l, l), (w - board, w), (0.0, top), finish)];
    if backed {
        parts.push(block((-l, -l + 0.008), (-w, w), (0.0, top), shade(finish, 0.8)));
    }
    let levels = ((top / dice.between(0.28, 0.42)).round() as usize).max(2);
    let plinth = dice.between(0.0, 0.1);
    let closed = if dice.chance(0.2) { dice.whole(1, 2).min(levels) } else { 0 };
    for level in 0..=levels {
        let at = plinth + (top - plinth - board) * level as f64 / levels as f64;
        parts.push(block((-l, l), (-w + board, w - board), (at, at + board), finish));
        if level < levels && level >= closed {
            let room = (top - plinth - board) / levels as f64 - board;
            parts.extend(books(dice, size, (at + board, at + board + room), full));
        }
    }
    if closed > 0 {
        let high = plinth + (top - plinth) * closed as f64 / levels as f64;
        parts.extend(doors_on(dice, l - 0.02, (-w, w), (plinth, high), 2, finish));
    }
    parts
}

/// Runs of books on one board.
fn books(dice: &mut Dice, size: &Body, z: Span, full: f64) -> Vec<Frustum> {
    let mut parts = Vec::new();
    let mut y = -size.w + 0.04;
    while y < size.w - 0.1 {
        let wide = dice.between(0.05, 0.3).min(size.w - 0.04 - y);
        if dice.chance(full) {
            let high = z.0 + (z.1 - z.0) * dice.between(0.5, 0.95);
            let deep = (2.0 * size.l - 0.02) * dice.between(0.6, 0.95);
            parts.push(block((-size.l + 0.01, -size.l + 0.01 + deep), (y, y + wide), (z.0, high), gaudy(dice)));
        }
        y += wide + 0.005;
    }
    parts
}

/// A cabinet or sideboard with doors.
pub fn cabinet(dice: &mut Dice) -> Vec<Frustum> {
    let tall = dice.chance(0.25);
    let size = if tall {
        body(dice, (0.32, 0.5), (0.4, 1.1), (1.25, 2.0))
    } else {
        body(dice, (0.32, 0.62), (0.5, 1.8), (0.65, 1.2))
    };
    let finish = wooden(dice);
    let (l, w, top) = (size.l, size.w, size.top);
    let low = if dice.chance(0.4) { dice.between(0.05, 0.18) } else { 0.0 };
    let mut parts = vec![block((-l, l), (-w, w), (low, top), finish)];
    if low > 0.0 {
        parts.extend(legs((-l, l), (-w, w), low, (0.03, 0.05), 0.0, finish));
    }
    let doors = ((2.0 * w / 0.45).round() as usize).max(1);
    let split = if !tall && dice.chance(0.4) { top - 0.2 } else { top - 0.03 };
    parts.extend(doors_on(dice, l, (-w, w), (low + 0.03, split), doors, finish));
    if split < top - 0.1 {
        parts.extend(fronts(dice, l, (-w, w), (split, top - 0.03), finish));
    }
    parts
}

/// A low body for a television.
pub fn tv_stand(dice: &mut Dice) -> Vec<Frustum> {
    let size = body(dice, (0.34, 0.55), (0.8, 2.1), (0.32, 0.68));
    let finish = wooden(dice);
    let (l, w, top) = (size.l, size.w, size.top);
    let board = dice.between(0.018, 0.04);
    let low = if dice.chance(0.5) { dice.between(0.04, 0.18) } else { 0.0 };
    let mut parts = vec![
        block((-l, l), (-w, w), (top - board, top), finish),
        block((-l, l), (-w, w), (low, low + board), finish),
        block((-l, -l + 0.01), (-w, w), (low, top), shade(finish, 0.8)),
    ];
    let bays = dice.whole(2, 4);
    let wide = 2.0 * w / bays as f64;
    for bay in 0..bays {
        let y = (-w + bay as f64 * wide, -w + (bay + 1) as f64 * wide);
        parts.push(block((-l, l), (y.0, y.0 + board), (low, top), finish));
        if dice.chance(0.55) {
            parts.push(block((-l, l - 0.02), y, (low, top), finish));
            parts.extend(fronts(dice, l - 0.02, y, (low + board, top - board), finish));
        }
    }
    parts.push(block((-l, l), (w - board, w), (low, top), finish));
    if low > 0.0 {
        parts.extend(legs((-l, l), (-w, w), low, (0.03, 0.05), 0.0, finish));
    }
    parts
}
