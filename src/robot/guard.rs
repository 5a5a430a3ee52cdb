//! Sonars and bumpers have the last word on speed.

use super::Report;

/// Nothing nearer than this before a sonar, metres: the robot stands. The executive itself stops at 0.15.
const STOP_M: f64 = 0.10;
/// The braking counted on before something the sonar sees, m/s².
const BRAKE_M_S2: f64 = 0.25;
/// Sonars within this of the way watch it, radians.
const WATCH_RAD: f64 = 0.7;

/// The speed, m/s, that sonars and bumpers allow of `wanted`, and why it is less.
pub fn guarded_speed(wanted: f64, report: &Report) -> (f64, Option<String>) {
    let ahead = wanted >= 0.0;
    let bumpers = if ahead { report.front_bumpers } else { report.rear_bumpers };
    let side = if ahead { "front" } else { "rear" };
    if wanted != 0.0 && bumpers != 0 {
        return (0.0, Some(format!("a {side} bumper is pressed: no way on to that side")));
    }
    let watches = |bearing: f64| {
        if ahead { bearing.abs() <= WATCH_RAD } else { bearing.abs() >= std::f64::consts::PI - WATCH_RAD }
    };
    let watching = report.sonar.iter().filter(|reading| watches(reading.bearing));
    let nearest = watching.map(|reading| reading.range_m).fold(f64::INFINITY, f64::min);
    // It goes on until the command that slows it down has reached it.
    let going = if ahead { report.velocity.0 } else { -report.velocity.0 }.max(0.0);
    let late = going * (report.age_s() + report.dead_time.as_secs_f64());
    let most = (2.0 * BRAKE_M_S2 * (nearest - STOP_M - late).max(0.0)).sqrt();
    if most >= wanted.abs() {
        return (wanted, None);
    }
    let why = format!("sonar: something {nearest:.2} m off at the {side}, slowing to {most:.2} m/s");
    (most.copysign(wanted), Some(why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vec2;
    use crate::robot::SonarReading;

    fn report(bearing: f64, range_m: f64) -> Report {
        Report { sonar: vec![SonarReading { mount: vec2(0.0, 0.0), bearing, range_m }], ..Report::default() }
    }

    #[test]
    fn something_ahead_slows_and_stops_the_way_ahead_only() {
        assert_eq!(guarded_speed(0.3, &report(0.17, 5.0)).0, 0.3);
        let near = guarded_speed(0.3, &report(0.17, 0.2)).0;
        assert!(near > 0.0 && near < 0.3, "{near}");
        assert_eq!(guarded_speed(0.3, &report(0.17, 0.09)).0, 0.0);
        assert_eq!(guarded_speed(-0.3, &report(0.17, 0.09)).0, -0.3);
        assert_eq!(guarded_speed(0.3, &report(1.5, 0.09)).0, 0.3);
    }

    #[test]
    fn a_pressed_bumper_forbids_its_side() {
        let report = Report { rear_bumpers: 4, ..Report::default() };
        assert_eq!((guarded_speed(-0.2, &report).0, guarded_speed(0.2, &report).0), (0.0, 0.2));
    }
}
