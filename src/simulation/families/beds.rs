//! Beds: a mattress on a frame, head at the rear.

use super::finishes::{linen, metal, shade, upholstered, wooden};
use super::parts::{block, cushion, legs};
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// A bed for one or two, with or without headboard and footboard; its foot is its front.
pub fn bed(dice: &mut Dice) -> Vec<Frustum> {
    let w = if dice.chance(0.45) { dice.between(0.8, 1.25) } else { dice.between(1.3, 2.0) } / 2.0;
    let l = if dice.chance(0.1) { dice.between(1.45, 1.85) } else { dice.between(1.85, 2.15) } / 2.0;
    let frame = if dice.chance(0.25) { upholstered(dice) } else { wooden(dice) };
    let top = if dice.chance(0.25) { dice.between(0.6, 0.85) } else { dice.between(0.36, 0.64) };
    let thickest = if top > 0.6 { 0.5 } else { 0.28 };
    let mattress = dice.between(0.14, thickest).min(top - 0.12);
    let rail = top - mattress;
    let mut parts = Vec::new();
    let rim = dice.between(0.0, 0.05);
    if dice.chance(0.35) {
        parts.extend(legs((-l, l), (-w, w), rail, (0.05, 0.07), 0.0, frame));
        parts.push(block((-l, l), (-w - rim, w + rim), (rail - 0.1, rail + 0.02), frame));
    } else {
        parts.push(block((-l, l), (-w - rim, w + rim), (0.0, rail), frame));
    }
    parts.extend(bedding(dice, l, w, (rail, top)));
    if dice.chance(0.25) {
        parts.extend(barred_ends(dice, l, w + rim, top));
    } else {
        parts.extend(boards(dice, l, w + rim, top, frame));
    }
    if dice.chance(0.1) {
        let (from, to) = (dice.between(-0.9, -0.2) * l, dice.between(0.0, 0.9) * l);
        for y in [-w - rim, w + rim - 0.025] {
            let high = top + dice.between(0.1, 0.3);
            parts.push(block((from, to), (y, y + 0.025), (high - 0.12, high), frame));
            parts.push(block((from, from + 0.04), (y, y + 0.025), (rail, high), frame));
            parts.push(block((to - 0.04, to), (y, y + 0.025), (rail, high), frame));
        }
    }
    parts
}

fn bedding(dice: &mut Dice, l: f64, w: f64, z: (f64, f64)) -> Vec<Frustum> {
    let sheet = linen(dice);
    let mut parts = cushion((-l, l), (-w, w), z, 0.03, sheet);
    if dice.chance(0.75) {
        let blanket = linen(dice);
        let thick = dice.between(0.02, 0.08);
        let over = if dice.chance(0.5) { 0.03 } else { 0.0 };
        let to = -l + dice.between(0.4, 0.8);
        parts.push(block((to, l + over), (-w - over, w + over), (z.1 - 0.12, z.1 + thick), blanket));
    }
    let pillows = if w > 0.62 { 2 } else { 1 };
    if dice.chance(0.85) {
        let (finish, each) = (linen(dice), 2.0 * w / f64::from(pillows));
        for i in 0..pillows {
            let from = -w + f64::from(i) * each;
            let y = (from + 0.12 * each, from + 0.88 * each);
            parts.extend(cushion((-l + 0.05, -l + 0.48), y, (z.1, z.1 + dice.between(0.08, 0.16)), 0.06, finish));
        }
    }
    parts
}

fn boards(dice: &mut Dice, l: f64, w: f64, top: f64, frame: Finish) -> Vec<Frustum> {
    let mut parts = Vec::new();
    if dice.chance(0.8) {
        let thick = dice.between(0.03, 0.14);
        let wider = if dice.chance(0.2) { dice.between(0.05, 0.3) } else { 0.0 };
        let high = (top + dice.between(0.1, 0.7)).min(1.4);
        parts.push(block((-l - thick, -l), (-w - wider, w + wider), (0.0, high), frame));
    }
    if dice.chance(0.35) {
        let thick = dice.between(0.03, 0.07);
        let high = top + dice.between(-0.15, 0.3);
        parts.push(block((l + 0.03, l + 0.03 + thick), (-w, w), (0.0, high), shade(frame, 0.95)));
    }
    parts
}

/// Bars of steel or wood at the head, and often at the foot.
fn barred_ends(dice: &mut Dice, l: f64, w: f64, top: f64) -> Vec<Frustum> {
    let finish = if dice.chance(0.7) { metal(dice) } else { wooden(dice) };
    let thick = dice.between(0.02, 0.045);
    let bars = dice.whole(3, 9);
    let mut parts = Vec::new();
    let mut end = |x: f64, high: f64| {
        let x = (x, x + thick);
        for i in 0..=bars {
            let y = -w + (2.0 * w - thick) * i as f64 / bars as f64;
            parts.push(block(x, (y, y + thick), (0.0, high), finish));
        }
        parts.push(block(x, (-w, w), (high - thick, high), finish));
        parts.push(block(x, (-w, w), (0.5 * top, 0.5 * top + thick), finish));
    };
    end(-l - thick, top + dice.between(0.25, 0.75));
    if dice.chance(0.6) {
        end(l, top + dice.between(0.05, 0.4));
    }
    parts
}
