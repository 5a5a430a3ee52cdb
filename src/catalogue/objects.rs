//! Small portable objects.

use super::{Color, Size, size};

/// A small portable object: its size and colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallObject {
    /// Noun.
    pub name: &'static str,
    /// Its usual size.
    pub size: Size,
    /// Its usual colour.
    pub color: Color,
}

const fn small(name: &'static str, length: f64, width: f64, height: f64, color: Color) -> SmallObject {
    SmallObject { name, size: size(length, width, height), color }
}

/// Portable objects with usual sizes.
pub const OBJECTS: &[SmallObject] = &[
    small("fork", 0.19, 0.03, 0.02, [205, 205, 210]),
    small("glasses_case", 0.16, 0.07, 0.05, [170, 40, 45]),
    small("laptop", 0.26, 0.36, 0.22, [60, 62, 70]),
    small("statue", 0.12, 0.12, 0.3, [190, 180, 150]),
    small("monitor", 0.2, 0.5, 0.42, [30, 30, 34]),
    small("mug", 0.09, 0.09, 0.1, [200, 60, 50]),
    small("cup", 0.08, 0.08, 0.09, [240, 240, 235]),
    small("keys", 0.08, 0.05, 0.015, [200, 170, 80]),
    small("book", 0.24, 0.17, 0.03, [50, 110, 70]),
    small("wallet", 0.11, 0.09, 0.02, [80, 50, 30]),
    small("cellphone", 0.15, 0.07, 0.01, [30, 30, 35]),
    small("letter", 0.22, 0.11, 0.005, [245, 245, 240]),
    small("notepad", 0.21, 0.15, 0.015, [240, 220, 90]),
    small("remote", 0.18, 0.05, 0.02, [35, 35, 38]),
    small("bottle", 0.07, 0.07, 0.25, [60, 130, 80]),
    small("vase", 0.14, 0.14, 0.28, [90, 130, 190]),
    small("tablet", 0.25, 0.17, 0.01, [40, 40, 45]),
];

/// The small object of that name.
pub fn object(name: &str) -> Option<&'static SmallObject> {
    OBJECTS.iter().find(|object| object.name == name)
}
