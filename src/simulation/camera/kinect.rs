//! A simulated Kinect: colour and depth of a scene, and whose pixels they are.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use super::SolidScene;
use super::colors::{Light, paint};
use super::depths::{KinectFaults, measure};
use super::faces::{Face, Faces};
use super::raster::{Canvas, View};
use crate::frame::Camera;
use crate::frame::{Intrinsics, RgbdFrame};
use crate::geometry::Pose;

/// A Kinect on the robot's tower, with its faults, in some light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinect {
    /// Intrinsics, height and tilt.
    pub camera: Camera,
    /// What is wrong with its depth.
    pub faults: KinectFaults,
    /// What its colour camera works in.
    pub light: Light,
}

impl Default for Kinect {
    fn default() -> Self {
        Self { camera: Camera::kinect(), faults: KinectFaults::default(), light: Light::default() }
    }
}

impl Kinect {
    /// The frame taken by a robot at `pose`, and of each pixel the item's id + 1.
    ///
    /// Items are numbered as in the scene, furniture first, then objects; 0 is floor, wall or nothing.
    pub fn capture(&self, scene: &SolidScene, pose: Pose, rng: &mut ChaCha8Rng) -> (RgbdFrame, Vec<u16>) {
        self.capture_faces(scene.faces(), pose, rng)
    }

    /// The same of bare faces, numbered by their own ids.
    pub fn capture_faces(&self, scene: &Faces, pose: Pose, rng: &mut ChaCha8Rng) -> (RgbdFrame, Vec<u16>) {
        let view = View::new(self.camera, pose);
        let (color, depth, ids) = Canvas::lend(&self.camera, |canvas| {
            for (number, face) in (1..).zip(&scene.faces) {
                canvas.draw(&view, number, face);
            }
            let color = paint(&view, &scene.faces, canvas, &self.light, rng.next_u64());
            let depth = measure(&view, &scene.faces, canvas, &self.faults, rng.next_u64());
            (color, depth, mask(&scene.faces, canvas))
        });
        let (cx, cy) = view.centre();
        let frame = RgbdFrame {
            width: self.camera.width,
            height: self.camera.height,
            color,
            depth,
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: self.camera.focal, fy: self.camera.focal, cx, cy },
            world_from_camera: view.world_from_camera(),
        };
        (frame, ids)
    }

    /// Pixels of the item of an id (from 1) if nothing stood before it.
    pub fn pixels_alone(&self, scene: &Faces, id: u16, pose: Pose) -> usize {
        let view = View::new(self.camera, pose);
        Canvas::lend(&self.camera, |canvas| {
            for (number, face) in (1..).zip(scene.faces.iter().filter(|face| face.id == id)) {
                canvas.draw(&view, number, face);
            }
            canvas.face.iter().filter(|&&face| face > 0).count()
        })
    }
}

