//! Dining chairs, office chairs and stools.

use super::finishes::{metal, upholstered, wooden};
use super::parts::{Span, bar, block, cushion, leaning, legs, round};
use crate::geometry::vec2;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// A chair for a table or a desk.
pub fn chair(dice: &mut Dice) -> Vec<Frustum> {
    if dice.chance(0.25) { office_chair(dice) } else { dining_chair(dice) }
}

/// The measures of a seat with a back.
struct Seat {
    l: f64,
    w: f64,
    height: f64,
    top: f64,
    lean: f64,
}

fn dining_chair(dice: &mut Dice) -> Vec<Frustum> {
    let wood = if dice.chance(0.2) { metal(dice) } else { wooden(dice) };
    let seat_finish = if dice.chance(0.45) { upholstered(dice) } else { wood };
    let seat = Seat {
        l: dice.between(0.38, 0.52) / 2.0,
        w: dice.between(0.36, 0.54) / 2.0,
        height: dice.between(0.42, 0.49),
        top: dice.between(0.74, 1.1),
        lean: dice.between(0.0, 0.12),
    };
    let thick = dice.between(0.025, 0.08);
    let splay = if dice.chance(0.3) { 0.05 } else { 0.0 };
    let taper = dice.between(0.5, 1.0);
    let leg = dice.between(0.022, 0.05);
    let (x, y) = ((-seat.l, seat.l), (-seat.w, seat.w));
    let mut parts = if dice.chance(0.15) {
        cantilever(&seat, leg, wood)
    } else {
        legs(x, y, seat.height - thick, (leg * taper, leg), splay, wood)
    };
    parts.extend(cushion(x, y, (seat.height - thick, seat.height), 0.01, seat_finish));
    parts.extend(back(dice, &seat, wood, seat_finish));
    if dice.chance(0.2) {
        parts.extend(arms(&seat, dice.between(0.18, 0.24), wood));
    }
    parts
}

/// Two tubes in front and on the floor, none behind.
fn cantilever(seat: &Seat, thick: f64, finish: Finish) -> Vec<Frustum> {
    let t = thick.min(0.03);
    [-seat.w, seat.w - t]
        .into_iter()
        .flat_map(|y| {
            [
                block((seat.l - t, seat.l), (y, y + t), (0.0, seat.height - 0.02), finish),
                block((-seat.l, seat.l), (y, y + t), (0.0, t), finish),
            ]
        })
        .collect()
}

/// A full panel, a frame with slats, or rails.
fn back(dice: &mut Dice, seat: &Seat, wood: Finish, cloth: Finish) -> Vec<Frustum> {
    let thick = dice.between(0.015, 0.06);
    let z = (seat.height, seat.top);
    let at = |share: f64, y: Span, finish: Finish| {
        let (low, high) = (z.0 + share * (z.1 - z.0), z.1);
        let below = -seat.l - share * seat.lean;
        leaning((below, below + thick), (-seat.l - seat.lean, -seat.l - seat.lean + thick), y, (low, high), finish)
    };
    if dice.chance(0.5) {
        let free = if dice.chance(0.4) { 0.0 } else { dice.between(0.1, 0.6) };
        let mut parts = vec![at(free, (-seat.w, seat.w), cloth)];
        if free > 0.0 {
            parts.extend(posts(seat, thick, wood));
        }
        return parts;
    }
    let mut parts = posts(seat, thick, wood);
    parts.push(at(dice.between(0.75, 0.88), (-seat.w, seat.w), wood));
    let slats = dice.whole(2, 6);
    let wide = dice.between(0.015, 0.06);
    for i in 0..slats {
        let middle = -seat.w + 2.0 * seat.w * (i + 1) as f64 / (slats + 1) as f64;
        let mut slat = at(0.0, (middle - wide / 2.0, middle + wide / 2.0), wood);
        slat.high -= 0.02;
        parts.push(slat);
    }
    parts
}

fn posts(seat: &Seat, thick: f64, finish: Finish) -> Vec<Frustum> {
    let half = thick / 2.0;
    [-seat.w + half, seat.w - half]
        .map(|y| {
            let (foot, head) = (vec2(-seat.l + half, y), vec2(-seat.l - seat.lean + half, y));
            bar(foot, head, (thick, thick), (seat.height, seat.top), finish)
        })
        .to_vec()
}

fn arms(seat: &Seat, above: f64, finish: Finish) -> Vec<Frustum> {
    let (low, high) = (seat.height + above - 0.03, seat.height + above);
    [-seat.w, seat.w - 0.04]
        .into_iter()
        .flat_map(|y| {
            [
                block((-seat.l, 0.7 * seat.l), (y, y + 0.04), (low, high), finish),
                block((0.7 * seat.l - 0.03, 0.7 * seat.l), (y, y + 0.04), (seat.height, low), finish),
            ]
        })
        .collect()
}

