//! `hof` as a stage: two shapes in a record, histograms and a sentence out.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::between::betweenness;
use super::input::{Extent, Object, object};
use super::polygon::{histograms, hybrid};
use super::raster::{Fuzzy, Raster, RasterPair};
use super::rose::picture;
use super::{Axes, AxesName, Description, Force, ForceName, Histogram, Infinite, RelativePosition};
use crate::escape::for_file_name;
use crate::files::{Claims, write_file};
use crate::record::{DegreeOfTruth, Hof, HofForce, Note, Record, Stage, StageError};

/// Where pictures go: each to `FOLDER/ID.svg`.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// Made if it is not there.
    pub folder: PathBuf,
    /// Whether files that exist may go.
    pub overwrite: bool,
    /// Which of them belong to which record of this run.
    pub claims: Claims,
}

/// Computes histograms of forces for records that hold two shapes, `a` and `b`, and describes where `a` is of `b`.
#[derive(Clone, Debug)]
pub struct Describer {
    /// The forces wanted.
    pub forces: Vec<ForceName>,
    /// Directions of the histograms.
    pub directions: usize,
    /// The frame in which directions are named.
    pub frame: AxesName,
    /// How memberships of fuzzy rasters combine.
    pub fuzzy: Fuzzy,
    /// Where to draw both objects and the histograms, when pictures are wanted.
    pub pictures: Option<Pictures>,
}

/// What two objects of one kind yield.
struct Measured {
    histograms: Vec<Result<Histogram, Infinite>>,
    relation: RelativePosition,
}

impl Describer {
    fn measure(&self, a: &Extent, b: &Extent) -> Result<Measured, StageError> {
        match (a, b) {
            (Extent::Polygons(a), Extent::Polygons(b)) => {
                let forces = self.forces_with(|| hybrid(a, b));
                let histograms = histograms(a, b, &forces, self.directions);
                Ok(Measured { histograms, relation: RelativePosition::between(a, b) })
            }
            (Extent::Cells(a), Extent::Cells(b)) => {
                let pair = self.pair(a, b, "b")?;
                let histograms = pair.histograms(&self.forces_with(|| pair.hybrid()), self.directions);
                Ok(Measured { histograms, relation: RelativePosition::between_rasters(a, b, &pair) })
            }
            _ => Err(mixed("b")),
        }
    }

    /// The third object, where there is one, and how far `a` lies between it and `b`.
    fn third(&self, record: &Record, a: &Object, to_b: &Measured) -> Result<Option<(Object, f64)>, StageError> {
        if record.raw("c").is_none() {
            return Ok(None);
        }
        let c = object(record, "c")?;
        let relation = match (&a.extent, &c.extent) {
            (Extent::Polygons(a), Extent::Polygons(c)) => RelativePosition::between(a, c),
            (Extent::Cells(a), Extent::Cells(c)) => RelativePosition::between_rasters(a, c, &self.pair(a, c, "c")?),
            _ => return Err(mixed("c")),
        };
        Ok(Some((c, betweenness(&to_b.relation, &relation))))
    }

    fn pair(&self, a: &Raster, other: &Raster, key: &str) -> Result<RasterPair, StageError> {
        RasterPair::new(a, other, self.fuzzy).map_err(|error| StageError::new(format!("`a`, `{key}`: {error}")))
    }

    fn forces_with(&self, hybrid: impl Fn() -> Force) -> Vec<Force> {
        let force = |name: &ForceName| if let ForceName::Power(r) = name { Force::Power(*r) } else { hybrid() };
        self.forces.iter().map(force).collect()
    }

    fn axes_of(&self, record: &Record) -> Result<Axes, StageError> {
        if self.frame == AxesName::Map {
            return Ok(Axes::Map);
        }
        let wanted = "the frame needs it: radians, counter-clockwise from +x";
        let heading: f64 = record.require("heading", wanted)?;
        Ok(match self.frame {
            AxesName::Map => Axes::Map,
            AxesName::Robot | AxesName::Intrinsic => Axes::Body { heading },
            AxesName::Viewer => Axes::Viewer { heading },
            AxesName::Facing => Axes::facing(heading),
        })
    }

