//! The standard server information packet (SIP), sent every cycle of about 100 ms.

use super::fields::{Field, Reader, optional_fields};
use super::packet::Packet;

/// Type of the packet while the robot stands.
pub const SIP_STOPPED: u8 = 0x32;
/// Type of the packet while it moves; some senders never use it.
pub const SIP_MOVING: u8 = 0x33;
/// No robot has more sonars; a longer list is a broken packet.
const MOST_SONARS: u8 = 32;

/// What the robot reports every cycle. Positions and velocities are in its own units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sip {
    /// Sent as the moving type.
    pub moving: bool,
    /// Position by the wheels, robot units; the low 15 bits count.
    pub x: u16,
    /// Position by the wheels, robot units; the low 15 bits count.
    pub y: u16,
    /// Heading, 4096 to the turn, counter-clockwise.
    pub heading: i16,
    /// Left wheel, mm/s.
    pub left_mm_s: i16,
    /// Right wheel, mm/s.
    pub right_mm_s: i16,
    /// Decivolts.
    pub battery_dv: u8,
    /// Bit 0: left wheel stalled; bits 1 to 7: rear bumpers.
    pub left_stall_rear_bumpers: u8,
    /// Bit 0: right wheel stalled; bits 1 to 7: front bumpers.
    pub right_stall_front_bumpers: u8,
    /// Heading set-point, obsolete.
    pub control: i16,
    /// Motors, sonars, stop button.
    pub flags: Flags,
    /// Units of 2°.
    pub compass: u8,
    /// Sonars read since the last packet: number and range, robot units.
    pub sonar: Vec<(u8, u16)>,
    /// What newer firmware adds.
    pub tail: SipTail,
}

/// The flags of a SIP (Operations Manual).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags(pub u16);

impl Flags {
    /// Motors enabled.
    pub const MOTORS: u16 = 1;
    /// The first sonar array is on; three more follow.
    pub const SONAR: u16 = 1 << 1;
    /// The STOP button is pressed.
    pub const STOP_BUTTON: u16 = 1 << 5;
    /// The emergency stall is engaged.
    pub const E_STALL: u16 = 1 << 6;
    /// The charger gives power.
    pub const CHARGER: u16 = 1 << 10;

    /// Whether the motors are enabled.
    pub fn motors_enabled(self) -> bool {
        self.0 & Self::MOTORS != 0
    }

    /// Whether any sonar array is on.
    pub fn sonar_on(self) -> bool {
        self.0 & 0b1_1110 != 0
    }

    /// Whether the robot was stopped by its button.
    pub fn emergency_stopped(self) -> bool {
        self.0 & (Self::STOP_BUTTON | Self::E_STALL) != 0
    }
}

optional_fields! {
    /// The part of a SIP that older firmware leaves out, wholly or from some field on.
    pub struct SipTail {
        /// Gripper state.
        gripper: u8 by u8,
        /// Which analog port is shown.
        analog_port: u8 by u8,
        /// 0 to 255 for 0 to 5 V.
        analog: u8 by u8,
        /// Digital inputs.
        digital_in: u8 by u8,
        /// Digital outputs.
        digital_out: u8 by u8,
        /// Decivolts, beyond 25.5 V too.
        battery_dv: u16 by u16,
        /// 0 not charging, 1 bulk, 2 over, 3 float, 4 balance, 255 unknown.
        charge_state: u8 by u8,
        /// Rotation, tenths of a degree a second.
        turn_ddeg_s: i16 by i16,
        /// Faults of the hardware.
        faults: u16 by u16,
        /// Sideways velocity, mm/s.
        lateral_mm_s: i16 by i16,
        /// °C; -127 and -128 are none.
        temperature_c: i8 by i8,
        /// Percent.
        charge_percent: i8 by i8,
        /// The robot's clock, microseconds.
        clock_us: u32 by u32,
        /// More flags.
        more_flags: u32 by u32,
    }
}

impl Sip {
    /// Reads a SIP; nothing for another packet, or one cut off before its tail.
    pub fn from_packet(packet: &Packet) -> Option<Self> {
        if !matches!(packet.kind, SIP_STOPPED | SIP_MOVING) {
            return None;
        }
        let mut reader = Reader(&packet.data);
        let mut sip = Self {
            moving: packet.kind == SIP_MOVING,
            x: reader.u16()?,
            y: reader.u16()?,
            heading: reader.i16()?,
            left_mm_s: reader.i16()?,
            right_mm_s: reader.i16()?,
            battery_dv: reader.u8()?,
            left_stall_rear_bumpers: reader.u8()?,
            right_stall_front_bumpers: reader.u8()?,
            control: reader.i16()?,
            flags: Flags(reader.u16()?),
            compass: reader.u8()?,
            ..Self::default()
        };
        let count = reader.u8().filter(|count| *count <= MOST_SONARS)?;
        for _ in 0..count {
            sip.sonar.push((reader.u8()?, reader.u16()?));
        }
        sip.tail = SipTail::read(&mut reader);
        Some(sip)
    }

