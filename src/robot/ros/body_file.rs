//! Bodies in files: outline, speeds and accelerations of a robot, with where the figures are from.

use serde::Deserialize;

use crate::robot::Body;
use crate::robot::p3dx;

/// Robots whose figures are shipped.
const SHIPPED: [(&str, &str); 4] = [
    ("p3dx", include_str!("../../../fixtures/bodies/p3dx.json")),
    ("turtlebot2", include_str!("../../../fixtures/bodies/turtlebot2.json")),
    ("turtlebot4", include_str!("../../../fixtures/bodies/turtlebot4.json")),
    ("create3", include_str!("../../../fixtures/bodies/create3.json")),
];

/// A body as a file holds it: metres, seconds, radians.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BodyFile {
    /// What the robot is called.
    pub name: String,
    /// Where the figures are from.
    pub source: String,
    front_m: f64,
    rear_m: f64,
    width_m: f64,
    swing_m: f64,
    speed_m_s: f64,
    turn_rad_s: f64,
    acceleration_m_s2: f64,
    braking_m_s2: f64,
    turn_acceleration_rad_s2: f64,
}

/// Names of the bodies that are shipped.
pub fn shipped_bodies() -> impl Iterator<Item = &'static str> {
    SHIPPED.into_iter().map(|(name, _)| name)
}

impl BodyFile {
    /// A body that is shipped.
    pub fn shipped(name: &str) -> Option<Self> {
        let (_, text) = SHIPPED.into_iter().find(|(shipped, _)| *shipped == name)?;
        Self::read(text).ok()
    }

    /// The body in this text.
    ///
    /// # Errors
    /// Says where the text is no JSON, or which figure cannot be.
    pub fn read(text: &str) -> Result<Self, String> {
        let file: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let figures = [
            ("front_m", file.front_m, 2.0),
            ("rear_m", file.rear_m, 2.0),
            ("width_m", file.width_m, 2.0),
            ("swing_m", file.swing_m, 2.0),
            ("speed_m_s", file.speed_m_s, 1.5),
            ("turn_rad_s", file.turn_rad_s, 6.3),
            ("acceleration_m_s2", file.acceleration_m_s2, 10.0),
            ("braking_m_s2", file.braking_m_s2, 10.0),
            ("turn_acceleration_rad_s2", file.turn_acceleration_rad_s2, 50.0),
        ];
        match figures.into_iter().find(|(_, value, most)| !(*value > 0.0 && value <= most)) {
            Some((name, value, most)) => Err(format!("{name} is {value}: it is more than 0 and at most {most}")),
            None => Ok(file),
        }
    }

    /// The body.
    pub fn body(&self) -> Body {
        Body {
            front_m: self.front_m,
            rear_m: self.rear_m,
            width_m: self.width_m,
            swing_m: self.swing_m,
            sonar_range_m: p3dx::SONAR_RANGE_M,
            speed_m_s: self.speed_m_s,
            turn_rad_s: self.turn_rad_s,
            acceleration_m_s2: self.acceleration_m_s2,
            braking_m_s2: self.braking_m_s2,
            turn_acceleration_rad_s2: self.turn_acceleration_rad_s2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_body_is_one_and_the_pioneers_is_the_one_we_drive() {
        for name in shipped_bodies() {
            assert!(BodyFile::shipped(name).is_some(), "{name}");
        }
        assert_eq!(BodyFile::shipped("p3dx").map(|file| file.body()), Some(p3dx::BODY));
    }

    #[test]
    fn a_figure_that_cannot_be_is_named() {
        let text = SHIPPED[0].1.replace("0.301", "-0.3");
        assert!(BodyFile::read(&text).is_err_and(|error| error.starts_with("rear_m is -0.3")));
        assert!(BodyFile::read("{}").is_err());
    }
}
