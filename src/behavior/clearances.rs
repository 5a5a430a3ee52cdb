//! How much room a body needs: what planning keeps clear of everything known, metres from the wheels' middle.

use crate::robot::Body;

/// Beyond the circle it sweeps in a turn: a cell of the planning grid, and how far from a goal the robot may stop.
/// A P3DX then keeps 0.46 m.
const BEYOND_SWING_M: f64 = 0.46 - 0.369;
/// Beyond half its width, where there is no wider way, as a P3DX through a door of 0.9 m: 0.4 m.
const BEYOND_SIDES_M: f64 = 0.4 - 0.2125;
/// The same for a bold robot, where there is none so wide: it has room to drive, and before a turn it makes room.
const BOLD_BEYOND_SIDES_M: f64 = 0.36 - 0.2125;
/// Where there is room for it, beyond half its width.
const ROOMY_BEYOND_SIDES_M: f64 = 0.52 - 0.2125;
/// What the sonars must not hear before a turn in place, beyond the circle it sweeps.
const HEARD_BEYOND_SWING_M: f64 = 0.03;

/// What a base keeps clear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearances {
    /// Where it can turn in place.
    pub to_turn: f64,
    /// On a way with room.
    pub roomy: f64,
    /// On a way where there is no wider one.
    pub narrow: f64,
    /// On a way where there is not even that, for a bold robot.
    pub bold: f64,
    /// Before a turn: what is heard nearer is in the way.
    pub heard: f64,
}

impl Clearances {
    /// Those of a body.
    pub fn of(body: &Body) -> Self {
        let side = body.width_m / 2.0;
        Self {
            to_turn: body.swing_m + BEYOND_SWING_M,
            roomy: side + ROOMY_BEYOND_SIDES_M,
            narrow: side + BEYOND_SIDES_M,
            bold: side + BOLD_BEYOND_SIDES_M,
            heard: body.swing_m + HEARD_BEYOND_SWING_M,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::p3dx;

    #[test]
    fn a_p3dx_keeps_what_it_was_tuned_with_and_a_smaller_robot_passes_narrower_gaps() {
        let p3dx = Clearances::of(&p3dx::BODY);
        assert_eq!(p3dx, Clearances { to_turn: 0.46, roomy: 0.52, narrow: 0.4, bold: 0.36, heard: 0.369 + 0.03 });
        let small = Body { width_m: 0.3, swing_m: 0.2, ..p3dx::BODY };
        assert!(Clearances::of(&small).narrow < p3dx.narrow && Clearances::of(&small).to_turn < p3dx.to_turn);
    }
}
