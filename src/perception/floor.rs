//! The floor as the depth shows it: a tower that leans or a tilt known badly would lift far furniture.

/// Points this near to z = 0 may be floor, metres, and this much more for each metre of range.
const NEAR_FLOOR_M: f32 = 0.06;
const NEAR_FLOOR_SLOPE: f32 = 0.035;
/// A steeper floor is no error of the tower: tan 3°.
const STEEPEST: f64 = 0.0524;
/// Fewer points tell nothing.
const LEAST_POINTS: usize = 300;

/// z = a + b x + c y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FloorPlane {
    height: f64,
    slopes: [f64; 2],
}

impl FloorPlane {
    /// Least squares over the points near z = 0, thrice, each time nearer to the plane before.
    ///
    /// Nothing when there is too little floor in view, or when it tilts by more
    /// than 3°: then it is a ramp, a table or a wrong pose, and is left alone.
    pub fn fit(points: &[[f32; 3]]) -> Option<Self> {
        let near: Vec<[f64; 3]> = points
            .iter()
            .step_by(7)
            .filter(|[x, _, z]| *x > 0.3 && z.abs() < NEAR_FLOOR_M + NEAR_FLOOR_SLOPE * x)
            .map(|point| point.map(f64::from))
            .collect();
        let mut plane = Self { height: 0.0, slopes: [0.0; 2] };
        for reach in [0.15, 0.07, 0.04] {
            let close = |p: &&[f64; 3]| (p[2] - plane.height_at(p[0], p[1])).abs() < reach;
            plane = least_squares(near.iter().filter(close))?;
        }
        (plane.slopes[0].hypot(plane.slopes[1]) < STEEPEST && plane.height.abs() < 0.15).then_some(plane)
    }

    fn height_at(&self, x: f64, y: f64) -> f64 {
        self.height + self.slopes[0] * x + self.slopes[1] * y
    }

    /// The floor's height at a place, metres.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        self.height as f32 + self.slopes[0] as f32 * x + self.slopes[1] as f32 * y
    }

    /// Turns the plane to z = 0 (for these small tilts, by lowering).
    pub fn level(&self, points: &mut [[f32; 3]]) {
        let (height, [b, c]) = (self.height as f32, self.slopes.map(|slope| slope as f32));
        for [x, y, z] in points.iter_mut().filter(|point| point[0] > 0.0) {
            *z -= height + b * *x + c * *y;
        }
    }
}

fn least_squares<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Option<FloorPlane> {
    let (mut normal, mut right) = (nalgebra::Matrix3::<f64>::zeros(), nalgebra::Vector3::<f64>::zeros());
    let mut count = 0;
    for [x, y, z] in points {
        let row = nalgebra::Vector3::new(1.0, *x, *y);
        normal += row * row.transpose();
        right += row * *z;
        count += 1;
    }
    if count < LEAST_POINTS / 7 {
        return None;
    }
    let solution = normal.try_inverse()? * right;
    Some(FloorPlane { height: solution[0], slopes: [solution[1], solution[2]] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor(slope: f32) -> Vec<[f32; 3]> {
        let at = |i: usize| [1.0 + (i % 50) as f32 * 0.06, (i / 50) as f32 * 0.04 - 1.0];
        (0..2500).map(at).map(|[x, y]| [x, y, 0.01 + slope * x]).collect()
    }

    #[test]
    fn a_floor_that_leans_by_a_degree_is_levelled() {
        let mut points = floor(0.0175);
        FloorPlane::fit(&points).expect("a floor").level(&mut points);
        assert!(points.iter().all(|p| p[2].abs() < 1e-3));
    }

    #[test]
    fn a_floor_that_leans_by_four_degrees_is_left_alone() {
        assert_eq!(FloorPlane::fit(&floor(0.07)), None);
    }
}
