//! What a pixel of a `map_server` image says, by the file's mode and thresholds, as Nav2's `map_server` reads it
//! (`nav2_map_server/src/map_io.cpp`).

use serde::Deserialize;

use super::image::{Pixel, UNKNOWN};

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellState {
    Free,
    Occupied,
    Unknown,
}

/// How pixels tell of occupancy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Mode {
    /// Dark is occupied, bright is free, what lies between is unknown.
    #[default]
    Trinary,
    /// The same, and what is not opaque is unknown.
    Scale,
    /// The pixel's value, 0 to 255, is the per cent of occupancy; above 100 it is unknown.
    Raw,
}

impl Mode {
    /// By its name in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "trinary" => Some(Self::Trinary),
            "scale" => Some(Self::Scale),
            "raw" => Some(Self::Raw),
            _ => None,
        }
    }
}

/// `negate: 1` or `negate: true`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Negate {
    Number(i64),
    Word(bool),
}

impl Negate {
    pub fn is_set(self) -> bool {
        matches!(self, Self::Word(true)) || matches!(self, Self::Number(number) if number != 0)
    }
}

/// How an image is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thresholds {
    pub mode: Mode,
    /// Occupied is what is darker, a share of 1.
    pub occupied: f64,
    /// Free is what is less dark, a share of 1.
    pub free: f64,
    /// Bright is occupied.
    pub negate: bool,
}

impl Thresholds {
    /// What a pixel says.
    pub fn state(self, pixel: Pixel) -> CellState {
        let bright = f64::from(pixel.bright);
        match self.mode {
            Mode::Raw => {
                let per_cent = (bright * 255.0).round();
                if per_cent > 100.0 { CellState::Unknown } else { self.of_darkness(per_cent / 100.0) }
            }
            Mode::Scale if pixel.opaque < 1.0 => CellState::Unknown,
            Mode::Scale => self.of_darkness(self.darkness(bright)),
            Mode::Trinary if self.is_saved_unknown(pixel) => CellState::Unknown,
            Mode::Trinary if pixel.opaque < 1.0 => {
                // Opacity counts as one more channel beside the three of colour.
                self.of_darkness(self.darkness((3.0 * bright + f64::from(pixel.opaque)) / 4.0))
            }
            Mode::Trinary => self.of_darkness(self.darkness(bright)),
        }
    }

    fn darkness(self, bright: f64) -> f64 {
        if self.negate { bright } else { 1.0 - bright }
    }

    fn of_darkness(self, dark: f64) -> CellState {
        if dark > self.occupied {
            CellState::Occupied
        } else if dark < self.free {
            CellState::Free
        } else {
            CellState::Unknown
        }
    }

    /// Savers wrote `free_thresh: 0.25` beside this level for years, by which it would be free.
    fn is_saved_unknown(self, pixel: Pixel) -> bool {
        !self.negate && (pixel.bright - UNKNOWN).abs() < 1e-6
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use CellState::{Free, Occupied, Unknown};

    fn usual(mode: Mode) -> Thresholds {
        Thresholds { mode, occupied: 0.65, free: 0.196, negate: false }
    }

    fn states(thresholds: Thresholds, levels: &[u8]) -> Vec<CellState> {
        let pixel = |&level: &u8| Pixel { bright: f32::from(level) / 255.0, opaque: 1.0 };
        levels.iter().map(|level| thresholds.state(pixel(level))).collect()
    }

    #[test]
    fn the_three_levels_of_a_saver_are_read_whatever_its_free_threshold() {
        for free in [0.196, 0.2, 0.25, 0.3] {
            let thresholds = Thresholds { free, ..usual(Mode::Trinary) };
            assert_eq!(states(thresholds, &[0, 254, 205]), [Occupied, Free, Unknown], "{free}");
        }
    }

    #[test]
    fn raw_values_are_per_cent_and_unknown_above_a_hundred() {
        assert_eq!(states(usual(Mode::Raw), &[0, 100, 255, 101, 50]), [Free, Occupied, Unknown, Unknown, Unknown]);
    }

    #[test]
    fn what_is_not_opaque_is_unknown_in_scale() {
        let clear = Pixel { bright: 1.0, opaque: 0.0 };
        assert_eq!(usual(Mode::Scale).state(clear), Unknown);
        assert_eq!(states(usual(Mode::Scale), &[0, 254]), [Occupied, Free]);
    }

    #[test]
    fn negated_bright_is_occupied() {
        let thresholds = Thresholds { negate: true, ..usual(Mode::Trinary) };
        assert_eq!(states(thresholds, &[254, 0]), [Occupied, Free]);
    }

    #[test]
    fn modes_are_named_in_any_case() {
        assert_eq!(Mode::from_name("Trinary"), Some(Mode::Trinary));
        assert_eq!(Mode::from_name("colour"), None);
    }
}
