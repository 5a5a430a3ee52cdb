//! The whole footprint of a piece of which only part is seen.

use super::front::Hidden;
use super::walls::Wall;
use crate::catalogue::Size;
use crate::geometry::{Pose, vec2};

/// How near a size must be to what is seen to count in full, metres.
const AGREEMENT_M: f64 = 0.12;
/// A side more hidden than this may go on.
const HIDDEN: f64 = 0.55;

/// A footprint: its middle with the front's heading, the length along it and the width across it, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Middle and heading.
    pub pose: Pose,
    /// Along the heading.
    pub length: f64,
    /// Across it.
    pub width: f64,
}

impl Footprint {
    /// Extended at its hidden sides to what pieces of its category, like it in what is seen, measure on average.
    ///
    /// `hidden` is in the frame of the pose: ahead, left, behind, right. No side is moved through a wall.
    pub fn completed(mut self, hidden: Hidden, height: f64, sizes: &[Size], walls: &[Wall]) -> Self {
        let open = hidden.map(|share| share > HIDDEN);
        let (along, across) = (open[0] || open[2], open[1] || open[3]);
        if !(along || across) || sizes.is_empty() {
            return self;
        }
        let weight = |size: &Size| {
            let near = |a: f64, b: f64| (-((a - b) / AGREEMENT_M).powi(2) / 2.0).exp();
            let fit = |seen: f64, whole: f64, is_open: bool| {
                if is_open && whole >= seen { 1.0 } else { near(seen, whole) }
            };
            fit(self.length, size.length, along) * fit(self.width, size.width, across) * near(height, size.height)
                + 1e-9
        };
        let mean = |of: fn(&Size) -> f64, least: f64| {
            let weighted = sizes.iter().filter(|s| of(s) >= least).map(|s| (weight(s), of(s)));
            let (sum, total) = weighted.fold((0.0, 0.0), |(sum, total), (w, v)| (sum + w * v, total + w));
            if total > 0.0 { sum / total } else { least }
        };
        let (length, width) = (mean(|s| s.length, self.length), mean(|s| s.width, self.width));
        if along {
            self.extend(0.0, length - self.length, (open[0], open[2]), walls);
        }
        if across {
            self.extend(std::f64::consts::FRAC_PI_2, width - self.width, (open[1], open[3]), walls);
        }
        self
    }

    /// Adds `missing` metres along a direction of its frame, on its positive side, its negative side or both.
    fn extend(&mut self, turn: f64, missing: f64, (ahead, behind): (bool, bool), walls: &[Wall]) {
        let half = if turn == 0.0 { self.length } else { self.width } / 2.0;
        let direction = vec2(turn.cos(), turn.sin());
        let room = |sign: f64, wanted: f64| {
            let steps = (0..(wanted / 0.05).ceil() as usize).map(|i| i as f64 * 0.05);
            let free = |step: &f64| {
                let place = self.pose.to_world(direction * sign * (half + step));
                !walls.iter().any(|wall| wall.distance(place) < 0.05)
            };
            steps.take_while(free).last().map_or(0.0, |last| (last + 0.05).min(wanted))
        };
        let share = if ahead && behind { missing / 2.0 } else { missing };
        let (plus, minus) = (if ahead { room(1.0, share) } else { 0.0 }, if behind { room(-1.0, share) } else { 0.0 });
        let middle = self.pose.to_world(direction * (plus - minus) / 2.0);
        (self.pose.x, self.pose.y) = (middle.x, middle.y);
        *(if turn == 0.0 { &mut self.length } else { &mut self.width }) += plus + minus;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WARDROBE: Size = Size { length: 0.6, width: 1.2, height: 2.0 };

    #[test]
    fn a_wardrobe_of_which_only_the_front_is_seen_gets_its_depth_behind_it() {
        let seen = Footprint { pose: Pose::new(2.0, 0.0, std::f64::consts::PI), length: 0.1, width: 1.2 };
        let whole = seen.completed([0.0, 0.0, 1.0, 0.0], 2.0, &[WARDROBE], &[]);
        assert!((whole.length - 0.6).abs() < 1e-9 && (whole.width - 1.2).abs() < 1e-9);
        assert!((whole.pose.x - 2.25).abs() < 1e-9, "the front stays where it was seen");
    }

    #[test]
    fn what_is_seen_on_all_sides_stays_as_it_is() {
        let seen = Footprint { pose: Pose::new(2.0, 0.0, 0.0), length: 0.4, width: 0.5 };
        assert_eq!(seen.completed([0.0; 4], 0.7, &[WARDROBE], &[]), seen);
    }
}
