//! Furniture as a triangle mesh from a file, where composed solids will not do.

mod bvh;
mod obj;

use std::path::Path;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::catalogue::Size;
use crate::geometry::{Polygon, Vec2, vec2};
use crate::limits::MESH_LAYERS;
use crate::map::error::WorldError;
use bvh::Bvh;

/// A point or a direction in space: x along the piece's front, y to its left, z up, metres.
pub type Point = nalgebra::Vector3<f64>;

/// A mesh file of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Wavefront OBJ, beside the scene file.
    pub file: String,
    /// Its upward axis.
    #[serde(default)]
    pub up: Up,
    /// What brings its unit to metres.
    #[serde(default = "one")]
    pub scale: f64,
    /// Direction of its front in the horizontal plane, degrees counter-clockwise from its first axis.
    #[serde(default)]
    pub front_deg: f64,
    /// The mesh, once read.
    #[serde(skip)]
    pub(super) loaded: Option<Arc<Mesh>>,
}

/// The upward axis of a mesh file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// As most modelling programs have it.
    #[default]
    Y,
    /// As robotics has it.
    Z,
}

fn one() -> f64 {
    1.0
}

/// Triangles, standing on the floor, their box centred on the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    bvh: Bvh,
    size: Size,
    outline: Vec<Vec2>,
}

impl MeshFile {
    /// Reads the mesh beside the scene file `scene`; `item` is named in errors.
    pub(super) fn load(&mut self, scene: &Path, item: &str) -> Result<(), WorldError> {
        let wrong = |message: String| WorldError::Wrong {
            file: scene.display().to_string(),
            item: format!("furniture `{item}`"),
            message,
        };
        if !(self.scale.is_finite() && self.scale > 0.0 && self.front_deg.is_finite()) {
            return Err(wrong("the mesh's `scale` must be above 0, its `front_deg` a number".to_string()));
        }
        let path = scene.parent().unwrap_or(Path::new("")).join(&self.file);
        let triangles = obj::read(&path).map_err(|message| wrong(format!("mesh {}: {message}", path.display())))?;
        let mesh = Mesh::new(triangles.into_iter().map(|corners| corners.map(|c| self.upright(c))).collect());
        self.loaded = Some(Arc::new(mesh.map_err(|message| wrong(format!("mesh {}: {message}", path.display())))?));
        Ok(())
    }

    /// A corner of the file in the piece's own axes, metres.
    fn upright(&self, [x, y, z]: [f64; 3]) -> Point {
        let flat = match self.up {
            Up::Y => vec2(x, -z),
            Up::Z => vec2(x, y),
        };
        let height = if self.up == Up::Y { y } else { z };
        let (sin, cos) = (-self.front_deg.to_radians()).sin_cos();
        Point::new(cos * flat.x - sin * flat.y, sin * flat.x + cos * flat.y, height) * self.scale
    }
}

impl Mesh {
    fn new(mut triangles: Vec<[Point; 3]>) -> Result<Self, String> {
        let none = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
        let corners = || triangles.iter().flatten();
        let (low, high) = corners().fold(none, |(low, high), c| (low.inf(c), high.sup(c)));
        let extent = high - low;
        if !extent.iter().all(|v| v.is_finite() && *v > 0.0) {
            return Err("has no extent in one of its axes; is it a solid piece of furniture?".to_string());
        }
        // Triangles that lie upon each other are all drawn, in every picture.
        let area: f64 = triangles.iter().map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0).sum();
        let surface = 2.0 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
        if area > MESH_LAYERS.value as f64 * surface {
            return Err(MESH_LAYERS.exceeded(&format!("{:.0}", area / surface)));
        }
        let origin = Point::new((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z);
        triangles.iter_mut().flatten().for_each(|corner| *corner -= origin);
        let outline = Polygon::hull(triangles.iter().flatten().map(|c| vec2(c.x, c.y)).collect());
        let size = Size { length: extent.x, width: extent.y, height: extent.z };
        Ok(Self { bvh: Bvh::new(triangles), size, outline: outline.corners().to_vec() })
    }

