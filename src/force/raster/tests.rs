use super::*;
use crate::force::{Shape, polygon};
use crate::geometry::vec2;

/// The same object as cells and as rectangles, one for each cell.
fn both(rows: &[&str]) -> (Raster, Shape) {
    let height = rows.len();
    let mut parts = Vec::new();
    for (row, cells) in rows.iter().enumerate() {
        for (column, _) in cells.chars().enumerate().filter(|(_, cell)| *cell == '#') {
            let (x, y) = (column as f64, (height - row - 1) as f64);
            parts.push(vec![vec2(x, y), vec2(x + 1.0, y), vec2(x + 1.0, y + 1.0), vec2(x, y + 1.0)]);
        }
    }
    (Raster::from_rows(rows, 1.0).expect("a grid"), Shape::of_cells(parts))
}

fn assert_alike(raster: &Histogram, polygon: &Histogram) {
    let peak = polygon.peak();
    for (i, (r, p)) in raster.values().iter().zip(polygon.values()).enumerate() {
        assert!((r - p).abs() <= 1e-10 * peak, "direction {i}: {r} is not {p}");
    }
}

const RING: [&str; 7] = [".......", ".#####.", ".#...#.", ".#...#.", ".#...#.", ".####..", "......."];
const DOT: [&str; 7] = [".......", ".......", ".......", "...#...", ".......", ".......", "......."];
const CORNER: [&str; 7] = ["#......", "##.....", ".......", ".......", ".......", ".......", "......."];

#[test]
fn cells_and_the_squares_they_are_have_one_histogram() {
    for (rows_a, rows_b) in [(RING, DOT), (CORNER, DOT), (DOT, CORNER)] {
        let ((a, polygon_a), (b, polygon_b)) = (both(&rows_a), both(&rows_b));
        let pair = RasterPair::new(&a, &b, Fuzzy::Product).expect("one grid");
        for force in [0.0, 0.5, 1.0, 2.0, 3.0].map(Force::Power).into_iter().chain([Force::Hybrid(1.3)]) {
            let raster = pair.histogram(force, 72).expect("apart");
            assert_alike(&raster, &polygon::histogram(&polygon_a, &polygon_b, force, 72).expect("apart"));
        }
    }
}

#[test]
fn overlapping_cells_have_finite_forces_below_one_and_the_hybrid() {
    let ((a, polygon_a), (b, polygon_b)) = (both(&RING), both(&RING));
    let pair = RasterPair::new(&a, &b, Fuzzy::Product).expect("one grid");
    assert_eq!(pair.histogram(Force::Power(1.0), 8), Err(Infinite));
    for force in [Force::Power(0.0), Force::Power(0.5), Force::Hybrid(2.0)] {
        let raster = pair.histogram(force, 40).expect("finite");
        assert_alike(&raster, &polygon::histogram(&polygon_a, &polygon_b, force, 40).expect("finite"));
    }
}

#[test]
fn cells_that_touch_have_no_finite_gravitation() {
    let a = Raster::from_rows(&["#.", ".."], 1.0).expect("a grid");
    let b = Raster::from_rows(&["..", ".#"], 1.0).expect("a grid");
    let pair = RasterPair::new(&a, &b, Fuzzy::Product).expect("one grid");
    assert_eq!(pair.histogram(Force::Power(2.0), 8), Err(Infinite));
    assert!(pair.histogram(Force::Power(1.5), 8).is_ok());
    assert_eq!(pair.distance(), 0.0);
}

#[test]
fn a_long_ray_keeps_its_digits() {
    let far = format!("{}#", ".".repeat(400));
    let near = format!("#{}", ".".repeat(400));
    let (a, b) = (Raster::from_rows(&[far], 0.1).expect("a grid"), Raster::from_rows(&[near], 0.1).expect("a grid"));
    let value =
        RasterPair::new(&a, &b, Fuzzy::Product).expect("one grid").histogram(Force::Power(2.0), 4).expect("apart");
    let want = 0.1 * (400.0_f64 * 400.0 / (399.0 * 401.0)).ln();
    assert!((value.values()[0] / want - 1.0).abs() < 1e-10, "{} {want}", value.values()[0]);
}

#[test]
fn a_fuzzy_pair_is_the_sum_of_its_cuts() {
    let a = Raster::from_rows(&["..36", "..9.", "...."], 1.0).expect("a grid");
    let b = Raster::from_rows(&["....", "....", "93.."], 1.0).expect("a grid");
    let at_least = |raster: &Raster, m: f64| {
        let levels = (0..12).map(|i| u8::from(raster.membership(i % 4, i / 4) >= m - 1e-9)).collect();
        Raster::from_levels(4, 3, levels, 1, 1.0).expect("a cut")
    };
    let value = |a: &Raster, b: &Raster, fuzzy| {
        RasterPair::new(a, b, fuzzy).expect("one grid").histogram(Force::Power(0.0), 16).expect("finite").values()[2]
    };
    let thirds = [1.0 / 3.0, 2.0 / 3.0, 1.0];
    let single: f64 = thirds.map(|m| value(&at_least(&a, m), &at_least(&b, m), Fuzzy::Product) / 3.0).iter().sum();
    assert!((value(&a, &b, Fuzzy::Minimum) - single).abs() < 1e-12);
    let pairs = thirds.map(|m| thirds.map(|n| value(&at_least(&a, m), &at_least(&b, n), Fuzzy::Product) / 9.0));
    let double: f64 = pairs.iter().flatten().sum();
    assert!((value(&a, &b, Fuzzy::Product) - double).abs() < 1e-12);
}
