//! Cameras and the poses of the robots that carry them.

use crate::geometry::{Pose, vec2};

/// The pose that undoes `pose`.
pub fn inverse(pose: Pose) -> Pose {
    let at = pose.to_local(vec2(0.0, 0.0));
    Pose::new(at.x, at.y, -pose.heading)
}

/// A camera that is known from its robot, on a robot at `pose`.
pub fn placed(camera: &[[f64; 4]; 4], pose: Pose) -> [[f64; 4]; 4] {
    let (sin, cos) = pose.heading.sin_cos();
    let mut world = *camera;
    for column in 0..4 {
        world[0][column] = cos * camera[0][column] - sin * camera[1][column];
        world[1][column] = sin * camera[0][column] + cos * camera[1][column];
    }
    world[0][3] += pose.x;
    world[1][3] += pose.y;
    world
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_ahead_of_its_robot_turns_and_moves_with_it() {
        let mut camera = [[0.0; 4]; 4];
        camera[0] = [0.0, 0.0, 1.0, 0.1];
        let world = placed(&camera, Pose::new(2.0, 3.0, std::f64::consts::FRAC_PI_2));
        assert!((world[0][3] - 2.0).abs() < 1e-12 && (world[1][3] - 3.1).abs() < 1e-12);
        assert!(world[0][2].abs() < 1e-12 && (world[1][2] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_placed_and_taken_back_is_where_it_was() {
        let mut camera = [[0.0; 4]; 4];
        camera[0] = [0.0, 0.6, 0.8, 0.1];
        camera[1] = [1.0, 0.0, 0.0, -0.2];
        let pose = Pose::new(-1.0, 0.5, 2.0);
        let back = placed(&placed(&camera, pose), inverse(pose));
        let off = (0..2).flat_map(|row| (0..4).map(move |column| (row, column)));
        assert!(off.map(|(row, column)| (back[row][column] - camera[row][column]).abs()).all(|off| off < 1e-12));
    }
}
