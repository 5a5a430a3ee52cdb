//! Armchairs and couches: a seat between arms, before a back.

use super::finishes::{metal, shade, upholstered, wooden};
use super::parts::{Span, block, cushion, leaning, legs};
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// The measures of an upholstered seat.
struct Sofa {
    depth: f64,
    /// Between the arms.
    seat_width: f64,
    seat: f64,
    arm: f64,
    arm_width: f64,
    back: f64,
    back_thick: f64,
    lean: f64,
    foot: f64,
    seats: usize,
    /// How far the arms roll out over their sides.
    roll: f64,
}

impl Sofa {
    /// One shell around the seat.
    fn with_arms_as_high_as_the_back(self) -> Self {
        let back = self.back.min(0.84);
        Self { arm: back - 0.005, arm_width: self.arm_width.max(0.1), back, lean: 0.0, ..self }
    }
}

fn rolled(dice: &mut Dice) -> f64 {
    if dice.chance(0.2) { dice.between(0.03, 0.1) } else { 0.0 }
}

/// An armchair.
pub fn armchair(dice: &mut Dice) -> Vec<Frustum> {
    let sofa = Sofa {
        depth: dice.between(0.58, 0.98),
        seat_width: dice.between(0.45, 0.7),
        seat: dice.between(0.37, 0.48),
        arm: dice.between(0.52, 0.68),
        arm_width: dice.between(0.04, 0.22),
        back: dice.between(0.68, 1.08),
        back_thick: dice.between(0.08, 0.24),
        lean: dice.between(0.0, 0.16),
        foot: if dice.chance(0.5) { dice.between(0.05, 0.2) } else { 0.0 },
        seats: 1,
        roll: rolled(dice),
    };
    let sofa = if dice.chance(0.15) { sofa.with_arms_as_high_as_the_back() } else { sofa };
    if sofa.arm_width < 0.08 { framed(dice, &sofa) } else { upholstered_sofa(dice, &sofa) }
}

/// A couch with one to four seats, sometimes with a long seat at one end.
pub fn couch(dice: &mut Dice) -> Vec<Frustum> {
    let seats = dice.pick(&[1, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 4, 4]);
    let each = if seats == 1 { dice.between(0.8, 1.05) } else { dice.between(0.52, 0.78) };
    let armless = dice.chance(0.08);
    let sofa = Sofa {
        depth: dice.between(0.7, 1.05),
        seat_width: each * seats as f64,
        seat: dice.between(0.36, 0.48),
        arm: dice.between(0.5, 0.68),
        arm_width: if armless { 0.0 } else { dice.between(0.1, 0.28) },
        back: dice.between(0.64, 1.0),
        back_thick: dice.between(0.12, 0.28),
        lean: dice.between(0.0, 0.14),
        foot: if dice.chance(0.5) { dice.between(0.04, 0.16) } else { 0.0 },
        seats,
        roll: rolled(dice),
    };
    let sofa = if !armless && dice.chance(0.12) { sofa.with_arms_as_high_as_the_back() } else { sofa };
    let mut parts = upholstered_sofa(dice, &sofa);
    if seats >= 3 && dice.chance(0.3) {
        parts.extend(long_seat(dice, &sofa, parts[0].finish));
    }
    parts
}

