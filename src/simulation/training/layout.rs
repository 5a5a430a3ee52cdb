//! Where furniture stands: at walls, in the open, around, beside, before and on other furniture.

use std::f64::consts::{FRAC_PI_2, PI};

use super::room::{FurnishedRoom, Placed};
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::simulation::Dice;
use crate::simulation::families::Piece;

/// A thing may be so much larger than what it stands on.
const OVERHANG: f64 = 1.25;
/// How often a place is tried before a piece is left out.
const TRIES: usize = 25;

impl FurnishedRoom {
    /// Puts a piece with its back to a wall; its number when there was room.
    pub fn at_wall(&mut self, piece: Piece, dice: &mut Dice) -> Option<usize> {
        self.try_places(piece, dice, |room, piece, dice| {
            let gap = piece.size.length / 2.0 + dice.between(0.005, 0.08);
            let heading = f64::from(dice.whole(0, 3) as u32) * FRAC_PI_2;
            let (deep, wide) = if heading.sin().abs() < 0.5 { room.half } else { (room.half.1, room.half.0) };
            let free = (wide - piece.size.width / 2.0).max(0.0);
            let beside = dice.between(-free, free);
            let local = Pose::new(0.0, 0.0, heading).to_world(vec2(gap - deep, beside));
            Pose::new(local.x, local.y, heading + dice.normal(0.0, 0.01))
        })
    }

    /// Puts a piece anywhere, turned to the walls or not.
    pub fn in_the_open(&mut self, piece: Piece, dice: &mut Dice) -> Option<usize> {
        self.try_places(piece, dice, |room, _, dice| {
            let (x, y) = (dice.between(-room.half.0, room.half.0), dice.between(-room.half.1, room.half.1));
            let turned = if dice.chance(0.6) { dice.normal(0.0, 0.08) } else { dice.between(-PI, PI) };
            Pose::new(x, y, f64::from(dice.whole(0, 3) as u32) * FRAC_PI_2 + turned)
        })
    }

    /// Puts a seat at one of a table's four sides, facing it, and pushes it under.
    pub fn at_table(&mut self, table: usize, seat: Piece, dice: &mut Dice) -> Option<usize> {
        let (at, half) = (self.placed[table].pose, self.placed[table].piece.half());
        for _ in 0..TRIES {
            let side = dice.whole(0, 3);
            let (reach, along) = if side.is_multiple_of(2) { (half.x, half.y) } else { (half.y, half.x) };
            let away = reach + seat.size.length / 2.0 + dice.between(-0.28, 0.12);
            let free = (along - seat.size.width / 2.0).max(0.0);
            let local = Pose::new(0.0, 0.0, side as f64 * FRAC_PI_2);
            let spot = at.to_world(local.to_world(vec2(away, dice.between(-free, free))));
            let heading = at.heading + side as f64 * FRAC_PI_2 + PI + dice.normal(0.0, 0.12);
            let pose = Pose::new(spot.x, spot.y, heading);
            if self.is_free(&seat, pose, Some(table)) {
                return Some(self.put(seat, pose));
            }
        }
        None
    }

    /// Puts a piece to the left or right of another's rear, facing the same way: a nightstand.
    pub fn beside(&mut self, other: usize, piece: Piece, dice: &mut Dice) -> Option<usize> {
        let (at, half) = (self.placed[other].pose, self.placed[other].piece.half());
        self.try_places(piece, dice, |_, piece, dice| {
            let side = dice.pick(&[-1.0, 1.0]);
            let beside = side * (half.y + piece.size.width / 2.0 + dice.between(0.02, 0.25));
            let spot = at.to_world(vec2(piece.size.length / 2.0 - half.x, beside));
            Pose::new(spot.x, spot.y, at.heading + dice.normal(0.0, 0.03))
        })
    }

    /// Puts a piece before another's front: a coffee table.
    pub fn before(&mut self, other: usize, piece: Piece, dice: &mut Dice) -> Option<usize> {
        let (at, half) = (self.placed[other].pose, self.placed[other].piece.half());
        self.try_places(piece, dice, |_, piece, dice| {
            let away = half.x + piece.size.length / 2.0 + dice.between(0.2, 0.6);
            let spot = at.to_world(vec2(away, dice.normal(0.0, 0.15)));
            Pose::new(spot.x, spot.y, at.heading + dice.normal(0.0, 0.08))
        })
    }

    /// Puts a small piece on top of another; `target` when a person might ask for it.
    pub fn on_top(&mut self, other: usize, piece: Piece, target: bool, dice: &mut Dice) {
        let holder = &self.placed[other];
        let (half, own) = (holder.piece.half(), piece.half());
        // Within the inscribed ellipse, so that it also lies on round tops.
        let free = ((half - own * 1.1) * 0.68).sup(&Vec2::zeros());
        // A monitor may stand over the edges of a nightstand.
        if own.x > OVERHANG * half.x || own.y > OVERHANG * half.y {
            return;
        }
        let local = vec2(dice.between(-free.x, free.x), dice.between(-free.y, free.y));
        let spot = holder.pose.to_world(local);
        let pose = Pose::new(spot.x, spot.y, holder.pose.heading + dice.normal(0.0, 0.4));
        let lift = holder.lift + holder.piece.surface_at(local);
        self.placed.push(Placed { piece, pose, lift, on: Some(other), target });
    }

    fn try_places(
        &mut self,
        piece: Piece,
        dice: &mut Dice,
        place: impl Fn(&Self, &Piece, &mut Dice) -> Pose,
    ) -> Option<usize> {
        for _ in 0..TRIES {
            let pose = place(self, &piece, dice);
            if self.is_free(&piece, pose, None) {
                return Some(self.put(piece, pose));
            }
        }
        None
    }

    fn put(&mut self, piece: Piece, pose: Pose) -> usize {
        self.placed.push(Placed { piece, pose, lift: 0.0, on: None, target: false });
        self.placed.len() - 1
    }

    /// Whether a piece fits there; `under` may overlap with it, as a chair does with its table.
    fn is_free(&self, piece: &Piece, pose: Pose, under: Option<usize>) -> bool {
        let outline = Polygon::rectangle(pose, piece.size.length, piece.size.width);
        let inside = outline.corners().iter().all(|c| c.x.abs() < self.half.0 && c.y.abs() < self.half.1);
        let others = self.placed.iter().enumerate();
        let mut in_the_way = others.filter(|&(i, other)| other.on.is_none() && Some(i) != under);
        inside && !in_the_way.any(|(_, other)| other.footprint().touches(&outline))
    }
}
