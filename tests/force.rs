//! The histogram of forces against values computed independently (fixtures/hof/cases.json), and the laws it obeys.

use std::f64::consts::{FRAC_PI_2, TAU};

use proptest::prelude::*;
use serde::Deserialize;
use serde_json::Value;
use spatial_fetch::force::raster::{Fuzzy, Raster, RasterPair};
use spatial_fetch::force::{Force, Histogram, Infinite, Shape, degree_of_truth, main_direction, polygon};

#[derive(Deserialize)]
struct Cases {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    #[serde(rename = "A")]
    a: Vec<Vec<[f64; 2]>>,
    #[serde(rename = "B")]
    b: Vec<Vec<[f64; 2]>>,
    #[serde(rename = "hybrid_Y0")]
    near: f64,
    values: Vec<serde_json::Map<String, Value>>,
    #[serde(rename = "degrees_N180")]
    degrees: serde_json::Map<String, Value>,
}

/// All forces that the cases name.
fn forces(case: &Case) -> [(&'static str, Force); 5] {
    let power = Force::Power;
    [
        ("F0", power(0.0)),
        ("F0.5", power(0.5)),
        ("F1", power(1.0)),
        ("F2", power(2.0)),
        ("F02", Force::Hybrid(case.near)),
    ]
}

fn cases() -> Vec<Case> {
    let text = include_str!("../fixtures/hof/cases.json");
    serde_json::from_str::<Cases>(text).expect("the cases are JSON").cases
}

fn shape(rings: &[Vec<[f64; 2]>]) -> Shape {
    let area = |ring: &[[f64; 2]]| -> f64 {
        (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()])).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum()
    };
    let closed = |ring: &Vec<[f64; 2]>| ring.iter().chain(ring.first()).copied().collect::<Vec<_>>();
    let (outer, holes): (Vec<_>, Vec<_>) = rings.iter().partition(|ring| area(ring) > 0.0);
    let mut parts: Vec<Vec<Vec<[f64; 2]>>> = outer.into_iter().map(|ring| vec![closed(ring)]).collect();
    parts[0].extend(holes.into_iter().map(closed));
    Shape::from_parts(&parts).expect("the cases are valid shapes")
}

/// The object as cells of half a metre, when all its corners lie on their grid.
fn raster(shape: &Shape, rings: &[Vec<[f64; 2]>]) -> Option<Raster> {
    const CELL: f64 = 0.5;
    const SIDE: usize = 64;
    let on_grid = |v: f64| (v / CELL).fract() == 0.0 && (v / CELL).abs() < (SIDE / 2) as f64;
    let axis_parallel = |ring: &Vec<[f64; 2]>| {
        (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()])).all(|(p, q)| p[0] == q[0] || p[1] == q[1])
    };
    let fits = rings.iter().all(axis_parallel) && rings.iter().flatten().all(|p| on_grid(p[0]) && on_grid(p[1]));
    let coordinate = |i: usize| (i as f64 + 0.5 - (SIDE / 2) as f64) * CELL;
    let cell = |i: usize| {
        let (x, y) = (coordinate(i % SIDE), -coordinate(i / SIDE));
        u8::from(shape.contains(spatial_fetch::geometry::vec2(x, y)))
    };
    fits.then(|| Raster::from_levels(SIDE, SIDE, (0..SIDE * SIDE).map(cell).collect(), 1, CELL).expect("a raster"))
}

/// Compares with the values of a case; a force that has none must be infinite. Returns how many were compared.
fn compare(case: &Case, name: &str, computed: Result<Histogram, Infinite>) -> usize {
    let wanted: Vec<(usize, f64)> =
        case.values.iter().filter_map(|v| Some((v["theta_deg"].as_u64()? as usize, v.get(name)?.as_f64()?))).collect();
    let Ok(histogram) = computed else {
        assert!(wanted.is_empty(), "{}: {name} should be finite", case.name);
        return 0;
    };
    assert!(!wanted.is_empty(), "{}: {name} should be infinite", case.name);
    for (degrees, want) in &wanted {
        let got = histogram.values()[degrees / 5];
        assert!((got - want).abs() <= (1e-7 * want).max(1e-9), "{} {name} {degrees}°: {got} is not {want}", case.name);
    }
    wanted.len()
}

#[test]
fn polygons_have_the_forces_of_all_cases() {
    let mut compared = 0;
    for case in cases() {
        let (a, b) = (shape(&case.a), shape(&case.b));
        for (name, force) in forces(&case) {
            compared += compare(&case, name, polygon::histogram(&a, &b, force, 72));
        }
    }
    assert!(compared > 600, "only {compared} values compared");
}