fn upholstered_sofa(dice: &mut Dice, sofa: &Sofa) -> Vec<Frustum> {
    let finish = upholstered(dice);
    let (l, w) = (sofa.depth / 2.0, sofa.seat_width / 2.0);
    let base = sofa.seat * 0.6;
    let rear = -l + sofa.back_thick;
    let mut parts = vec![block((-l, l), (-w, w), (sofa.foot, base), finish)];
    let each = sofa.seat_width / sofa.seats as f64;
    let soft = if dice.chance(0.8) { finish } else { upholstered(dice) };
    for i in 0..sofa.seats {
        let y: Span = (-w + i as f64 * each + 0.005, -w + (i + 1) as f64 * each - 0.005);
        parts.extend(cushion((rear, l), y, (base, sofa.seat), 0.02, soft));
        if dice.chance(0.6) {
            let high = sofa.back - dice.between(-0.03, 0.1);
            parts.push(leaning((rear, rear + 0.16), (rear - 0.05, rear + 0.06), y, (sofa.seat, high), soft));
        }
    }
    let full = w + sofa.arm_width;
    let lean = sofa.lean;
    parts.push(leaning((-l, rear), (-l - lean, rear - lean), (-full, full), (sofa.foot, sofa.back), finish));
    if sofa.arm_width > 0.0 {
        let front = if dice.chance(0.3) { l - 0.08 } else { l };
        for y in [(-full, -w), (w, full)] {
            parts.extend(cushion((-l, front), y, (sofa.foot, sofa.arm), 0.015, finish));
            if sofa.roll > 0.0 {
                let out = if y.0 < 0.0 { (y.0 - sofa.roll, y.1) } else { (y.0, y.1 + sofa.roll) };
                parts.extend(cushion((-l, front + 0.02), out, (sofa.arm - 0.16, sofa.arm), 0.03, finish));
            }
        }
    }
    if sofa.foot > 0.0 {
        let feet = if dice.chance(0.5) { metal(dice) } else { wooden(dice) };
        parts.extend(legs((-l, l), (-full, full), sofa.foot, (0.04, 0.05), 0.0, feet));
    }
    if sofa.seats > 1 && dice.chance(0.4) {
        parts.extend(pillow(dice, rear, w, sofa.seat));
    }
    parts
}

fn pillow(dice: &mut Dice, rear: f64, w: f64, seat: f64) -> Vec<Frustum> {
    let finish = upholstered(dice);
    let y = dice.pick(&[-1.0, 1.0]) * (w - 0.25);
    vec![leaning(
        (rear + 0.12, rear + 0.24),
        (rear + 0.02, rear + 0.12),
        (y - 0.2, y + 0.2),
        (seat, seat + 0.36),
        finish,
    )]
}

/// The long seat of an L-shaped couch.
fn long_seat(dice: &mut Dice, sofa: &Sofa, finish: Finish) -> Vec<Frustum> {
    let (l, w) = (sofa.depth / 2.0, sofa.seat_width / 2.0);
    let side = dice.pick(&[-1.0, 1.0]);
    let wide = dice.between(0.65, 0.9);
    let edge = side * (w + sofa.arm_width);
    let y = (edge.min(edge - side * wide), edge.max(edge - side * wide));
    let longer = dice.between(0.45, 0.9);
    let mut parts = vec![block((l, l + longer), y, (sofa.foot, 0.6 * sofa.seat), finish)];
    parts.extend(cushion((l - 0.02, l + longer), y, (0.6 * sofa.seat, sofa.seat), 0.02, finish));
    parts
}

/// A wooden or steel frame with two cushions.
fn framed(dice: &mut Dice, sofa: &Sofa) -> Vec<Frustum> {
    let frame = if dice.chance(0.3) { metal(dice) } else { wooden(dice) };
    let cloth = upholstered(dice);
    let (l, w, t) = (sofa.depth / 2.0, sofa.seat_width / 2.0, sofa.arm_width);
    let full = w + t;
    let mut parts = Vec::new();
    for y in [(-full, -w), (w, full)] {
        parts.push(block((-l, l), y, (sofa.arm - 0.035, sofa.arm), frame));
        parts.push(block((l - 0.05, l), y, (0.0, sofa.arm - 0.035), frame));
        parts.push(block((-l, -l + 0.05), y, (0.0, sofa.arm - 0.035), frame));
    }
    parts.push(block((-l, l), (-w, w), (sofa.seat - 0.16, sofa.seat - 0.12), shade(frame, 0.9)));
    parts.extend(cushion((-l + 0.05, l), (-w, w), (sofa.seat - 0.12, sofa.seat), 0.02, cloth));
    let rear = -l - sofa.lean;
    parts.push(leaning((-l, -l + 0.14), (rear, rear + 0.1), (-w, w), (sofa.seat - 0.05, sofa.back), cloth));
    parts
}
