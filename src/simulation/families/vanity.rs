//! Dressing tables, and the mirrors on them and on chests of drawers.

use super::drawers::fronts;
use super::finishes::{shade, wooden};
use super::parts::{block, legs, sided};
use crate::geometry::vec2;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum, Texture};

/// A narrow table with drawers under its top and a mirror over its rear.
pub fn dressing_table(dice: &mut Dice) -> Vec<Frustum> {
    let finish = wooden(dice);
    let (l, w) = (dice.between(0.36, 0.52) / 2.0, dice.between(0.7, 1.25) / 2.0);
    let top = dice.between(0.7, 0.82);
    let drawer = top - dice.between(0.1, 0.22);
    let mut parts = vec![block((-l, l), (-w, w), (drawer, top), finish)];
    parts.extend(fronts(dice, l, (-w, w), (drawer, top - 0.02), finish));
    if dice.chance(0.6) {
        parts.extend(legs((-l, l), (-w, w), drawer, (0.03, 0.05), 0.0, finish));
    } else {
        let wide = dice.between(0.25, 0.35) * w;
        for y in [(-w, -w + 2.0 * wide), (w - 2.0 * wide, w)] {
            parts.push(block((-l, l), y, (0.0, drawer), finish));
            parts.extend(fronts(dice, l, y, (0.02, drawer), finish));
        }
    }
    if dice.chance(0.5) {
        let (deep, tall) = (dice.between(0.12, 0.2), dice.between(0.08, 0.2));
        parts.push(block((-l, -l + deep), (-w, w), (top, top + tall), finish));
    }
    parts.extend(mirror(dice, l, w, top));
    parts
}

/// One or three mirrors that stand on the rear of a top: cold, and often without depth.
pub fn mirror(dice: &mut Dice, l: f64, w: f64, top: f64) -> Vec<Frustum> {
    let frame = wooden(dice);
    let glass = Finish::new([168, 176, 182], Texture::Plain);
    let (tall, thick) = (dice.between(0.4, 0.85), dice.between(0.02, 0.05));
    let half = w * dice.between(0.35, 0.95);
    let low = top + dice.between(0.0, 0.15);
    let x = (-l, -l + thick);
    let mut parts = vec![block(x, (-half, half), (low, low + tall), shade(frame, 0.95))];
    parts.push(block((x.1, x.1 + 0.004), (-half + 0.04, half - 0.04), (low + 0.04, low + tall - 0.04), glass));
    if low > top + 0.02 {
        for side in [-half, half - 0.03] {
            parts.push(block(x, (side, side + 0.03), (top, low + 0.5 * tall), frame));
        }
    }
    if dice.chance(0.2) {
        let ring =
            sided(8, vec2(-l + thick, 0.0), (thick, 2.0 * half), (thick, half), (low + tall, low + tall + 0.08), frame);
        parts.push(ring);
    }
    parts
}
