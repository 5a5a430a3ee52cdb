use super::*;
use crate::frame::{CameraMount, Intrinsics, RgbdFrame};
use crate::map::RoomMap;
use crate::simulation::Scene;
use crate::simulation::camera::{Kinect, SolidScene};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The apartment from one place, by a camera at some height and tilt.
fn taken(height_m: f64, tilt_deg: f64) -> RgbdFrame {
    let scene = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
    let mut kinect = Kinect::default();
    kinect.camera = kinect.camera.mounted(CameraMount { height_m, tilt_deg });
    let pose = crate::geometry::Pose::new(3.0, 2.0, 0.4);
    kinect.capture(&scene, pose, &mut ChaCha8Rng::seed_from_u64(1)).0
}

fn depths(frame: &RgbdFrame) -> Depths<'_> {
    let (width, intrinsics) = (frame.width, frame.intrinsics);
    Depths { pixels: &frame.depth, width, intrinsics, unit_m: frame.depth_unit_m }
}

/// The frame without what lies lower than this, metres.
fn without_what_is_below(mut frame: RgbdFrame, least_m: f64) -> RgbdFrame {
    for at in 0..frame.depth.len() {
        let (column, row) = (at % frame.width, at / frame.width);
        let depth = f64::from(frame.depth[at]) * frame.depth_unit_m;
        if frame.point(column, row, depth)[2] < least_m {
            frame.depth[at] = 0;
        }
    }
    frame
}

fn assert_near(found: &Pose, true_pose: &Pose) {
    assert!((found[2][3] - true_pose[2][3]).abs() < 0.04, "{} m, not {}", found[2][3], true_pose[2][3]);
    for axis in 0..3 {
        assert!((found[2][axis] - true_pose[2][axis]).abs() < 0.06, "{:?}, not {:?}", found[2], true_pose[2]);
    }
}

#[test]
fn height_and_tilt_are_read_off_the_floor_from_a_small_robot_s_camera_to_one_held_up() {
    for (height_m, tilt_deg) in [(0.21, 0.0), (0.6, 5.0), (1.2, 15.0), (1.7, 30.0)] {
        let frame = taken(height_m, tilt_deg);
        let (found, source) = camera_over_floor(&depths(&frame), Told::default()).expect("a floor");
        assert_eq!(source, PoseSource::Floor);
        assert_near(&found, &frame.world_from_camera);
    }
}

#[test]
fn a_table_s_top_is_no_floor_and_the_height_that_is_told_makes_up_for_it() {
    let frame = without_what_is_below(taken(1.2, 15.0), 0.3);
    let refused = camera_over_floor(&depths(&frame), Told::default()).expect_err("no floor shows");
    assert!(matches!(refused, NoPose::Unsure { .. } | NoPose::NoFloor { .. }), "{refused:?}");
    let told = Told { height_m: Some(1.2), tilt_deg: None };
    let (found, source) = camera_over_floor(&depths(&frame), told).expect("told");
    assert_eq!(source, PoseSource::Gravity);
    assert_near(&found, &frame.world_from_camera);
}

#[test]
fn a_picture_of_nothing_but_a_wall_tells_no_pose_unless_height_and_tilt_are_told() {
    let intrinsics = Intrinsics { fx: 525.0, fy: 525.0, cx: 319.5, cy: 239.5 };
    for depth in [2000, 0] {
        let pixels = vec![depth; 640 * 480];
        let depths = Depths { pixels: &pixels, width: 640, intrinsics, unit_m: 0.001 };
        assert!(camera_over_floor(&depths, Told::default()).is_err());
        let told = Told { height_m: Some(0.9), tilt_deg: Some(10.0) };
        let (pose, source) = camera_over_floor(&depths, told).expect("told");
        assert_eq!((source, pose[2][3]), (PoseSource::Told, 0.9));
        assert!((pose[2][2] + 10.0_f64.to_radians().sin()).abs() < 1e-9, "looks down: {:?}", pose[2]);
    }
}