/// The id of the face that each pixel shows.
fn mask(faces: &[Face], canvas: &Canvas) -> Vec<u16> {
    let mut ids = Vec::with_capacity(canvas.pixels());
    for (run, number) in (0..canvas.height).flat_map(|row| canvas.runs(row)) {
        let id = if number > 0 { faces[number as usize - 1].id } else { 0 };
        ids.resize(ids.len() + run.len(), id);
    }
    ids
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::geometry::vec2;
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::camera::{Finish, Texture};
    use crate::simulation::solid::Solid;

    const GREY: Finish = Finish::new([180, 180, 180], Texture::Plain);

    /// A wall across the view so many metres ahead, and a post a metre and a half ahead when asked for.
    fn wall(ahead: f64, post: bool) -> Faces {
        let mut faces = Faces::default();
        faces.add_wall(vec2(ahead, -9.0), vec2(ahead, 9.0), 9.0, GREY);
        if post {
            let block = Solid::block(Pose::new(1.5, 0.0, 0.0), (-0.1, 0.1), (-0.1, 0.1), (0.0, 9.0), [90, 90, 90]);
            faces.add_solid(&block, Texture::Plain, 1);
        }
        faces
    }

    /// Looks level from the middle of the wall's height.
    fn capture(faces: &Faces, faults: KinectFaults) -> (RgbdFrame, Vec<u16>) {
        let camera = Camera { tilt: 0.0, tower_m: 4.5, ..Camera::kinect() };
        let kinect = Kinect { camera, faults, ..Kinect::default() };
        kinect.capture_faces(faces, Pose::default(), &mut ChaCha8Rng::seed_from_u64(1))
    }

    fn lost(frame: &RgbdFrame) -> f64 {
        frame.depth.iter().filter(|&&depth| depth == 0).count() as f64 / frame.depth.len() as f64
    }

    /// Mean and standard deviation of the depths near the middle, millimetres.
    fn middle(frame: &RgbdFrame) -> (f64, f64) {
        let rows = 200..280;
        let values: Vec<f64> = rows
            .flat_map(|row| frame.depth[row * 640 + 280..row * 640 + 360].iter())
            .filter(|&&depth| depth > 0)
            .map(|&depth| f64::from(depth))
            .collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt())
    }

    #[test]
    fn an_ideal_sensor_measures_every_pixel_of_a_wall_at_its_depth() {
        let (frame, ids) = capture(&wall(3.0, false), KinectFaults::NONE);
        assert!(frame.depth.iter().all(|&depth| depth == 3000));
        assert!(ids.iter().all(|&id| id == 0));
    }

    #[test]
    fn noise_is_the_published_and_grows_with_the_square_of_depth() {
        for ahead in [1.0, 2.0, 4.0] {
            let faults = KinectFaults { noise: 1.0, ..KinectFaults::NONE };
            let (mean, deviation) = middle(&capture(&wall(ahead, false), faults).0);
            let published = 1.425 * ahead * ahead;
            assert!((mean - 1000.0 * ahead).abs() < published, "{mean}");
            assert!((deviation / published - 1.0).abs() < 0.25, "{deviation} at {ahead} m");
        }
    }

    #[test]
    fn depth_comes_in_steps_of_an_eighth_of_a_pixel_of_disparity() {
        let faults = KinectFaults { noise: 1.0, steps: true, ..KinectFaults::NONE };
        let (frame, _) = capture(&wall(5.0, false), faults);
        let mut values = frame.depth.clone();
        values.sort_unstable();
        values.dedup();
        assert!(values.windows(2).all(|pair| pair[1] - pair[0] >= 60), "{values:?}");
    }

    #[test]
    fn beyond_its_range_the_sensor_is_blind() {
        let faults = KinectFaults { range: true, ..KinectFaults::NONE };
        assert_eq!(lost(&capture(&wall(8.5, false), faults).0), 1.0);
        assert_eq!(lost(&capture(&wall(0.4, false), faults).0), 1.0);
        assert_eq!(lost(&capture(&wall(7.5, false), faults).0), 0.0);
    }

    #[test]
    fn the_projectors_shadow_lies_to_the_left_of_what_is_near_and_is_as_wide_as_the_disparities_differ() {
        let faults = KinectFaults { shadow: true, ..KinectFaults::NONE };
        let (frame, ids) = capture(&wall(4.0, true), faults);
        let row = 240 * 640;
        let post = (0..640).find(|column| ids[row + column] == 1).expect("the post shows");
        let width = (0..640).filter(|column| frame.depth[row + column] == 0).count();
        let expected = 580.0 * 0.075 * (1.0 / 1.4 - 1.0 / 4.0);
        assert!((width as f64 - expected).abs() < 2.0, "{width} px, expected {expected:.1}");
        assert!((1..=width).all(|k| frame.depth[row + post - k] == 0));
    }

    #[test]
    fn as_many_pixels_are_lost_as_asked_for() {
        let faults = KinectFaults { loss: 0.3, ..KinectFaults::NONE };
        let share = lost(&capture(&wall(3.0, false), faults).0);
        assert!((share - 0.3).abs() < 0.04, "{share}");
    }

    #[test]
    fn a_floor_seen_at_a_grazing_angle_gives_no_depth() {
        let mut faces = Faces::default();
        faces.add_level(vec2(-30.0, -30.0), vec2(30.0, 30.0), 0.0, GREY);
        let (frame, _) = capture(&faces, KinectFaults { grazing: true, ..KinectFaults::NONE });
        // The first row is seen at 3.3 degrees, the second at 21.
        assert_eq!(frame.depth[270 * 640 + 320], 0);
        assert!(frame.depth[440 * 640 + 320] > 0);
    }

    #[test]
    fn half_the_light_makes_a_picture_half_as_bright() {
        let brightness = |level: f64| {
            let light = Light { level, ..Light::default() };
            let camera = Camera { tilt: 0.0, tower_m: 4.5, ..Camera::kinect() };
            let kinect = Kinect { camera, light, ..Kinect::default() };
            let (frame, _) =
                kinect.capture_faces(&wall(3.0, false), Pose::default(), &mut ChaCha8Rng::seed_from_u64(1));
            frame.color.as_flattened().iter().map(|&v| f64::from(v)).sum::<f64>()
        };
        assert!((brightness(0.5) / brightness(1.0) - 0.5).abs() < 0.02);
    }

    #[test]
    fn the_red_mug_shows_in_the_picture_taken_before_it_and_in_the_mask() {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let solids = SolidScene::new(&map, &scene);
        let pose = Pose::new(0.2, -5.0, std::f64::consts::PI);
        let (frame, ids) = Kinect::default().capture(&solids, pose, &mut ChaCha8Rng::seed_from_u64(1));
        let mug = scene.objects.iter().position(|object| object.name == "mug").expect("a mug");
        let id = (scene.furniture.len() + mug + 1) as u16;
        let pixels: Vec<_> = (0..ids.len()).filter(|&i| ids[i] == id).collect();
        let red = pixels.iter().filter(|&&i| frame.color[i][0] > 2 * frame.color[i][1]).count();
        assert!(pixels.len() > 100 && red * 10 > pixels.len() * 9, "{red} of {} pixels", pixels.len());
    }
}
