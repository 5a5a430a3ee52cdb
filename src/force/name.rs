//! Forces, frames and ways to combine memberships, as a user names them.

use std::fmt;
use std::str::FromStr;

use super::raster::Fuzzy;

/// A number r, or `hybrid`, whose Y0 follows from the objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceName {
    /// d^−r.
    Power(f64),
    /// r = 0 near, r = 2 far.
    Hybrid,
}

impl FromStr for ForceName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.trim() {
            "hybrid" => Ok(Self::Hybrid),
            number => match number.parse::<f64>() {
                // Adding zero turns −0 into 0.
                Ok(r) if r.is_finite() => Ok(Self::Power(r + 0.0)),
                _ => Err(format!("`{number}` is no force; give a number such as 0 or 2, or `hybrid`")),
            },
        }
    }
}

impl fmt::Display for ForceName {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Power(r) => write!(formatter, "{r}"),
            Self::Hybrid => formatter.write_str("hybrid"),
        }
    }
}

/// A frame of reference by name; all but the map's take a heading from the record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AxesName {
    /// Right, above, left, below.
    #[default]
    Map,
    /// The robot's front, left, rear, right; `heading` is the robot's.
    Robot,
    /// B's own front, left, rear, right; `heading` is where B's front points.
    Intrinsic,
    /// As seen by someone who looks along `heading`.
    Viewer,
    /// As seen by someone who stands before B's front, which points along `heading`.
    Facing,
}

impl FromStr for AxesName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "map" => Ok(Self::Map),
            "robot" => Ok(Self::Robot),
            "intrinsic" => Ok(Self::Intrinsic),
            "viewer" => Ok(Self::Viewer),
            "facing" => Ok(Self::Facing),
            _ => Err(format!("`{text}` is no frame; take map, robot, intrinsic, viewer or facing")),
        }
    }
}

impl FromStr for Fuzzy {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "product" => Ok(Self::Product),
            "minimum" => Ok(Self::Minimum),
            _ => Err(format!("`{text}` combines nothing; take product or minimum")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_forces_translate_both_ways() {
        for name in ["0", "2", "-0.5", "hybrid"] {
            assert_eq!(name.parse::<ForceName>().expect("a force").to_string(), name);
        }
        assert!("gravity".parse::<ForceName>().expect_err("no force").contains("`gravity` is no force"));
        assert!("nan".parse::<ForceName>().is_err());
    }
}
