//! True boxes as a sensor would give them: noisy, sometimes missed, sometimes called wrongly, sometimes made up.

use super::truth::TruthEyes;
use crate::catalogue;
use crate::geometry::{Pose, Vec2, vec2, wrap_angle};
use crate::perception::{Eyes, View};
use crate::record::Detection;
use crate::simulation::Dice;

/// A piece in view is not reported in one look of ten.
const MISSED: f64 = 0.1;
/// What is reported is called by a wrong name in one look of ten.
const MISCALLED: f64 = 0.1;
/// A look shows something that is not there.
const MADE_UP: f64 = 0.03;
/// Standard deviation of the centre: metres at hand, and per square metre of distance.
const CENTRE_M: (f64, f64) = (0.02, 0.006);
/// Of the front's heading, degrees.
const YAW_DEG: f64 = 8.0;
/// Of the lengths, a share.
const SIZE: f64 = 0.05;

/// `--perception boxes`: the truth with the sensor's noise, misses and confusions.
pub struct BoxEyes {
    truth: TruthEyes,
    dice: Dice,
}

impl BoxEyes {
    /// Eyes that spoil what `truth` reports by `dice`.
    pub fn new(truth: TruthEyes, dice: Dice) -> Self {
        Self { truth, dice }
    }
}

impl Eyes for BoxEyes {
    fn look(&mut self, believed: Pose) -> View {
        let View { furniture, mut objects } = self.truth.look(believed);
        let dice = &mut self.dice;
        let mut boxes: Vec<Detection> = furniture
            .into_iter()
            .filter_map(|truly| (!dice.chance(MISSED)).then(|| spoilt(truly, believed, dice)))
            .collect();
        if dice.chance(MADE_UP) {
            boxes.push(made_up(believed, dice));
        }
        objects.retain(|_| !dice.chance(MISSED));
        for object in &mut objects {
            object.x += dice.normal(0.0, 0.02);
            object.y += dice.normal(0.0, 0.02);
        }
        View { furniture: boxes, objects }
    }
}

fn spoilt(mut piece: Detection, believed: Pose, dice: &mut Dice) -> Detection {
    let centre = vec2(piece.x, piece.y);
    let deviation = CENTRE_M.0 + CENTRE_M.1 * (centre - believed.position()).norm_squared();
    let moved = centre + vec2(dice.normal(0.0, deviation), dice.normal(0.0, deviation));
    let turn = dice.normal(0.0, YAW_DEG).to_radians();
    let size = dice.normal(1.0, SIZE).clamp(0.7, 1.3);
    let (sin, cos) = turn.sin_cos();
    for corner in &mut piece.footprint {
        let d: Vec2 = (vec2(corner[0], corner[1]) - centre) * size;
        *corner = [moved.x + cos * d.x - sin * d.y, moved.y + sin * d.x + cos * d.y];
    }
    (piece.x, piece.y) = (moved.x, moved.y);
    piece.yaw = piece.yaw.map(|yaw| wrap_angle(yaw + turn));
    piece.length *= size;
    piece.width *= size;
    piece.height += dice.normal(0.0, 0.02);
    piece.confidence = dice.between(0.6, 0.95);
    let alike = catalogue::CATEGORIES.iter().find(|row| row.noun == piece.category).map_or(&[][..], |row| row.alike);
    if !alike.is_empty() && dice.chance(MISCALLED) {
        piece.category = dice.pick(alike).to_string();
        piece.confidence = dice.between(0.4, 0.7);
    }
    piece.why =
        format!("true box, spoilt: centre by {:.2} m, turned by {:.0}°", (moved - centre).norm(), turn.to_degrees());
    piece
}

/// A box where there is nothing, in view.
fn made_up(believed: Pose, dice: &mut Dice) -> Detection {
    let (away, aside) = (dice.between(1.2, 4.5), dice.between(-0.4, 0.4));
    let at = believed.to_world(vec2(away, away * aside));
    let (length, width) = (dice.between(0.4, 0.9), dice.between(0.4, 0.9));
    let outline = crate::geometry::Polygon::rectangle(Pose::new(at.x, at.y, believed.heading), length, width);
    Detection {
        category: dice.pick(&["chair", "table", "nightstand", "armchair"]).to_string(),
        confidence: dice.between(0.3, 0.6),
        scores: Default::default(),
        x: at.x,
        y: at.y,
        yaw: None,
        length,
        width,
        height: dice.between(0.4, 0.9),
        footprint: outline.corners().iter().map(|c| [c.x, c.y]).collect(),
        attributes: Vec::new(),
        why: "not there".to_string(),
    }
}
