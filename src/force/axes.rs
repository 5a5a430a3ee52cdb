//! Frames of reference: what "front" or "above" means, and the names of directions in them.

use std::f64::consts::{FRAC_PI_2, TAU};

/// The axes in which directions are named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axes {
    /// A map or an image: right, above, left, below.
    Map,
    /// A body that faces `heading`, radians: its own front, left, rear, right. The robot's frame, and the intrinsic
    /// frame of furniture.
    Body {
        /// Radians, counter-clockwise from +x.
        heading: f64,
    },
    /// Someone who looks along `heading`, radians, at the reference: what is nearer to them is in front of it, what
    /// is farther is behind it, left and right are their own.
    Viewer {
        /// Radians, counter-clockwise from +x.
        heading: f64,
    },
}

/// The words for one direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// One word: `front`.
    pub name: &'static str,
    /// Before a reference: `in front of`.
    pub preposition: &'static str,
    /// On its own: `in front`.
    pub adverb: &'static str,
}

const fn words(name: &'static str, preposition: &'static str, adverb: &'static str) -> Words {
    Words { name, preposition, adverb }
}

const RIGHT: Words = words("right", "to the right of", "to the right");
const LEFT: Words = words("left", "to the left of", "to the left");
const ABOVE: Words = words("above", "above", "above");
const BELOW: Words = words("below", "below", "below");
const FRONT: Words = words("front", "in front of", "in front");
const REAR: Words = words("rear", "behind", "to the rear");
const BACK: Words = words("back", "behind", "behind");

impl Axes {
    /// The frame of someone who stands before the front of an item that faces `front` and looks at it: left and
    /// right are mirrored against the item's own.
    pub fn facing(front: f64) -> Self {
        Self::Viewer { heading: front + TAU / 2.0 }
    }

    /// The four directions of the frame, counter-clockwise about the reference where the frame is not mirrored.
    pub fn directions(self) -> [Words; 4] {
        match self {
            Self::Map => [RIGHT, ABOVE, LEFT, BELOW],
            Self::Body { .. } => [FRONT, LEFT, REAR, RIGHT],
            Self::Viewer { .. } => [BACK, LEFT, FRONT, RIGHT],
        }
    }

    /// The angles of [`Axes::directions`] on the map, radians.
    pub fn angles(self) -> [f64; 4] {
        [0.0, 1.0, 2.0, 3.0].map(|quarter| self.origin() + quarter * FRAC_PI_2)
    }

    /// The angle of the first direction. Looking along a heading, what lies ahead of the reference is behind it, and
    /// left is a quarter turn further, as for a body with that heading.
    fn origin(self) -> f64 {
        match self {
            Self::Map => 0.0,
            Self::Body { heading } | Self::Viewer { heading } => heading,
        }
    }

    /// The name of a direction among sixteen, as Skubic et al. (IEEE SMC-C 34(2), 2004) speak of them: "in front",
    /// "mostly in front but somewhat to the left", "in front and to the left", …
    ///
    /// ```
    /// use spatial_fetch::force::Axes;
    /// let robot = Axes::Body { heading: 0.0 };
    /// assert_eq!(robot.name(0.4), "mostly in front but somewhat to the left");
    /// assert_eq!(robot.name(-0.8), "in front and to the right");
    /// ```
    pub fn name(self, theta: f64) -> String {
        let sixteenth = ((theta - self.origin()) / TAU * 16.0).round().rem_euclid(16.0) as usize;
        let words = self.directions();
        let (quarter, rest) = (sixteenth / 4, sixteenth % 4);
        let (here, next) = (words[quarter].adverb, words[(quarter + 1) % 4].adverb);
        match rest {
            0 => here.to_string(),
            1 => format!("mostly {here} but somewhat {next}"),
            // Front and rear are spoken before left and right, whichever way round the circle goes.
            2 if quarter % 2 == 0 => format!("{here} and {next}"),
            2 => format!("{next} and {here}"),
            _ => format!("mostly {next} but somewhat {here}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn angle_of(axes: Axes, name: &str) -> f64 {
        let at = axes.directions().iter().position(|words| words.name == name).expect("a direction of the frame");
        axes.angles()[at].rem_euclid(TAU)
    }

    #[test]
    fn a_robot_that_faces_north_has_west_on_its_left() {
        let axes = Axes::Body { heading: FRAC_PI_2 };
        assert!((angle_of(axes, "left") - PI).abs() < 1e-12);
        assert!((angle_of(axes, "rear") - 1.5 * PI).abs() < 1e-12);
    }

    #[test]
    fn a_viewer_has_the_front_of_things_on_the_near_side_and_their_left_on_the_viewers_left() {
        let axes = Axes::Viewer { heading: FRAC_PI_2 };
        assert!((angle_of(axes, "front") - 1.5 * PI).abs() < 1e-12);
        assert!((angle_of(axes, "left") - PI).abs() < 1e-12);
    }

    #[test]
    fn facing_an_item_mirrors_its_left_and_right() {
        let (own, facing) = (Axes::Body { heading: 0.3 }, Axes::facing(0.3));
        assert!((angle_of(own, "left") - angle_of(facing, "right")).abs() < 1e-12);
        assert!((angle_of(own, "front") - angle_of(facing, "front")).abs() < 1e-12);
    }

    #[test]
    fn all_sixteen_directions_have_names_of_their_own() {
        for axes in [Axes::Map, Axes::Body { heading: 1.0 }, Axes::Viewer { heading: 2.0 }] {
            let mut names: Vec<String> =
                (0..16).map(|i| axes.name(axes.angles()[0] + TAU * f64::from(i) / 16.0)).collect();
            names.sort();
            names.dedup();
            assert_eq!(names.len(), 16);
        }
    }
}
