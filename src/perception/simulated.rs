//! Eyes of the simulated robot that see by its Kinect: with true segmentation, or with nothing true.

use std::cell::RefCell;
use std::rc::Rc;

use rand_chacha::ChaCha8Rng;

use super::objects::sightings;
use super::{Detector, Eyes, View};
use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::record::Detection;
use crate::robot::simulated::Truth;
use crate::world::camera::{Kinect, SolidScene};
use crate::world::{RoomMap, Scene};

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
        frame.world_from_camera = self.kinect.camera.world_from_camera(believed);
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
}

/// Fewer pixels of a piece tell nothing.
const FEWEST_PIXELS: usize = 400;

impl MaskEyes {
    /// Eyes behind a Kinect whose pixels know what they belong to.
    pub fn new(kinect: SimulatedKinect, map: RoomMap) -> Self {
        Self { kinect, detector: Detector::default(), map }
    }

    /// The largest thing the detector makes of one item's pixels, alone with floor and walls.
    fn piece(&self, frame: &RgbdFrame, ids: &[u16], id: u16) -> Option<Detection> {
        let mut alone = frame.clone();
        for (depth, &other) in alone.depth.iter_mut().zip(ids) {
            if other != 0 && other != id {
                *depth = 0;
            }
        }
        let found = self.detector.detect(&alone, Some(&self.map)).furniture;
        found.into_iter().max_by(|a, b| (a.length * a.width).total_cmp(&(b.length * b.width)))
    }
}

impl Eyes for MaskEyes {
    fn look(&mut self, believed: Pose) -> View {
        let (frame, ids) = self.kinect.frame(believed);
        let last = ids.iter().copied().max().unwrap_or(0);
        let mut pixels = vec![0_usize; usize::from(last) + 1];
        ids.iter().for_each(|&id| pixels[usize::from(id)] += 1);
        let pieces = (1..=self.kinect.solids.furniture_count() as u16)
            .filter(|&id| pixels.get(usize::from(id)).is_some_and(|&n| n >= FEWEST_PIXELS));
        let furniture: Vec<Detection> = pieces.filter_map(|id| self.piece(&frame, &ids, id)).collect();
        let objects = sightings(&frame, &furniture);
        View { furniture, objects }
    }
}
