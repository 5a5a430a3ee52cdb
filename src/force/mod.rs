//! Histogram of forces, and the spatial relations built on it.
//!
//! The histogram of forces between two objects A and B gives, for each
//! direction θ, the weight of the arguments for "A is in direction θ of B"
//! (Matsakis & Wendling, "A new way to represent the relative position
//! between areal objects", IEEE TPAMI 21(7), 1999):
//!
//! F_r(θ) = ∫ f_r(A_θ(v), B_θ(v)) dv, f_r(I, J) = ∫∫ (x − z)^−r dz dx over x ∈ I, z ∈ J, x > z,
//!
//! where A_θ(v) is the section of A by the line of direction θ with normal
//! offset v. Angles are counter-clockwise from +x, y upward.
//!
//! Nothing here knows of robots or language; only `stage` knows of records.
//!
//! ```
//! use spatial_fetch::force::{Force, Shape, polygon};
//! let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
//! let histogram = polygon::histogram(&square(3.0), &square(0.0), Force::Power(2.0), 4).unwrap();
//! assert!((histogram.values()[0] - (9.0_f64 / 8.0).ln()).abs() < 1e-12);
//! assert_eq!(histogram.values()[2], 0.0);
//! ```

mod axes;
mod between;
mod boxes;
mod degree;
mod describe;
mod gap;
mod histogram;
mod input;
mod kernel;
mod main_direction;
mod mask;
mod name;
pub mod polygon;
mod quadrature;
pub mod raster;
mod relation;
mod rose;
mod shape;
mod shape_error;
mod stage;
mod surround;
mod validity;
mod wording;

pub use axes::{Axes, Words};
pub use between::between;
pub use degree::{DegreeOfTruth, degree_of_truth};
pub use describe::Description;
pub use histogram::Histogram;
pub use kernel::{Force, Infinite};
pub use main_direction::main_direction;
pub use name::{AxesName, ForceName};
pub use relation::RelativePosition;
pub use shape::Shape;
pub use shape_error::ShapeError;
pub use stage::{Describer, Pictures};
pub use surround::surround;
pub use wording::{Assessment, Closeness};