fn office_chair(dice: &mut Dice) -> Vec<Frustum> {
    let (cloth, steel) = (upholstered(dice), metal(dice));
    let seat = Seat {
        l: dice.between(0.42, 0.52) / 2.0,
        w: dice.between(0.42, 0.54) / 2.0,
        height: dice.between(0.42, 0.54),
        top: dice.between(0.8, 1.25),
        lean: dice.between(0.03, 0.12),
    };
    let origin = vec2(0.0, 0.0);
    let spread = dice.between(0.26, 0.34);
    let turn = dice.between(0.0, 1.2);
    let mut parts: Vec<Frustum> = (0..5)
        .flat_map(|i| {
            let angle = turn + std::f64::consts::TAU * f64::from(i) / 5.0;
            let end = vec2(angle.cos(), angle.sin()) * spread;
            [
                bar(end * 0.8, origin, (0.05, 0.06), (0.05, 0.12), steel),
                round(end, (0.06, 0.06), (0.05, 0.05), (0.0, 0.06), steel),
            ]
        })
        .collect();
    parts.push(round(origin, (0.06, 0.06), (0.05, 0.05), (0.1, seat.height - 0.07), steel));
    let thick = dice.between(0.05, 0.1);
    parts.extend(cushion((-seat.l, seat.l), (-seat.w, seat.w), (seat.height - thick, seat.height), 0.03, cloth));
    let free = dice.between(0.0, 0.2);
    let narrow = dice.between(0.75, 1.0) * seat.w;
    let rear = -seat.l - seat.lean;
    parts.push(leaning(
        (-seat.l, -seat.l + 0.07),
        (rear, rear + 0.06),
        (-narrow, narrow),
        (seat.height + free, seat.top),
        cloth,
    ));
    parts.push(block((-seat.l, -seat.l + 0.03), (-0.05, 0.05), (seat.height - 0.05, seat.height + free + 0.05), steel));
    if dice.chance(0.6) {
        parts.extend(arms(&seat, dice.between(0.18, 0.25), steel));
    }
    parts
}

/// A stool, low or at a bar, or a bench without a back.
pub fn stool(dice: &mut Dice) -> Vec<Frustum> {
    if dice.chance(0.12) {
        return bench(dice);
    }
    let height = if dice.chance(0.3) { dice.between(0.6, 0.8) } else { dice.between(0.38, 0.52) };
    let side = dice.between(0.28, 0.46);
    let finish = if dice.chance(0.4) { upholstered(dice) } else { wooden(dice) };
    let frame = if dice.chance(0.5) { metal(dice) } else { wooden(dice) };
    let (thick, origin) = (dice.between(0.025, 0.09), vec2(0.0, 0.0));
    let is_round = dice.chance(0.6);
    let z = (height - thick, height);
    let half = side / 2.0;
    let mut parts = if is_round {
        vec![round(origin, (side, side), (side, side), z, finish)]
    } else {
        cushion((-half, half), (-half, half), z, 0.01, finish)
    };
    if dice.chance(0.25) {
        parts.push(round(origin, (0.05, 0.05), (0.05, 0.05), (0.02, z.0), frame));
        parts.push(round(origin, (0.9 * side, 0.9 * side), (0.5 * side, 0.5 * side), (0.0, 0.03), frame));
    } else {
        let reach = if is_round { 0.68 * half } else { half };
        let splay = if dice.chance(0.4) { 0.05 } else { 0.0 };
        parts.extend(legs(
            (-reach - splay, reach + splay),
            (-reach - splay, reach + splay),
            z.0,
            (0.03, 0.035),
            splay,
            frame,
        ));
    }
    parts
}

fn bench(dice: &mut Dice) -> Vec<Frustum> {
    let (l, w) = (dice.between(0.28, 0.5) / 2.0, dice.between(0.85, 1.4) / 2.0);
    let height = dice.between(0.4, 0.5);
    let finish = if dice.chance(0.4) { upholstered(dice) } else { wooden(dice) };
    let frame = if dice.chance(0.3) { metal(dice) } else { wooden(dice) };
    let under = height - dice.between(0.03, 0.12);
    let mut parts = cushion((-l, l), (-w, w), (under, height), 0.01, finish);
    parts.extend(legs((-l, l), (-w, w), under, (0.03, 0.05), 0.0, frame));
    parts
}
