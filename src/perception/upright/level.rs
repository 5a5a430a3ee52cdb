//! Level planes below the camera: what speaks for one being the floor, and what against it.

use nalgebra::Matrix3;

use super::surface::{Point, Surface};

/// A camera is held at most so much askew: cosine of 45° between the picture's up and the room's.
const LEAST_UPRIGHT: f64 = 0.7;
/// How high a camera may be above the floor, metres: a small robot's, or one held up.
pub(super) const HEIGHTS_M: std::ops::Range<f64> = 0.1..3.0;
/// Cosine within which a surface lies as a plane does; depth noise alone turns the far ones by 20°.
const LIES: f64 = 0.9;
/// Sine within which a surface stands upright on it.
const STANDS: f64 = 0.1;

/// A plane below the camera: the direction up from it, and how high above it the camera is, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) up: Point,
    pub(super) height: f64,
}

/// What the picture's surfaces say of a plane, as shares of them but for `on`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Evidence {
    /// How many lie on it, those that do not face up counting little.
    pub(super) on: f64,
    /// Share that lies under it: there is nothing under a floor but noise.
    pub(super) under: f64,
    /// Share that is level as it is, wherever; and share that stands upright on it.
    pub(super) level: f64,
    pub(super) upright: f64,
    /// Share of what lies on it and faces some way that faces up; 0 when nothing does.
    pub(super) facing: f64,
    /// How far what lies on it is off, root mean square, as a share of what noise may be.
    pub(super) rough: f64,
    surfaces: f64,
}

/// How far off a plane a point of it may be by the depth's noise, metres.
fn noise(point: &Point) -> f64 {
    0.02 + 0.004 * point.z * point.z
}

impl Level {
    /// The level plane through a point.
    pub(super) fn through(up: Point, point: &Point) -> Self {
        Self { up, height: -up.dot(point) }
    }

    fn above(&self, point: &Point) -> f64 {
        self.up.dot(point) + self.height
    }

    /// Degrees by which a camera over it looks down.
    pub(super) fn tilt_deg(&self) -> f64 {
        (-self.up.z).clamp(-1.0, 1.0).asin().to_degrees()
    }

    pub(super) fn is_plausible(&self) -> bool {
        -self.up.y > LEAST_UPRIGHT && HEIGHTS_M.contains(&self.height)
    }

    pub(super) fn evidence<'a>(&self, surfaces: impl Iterator<Item = &'a Surface>) -> Evidence {
        let (mut found, mut lying, mut up_of_lying, mut facing, mut square) = (Evidence::default(), 0.0, 0.0, 0.0, 0.0);
        for surface in surfaces {
            let (above, noise, faces) = (self.above(&surface.at), noise(&surface.at), surface.faces(&self.up));
            found.surfaces += 1.0;
            if above.abs() < noise {
                let lies = faces.is_none_or(|faces| faces > LIES);
                found.on += if !lies { 0.1 } else { faces.map_or(0.3, |_| 1.0) };
                facing += f64::from(u8::from(faces.is_some()));
                up_of_lying += f64::from(u8::from(lies && faces.is_some()));
                if lies {
                    lying += 1.0;
                    square += (above / noise).powi(2);
                }
            }
            found.under += f64::from(u8::from(above < -0.06 - 3.0 * noise));
            found.level += f64::from(u8::from(faces.is_some_and(|faces| faces > 0.97)));
            found.upright += f64::from(u8::from(faces.is_some_and(|faces| faces.abs() < STANDS)));
        }
        let all = f64::max(found.surfaces, 1.0);
        found.under /= all;
        found.level /= all;
        found.upright /= all;
        found.facing = up_of_lying / f64::max(facing, 1.0);
        found.rough = (square / f64::max(lying, 1.0)).sqrt();
        found
    }

    /// The plane through the surfaces that lie near this one, the far ones counting less.
    pub(super) fn refined(&self, surfaces: &[Surface]) -> Option<Self> {
        let near = |s: &&Surface| {
            self.above(&s.at).abs() < 1.25 * noise(&s.at) && s.faces(&self.up).is_none_or(|faces| faces > 0.85)
        };
        let near: Vec<&Surface> = surfaces.iter().filter(near).collect();
        if near.len() < 12 {
            return None;
        }
        let weight = |at: &Point| 1.0 / (0.3 + at.z * at.z);
        let total: f64 = near.iter().map(|s| weight(&s.at)).sum();
        let middle = near.iter().map(|s| s.at * weight(&s.at)).sum::<Point>() / total;
        let outer = |d: Point| d * d.transpose();
        let spread: Matrix3<f64> = near.iter().map(|s| outer(s.at - middle) * weight(&s.at)).sum();
        let eigen = spread.symmetric_eigen();
        let normal = Point::from(eigen.eigenvectors.column(eigen.eigenvalues.imin()));
        let refined = Self::through(if normal.y > 0.0 { -normal } else { normal }, &middle);
        refined.is_plausible().then_some(refined)
    }
}

impl Evidence {
    /// What speaks for a floor: what lies on it and what stands on it; against it, ten times, what lies under it.
    pub(super) fn score(&self) -> f64 {
        self.on + (0.1 * self.upright - 10.0 * self.under) * self.surfaces
    }

    /// What speaks for a direction up, wherever the floor is.
    pub(super) fn gravity(&self) -> f64 {
        self.level + 0.5 * self.upright
    }

    /// Whether this is a floor and no top, seat or accident of the lowest points.
    ///
    /// Of pictures with and without a floor, real ones of many rooms among them, every right plane has next to nothing
    /// under it and either faces up as a whole or is as smooth as the sensor allows; the lowest points of a picture
    /// without a floor are rough, and face every way.
    pub(super) fn is_floor(&self) -> bool {
        let even = self.rough < 0.42 && self.facing >= 0.5 || self.rough < 0.28;
        self.on >= 20.0 && self.under < 0.0015 && even
    }

    /// Whether it is one when its height is known anyway.
    pub(super) fn is_floor_as_told(&self) -> bool {
        self.on >= 12.0 && self.under < 0.01
    }
}
