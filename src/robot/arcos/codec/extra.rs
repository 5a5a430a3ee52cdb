//! Packets a client asks for beside the SIP: encoders, inputs and outputs, gyro.

use super::fields::Reader;
use super::packet::Packet;

/// Type of the encoder packet.
pub const ENCODER_PACKET: u8 = 0x90;
/// Type of the packet of inputs and outputs.
pub const IO_PACKET: u8 = 0xF0;
/// Type of the gyro packet.
pub const GYRO_PACKET: u8 = 0x98;

/// Wheel encoders, ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Encoder {
    /// Left wheel.
    pub left: i32,
    /// Right wheel.
    pub right: i32,
}

impl Encoder {
    /// Reads the packet; nothing for another.
    pub fn from_packet(packet: &Packet) -> Option<Self> {
        let mut reader = Reader(&packet.data);
        let encoder = Self { left: reader.i32()?, right: reader.i32()? };
        (packet.kind == ENCODER_PACKET).then_some(encoder)
    }

    /// The packet.
    pub fn to_packet(self) -> Packet {
        Packet::new(ENCODER_PACKET, [self.left.to_le_bytes(), self.right.to_le_bytes()].concat())
    }
}

/// Digital and analog inputs and outputs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Io {
    /// Eight inputs a byte.
    pub digital_in: Vec<u8>,
    /// Eight outputs a byte.
    pub digital_out: Vec<u8>,
    /// 0 to 1023 for 0 to 5 V.
    pub analog: Vec<u16>,
}

impl Io {
    /// Reads the packet; nothing for another, or one cut off.
    pub fn from_packet(packet: &Packet) -> Option<Self> {
        let mut reader = Reader(&packet.data);
        let bytes = |reader: &mut Reader| {
            let count = reader.u8()?;
            (0..count).map(|_| reader.u8()).collect::<Option<Vec<u8>>>()
        };
        let (digital_in, digital_out) = (bytes(&mut reader)?, bytes(&mut reader)?);
        let count = reader.u8()?;
        let analog = (0..count).map(|_| reader.u16()).collect::<Option<_>>()?;
        (packet.kind == IO_PACKET).then_some(Self { digital_in, digital_out, analog })
    }

    /// The packet.
    pub fn to_packet(&self) -> Packet {
        let mut data = vec![self.digital_in.len() as u8];
        data.extend(&self.digital_in);
        data.push(self.digital_out.len() as u8);
        data.extend(&self.digital_out);
        data.push(self.analog.len() as u8);
        data.extend(self.analog.iter().flat_map(|value| value.to_le_bytes()));
        Packet::new(IO_PACKET, data)
    }
}

/// Gyro samples of one cycle: rate (about 512 at rest) and temperature.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Gyro {
    /// Rate and temperature.
    pub samples: Vec<(u16, u8)>,
}

impl Gyro {
    /// Reads the packet; nothing for another, or one cut off.
    pub fn from_packet(packet: &Packet) -> Option<Self> {
        let mut reader = Reader(&packet.data);
        let count = reader.u8()?;
        let samples = (0..count).map(|_| Some((reader.u16()?, reader.u8()?))).collect::<Option<_>>()?;
        (packet.kind == GYRO_PACKET).then_some(Self { samples })
    }

    /// The packet.
    pub fn to_packet(&self) -> Packet {
        let mut data = vec![self.samples.len() as u8];
        for (rate, temperature) in &self.samples {
            data.extend(rate.to_le_bytes());
            data.push(*temperature);
        }
        Packet::new(GYRO_PACKET, data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_read_as_written() {
        let encoder = Encoder { left: -5, right: 70_000 };
        assert_eq!(Encoder::from_packet(&encoder.to_packet()), Some(encoder));
        let io = Io { digital_in: vec![1], digital_out: vec![2, 3], analog: vec![1023, 4] };
        assert_eq!(Io::from_packet(&io.to_packet()), Some(io));
        let gyro = Gyro { samples: vec![(512, 20), (500, 21)] };
        assert_eq!(Gyro::from_packet(&gyro.to_packet()), Some(gyro));
    }

    #[test]
    fn one_that_is_cut_off_is_refused() {
        let mut packet = Io { analog: vec![1, 2], ..Io::default() }.to_packet();
        packet.data.pop();
        assert_eq!(Io::from_packet(&packet), None);
    }
}
