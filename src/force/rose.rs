//! A picture of two objects and their histogram as a rose.

use std::f64::consts::TAU;
use std::fmt::Write;

use super::input::Extent;
use super::raster::Raster;
use super::{Histogram, Shape};
use crate::escape::for_markup;
use crate::geometry::{Vec2, vec2};

/// Side of each of the two panels, in units of the picture.
const PANEL: f64 = 320.0;
const MARGIN: f64 = 24.0;
const CAPTION: f64 = 44.0;
const A_COLOR: &str = "#c44e52";
const B_COLOR: &str = "#4c72b0";
const ROSE_COLORS: [&str; 6] = ["#55a868", "#8172b3", "#ccb974", "#64b5cd", "#937860", "#da8bc3"];

/// An SVG of `a` and `b` on the left and their histograms on the right, each scaled to its peak.
pub(super) fn picture(objects: [&Extent; 2], names: [&str; 2], roses: &[(String, Histogram)], caption: &str) -> String {
    let (width, height) = (2.0 * PANEL + 3.0 * MARGIN, PANEL + 2.0 * MARGIN + CAPTION);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    draw_objects(&mut svg, objects, names);
    draw_roses(&mut svg, roses);
    let (x, y) = (width / 2.0, height - 0.6 * CAPTION);
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>\n</svg>", for_markup(caption));
    svg
}

/// From the plane of the objects (y up) to the left panel (y down).
struct View {
    middle: Vec2,
    scale: f64,
}

impl View {
    fn new(objects: [&Extent; 2]) -> Self {
        let [(l1, h1), (l2, h2)] = objects.map(|object| match object {
            Extent::Polygons(shape) => shape.bounds(),
            Extent::Cells(raster) => raster.bounds(),
        });
        let (low, high) = (l1.inf(&l2), h1.sup(&h2));
        Self { middle: (low + high) / 2.0, scale: PANEL / (high - low).max().max(f64::MIN_POSITIVE) }
    }

    fn place(&self, point: Vec2) -> Vec2 {
        let d = (point - self.middle) * self.scale;
        vec2(MARGIN + PANEL / 2.0 + d.x, MARGIN + PANEL / 2.0 - d.y)
    }
}

fn draw_objects(svg: &mut String, objects: [&Extent; 2], names: [&str; 2]) {
    let view = View::new(objects);
    // A lies over B where the two overlap.
    for (object, color) in objects.into_iter().zip([A_COLOR, B_COLOR]).rev() {
        match object {
            Extent::Polygons(shape) => draw_shape(svg, &view, shape, color),
            Extent::Cells(raster) => draw_cells(svg, &view, raster, color),
        }
    }
    for (i, (name, color)) in names.into_iter().zip([A_COLOR, B_COLOR]).enumerate() {
        let x = MARGIN + i as f64 * PANEL / 2.0;
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{}\" fill=\"{color}\">{}</text>", MARGIN - 8.0, for_markup(name));
    }
}

fn draw_shape(svg: &mut String, view: &View, shape: &Shape, color: &str) {
    let mut path = String::new();
    for ring in shape.rings() {
        for (i, corner) in ring.iter().enumerate() {
            let place = view.place(*corner);
            let _ = write!(path, "{}{:.2} {:.2}", if i == 0 { "M" } else { "L" }, place.x, place.y);
        }
        path.push('Z');
    }
    let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{color}\" fill-opacity=\"0.6\" stroke=\"{color}\"/>");
}

/// Each run of equal cells is one rectangle.
fn draw_cells(svg: &mut String, view: &View, raster: &Raster, color: &str) {
    let (_, height) = raster.size();
    let side = raster.cell() * view.scale;
    for (row, cells) in raster.rows().enumerate() {
        let mut column = 0;
        for run in cells.chunk_by(|p, q| p == q) {
            let corner = view.place(vec2(column as f64, (height - row) as f64) * raster.cell());
            let opacity = 0.8 * raster.membership(column, row);
            column += run.len();
            if opacity > 0.0 {
                let width = run.len() as f64 * side;
                let _ = writeln!(
                    svg,
                    "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{side:.2}\" fill=\"{color}\" fill-opacity=\"{opacity:.2}\"/>",
                    corner.x, corner.y
                );
            }
        }
    }
}

fn draw_roses(svg: &mut String, roses: &[(String, Histogram)]) {
    let radius = PANEL / 2.0;
    let (x, y) = (2.0 * MARGIN + PANEL + radius, MARGIN + radius);
    for share in [0.5, 1.0] {
        let _ = writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\" fill=\"none\" stroke=\"#ccc\"/>", share * radius);
    }
    let _ = writeln!(
        svg,
        "<path d=\"M{} {y}H{}M{x} {}V{}\" stroke=\"#ccc\"/>",
        x - radius,
        x + radius,
        y - radius,
        y + radius
    );
    for (i, (name, histogram)) in roses.iter().enumerate() {
        let color = ROSE_COLORS[i % ROSE_COLORS.len()];
        draw_rose(svg, histogram, (x, y), radius, color);
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" fill=\"{color}\">{}</text>",
            x - radius + 60.0 * i as f64,
            MARGIN - 8.0,
            for_markup(name)
        );
    }
}

fn draw_rose(svg: &mut String, histogram: &Histogram, (x, y): (f64, f64), radius: f64, color: &str) {
    let (values, peak) = (histogram.values(), histogram.peak());
    if peak <= 0.0 {
        return;
    }
    let mut points = String::new();
    for (i, value) in values.iter().enumerate() {
        let (sin, cos) = (TAU * i as f64 / values.len() as f64).sin_cos();
        let length = radius * value / peak;
        let _ = write!(points, "{:.2},{:.2} ", x + length * cos, y - length * sin);
    }
    let points = points.trim_end();
    let _ = writeln!(
        svg,
        "<polygon points=\"{points}\" fill=\"{color}\" fill-opacity=\"0.3\" stroke=\"{color}\" stroke-linejoin=\"round\"/>"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_holds_both_objects_the_rose_and_the_caption() {
        let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
        let (a, b) = (Extent::Polygons(square(2.0)), Extent::Polygons(square(0.0)));
        let roses = [("0".to_string(), Histogram::from_values(vec![1.0, 0.0, 0.0, 0.0]))];
        let svg = picture([&a, &b], ["A & C", "B"], &roses, "A < B");
        assert_eq!(svg.matches("<path d=\"M").count(), 3);
        assert_eq!(svg.matches("<polygon").count(), 1);
        assert!(svg.contains("A &amp; C") && svg.contains("A &lt; B") && svg.ends_with("</svg>\n"));
    }
}
