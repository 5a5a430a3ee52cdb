//! Drawer fronts.

use super::finishes::{metal, shade};
use super::parts::{Span, block};
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Frustum};

/// Drawer fronts with knobs on the face at x, standing out a little.
pub fn fronts(dice: &mut Dice, x: f64, y: Span, z: Span, finish: Finish) -> Vec<Frustum> {
    let (width, height) = (y.1 - y.0, z.1 - z.0);
    let rows = ((height / dice.between(0.15, 0.26)).round() as usize).clamp(1, 6);
    let columns = ((width / 0.75).round() as usize).clamp(1, 2);
    let face = shade(finish, dice.pick(&[0.92, 1.0, 1.08]));
    let knob = metal(dice);
    let mut parts = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let from = y.0 + width * column as f64 / columns as f64 + 0.01;
            let to = y.0 + width * (column + 1) as f64 / columns as f64 - 0.01;
            let (low, high) = (
                z.0 + height * row as f64 / rows as f64 + 0.008,
                z.0 + height * (row + 1) as f64 / rows as f64 - 0.008,
            );
            parts.push(block((x, x + 0.015), (from, to), (low, high), face));
            let (middle, level) = ((from + to) / 2.0, (low + high) / 2.0);
            parts.push(block(
                (x + 0.015, x + 0.035),
                (middle - 0.04, middle + 0.04),
                (level - 0.01, level + 0.01),
                knob,
            ));
        }
    }
    parts
}