    fn draw(&self, record: &Record, objects: [&Object; 2], measured: &Measured, hof: &Hof) -> Result<(), StageError> {
        let Some(pictures) = &self.pictures else { return Ok(()) };
        let id = record.id().ok_or_else(|| StageError::new("`id` is missing; pictures are named after it"))?;
        let finite = self.forces.iter().zip(&measured.histograms);
        let roses: Vec<(String, Histogram)> =
            finite.filter_map(|(name, h)| Some((format!("F {name}"), h.as_ref().ok()?.clone()))).collect();
        let [a, b] = objects;
        let names = [spoken(a, "A"), spoken(b, "B")];
        let svg = picture([&a.extent, &b.extent], [&names[0], &names[1]], &roses, &hof.description);
        pictures.save(&id, &svg).map_err(StageError::new)
    }
}

impl Pictures {
    fn save(&self, id: &str, svg: &str) -> Result<(), String> {
        std::fs::create_dir_all(&self.folder).map_err(|error| format!("{}: {error}", self.folder.display()))?;
        let path = self.folder.join(format!("{}.svg", for_file_name(id)));
        self.claims.claim(&path, id).map_err(|error| error.to_string())?;
        write_file(&path, svg.as_bytes(), self.overwrite).map_err(|error| error.to_string())
    }
}

fn mixed(key: &str) -> StageError {
    StageError::new(format!("`a`, `{key}`: one has polygons and the other cells; give both in one form"))
}

/// "the couch" for an object that has a name.
fn spoken(object: &Object, otherwise: &str) -> String {
    object.name.as_ref().map_or_else(|| otherwise.to_string(), |name| format!("the {name}"))
}

impl Stage for Describer {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let (a, b) = (object(record, "a")?, object(record, "b")?);
        let axes = self.axes_of(record)?;
        let measured = self.measure(&a.extent, &b.extent)?;
        let description = Description::of(&measured.relation, axes);
        let third = self.third(record, &a, &measured)?;
        let names = axes.directions().map(|words| words.name.to_string());
        let degrees = description.degrees.map(|d| DegreeOfTruth { a: rounded(d.a, 1e6), b: rounded(d.b, 1e6) });
        let hof = Hof {
            directions: self.directions,
            forces: self.forces.iter().map(ToString::to_string).zip(measured.histograms.iter().map(values)).collect(),
            degrees: BTreeMap::from_iter(names.into_iter().zip(degrees)),
            main_deg: measured.relation.main_direction().map(|theta| rounded(theta.to_degrees(), 1e2)),
            distance_m: rounded(measured.relation.distance(), 1e6),
            closeness: description.closeness.name().to_string(),
            inside: rounded(measured.relation.inside(), 1e6),
            surrounded: rounded(measured.relation.surrounded(), 1e6),
            surrounds: rounded(measured.relation.surround(), 1e6),
            between: third.as_ref().map(|(_, between)| rounded(*between, 1e6)),
            description: match &third {
                Some((c, between)) => {
                    let names = [spoken(&a, "A"), spoken(&b, "B"), spoken(c, "C")];
                    description.sentence_of_three(*between, names.each_ref().map(String::as_str))
                }
                None => description.sentence(&spoken(&a, "A"), &spoken(&b, "B")),
            },
        };
        self.draw(record, [&a, &b], &measured, &hof)?;
        record.put(&hof);
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let hof: Hof = record.require_part("it is what `hof` adds")?;
        Ok(hof.description)
    }
}

fn values(histogram: &Result<Histogram, Infinite>) -> HofForce {
    match histogram {
        Ok(histogram) => HofForce::Values(histogram.values().iter().map(|v| twelve_digits(*v)).collect()),
        Err(Infinite) => HofForce::Infinite("infinite".to_string()),
    }
}