#[test]
fn rectilinear_cases_have_the_same_forces_as_rasters() {
    let mut compared = 0;
    for case in cases() {
        let (a, b) = (shape(&case.a), shape(&case.b));
        let (Some(cells_a), Some(cells_b)) = (raster(&a, &case.a), raster(&b, &case.b)) else { continue };
        let pair = RasterPair::new(&cells_a, &cells_b, Fuzzy::Product).expect("one grid");
        for (name, force) in forces(&case) {
            compared += compare(&case, name, pair.histogram(force, 72));
        }
    }
    assert!(compared > 400, "only {compared} values compared");
}

#[test]
fn degrees_of_truth_are_the_published_ones() {
    for case in cases() {
        let (a, b) = (shape(&case.a), shape(&case.b));
        for (name, force) in forces(&case) {
            let Some(wanted) = case.degrees.get(name) else { continue };
            let histogram = polygon::histogram(&a, &b, force, 180).expect("finite");
            for (quarter, direction) in ["right", "above", "left", "below"].into_iter().enumerate() {
                let degree = degree_of_truth(&histogram, quarter as f64 * FRAC_PI_2);
                let want = |key: &str| wanted[direction][key].as_f64().expect("a number");
                let near = |got: f64, want: f64| (got - want).abs() < 1e-3;
                assert!(
                    near(degree.a, want("a")) && near(degree.b, want("b")),
                    "{} {name} {direction}: {degree:?}",
                    case.name
                );
            }
        }
    }
}

#[test]
fn the_main_direction_is_at_least_as_true_as_the_best_of_all() {
    for case in cases() {
        let (a, b) = (shape(&case.a), shape(&case.b));
        for (name, force) in forces(&case) {
            let Some(wanted) = case.degrees.get(name) else { continue };
            let best = wanted["best_a"].as_f64().expect("a number");
            let histogram = polygon::histogram(&a, &b, force, 180).expect("finite");
            // A tie answers its axis, which may be a little less true than its flanks.
            let found = main_direction(&histogram).map_or(0.0, |theta| degree_of_truth(&histogram, theta).a);
            assert!(found > best - 0.01, "{} {name}: {found} against {best}", case.name);
        }
    }
}

fn polygon_from(x: f64, y: f64, radii: &[f64]) -> Shape {
    let corner = |(i, radius): (usize, &f64)| {
        let angle = TAU * i as f64 / radii.len() as f64;
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    Shape::from_ring(radii.iter().enumerate().map(corner).collect())
}

fn moved(shape: &Shape, map: impl Fn(f64, f64) -> [f64; 2]) -> Shape {
    let ring = |ring: &Vec<spatial_fetch::geometry::Vec2>| {
        let mut ring: Vec<[f64; 2]> = ring.iter().map(|c| map(c.x, c.y)).collect();
        ring.push(ring[0]);
        vec![ring]
    };
    Shape::from_parts(&shape.rings().iter().map(ring).collect::<Vec<_>>()).expect("a moved shape is a shape")
}

fn star() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.3..1.0_f64, 3..14)
}

/// Two stars that do not touch: the second one stands at the origin.
fn apart() -> impl Strategy<Value = (Shape, Shape)> {
    (star(), star(), 2.1..6.0_f64, 0.0..TAU).prop_map(|(a, b, distance, angle)| {
        (polygon_from(distance * angle.cos(), distance * angle.sin(), &a), polygon_from(0.0, 0.0, &b))
    })
}

fn force() -> impl Strategy<Value = Force> {
    prop_oneof![
        (-1.0..4.0_f64).prop_map(Force::Power),
        Just(Force::Power(0.0)),
        Just(Force::Power(2.0)),
        (0.01..5.0_f64).prop_map(Force::Hybrid)
    ]
}

fn histogram(a: &Shape, b: &Shape, force: Force) -> Histogram {
    polygon::histogram(a, b, force, 72).expect("the two are apart")
}