    /// The SIP as a packet.
    pub fn to_packet(&self) -> Packet {
        let mut data = Vec::with_capacity(90);
        self.x.write(&mut data);
        self.y.write(&mut data);
        self.heading.write(&mut data);
        self.left_mm_s.write(&mut data);
        self.right_mm_s.write(&mut data);
        data.extend([self.battery_dv, self.left_stall_rear_bumpers, self.right_stall_front_bumpers]);
        self.control.write(&mut data);
        self.flags.0.write(&mut data);
        data.push(self.compass);
        let sonar = &self.sonar[..self.sonar.len().min(usize::from(MOST_SONARS))];
        data.push(sonar.len() as u8);
        for (number, range) in sonar {
            number.write(&mut data);
            range.write(&mut data);
        }
        self.tail.write(&mut data);
        Packet::new(if self.moving { SIP_MOVING } else { SIP_STOPPED }, data)
    }

    /// Whether a wheel is held fast.
    pub fn stalled(&self) -> bool {
        (self.left_stall_rear_bumpers | self.right_stall_front_bumpers) & 1 != 0
    }

    /// Bumpers pressed in front, one bit each.
    pub fn front_bumpers(&self) -> u8 {
        self.right_stall_front_bumpers >> 1
    }

    /// Bumpers pressed at the rear, one bit each.
    pub fn rear_bumpers(&self) -> u8 {
        self.left_stall_rear_bumpers >> 1
    }

    /// Volts, by the field that does not end at 25.5.
    pub fn battery_v(&self) -> f64 {
        f64::from(self.tail.battery_dv.filter(|dv| *dv > 0).unwrap_or(u16::from(self.battery_dv))) / 10.0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sip_from(bytes: &[u8], sonars: u8, tail: usize) -> Sip {
        let mut data = bytes[..18].to_vec();
        data.push(sonars);
        data.extend(&bytes[20..20 + 3 * usize::from(sonars) + tail]);
        Sip::from_packet(&Packet::new(SIP_STOPPED, data)).expect("whole")
    }

    proptest! {
        #[test]
        fn a_sip_is_read_as_written_with_any_part_of_its_tail(
            bytes in prop::collection::vec(any::<u8>(), 250), sonars in 0..=MOST_SONARS, tail in 0..=26_usize,
        ) {
            let sip = sip_from(&bytes, sonars, tail);
            prop_assert_eq!(Sip::from_packet(&sip.to_packet()), Some(sip));
        }

        #[test]
        fn any_bytes_are_read_without_a_panic(kind: u8, data in prop::collection::vec(any::<u8>(), 0..252)) {
            let _ = Sip::from_packet(&Packet::new(kind, data));
        }
    }

    #[test]
    fn old_firmware_that_ends_with_its_digital_outputs_is_understood() {
        let tail = SipTail {
            gripper: Some(0),
            analog_port: Some(1),
            analog: Some(2),
            digital_in: Some(3),
            digital_out: Some(4),
            ..SipTail::default()
        };
        let sip = Sip { battery_dv: 126, tail, ..Sip::default() };
        let read = Sip::from_packet(&sip.to_packet()).expect("whole");
        assert_eq!((read.tail.digital_out, read.tail.battery_dv, read.battery_v()), (Some(4), None, 12.6));
    }

    #[test]
    fn bumpers_and_stalls_are_told_apart() {
        let sip = Sip { left_stall_rear_bumpers: 0b100, right_stall_front_bumpers: 0b11, ..Sip::default() };
        assert!(sip.stalled());
        assert_eq!((sip.front_bumpers(), sip.rear_bumpers()), (1, 2));
    }

    #[test]
    fn a_sip_that_announces_more_sonars_than_it_holds_is_no_sip() {
        let mut packet = Sip { sonar: vec![(0, 500)], ..Sip::default() }.to_packet();
        packet.data[18] = 9;
        packet.data.truncate(22);
        assert_eq!(Sip::from_packet(&packet), None);
    }

    #[test]
    fn sixteen_sonars_and_the_common_tail_make_a_packet_of_the_size_seen_on_real_lines() {
        let tail = SipTail {
            gripper: Some(0),
            analog_port: Some(0),
            analog: Some(0),
            digital_in: Some(0),
            digital_out: Some(0),
            battery_dv: Some(120),
            charge_state: Some(0),
            turn_ddeg_s: Some(0),
            faults: Some(0),
            lateral_mm_s: Some(0),
            temperature_c: Some(-127),
            charge_percent: Some(90),
            ..SipTail::default()
        };
        let sip = Sip { sonar: (0..16).map(|i| (i, 5000)).collect(), tail, ..Sip::default() };
        assert_eq!(sip.to_packet().to_bytes().len(), 89);
    }
}
