//! The CONFIG packet: what the robot is and how it is set, in the order of the wire.

use super::fields::{Reader, Text, optional_fields};
use super::packet::Packet;

/// Type of the packet.
pub const CONFIG_PACKET: u8 = 0x20;

optional_fields! {
    /// The robot's parameters, as far as its firmware sends them. Velocities mm/s and °/s, accelerations mm/s² and °/s².
    pub struct Config {
        /// "Pioneer".
        class: Text by text,
        /// "p3dx-sh".
        subclass: Text by text,
        /// Serial number.
        serial: Text by text,
        /// Four motors.
        four_motors: u8 by u8,
        /// Limit of `turn_max`.
        turn_top: u16 by u16,
        /// Limit of `speed_max`.
        speed_top: u16 by u16,
        /// Limit of turning acceleration.
        turn_acceleration_top: u16 by u16,
        /// Limit of acceleration.
        acceleration_top: u16 by u16,
        /// Motor power limit.
        pwm_max: u16 by u16,
        /// The name given to the robot.
        name: Text by text,
        /// Milliseconds between SIPs.
        sip_cycle_ms: u8 by u8,
        /// Baud rate of the host's line, 0 to 4 for 9600, 19200, 38400, 57600, 115200.
        host_baud: u8 by u8,
        /// Baud rate of AUX1.
        aux1_baud: u8 by u8,
        /// Gripper fitted.
        gripper: u16 by u16,
        /// Front sonar fitted.
        front_sonar: u16 by u16,
        /// Rear sonar fitted.
        rear_sonar: u8 by u8,
        /// Decivolts at which the battery counts as low.
        low_battery_dv: u16 by u16,
        /// Ticks of half a turn in place.
        rev_count: u16 by u16,
        /// Milliseconds without a command after which the robot stops.
        watchdog_ms: u16 by u16,
        /// Sends the older packets.
        p2_mpacs: u8 by u8,
        /// Motor power that counts as a stall.
        stall_value: u16 by u16,
        /// Milliseconds after a stall.
        stall_ms: u16 by u16,
        /// Joystick speed.
        joystick_speed: u16 by u16,
        /// Joystick turning.
        joystick_turn: u16 by u16,
        /// Turning limit in force.
        turn_max: u16 by u16,
        /// Speed limit in force.
        speed_max: u16 by u16,
        /// Turning acceleration.
        turn_acceleration: u16 by u16,
        /// Turning deceleration.
        turn_deceleration: u16 by u16,
        /// Turning control, proportional.
        turn_kp: u16 by u16,
        /// Turning control, derivative.
        turn_kv: u16 by u16,
        /// Turning control, integral.
        turn_ki: u16 by u16,
        /// Acceleration.
        acceleration: u16 by u16,
        /// Deceleration.
        deceleration: u16 by u16,
        /// Speed control, proportional.
        speed_kp: u16 by u16,
        /// Speed control, derivative.
        speed_kv: u16 by u16,
        /// Speed control, integral.
        speed_ki: u16 by u16,
        /// Bumpers in front.
        front_bumpers: u8 by u8,
        /// Bumpers at the rear.
        rear_bumpers: u8 by u8,
        /// Charger fitted.
        charger: u8 by u8,
        /// Milliseconds between sonars.
        sonar_cycle_ms: u8 by u8,
        /// 1: the baud rate can be changed; 2: it is found by the robot.
        auto_baud: u8 by u8,
        /// Gyro fitted.
        has_gyro: u8 by u8,
        /// Correction for unequal wheels, 1/8192.
        drift_factor: i16 by i16,
        /// Baud rate of AUX2.
        aux2_baud: u8 by u8,
        /// Baud rate of AUX3.
        aux3_baud: u8 by u8,
        /// Encoder ticks a millimetre.
        ticks_mm: u16 by u16,
        /// Decivolts at which the robot shuts down.
        shutdown_dv: u16 by u16,
        /// Firmware version.
        firmware: Text by text,
        /// Gyro scale, clockwise.
        gyro_cw: u16 by u16,
        /// Gyro scale, counter-clockwise.
        gyro_ccw: u16 by u16,
        /// Milliseconds by which positions are late.
        kinematics_delay_ms: u8 by u8,
        /// Limit of sideways velocity.
        lateral_top: u16 by u16,
        /// Limit of sideways acceleration.
        lateral_acceleration_top: u16 by u16,
        /// Sideways limit in force.
        lateral_max: u16 by u16,
        /// Sideways acceleration.
        lateral_acceleration: u16 by u16,
        /// Sideways deceleration.
        lateral_deceleration: u16 by u16,
        /// Charging begins below.
        charge_threshold: u16 by u16,
        /// Power board port.
        power_port: u8 by u8,
        /// Gyro rate limit.
        gyro_rate_limit: u16 by u16,
        /// °C that count as hot.
        high_temperature_c: i8 by i8,
        /// Power outputs.
        power_bits: u16 by u16,
        /// Kind of battery.
        battery_type: u8 by u8,
        /// Percent that counts as low.
        charge_low: u16 by u16,
        /// Percent at which the robot shuts down.
        charge_shutdown: u16 by u16,
        /// Boot loader version.
        boot_loader: Text by text,
        /// More flags.
        config_flags: u32 by u32,
        /// Gyro firmware.
        gyro_firmware: i16 by i16,
    }
}

impl Config {
    /// Reads the packet as far as it goes; nothing for another packet, or one without a subclass.
    pub fn from_packet(packet: &Packet) -> Option<Self> {
        let config = Self::read(&mut Reader(&packet.data));
        Some(config).filter(|config| packet.kind == CONFIG_PACKET && config.subclass.is_some())
    }

    /// The packet, up to the first field that is missing.
    pub fn to_packet(&self) -> Packet {
        let mut data = Vec::with_capacity(160);
        self.write(&mut data);
        Packet::new(CONFIG_PACKET, data)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_config_is_read_as_written_wherever_its_firmware_stops(
            numbers in prop::collection::vec(1..=127_u8, 160), cut in 40..160_usize,
        ) {
            let mut data = b"Pioneer\0p3dx-sh\0serial\0".to_vec();
            data.extend(&numbers[..11]);
            data.extend(b"name\0");
            data.extend(&numbers);
            data.truncate(cut);
            let config = Config::from_packet(&Packet::new(CONFIG_PACKET, data)).expect("has a subclass");
            prop_assert_eq!(Config::from_packet(&config.to_packet()), Some(config));
        }

        #[test]
        fn any_bytes_are_read_without_a_panic(data in prop::collection::vec(any::<u8>(), 0..252)) {
            if let Some(config) = Config::from_packet(&Packet::new(CONFIG_PACKET, data)) {
                let _ = config.to_packet();
            }
        }
    }

    #[test]
    fn what_the_firmware_does_not_send_is_not_invented() {
        let packet = Packet::new(CONFIG_PACKET, b"Pioneer\0p3dx\0s1\0\0\x68".to_vec());
        let config = Config::from_packet(&packet).expect("has a subclass");
        assert_eq!((config.four_motors, config.turn_top, config.name), (Some(0), None, None));
    }
}