fn rounded(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit + 0.0
}

/// Twelve significant digits: what is left is rounding, and may differ between machines.
fn twelve_digits(value: f64) -> f64 {
    if value == 0.0 || !value.is_normal() {
        return 0.0;
    }
    let places = 11 - value.abs().log10().floor() as i32;
    if !(-290..=290).contains(&places) {
        return value;
    }
    let scale = 10.0_f64.powi(places.abs());
    if places >= 0 { (value * scale).round() / scale } else { (value / scale).round() * scale }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn describer(frame: AxesName) -> Describer {
        let forces = vec![ForceName::Power(0.0), ForceName::Power(2.0), ForceName::Hybrid];
        Describer { forces, directions: 16, frame, fuzzy: Fuzzy::Product, pictures: None }
    }

    fn run(frame: AxesName, line: &str) -> Result<Hof, StageError> {
        let mut record = Record::parse(line).expect("a record");
        describer(frame).run(&mut record)?;
        Ok(record.get("hof").expect("readable").expect("added"))
    }

    const TOUCHING: &str = r#"{"id":1,"heading":1.5707963267948966,
        "a":{"name":"table","type":"Polygon","coordinates":[[[1,0],[2,0],[2,1],[1,1],[1,0]]]},
        "b":{"name":"couch","type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}}"#;

    #[test]
    fn forces_that_diverge_are_called_infinite() {
        let hof = run(AxesName::Map, TOUCHING).expect("described");
        assert_eq!(hof.forces["2"], HofForce::Infinite("infinite".to_string()));
        assert!(matches!(hof.forces["hybrid"], HofForce::Values(_)));
        assert_eq!((hof.distance_m, hof.main_deg), (0.0, Some(0.0)));
    }

    #[test]
    fn with_a_third_object_it_is_told_what_lies_between() {
        let square = |name: &str, x: f64| {
            let y = x + 1.0;
            format!(r#"{{"name":"{name}","type":"Polygon","coordinates":[[[{x},0],[{y},0],[{y},1],[{x},1],[{x},0]]]}}"#)
        };
        let line = |a: f64| {
            let (a, b, c) = (square("lamp", a), square("bed", 0.0), square("desk", 6.0));
            format!(r#"{{"a":{a},"b":{b},"c":{c}}}"#)
        };
        let inside = run(AxesName::Map, &line(3.0)).expect("described");
        assert_eq!(inside.description, "The lamp is between the bed and the desk.");
        let outside = run(AxesName::Map, &line(9.0)).expect("described");
        assert!(outside.between.is_some_and(|b| b < 0.1) && outside.description.contains("right of the bed"));
    }

    #[test]
    fn directions_are_named_in_the_frame_asked_for() {
        let said = |frame| run(frame, TOUCHING).expect("described").description;
        let right = "The table is directly to the right of the couch, touching it; the description is satisfactory.";
        assert_eq!(said(AxesName::Robot), right);
        assert_eq!(said(AxesName::Facing), right.replace("right", "left"));
    }

    #[test]
    fn a_frame_without_a_heading_says_what_it_misses() {
        let error = run(AxesName::Viewer, &TOUCHING.replace("heading", "x")).expect_err("no heading");
        assert!(error.message.contains("`heading`: missing; the frame needs it"), "{error}");
    }

    #[test]
    fn polygons_and_cells_do_not_mix() {
        let line = r##"{"a":{"grid":{"rows":["#"],"cell_m":1}},"b":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}"##;
        assert!(run(AxesName::Map, line).expect_err("mixed").message.contains("give both in one form"));
    }

    #[test]
    fn numbers_keep_twelve_digits() {
        assert_eq!(twelve_digits(1.0 / 3.0), 0.333_333_333_333);
        assert_eq!(twelve_digits(2.0e20 / 3.0), 66_666_666_666_700_000_000.0);
        assert_eq!(twelve_digits(0.0), 0.0);
    }
}
