//! Shapes as records hold them: GeoJSON, grids, masks.

use std::fmt;
use std::path::PathBuf;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::mask::read_mask;
use super::raster::Raster;
use super::{Shape, ShapeError};
use crate::record::{Record, StageError, message_without_position};

/// What belongs into `a` and `b`.
const WANTED: &str = "give a GeoJSON Polygon or MultiPolygon, a {\"grid\":{\"rows\":[…],\"cell_m\":…}}, or a {\"mask\":\"file.png\",\"cell_m\":…}";

/// One object of a record, and what it is called.
#[derive(Debug)]
pub(super) struct Object {
    pub(super) name: Option<String>,
    pub(super) extent: Extent,
}

/// An object in one of the two forms.
#[derive(Debug)]
pub(super) enum Extent {
    Polygons(Shape),
    Cells(Raster),
}

/// The keys an object may have.
#[derive(Debug, Default, Deserialize)]
struct Fields<'r> {
    #[serde(rename = "type", borrow, default)]
    kind: Option<std::borrow::Cow<'r, str>>,
    #[serde(borrow)]
    coordinates: Option<&'r RawValue>,
    #[serde(borrow)]
    geometry: Option<&'r RawValue>,
    properties: Option<Properties>,
    grid: Option<Grid>,
    mask: Option<PathBuf>,
    cell_m: Option<f64>,
    name: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Properties {
    name: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Grid {
    rows: Vec<String>,
    cell_m: f64,
}

type Rings = Vec<Vec<Position>>;

/// Two numbers; a third one, the height, is not looked at.
#[derive(Clone, Copy, Debug)]
struct Position([f64; 2]);

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PositionVisitor)
    }
}

struct PositionVisitor;

impl<'de> Visitor<'de> for PositionVisitor {
    type Value = Position;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a position of two numbers")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut sequence: S) -> Result<Position, S::Error> {
        let mut number =
            |index| sequence.next_element::<f64>()?.ok_or_else(|| serde::de::Error::invalid_length(index, &self));
        let position = Position([number(0)?, number(1)?]);
        while sequence.next_element::<IgnoredAny>()?.is_some() {}
        Ok(position)
    }
}

/// The object under `key`.
pub(super) fn object(record: &Record, key: &str) -> Result<Object, StageError> {
    let fields: Fields = record.require(key, WANTED)?;
    let wrong = |message: String| StageError::new(format!("`{key}`: {message}"));
    read(fields).map_err(wrong)
}

fn read(fields: Fields) -> Result<Object, String> {
    let name = fields.name.or(fields.properties.and_then(|properties| properties.name));
    if let (Some("Feature"), Some(geometry)) = (fields.kind.as_deref(), fields.geometry) {
        let inner: Fields = serde_json::from_str(geometry.get()).map_err(|e| message_without_position(&e))?;
        let extent = extent(inner)?;
        return Ok(Object { name, extent });
    }
    let extent = extent(Fields { name: None, properties: None, ..fields })?;
    Ok(Object { name, extent })
}

fn extent(fields: Fields) -> Result<Extent, String> {
    if let Some(grid) = fields.grid {
        return Raster::from_rows(&grid.rows, grid.cell_m).map(Extent::Cells).map_err(|error| error.to_string());
    }
    if let Some(path) = fields.mask {
        return read_mask(&path, fields.cell_m.unwrap_or(1.0)).map(Extent::Cells);
    }
    let coordinates = |kind: &str| {
        let missing = format!("the {kind} has no `coordinates`; they are the rings of its outline and holes");
        fields.coordinates.map(RawValue::get).ok_or(missing)
    };
    let parts = match fields.kind.as_deref() {
        Some("Polygon") => vec![parse::<Rings>(coordinates("Polygon")?)?],
        Some("MultiPolygon") => parse::<Vec<Rings>>(coordinates("MultiPolygon")?)?,
        Some(other) => return Err(format!("a {other} has no area; {WANTED}")),
        None => return Err(format!("neither `type`, `grid` nor `mask` is there; {WANTED}")),
    };
    shape(&parts).map(Extent::Polygons).map_err(|error| error.to_string())
}

fn parse<'r, T: Deserialize<'r>>(text: &'r str) -> Result<T, String> {
    serde_json::from_str(text).map_err(|error| {
        format!("`coordinates`: {}, {} bytes into them", message_without_position(&error), error.column())
    })
}

fn shape(parts: &[Rings]) -> Result<Shape, ShapeError> {
    let plane = |ring: &Vec<Position>| ring.iter().map(|position| position.0).collect();
    let parts: Vec<Vec<Vec<[f64; 2]>>> = parts.iter().map(|rings| rings.iter().map(plane).collect()).collect();
    Shape::from_parts(&parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_a(json: &str) -> Result<Object, String> {
        let line = format!("{{\"a\":{json}}}");
        let record = Record::parse(&line).expect("a record");
        object(&record, "a").map_err(|error| error.message)
    }

    fn message(json: &str) -> String {
        read_a(json).expect_err("a bad shape")
    }

    #[test]
    fn features_grids_and_geometries_are_read_with_their_names() {
        let square = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0,7],[1,1],[0,0]]],"name":"bed"}"#;
        assert_eq!(read_a(square).expect("a polygon").name.as_deref(), Some("bed"));
        let feature = r#"{"type":"Feature","properties":{"name":"lamp"},"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]]]}}"#;
        let lamp = read_a(feature).expect("a feature");
        assert!(lamp.name.as_deref() == Some("lamp") && matches!(lamp.extent, Extent::Polygons(_)));
        let grid = read_a(r##"{"grid":{"rows":["..#"],"cell_m":0.05}}"##).expect("a grid");
        assert!(matches!(grid.extent, Extent::Cells(_)));
    }

    #[test]
    fn each_kind_of_bad_shape_is_called_by_its_name() {
        let ring = |corners: &str| message(&format!(r#"{{"type":"Polygon","coordinates":[[{corners}]]}}"#));
        assert!(ring("[0,0],[1,0],[1,1],[0,1]").contains("ring 1 is open"));
        assert!(ring("[0,0],[1,1],[1,0],[0,1],[0,0]").contains("crosses itself"));
        assert!(ring("[0,0],[1,\"x\"],[1,0],[0,0]").contains("14 bytes into them"));
        assert!(ring("[0],[1,1],[1,0],[0,0]").contains("a position of two numbers"));
        assert!(message(r#"{"type":"Polygon","coordinates":[]}"#).contains("the shape is empty"));
        assert!(message(r#"{"type":"Polygon"}"#).contains("has no `coordinates`"));
        assert!(message(r#"{"type":"Point","coordinates":[0,0]}"#).contains("a Point has no area"));
        assert!(message("{}").contains("neither `type`, `grid` nor `mask`"));
        assert!(message(r##"{"grid":{"rows":["1","11"],"cell_m":1}}"##).contains("row 2 has 2 cells"));
        assert!(message(r##"{"grid":{"rows":["#"],"cell_m":0}}"##).contains("not a positive number"));
    }
}
