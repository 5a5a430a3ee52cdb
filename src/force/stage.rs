//! `hof` as a stage: shapes in a record, histograms and a sentence out.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

use super::polygon::{histograms, hybrid};
use super::{DegreeOfTruth as Degree, Force, Relation, Shape, describe};
use crate::record::{DegreeOfTruth, Hof, HofForce, Note, Record, Stage, StageError};

/// A force as the user names it: a number r, or `hybrid`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceName {
    /// d^−r.
    Power(f64),
    /// r = 0 near, r = 2 far.
    Hybrid,
}

impl FromStr for ForceName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.trim() {
            "hybrid" => Ok(Self::Hybrid),
            number => match number.parse::<f64>() {
                Ok(r) if r.is_finite() => Ok(Self::Power(r)),
                _ => Err(format!("`{number}` is no force; give a number such as 0 or 2, or `hybrid`")),
            },
        }
    }
}

impl fmt::Display for ForceName {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Power(r) => write!(formatter, "{r}"),
            Self::Hybrid => formatter.write_str("hybrid"),
        }
    }
}

/// Computes histograms of forces for records that hold two shapes, `a` and `b`.
#[derive(Clone, Debug)]
pub struct Describer {
    /// The forces wanted.
    pub forces: Vec<ForceName>,
    /// Directions of the histograms.
    pub directions: usize,
}

/// A shape as GeoJSON has it.
#[derive(Debug, Deserialize)]
#[serde(tag = "type")]
enum Geometry {
    Polygon { coordinates: Vec<Vec<Vec<f64>>> },
    MultiPolygon { coordinates: Vec<Vec<Vec<Vec<f64>>>> },
}

impl Describer {
    fn shape(record: &Record, key: &str) -> Result<Shape, StageError> {
        let hint = "a GeoJSON Polygon or MultiPolygon geometry belongs there";
        let geometry: Geometry = record.require(key, hint)?;
        let parts = match geometry {
            Geometry::Polygon { coordinates } => vec![coordinates],
            Geometry::MultiPolygon { coordinates } => coordinates,
        };
        let mut plane = Vec::with_capacity(parts.len());
        for part in &parts {
            plane.push(part.iter().map(|ring| in_plane(ring, key)).collect::<Result<Vec<_>, _>>()?);
        }
        Shape::from_parts(&plane).map_err(|error| StageError::new(format!("`{key}`: {error}")))
    }

    fn measure(&self, a: &Shape, b: &Shape) -> Hof {
        let near = hybrid(a, b);
        let force = |name: &ForceName| if let ForceName::Power(r) = name { Force::Power(*r) } else { near };
        let forces: Vec<Force> = self.forces.iter().map(force).collect();
        let values = histograms(a, b, &forces, self.directions).into_iter().map(|h| match h {
            Ok(histogram) => HofForce::Values(histogram.values().to_vec()),
            Err(_) => HofForce::Infinite("infinite".to_string()),
        });
        let relation = Relation::between(a, b);
        let degrees = relation.degrees([0.0, 1.0, 2.0, 3.0].map(|quarter| quarter * FRAC_PI_2));
        Hof {
            directions: self.directions,
            forces: self.forces.iter().map(ToString::to_string).zip(values).collect(),
            degrees: named(degrees),
            main_deg: relation.main_direction().map(f64::to_degrees),
            distance_m: relation.distance(),
            description: describe("A", "B", degrees, relation.surround(), relation.distance()),
        }
    }
}

fn in_plane(ring: &[Vec<f64>], key: &str) -> Result<Vec<[f64; 2]>, StageError> {
    ring.iter()
        .map(|position| match position.as_slice() {
            [x, y, ..] => Ok([*x, *y]),
            _ => Err(StageError::new(format!("`{key}`: a position needs two numbers"))),
        })
        .collect()
}

fn named(degrees: [Degree; 4]) -> BTreeMap<String, DegreeOfTruth> {
    let names = ["right", "above", "left", "below"];
    names.into_iter().zip(degrees).map(|(name, d)| (name.to_string(), DegreeOfTruth { a: d.a, b: d.b })).collect()
}

impl Stage for Describer {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let (a, b) = (Self::shape(record, "a")?, Self::shape(record, "b")?);
        record.set("hof", &self.measure(&a, &b));
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let hof: Hof = record.require("hof", "it is what `hof` adds")?;
        Ok(hof.description)
    }
}
