//! What a sonar hears of plane surfaces: the nearest point in its cone that sends sound back.
//!
//! A smooth surface sends an ultrasonic ping back only when it is met nearly
//! square; its ends and corners scatter, and are heard from every side
//! (Leonard & Durrant-Whyte, "Directed Sonar Sensing for Mobile Robot
//! Navigation", 1992).

use crate::geometry::{Vec2, cross, distance_to_segment};

/// Half of a Polaroid transducer's main lobe, radians.
pub const HALF_CONE_RAD: f64 = 0.26;
/// A surface met more aslant than this is not heard, radians.
const SPECULAR_RAD: f64 = 0.3;
/// Something nearer by more than this hides an echo, metres.
const HIDING_M: f64 = 0.03;

/// A piece of a wall, or an edge of something: its two ends, metres.
pub type Segment = (Vec2, Vec2);

/// A point that sends sound back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// Metres from the sonar.
    pub range_m: f64,
    /// The point, metres.
    pub point: Vec2,
    /// Met square, or the end of a surface: the point stays where it is when the sonar turns a little.
    pub steady: bool,
}

/// The nearest echo within `reach_m` of a sonar at `origin` that looks along `axis` (a unit vector).
///
/// Nothing when nothing sends sound back, or when something that does not hides what does.
pub fn echo(surfaces: &[Segment], origin: Vec2, axis: Vec2, reach_m: f64) -> Option<Echo> {
    let mut nearest: Option<Echo> = None;
    for &surface in surfaces {
        let reach_m = nearest.map_or(reach_m, |echo| echo.range_m);
        if let Some(echo) = surface_echo(surface, origin, axis, reach_m) {
            nearest = Some(echo);
        }
    }
    nearest.filter(|echo| !surfaces.iter().any(|&surface| hides(surface, origin, echo)))
}

/// The nearest point of one surface that sends sound back, nearer than `reach_m`.
pub fn surface_echo((a, b): Segment, origin: Vec2, axis: Vec2, reach_m: f64) -> Option<Echo> {
    // Most surfaces lie beside the cone or too far away: no angles need be taken for them. Where two share a corner,
    // rounding shall not decide here.
    if is_outside_cone(a - origin, b - origin, axis) || distance_to_segment(origin, a, b) > reach_m + 1e-6 {
        return None;
    }
    let along = b - a;
    let length = along.norm();
    let (from_a, along) = (a - origin, along / length.max(1e-12));
    let off = cross(along, from_a);
    let distance = off.abs();
    if distance >= reach_m {
        return None;
    }
    // Unit vector from the sonar square to the surface's line, and where the ends lie along the line from there.
    let square = Vec2::new(-along.y, along.x) * off.signum();
    let (first, last) = (from_a.dot(&along), from_a.dot(&along) + length);
    let axis_angle = axis.dot(&along).atan2(axis.dot(&square));
    let (first_angle, last_angle) = (first.atan2(distance), last.atan2(distance));
    let (low, high) = (axis_angle - HALF_CONE_RAD, axis_angle + HALF_CONE_RAD);
    let at = |angle: f64, steady: bool| {
        let range_m = distance / angle.cos().max(1e-6);
        let point = origin + square * distance + along * (distance * angle.tan());
        (range_m < reach_m).then_some(Echo { range_m, point, steady })
    };
    let nearest = 0.0_f64.clamp(first_angle, last_angle).clamp(low, high);
    let is_on_it = (first_angle..=last_angle).contains(&nearest);
    if is_on_it && nearest.abs() <= SPECULAR_RAD {
        return at(nearest, nearest == 0.0 || nearest == first_angle || nearest == last_angle);
    }
    let ends = [first_angle, last_angle].into_iter().filter(|end| (low..=high).contains(end));
    ends.min_by(|a, b| a.abs().total_cmp(&b.abs())).and_then(|end| at(end, true))
}

/// Whether a surface with these ends, seen from the sonar, lies wholly beside the cone.
fn is_outside_cone(a: Vec2, b: Vec2, axis: Vec2) -> bool {
    // A little wider than the cone, so that rounding decides nothing.
    let (sin, cos) = (HALF_CONE_RAD.sin() + 1e-6, HALF_CONE_RAD.cos());
    let beside = |off: f64, along: f64| off * cos > along * sin;
    let (off_a, off_b) = (cross(axis, a), cross(axis, b));
    let (along_a, along_b) = (a.dot(&axis), b.dot(&axis));
    (beside(off_a, along_a) && beside(off_b, along_b)) || (beside(-off_a, along_a) && beside(-off_b, along_b))
}

/// Whether a surface stands between the sonar and the echo.
pub fn hides((a, b): Segment, origin: Vec2, echo: &Echo) -> bool {
    let ray = echo.point - origin;
    let along = b - a;
    let denominator = cross(ray, along);
    if denominator.abs() < 1e-12 {
        return false;
    }
    let t = cross(a - origin, along) / denominator;
    let s = cross(a - origin, ray) / denominator;
    (0.0..1.0).contains(&t) && t * echo.range_m < echo.range_m - HIDING_M && (0.0..=1.0).contains(&s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vec2;

    const WALL: Segment = (vec2(-3.0, 2.0), vec2(3.0, 2.0));

    fn looking(deg: f64) -> Vec2 {
        vec2(deg.to_radians().cos(), deg.to_radians().sin())
    }

    #[test]
    fn a_wall_within_the_cone_is_as_far_as_it_is_square() {
        for deg in [80.0, 90.0, 100.0] {
            let echo = echo(&[WALL], vec2(0.0, 0.0), looking(deg), 5.0).expect("an echo");
            assert!((echo.range_m - 2.0).abs() < 1e-9 && echo.steady, "{deg}: {echo:?}");
        }
    }

    #[test]
    fn a_wall_met_aslant_is_not_heard_and_its_end_is() {
        assert_eq!(echo(&[WALL], vec2(0.0, 0.0), looking(50.0), 5.0), None);
        let end = echo(&[WALL], vec2(0.0, 0.0), looking(33.7), 5.0).expect("an echo");
        assert!((end.range_m - 13.0_f64.sqrt()).abs() < 0.2, "{end:?}");
    }

    #[test]
    fn what_is_behind_the_sonar_is_not_heard() {
        assert_eq!(echo(&[WALL], vec2(0.0, 0.0), looking(-90.0), 5.0), None);
        assert_eq!(echo(&[WALL], vec2(0.0, 5.0), looking(90.0), 5.0), None);
    }

    #[test]
    fn a_wall_that_sends_no_sound_back_still_hides_what_is_behind_it() {
        let aslant = (vec2(-1.0, 0.0), vec2(1.2, 2.0));
        let behind = (vec2(-1.0, 3.0), vec2(1.0, 3.0));
        assert!(echo(&[behind], vec2(0.0, 0.0), looking(90.0), 5.0).is_some());
        assert_eq!(echo(&[behind, aslant], vec2(0.0, 0.0), looking(90.0), 5.0), None);
    }
}
