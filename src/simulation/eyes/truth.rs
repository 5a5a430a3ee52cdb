//! Ideal eyes: they report what is there, but only what a camera would show.
//!
//! Furniture in view, at least 30 % unoccluded, within 6 m; an object as
//! recognisable only in view, at least 60 % unoccluded, within 2 m.

use std::cell::RefCell;
use std::rc::Rc;

use crate::frame::Camera;
use crate::geometry::Pose;
use crate::map::RoomMap;
use crate::perception::{Eyes, ObjectSighting, View};
use crate::record::Detection;
use crate::simulation::base::Truth;
use crate::simulation::camera::{SolidScene, Visibility};
use crate::simulation::{Item, Scene};

/// Furniture is reported up to here, metres.
const FURNITURE_RANGE_M: f64 = 6.0;
/// Share of a piece that must be unoccluded.
const FURNITURE_SHARE: f64 = 0.3;
/// Objects are recognisable up to here, metres.
const OBJECT_RANGE_M: f64 = 2.0;
/// Share of an object that must be unoccluded.
const OBJECT_SHARE: f64 = 0.6;

/// Eyes that know the scene and report what a camera would show of it.
pub struct TruthEyes {
    solids: Rc<SolidScene>,
    scene: Rc<Scene>,
    camera: Camera,
    truth: Rc<RefCell<Truth>>,
}

impl TruthEyes {
    /// Eyes on the robot whose truth is given.
    pub fn new(map: &RoomMap, scene: Rc<Scene>, camera: Camera, truth: Rc<RefCell<Truth>>) -> Self {
        let solids = Rc::new(SolidScene::new(map, &scene));
        Self { solids, scene, camera, truth }
    }
}

impl Eyes for TruthEyes {
    fn look(&mut self, believed: Pose) -> View {
        let pose = self.truth.borrow().pose;
        let seen = self.solids.visibility(&self.camera, pose);
        let report = Report { from: pose, believed };
        let furniture = self.scene.furniture.iter().zip(&seen.furniture);
        let objects = self.scene.objects.iter().zip(&seen.objects);
        View {
            furniture: furniture
                .filter(|(item, v)| is_shown(item, v, pose))
                .map(|(item, v)| report.detection(item, v))
                .collect(),
            objects: objects
                .filter(|(_, v)| v.seen > 0)
                .filter_map(|(object, v)| {
                    let at = object.pose_on(self.scene.item(&object.on)?).position();
                    let recognisable =
                        v.whole_in_view && v.share() >= OBJECT_SHARE && pose.distance_to(at) <= OBJECT_RANGE_M;
                    let at = report.believed_point(at);
                    Some(ObjectSighting { name: object.name.clone(), x: at.x, y: at.y, recognisable })
                })
                .collect(),
        }
    }
}

fn is_shown(item: &Item, visibility: &Visibility, pose: Pose) -> bool {
    visibility.seen > 0
        && visibility.share() >= FURNITURE_SHARE
        && pose.distance_to(item.pose().position()) <= FURNITURE_RANGE_M
}

/// Carries what is seen from where the robot is to where it believes to be.
struct Report {
    from: Pose,
    believed: Pose,
}

impl Report {
    fn believed_point(&self, point: crate::geometry::Vec2) -> crate::geometry::Vec2 {
        self.believed.to_world(self.from.to_local(point))
    }

    fn detection(&self, item: &Item, visibility: &Visibility) -> Detection {
        let at = self.believed_point(item.pose().position());
        let size = item.size();
        let turn = self.believed.heading - self.from.heading;
        let corners =
            item.footprint().corners().iter().map(|&corner| self.believed_point(corner)).map(|c| [c.x, c.y]).collect();
        Detection {
            category: item.kind().noun.to_string(),
            confidence: 1.0,
            scores: Default::default(),
            x: at.x,
            y: at.y,
            yaw: item.has_front().then(|| crate::geometry::wrap_angle(item.pose().heading + turn)),
            length: size.length,
            width: size.width,
            height: size.height,
            footprint: corners,
            attributes: item.attributes(),
            why: format!("true, {:.0} % of it unoccluded", 100.0 * visibility.share()),
        }
    }
}
