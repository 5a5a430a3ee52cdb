//! Eyes of the simulated robot that see by its Kinect: with true segmentation, or with nothing true.

use std::cell::RefCell;
use std::rc::Rc;

use rand_chacha::ChaCha8Rng;

use crate::frame::{RgbdFrame, steady};
use crate::geometry::Pose;
use crate::map::RoomMap;
use crate::perception::{Detector, Eyes, View};
use crate::simulation::Scene;
use crate::simulation::base::Truth;
use crate::simulation::camera::{Kinect, SolidScene};

/// The Kinect of the simulated robot.
pub struct SimulatedKinect {
    solids: SolidScene,
    kinect: Kinect,
    truth: Rc<RefCell<Truth>>,
    rng: ChaCha8Rng,
}

impl SimulatedKinect {
    /// A Kinect on the robot whose truth is given; its faults are drawn from `rng`.
    pub fn new(map: &RoomMap, scene: &Scene, kinect: Kinect, truth: Rc<RefCell<Truth>>, rng: ChaCha8Rng) -> Self {
        Self { solids: SolidScene::new(map, scene), kinect, truth, rng }
    }

    /// What the sensor gives where the robot truly stands, placed where it believes to stand; and the true mask.
    fn frame(&mut self, believed: Pose) -> (RgbdFrame, Vec<u16>) {
        let pose = self.truth.borrow().pose;
        let (mut frame, ids) = self.kinect.capture(&self.solids, pose, &mut self.rng);
        // As a recording of it is read back, so that the same is seen in it.
        frame.world_from_camera = steady(self.kinect.camera.world_from_camera(believed));
        (frame, ids)
    }
}

/// `--perception camera`: the detector on what the Kinect gives.
pub struct CameraEyes {
    kinect: SimulatedKinect,
    detector: Detector,
    map: RoomMap,
    last: Option<RgbdFrame>,
}

impl CameraEyes {
    /// Eyes behind a Kinect, of a robot that knows the map.
    pub fn new(kinect: SimulatedKinect, map: RoomMap) -> Self {
        Self { kinect, detector: Detector::default(), map, last: None }
    }
}

impl Eyes for CameraEyes {
    fn look(&mut self, believed: Pose) -> View {
        let (frame, _) = self.kinect.frame(believed);
        let view = self.detector.detect(&frame, Some(&self.map));
        self.last = Some(frame);
        view
    }

    fn frame(&self) -> Option<&RgbdFrame> {
        self.last.as_ref()
    }
}

/// `--perception masks`: the Kinect's pixels are truly divided among the items; what each is, the detector says.
pub struct MaskEyes {
    kinect: SimulatedKinect,
    detector: Detector,
    map: RoomMap,
    /// The furniture that each id of the mask counts as: small things count as what they lie on.
    furniture_of: Vec<u16>,
    last: Option<RgbdFrame>,
}

impl MaskEyes {
    /// Eyes behind a Kinect whose pixels know what they belong to.
    pub fn new(kinect: SimulatedKinect, map: RoomMap, scene: &Scene) -> Self {
        let number = |on: &str| scene.furniture.iter().position(|item| item.id == on).map_or(0, |i| i as u16 + 1);
        let furniture = 0..=scene.furniture.len() as u16;
        let furniture_of = furniture.chain(scene.objects.iter().map(|object| number(&object.on))).collect();
        Self { kinect, detector: Detector::default(), map, furniture_of, last: None }
    }
}

impl Eyes for MaskEyes {
    fn look(&mut self, believed: Pose) -> View {
        let (frame, mut ids) = self.kinect.frame(believed);
        ids.iter_mut().for_each(|id| *id = self.furniture_of.get(usize::from(*id)).copied().unwrap_or(0));
        let view = self.detector.detect_items(&frame, Some(&self.map), &ids);
        self.last = Some(frame);
        view
    }

    fn frame(&self) -> Option<&RgbdFrame> {
        self.last.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::geometry::vec2;

    #[test]
    fn true_masks_part_a_table_from_the_chair_beside_it() {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        // Beside the dinner table of the living room, looking along it.
        let pose = Pose::new(2.2, 5.2, 0.6);
        let truth = Rc::new(RefCell::new(Truth { pose, ..Truth::default() }));
        let kinect = SimulatedKinect::new(&map, &scene, Kinect::default(), truth, ChaCha8Rng::seed_from_u64(1));
        let view = MaskEyes::new(kinect, map, &scene).look(pose);
        for id in ["dinner-table-1", "chair-1"] {
            let item = scene.item(id).expect("there");
            let near = |piece: &&crate::record::Detection| (vec2(piece.x, piece.y) - vec2(item.x, item.y)).norm() < 0.3;
            assert_eq!(view.furniture.iter().filter(near).count(), 1, "{id}: {:?}", view.furniture);
        }
    }
}
