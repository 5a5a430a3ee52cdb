//! Training frames: rooms furnished at random from the [`families`](super::families), seen by a simulated Kinect.
//!
//! Rooms, light, camera height (1.0–1.4 m), tilt (5–20°), distance and the
//! sensor's faults vary from frame to frame; the truth comes along as
//! perception's development frames have it. `evaluate frames` writes them as
//! files; in memory:
//!
//! ```
//! use spatial_fetch::simulation::training;
//!
//! // Frame 17 of seed 1, the same on every machine and in any order.
//! let frame = training::frame(1, 17);
//! assert_eq!(frame.ids.len(), frame.rgbd.depth.len());
//! assert!(frame.items.iter().any(|item| item.visible_px > 500));
//! ```

mod clutter;
mod furnish;
mod layout;
pub mod learning;
mod room;
mod truth;
mod viewpoint;

pub use truth::TrueItem;

use super::Dice;
use super::camera::{Kinect, KinectFaults, Light};
use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::map::RoomMap;

/// A frame with the truth about it.
#[derive(Clone, Debug)]
pub struct TrainingFrame {
    /// What the sensor gave.
    pub rgbd: RgbdFrame,
    /// Of each pixel the item's id + 1; 0 for floor, walls and ceiling.
    pub ids: Vec<u16>,
    /// The items of which at least one pixel shows.
    pub items: Vec<TrueItem>,
    /// Where the robot stood.
    pub pose: Pose,
    /// The room: walls only, as a robot may know them.
    pub map: RoomMap,
}

/// Frame `index` under `seed`: a room of its own, seen from a place that shows some of its furniture.
pub fn frame(seed: u64, index: u64) -> TrainingFrame {
    let mut dice = Dice::new(seed, index);
    loop {
        let room = furnish::furnished_room(&mut dice);
        let Some((pose, camera)) = viewpoint::choose(&room, &mut dice) else { continue };
        let kinect = Kinect { camera, faults: faults(&mut dice), light: light(&mut dice) };
        let faces = room.faces(&mut dice);
        let (rgbd, ids) = kinect.capture_faces(&faces, pose, dice.numbers());
        let items = truth::items(&room, &kinect, &faces, pose, (&rgbd, &ids));
        if items.iter().any(|item| item.on_item.is_none() && item.visible_px > 1500) {
            return TrainingFrame { rgbd, ids, items, pose, map: room.map() };
        }
    }
}

fn faults(dice: &mut Dice) -> KinectFaults {
    let loss = if dice.chance(0.5) { dice.between(0.0, 0.05) } else { dice.between(0.05, 0.25) };
    KinectFaults { noise: dice.between(0.5, 1.5), dark: dice.chance(0.6), loss, ..KinectFaults::default() }
}

fn light(dice: &mut Dice) -> Light {
    let (around, up) = (dice.between(0.0, std::f64::consts::TAU), dice.between(0.5, 1.3_f64));
    let warmth = dice.between(-0.1, 0.1);
    Light {
        level: dice.between(0.55, 1.15),
        ambient: dice.between(0.45, 0.85),
        from: [around.cos() * up.cos(), around.sin() * up.cos(), up.sin()],
        tint: [1.0 + warmth, 1.0, 1.0 - warmth],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_the_same_whenever_it_is_made() {
        let (one, other) = (frame(5, 3), frame(5, 3));
        assert_eq!(one.rgbd, other.rgbd);
        assert_eq!(one.items, other.items);
    }

    #[test]
    fn frames_of_other_numbers_show_other_rooms() {
        assert_ne!(frame(5, 0).items, frame(5, 1).items);
    }

    #[test]
    fn the_mask_counts_as_the_items_say() {
        for index in 0..8 {
            let frame = frame(9, index);
            for item in &frame.items {
                let seen = frame.ids.iter().filter(|&&id| usize::from(id) == item.id + 1).count();
                assert_eq!(seen, item.visible_px, "{}", item.category);
                assert!(item.visible_px <= item.unoccluded_px, "{}", item.category);
            }
        }
    }
}
