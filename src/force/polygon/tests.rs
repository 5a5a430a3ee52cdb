use super::*;

fn rectangle(x: (f64, f64), y: (f64, f64)) -> Shape {
    Shape::from_ring(vec![[x.0, y.0], [x.1, y.0], [x.1, y.1], [x.0, y.1]])
}

fn value(a: &Shape, b: &Shape, force: Force, degrees: usize) -> f64 {
    histogram(a, b, force, 360).expect("finite").values()[degrees]
}

fn assert_near(got: f64, want: f64) {
    assert!((got - want).abs() < 1e-12 * want.abs().max(1.0), "{got} is not {want}");
}

#[test]
fn unit_squares_two_apart_have_the_known_forces() {
    let (a, b) = (rectangle((3.0, 4.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
    assert_near(value(&a, &b, Force::Power(0.0), 0), 1.0);
    assert_near(value(&a, &b, Force::Power(2.0), 0), (9.0_f64 / 8.0).ln());
    assert_near(value(&a, &b, Force::Power(2.0), 180), 0.0);
}

#[test]
fn a_square_against_itself_attracts_within() {
    let a = rectangle((0.0, 1.0), (0.0, 1.0));
    assert_near(value(&a, &a, Force::Power(0.0), 0), 0.5);
    assert_near(value(&a, &a, Force::Power(0.0), 45), 2.0_f64.sqrt() / 3.0);
}

#[test]
fn touching_squares_have_a_finite_force_below_two_and_none_from_two_on() {
    let (a, b) = (rectangle((1.0, 2.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
    assert_near(value(&a, &b, Force::Power(1.0), 0), 2.0 * 2.0_f64.ln());
    assert_eq!(histogram(&a, &b, Force::Power(2.0), 4), Err(Infinite));
    assert!(histogram(&a, &b, hybrid(&a, &b), 4).is_ok());
}

#[test]
fn far_pairs_keep_their_digits() {
    // Size over distance 1e-5: the gravitational force tends to area·area/distance².
    let (a, b) = (rectangle((1e5, 1e5 + 1.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
    let got = value(&a, &b, Force::Power(2.0), 0);
    assert!((got * 1e10 - 1.0).abs() < 1e-9, "{got}");
}

#[test]
fn the_intersection_of_shifted_squares_is_their_overlap() {
    let (a, b) = (rectangle((0.25, 1.25), (0.5, 1.5)), rectangle((0.0, 1.0), (0.0, 1.0)));
    assert_near(intersection_area(&a, &b), 0.375);
}

#[test]
fn a_hole_exerts_no_force() {
    let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
    let frame = Shape::from_parts(&[vec![square(0.0, 3.0), square(1.0, 2.0)]]).expect("a frame");
    let b = rectangle((-3.0, -2.0), (1.0, 2.0));
    let whole = rectangle((0.0, 3.0), (0.0, 3.0));
    let hole = rectangle((1.0, 2.0), (1.0, 2.0));
    for degrees in [0, 7, 20] {
        let difference = value(&whole, &b, Force::Power(2.0), degrees) - value(&hole, &b, Force::Power(2.0), degrees);
        assert_near(value(&frame, &b, Force::Power(2.0), degrees), difference);
    }
}
