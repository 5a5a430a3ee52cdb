//! Frames of the simulated Kinect and the ideal eyes' look, 640 × 480, in the furnished apartment.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use spatial_fetch::frame::Camera;
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::camera::{Kinect, KinectFaults, SolidScene};

fn main() {
    divan::main();
}

fn apartment() -> (SolidScene, Pose) {
    let map = RoomMap::apartment();
    let entry = map.entry_pose("living_room").unwrap_or_default();
    (SolidScene::new(&map, &Scene::apartment()), entry)
}

/// Colour, depth with every fault, and mask.
#[divan::bench]
fn kinect_frame(bencher: divan::Bencher) {
    let (scene, pose) = apartment();
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    bencher.bench_local(|| Kinect::default().capture(&scene, pose, &mut rng));
}

/// The same without faults.
#[divan::bench]
fn kinect_frame_without_faults(bencher: divan::Bencher) {
    let (scene, pose) = apartment();
    let kinect = Kinect { faults: KinectFaults::NONE, ..Kinect::default() };
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    bencher.bench_local(|| kinect.capture(&scene, pose, &mut rng));
}

/// Who hides whom, by rays.
#[divan::bench]
fn visibility(bencher: divan::Bencher) {
    let (scene, pose) = apartment();
    bencher.bench_local(|| scene.visibility(&Camera::kinect(), pose));
}
