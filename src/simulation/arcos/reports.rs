//! What the served robot reports: SIP, CONFIG, encoders.

use std::f64::consts::TAU;

use super::Server;
use crate::robot::arcos::codec::{Config, Encoder, Flags, Sip, SipTail};
use crate::robot::{MobileBase, p3dx};

/// Encoder ticks a millimetre.
const TICKS_MM: u16 = 128;
/// Half the distance between the wheels, metres.
const HALF_TRACK_M: f64 = 0.1785;
/// Firmware this robot is like.
const FIRMWARE: &str = "2.9";
/// Readings in one SIP: each array fires four times a cycle.
const SONARS_PER_SIP: u64 = 8;

impl Server {
    pub(super) fn sip(&self) -> Sip {
        let p = self.settings.parameters;
        let pose = self.own_pose();
        let (linear, angular) = self.base.velocity();
        let units = |metres: f64| ((metres / p.distance_m).round() as i64 & 0x7FFF) as u16;
        let half = (angular / p.turn_rad_per_mm).round();
        let mm_s = linear / p.velocity_m_s;
        let (rear, front) = self.contacts();
        Sip {
            moving: linear != 0.0 || angular != 0.0,
            x: units(pose.x),
            y: units(pose.y),
            heading: (pose.heading / p.angle_rad).round() as i16,
            left_mm_s: (mm_s - half).round() as i16,
            right_mm_s: (mm_s + half).round() as i16,
            battery_dv: (self.battery_v * 10.0).round() as u8,
            left_stall_rear_bumpers: rear,
            right_stall_front_bumpers: front,
            control: 0,
            flags: self.flags(),
            compass: 0,
            sonar: self.fresh_sonar(),
            tail: SipTail {
                gripper: Some(0),
                analog_port: Some(0),
                analog: Some(0),
                digital_in: Some(0),
                digital_out: Some(0),
                battery_dv: Some((self.battery_v * 10.0).round() as u16),
                charge_state: Some(0),
                turn_ddeg_s: Some((angular.to_degrees() * 10.0).round() as i16),
                faults: Some(0),
                ..SipTail::default()
            },
        }
    }

    /// Stall bits and bumpers of the rear and of the front byte.
    fn contacts(&self) -> (u8, u8) {
        let status = self.base.status();
        let stall = u8::from(status.stalled);
        let middle = u8::from(status.bumped) << 3;
        let backward = self.hit_backward;
        (stall | if backward { middle } else { 0 }, stall | if backward { 0 } else { middle })
    }

    fn flags(&self) -> Flags {
        let mut flags = 0;
        for (is_set, bits) in [
            (self.motors, Flags::MOTORS),
            (self.sonar, Flags::SONAR | Flags::SONAR << 1),
            (self.stop_button, Flags::STOP_BUTTON | Flags::E_STALL),
        ] {
            flags |= if is_set { bits } else { 0 };
        }
        Flags(flags)
    }

    /// The sonars fired since the last SIP: the even ones and the odd ones by turns.
    fn fresh_sonar(&self) -> Vec<(u8, u16)> {
        let fired = |number: &u64| self.sonar && number % 2 == self.sips % 2;
        let range_m = self.settings.parameters.range_m;
        let readings = self.base.sonar().iter().zip(0_u64..).filter(|(_, number)| fired(number));
        let fresh: Vec<_> = readings.map(|(r, n)| (n as u8, (r.range_m / range_m).round() as u16)).collect();
        debug_assert!(fresh.len() as u64 <= SONARS_PER_SIP);
        fresh
    }

    pub(super) fn encoder(&self) -> Encoder {
        let (ahead, turned) = self.travelled;
        let ticks = |metres: f64| (metres * 1000.0 * f64::from(TICKS_MM)).round() as i32;
        Encoder { left: ticks(ahead - turned * HALF_TRACK_M), right: ticks(ahead + turned * HALF_TRACK_M) }
    }

    pub(super) fn config(&self) -> Config {
        let limits = self.motion.limits;
        let mm = |metres: f64| Some((metres * 1000.0).round() as u16);
        let deg = |radians: f64| Some((radians * 360.0 / TAU).round() as u16);
        let text = |text: &str| Some(text.to_string());
        Config {
            class: text("Pioneer"),
            subclass: text(self.settings.parameters.subclass),
            serial: text("simulated"),
            four_motors: Some(0),
            turn_top: deg(p3dx::BODY.turn_rad_s),
            speed_top: mm(p3dx::BODY.speed_m_s),
            turn_acceleration_top: deg(p3dx::EMERGENCY_TURN_BRAKING_RAD_S2),
            acceleration_top: mm(p3dx::EMERGENCY_BRAKING_M_S2),
            pwm_max: Some(500),
            name: text(&self.settings.name),
            sip_cycle_ms: Some(self.settings.cycle.as_millis() as u8),
            host_baud: Some(0),
            aux1_baud: Some(0),
            gripper: Some(0),
            front_sonar: Some(1),
            rear_sonar: Some(1),
            low_battery_dv: Some(110),
            rev_count: Some(16_570),
            watchdog_ms: Some(self.settings.watchdog.as_millis() as u16),
            p2_mpacs: Some(1),
            stall_value: Some(200),
            stall_ms: Some(200),
            joystick_speed: Some(900),
            joystick_turn: Some(50),
            turn_max: deg(limits.turn),
            speed_max: mm(limits.speed),
            turn_acceleration: deg(limits.turn_acceleration),
            turn_deceleration: deg(limits.turn_braking),
            turn_kp: Some(40),
            turn_kv: Some(20),
            turn_ki: Some(0),
            acceleration: mm(limits.acceleration),
            deceleration: mm(limits.braking),
            speed_kp: Some(40),
            speed_kv: Some(30),
            speed_ki: Some(0),
            front_bumpers: Some(5),
            rear_bumpers: Some(5),
            charger: Some(0),
            sonar_cycle_ms: Some(25),
            auto_baud: Some(2),
            has_gyro: Some(0),
            drift_factor: Some(0),
            aux2_baud: Some(0),
            aux3_baud: Some(0),
            ticks_mm: Some(TICKS_MM),
            shutdown_dv: Some(100),
            firmware: text(FIRMWARE),
            ..Config::default()
        }
    }
}
