//! The eyes of the simulated robot, from ideal to nothing true, and what was truly before them at the end.
//!
//! [`truth`] reports what a camera would show without error, [`boxes`] spoils
//! that as a sensor would, [`rendered`] sees by rendered frames.

pub mod boxes;
pub mod rendered;
pub mod truth;

use std::cell::RefCell;
use std::rc::Rc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::base::Truth;
use super::camera::Kinect;
use super::{Dice, Home, Perception, TrialSettings};
use crate::geometry::Pose;
use crate::perception::Eyes;
use boxes::BoxEyes;
use rendered::{CameraEyes, MaskEyes, SimulatedKinect};
use truth::TruthEyes;

/// The eyes that the settings ask for, on the robot whose truth is given.
pub(super) fn eyes(home: &Home, settings: &TrialSettings, stream: u64, truth: Rc<RefCell<Truth>>) -> Box<dyn Eyes> {
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
    rng.set_stream(stream);
    let ideal = |truth| TruthEyes::new(&home.map, home.shared_scene(), home.camera(), truth);
    let mounted = Kinect { camera: home.camera(), ..settings.kinect };
    let kinect = |truth, rng| SimulatedKinect::new(&home.map, &home.scene, mounted, truth, rng);
    match settings.perception {
        Perception::Truth => Box::new(ideal(truth)),
        Perception::Boxes => Box::new(BoxEyes::new(ideal(truth), Dice::new(settings.seed, stream))),
        Perception::Masks => Box::new(MaskEyes::new(kinect(truth, rng), home.map.clone(), &home.scene)),
        Perception::Camera => Box::new(CameraEyes::new(kinect(truth, rng), home.map.clone())),
    }
}

/// Whether the object – any, when none is named – is truly recognisable to a robot at `pose`.
pub(super) fn is_recognisable(home: &Home, object: Option<&str>, pose: Pose) -> bool {
    let truth = Rc::new(RefCell::new(Truth { pose, ..Truth::default() }));
    let view = TruthEyes::new(&home.map, home.shared_scene(), home.camera(), truth).look(pose);
    view.objects.iter().any(|sighting| sighting.recognisable && object.is_none_or(|name| name == sighting.name))
}