    /// Its extent, metres.
    pub fn size(&self) -> Size {
        self.size
    }

    /// The convex hull of what stands over the floor.
    pub fn outline(&self) -> &[Vec2] {
        &self.outline
    }

    /// The triangles.
    pub fn triangles(&self) -> &[[Point; 3]] {
        self.bvh.triangles()
    }

    /// Where a ray first meets it beyond zero, in units of the direction, and the triangle's normal toward the ray.
    pub fn hit(&self, origin: Point, direction: Point) -> Option<(f64, Point)> {
        self.bvh.hit(origin, direction)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A box 1 × 2 × 0.5 in an OBJ with y up.
    pub(crate) const BOX: &str = "v 0 0 0\nv 1 0 0\nv 1 0 -2\nv 0 0 -2\nv 0 0.5 0\nv 1 0.5 0\nv 1 0.5 -2\nv 0 0.5 -2\n\
        f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

    fn loaded(text: &str, front_deg: f64) -> Result<Arc<Mesh>, String> {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("box.obj"), text).expect("written");
        let mut file = MeshFile { file: "box.obj".to_string(), up: Up::Y, scale: 1.0, front_deg, loaded: None };
        file.load(&folder.path().join("home.json"), "box-1").map_err(|error| error.to_string())?;
        file.loaded.ok_or_else(|| "not loaded".to_string())
    }

    #[test]
    fn a_mesh_stands_on_the_floor_with_its_box_round_the_origin() {
        let mesh = loaded(BOX, 0.0).expect("a mesh");
        let size = mesh.size();
        assert!(
            (size.length - 1.0).abs() < 1e-9 && (size.width - 2.0).abs() < 1e-9 && (size.height - 0.5).abs() < 1e-9
        );
        assert_eq!((mesh.triangles().len(), mesh.outline().len()), (12, 4));
        let (t, normal) = mesh.hit(Point::new(-3.0, 0.0, 0.2), Point::new(1.0, 0.0, 0.0)).expect("a hit");
        assert!((t - 2.5).abs() < 1e-9 && normal.x < -0.9);
        assert!(mesh.hit(Point::new(-3.0, 0.0, 0.7), Point::new(1.0, 0.0, 0.0)).is_none());
    }

    #[test]
    fn turning_the_front_swaps_length_and_width() {
        let size = loaded(BOX, 90.0).expect("a mesh").size();
        assert!((size.length - 2.0).abs() < 1e-9 && (size.width - 1.0).abs() < 1e-9);
    }

    #[test]
    fn faces_upon_each_other_and_more_faces_than_are_taken_are_refused() {
        let layers = BOX.to_string() + &"f 1 2 3\n".repeat(20_000);
        let error = loaded(&layers, 0.0).expect_err("layers");
        assert!(error.contains("times the area of the box in triangles are more than the 50"), "{error}");
        let many = BOX.to_string() + &"f 1 2 3\n".repeat(1_000_001);
        assert!(loaded(&many, 0.0).expect_err("many").contains("1000013 triangles are more than the 1000000"));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_mesh_without_an_end_is_refused() {
        let mut file = MeshFile { file: "/dev/zero".into(), up: Up::Y, scale: 1.0, front_deg: 0.0, loaded: None };
        let error = file.load(Path::new("home.json"), "box-1").expect_err("endless").to_string();
        assert!(error.contains("more than the 67108864 bytes that are taken of a mesh file"), "{error}");
    }

    #[test]
    fn what_is_no_mesh_is_refused_by_piece_and_file() {
        let error = loaded("v 0 0 0\n", 0.0).expect_err("no mesh");
        assert!(error.contains("furniture `box-1`: mesh") && error.contains("no triangles"), "{error}");
        assert!(loaded("f 1 2 3\n", 0.0).is_err());
    }
}
