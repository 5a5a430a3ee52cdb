//! Desks: a top on legs or panels, with drawers, a back panel, a rack.

use super::drawers::fronts;
use super::finishes::{metal, shade, wooden};
use super::parts::{block, legs};
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// A desk; its user sits before +x.
pub fn desk(dice: &mut Dice) -> Vec<Frustum> {
    let finish = wooden(dice);
    let (l, w) = (dice.between(0.48, 0.85) / 2.0, dice.between(0.9, 1.8) / 2.0);
    let height = dice.between(0.71, 0.79);
    let thick = dice.between(0.018, 0.045);
    let under = height - thick;
    let mut parts = vec![block((-l, l), (-w, w), (under, height), finish)];
    let pedestals = dice.whole(0, 3);
    let body = if dice.chance(0.7) { finish } else { shade(finish, 0.85) };
    if pedestals == 0 || (pedestals < 3 && dice.chance(0.6)) {
        parts.extend(supports(dice, l, w, under, body));
    }
    let sides: &[f64] = match pedestals {
        0 => &[],
        1 => &[1.0],
        2 => &[-1.0],
        _ => &[-1.0, 1.0],
    };
    for side in sides {
        let wide = dice.between(0.3, 0.45).min(0.8 * w);
        let edge = side * (w - 0.01);
        let y = (edge.min(edge - side * wide), edge.max(edge - side * wide));
        let bottom = if dice.chance(0.3) { 0.1 } else { 0.0 };
        parts.push(block((-l + 0.02, l - 0.03), y, (bottom, under), body));
        parts.extend(fronts(dice, l - 0.03, y, (bottom, under), body));
    }
    if dice.chance(0.5) {
        let low = under - dice.between(0.2, 0.55);
        parts.push(block((-l + 0.02, -l + 0.04), (-w + 0.03, w - 0.03), (low.max(0.0), under), body));
    }
    if dice.chance(0.15) {
        parts.extend(rack(dice, l, w, height, finish));
    }
    parts
}

fn supports(dice: &mut Dice, l: f64, w: f64, under: f64, body: Finish) -> Vec<Frustum> {
    if dice.chance(0.5) {
        let finish = if dice.chance(0.5) { metal(dice) } else { body };
        let thick = dice.between(0.025, 0.07);
        return legs((-l, l), (-w, w), under, (thick, thick), 0.0, finish);
    }
    let thick = dice.between(0.018, 0.04);
    vec![
        block((-l + 0.01, l - 0.01), (-w + 0.01, -w + 0.01 + thick), (0.0, under), body),
        block((-l + 0.01, l - 0.01), (w - 0.01 - thick, w - 0.01), (0.0, under), body),
    ]
}

/// A rack of shelves on the rear of the top.
fn rack(dice: &mut Dice, l: f64, w: f64, height: f64, finish: Finish) -> Vec<Frustum> {
    let (deep, tall) = (dice.between(0.2, 0.3), dice.between(0.25, 0.6));
    let x = (-l, -l + deep);
    vec![
        block((-l, -l + 0.015), (-w, w), (height, height + tall), finish),
        block(x, (-w, -w + 0.02), (height, height + tall), finish),
        block(x, (w - 0.02, w), (height, height + tall), finish),
        block(x, (-w, w), (height + tall - 0.02, height + tall), finish),
    ]
}