fn assert_same(got: &[f64], want: &[f64], tolerance: f64) -> Result<(), TestCaseError> {
    let peak = want.iter().copied().fold(0.0, f64::max);
    for (i, (g, w)) in got.iter().zip(want).enumerate() {
        prop_assert!((g - w).abs() <= tolerance * peak, "direction {}: {} is not {}", i, g, w);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(128) })]

    #[test]
    fn seen_from_the_other_object_the_histogram_is_half_a_turn_round((a, b) in apart(), force in force()) {
        let reversed = histogram(&b, &a, force).reversed();
        assert_same(histogram(&a, &b, force).values(), reversed.values(), 1e-9)?;
    }

    #[test]
    fn moving_both_changes_nothing((a, b) in apart(), force in force(), x in -1e3..1e3_f64, y in -1e3..1e3_f64) {
        let shift = |shape: &Shape| moved(shape, |px, py| [px + x, py + y]);
        assert_same(histogram(&shift(&a), &shift(&b), force).values(), histogram(&a, &b, force).values(), 1e-8)?;
    }

    #[test]
    fn turning_both_turns_the_histogram((a, b) in apart(), force in force(), steps in 1_usize..72) {
        let (sin, cos) = (TAU * steps as f64 / 72.0).sin_cos();
        let turn = |shape: &Shape| moved(shape, |x, y| [cos * x - sin * y, sin * x + cos * y]);
        let mut turned = histogram(&turn(&a), &turn(&b), force).values().to_vec();
        turned.rotate_left(steps);
        assert_same(&turned, histogram(&a, &b, force).values(), 1e-8)?;
    }

    #[test]
    fn scaling_by_k_multiplies_by_k_to_the_3_minus_r((a, b) in apart(), r in -1.0..4.0_f64, k in 0.01..100.0_f64) {
        let scale = |shape: &Shape| moved(shape, |x, y| [k * x, k * y]);
        let scaled = histogram(&scale(&a), &scale(&b), Force::Power(r));
        let want: Vec<f64> = histogram(&a, &b, Force::Power(r)).values().iter().map(|v| v * k.powf(3.0 - r)).collect();
        assert_same(scaled.values(), &want, 1e-8)?;
    }

    #[test]
    fn parts_add_up((a, b) in apart(), force in force(), radii in star()) {
        let other = polygon_from(-9.0, 2.0, &radii);
        let ring = |shape: &Shape| {
            let mut ring: Vec<[f64; 2]> = shape.rings()[0].iter().map(|c| [c.x, c.y]).collect();
            ring.push(ring[0]);
            vec![ring]
        };
        let together = Shape::from_parts(&[ring(&a), ring(&other)]).expect("two parts");
        let sum: Vec<f64> = histogram(&a, &b, force).values().iter()
            .zip(histogram(&other, &b, force).values()).map(|(x, y)| x + y).collect();
        assert_same(histogram(&together, &b, force).values(), &sum, 1e-8)?;
    }

    #[test]
    fn the_hybrid_force_is_gravitational_beyond_its_radius((a, b) in apart(), share in 0.01..0.999_f64) {
        let near = share * a.distance(&b);
        let hybrid = histogram(&a, &b, Force::Hybrid(near));
        assert_same(hybrid.values(), histogram(&a, &b, Force::Power(2.0)).values(), 1e-9)?;
    }

    #[test]
    fn the_hybrid_force_is_constant_within_its_radius((a, b) in apart()) {
        let hybrid = histogram(&a, &b, Force::Hybrid(20.0));
        let want: Vec<f64> = histogram(&a, &b, Force::Power(0.0)).values().iter().map(|v| v / 400.0).collect();
        assert_same(hybrid.values(), &want, 1e-9)?;
    }

    #[test]
    fn rectangles_of_cells_are_rectangles(x in 0_usize..20, y in 0_usize..20, w in 1_usize..9, h in 1_usize..9, power in 0.0..3.0_f64) {
        prop_assume!(x > 5 || y > 4);
        let cells = |x: usize, y: usize, w: usize, h: usize| {
            let inside = |i: usize| (x..x + w).contains(&(i % 32)) && (y..y + h).contains(&(31 - i / 32));
            Raster::from_levels(32, 32, (0..1024).map(|i| u8::from(inside(i))).collect(), 1, 1.0).expect("a raster")
        };
        let shape = |x: usize, y: usize, w: usize, h: usize| {
            let (x, y, w, h) = (x as f64, y as f64, w as f64, h as f64);
            Shape::from_ring(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]])
        };
        let pair = RasterPair::new(&cells(x, y, w, h), &cells(0, 0, 5, 4), Fuzzy::Product).expect("one grid");
        for force in [Force::Power(power), Force::Power(0.0), Force::Power(2.0), Force::Hybrid(3.0)] {
            let raster = pair.histogram(force, 72).expect("apart");
            assert_same(raster.values(), histogram(&shape(x, y, w, h), &shape(0, 0, 5, 4), force).values(), 1e-9)?;
        }
    }

    #[test]
    fn degrees_lie_between_zero_and_their_bound((a, b) in apart(), theta in 0.0..TAU) {
        let degree = degree_of_truth(&histogram(&a, &b, Force::Power(0.0)), theta);
        prop_assert!(0.0 <= degree.a && degree.a <= degree.b && degree.b <= 1.0 + 1e-12, "{:?}", degree);
    }
}
