//! What differs between the robots that speak ARCOS: scales and sonars.

use std::f64::consts::TAU;

use crate::robot::p3dx::SonarArray;

/// Scales of one subclass (ARIA's parameter files for the P3DX).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// The subclass these are for.
    pub subclass: &'static str,
    /// Metres a robot unit of position.
    pub distance_m: f64,
    /// Radians a unit of heading.
    pub angle_rad: f64,
    /// Metres a unit of sonar range.
    pub range_m: f64,
    /// m/s a unit of wheel velocity.
    pub velocity_m_s: f64,
    /// rad/s by which the robot turns for each mm/s between its wheels, halved.
    pub turn_rad_per_mm: f64,
    /// mm/s a unit of VEL2.
    pub vel2_mm_s: f64,
    /// Where the sonars sit.
    pub sonars: SonarArray,
}

impl Parameters {
    /// The P3DX with ARCOS on the SH2 processor.
    pub const P3DX_SH: Self = Self {
        subclass: "p3dx-sh",
        distance_m: 0.001,
        angle_rad: TAU / 4096.0,
        range_m: 0.001,
        velocity_m_s: 0.001,
        turn_rad_per_mm: 0.0056,
        vel2_mm_s: 20.0,
        sonars: SonarArray::Newer,
    };
    /// The older P3DX with the H8 processor; its unit of position is 0.485 mm.
    pub const P3DX: Self = Self { subclass: "p3dx", distance_m: 0.000_485, ..Self::P3DX_SH };

    /// The parameters of a subclass as the robot names it; nothing for one we have no scales of.
    pub fn of(subclass: &str) -> Option<Self> {
        [Self::P3DX_SH, Self::P3DX].into_iter().find(|known| known.subclass == subclass)
    }
}
