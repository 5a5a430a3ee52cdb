//! Lamps on the floor and on tables.

use super::finishes::{gaudy, linen, metal, shade, wooden};
use super::parts::{Span, bar, round};
use crate::geometry::vec2;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// A floor lamp.
pub fn floor_lamp(dice: &mut Dice) -> Vec<Frustum> {
    let height = dice.between(1.15, 1.9);
    let wide = dice.between(0.25, 0.55);
    let tall = dice.between(0.18, 0.45);
    let finish = if dice.chance(0.7) { metal(dice) } else { wooden(dice) };
    let origin = vec2(0.0, 0.0);
    let mut parts = vec![shade_of(dice, wide, (height - tall, height))];
    if dice.chance(0.2) {
        for i in 0..3 {
            let angle = std::f64::consts::TAU * f64::from(i) / 3.0;
            let foot = vec2(angle.cos(), angle.sin()) * dice.between(0.2, 0.28);
            parts.push(bar(foot, origin, (0.025, 0.03), (0.0, height - tall), finish));
        }
        return parts;
    }
    let foot = dice.between(0.22, 0.34);
    let pole = dice.between(0.02, 0.05);
    parts.push(round(origin, (foot, foot), (0.8 * foot, 0.8 * foot), (0.0, 0.03), finish));
    parts.push(round(origin, (pole, pole), (pole, pole), (0.03, height - 0.6 * tall), finish));
    parts
}

/// A lamp to stand on a table.
pub fn table_lamp(dice: &mut Dice) -> Vec<Frustum> {
    let height = dice.between(0.25, 0.8);
    let wide = dice.between(0.16, 0.45);
    let tall = height * dice.between(0.3, 0.5);
    let finish = match dice.whole(0, 2) {
        0 => metal(dice),
        1 => wooden(dice),
        _ => gaudy(dice),
    };
    let origin = vec2(0.0, 0.0);
    let foot = wide * dice.between(0.35, 0.7);
    let waist = dice.between(0.02, 0.12).min(foot);
    vec![
        shade_of(dice, wide, (height - tall, height)),
        round(origin, (foot, foot), (waist, waist), (0.0, 0.4 * (height - tall)), finish),
        round(origin, (waist, waist), (0.03, 0.03), (0.4 * (height - tall), height - 0.5 * tall), finish),
    ]
}

/// A drum, a cone or a bowl.
fn shade_of(dice: &mut Dice, wide: f64, z: Span) -> Frustum {
    let finish: Finish = if dice.chance(0.8) { shade(linen(dice), 1.08) } else { metal(dice) };
    let above = wide * dice.pick(&[1.0, 0.9, 0.6, 0.4]);
    round(vec2(0.0, 0.0), (wide, wide), (above, above), z, finish)
}
