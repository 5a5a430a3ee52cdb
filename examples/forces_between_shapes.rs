//! Where one GeoJSON polygon lies of another, by histograms of forces: `cargo run --example forces_between_shapes`.

use spatial_fetch::force::{Axes, Description, Force, RelativePosition, Shape, polygon};

const TABLE: &str = r#"{"type": "Polygon", "coordinates": [[[2, 1], [3, 1], [3, 2], [2, 2], [2, 1]]]}"#;
const COUCH: &str = r#"{"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 0.9], [0, 0.9], [0, 0]]]}"#;

fn shape(geometry: &str) -> Result<Shape, Box<dyn std::error::Error>> {
    let rings = serde_json::from_str::<serde_json::Value>(geometry)?["coordinates"].take();
    Ok(Shape::from_parts(&[serde_json::from_value(rings)?])?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (table, couch) = (shape(TABLE)?, shape(COUCH)?);
    // A force that does not fade with distance, in sixteen directions.
    let forces = polygon::histograms(&table, &couch, &[Force::Power(0.0)], 16);
    for (i, force) in forces[0].as_ref().map_err(|_| "the force is infinite")?.values().iter().enumerate() {
        println!("{:5.1}°  {force:.3}", 22.5 * i as f64);
    }
    // The couch faces south.
    let axes = Axes::Body { heading: -std::f64::consts::FRAC_PI_2 };
    println!(
        "{}",
        Description::of(&RelativePosition::between(&table, &couch), axes).sentence("the table", "the couch")
    );
    Ok(())
}
