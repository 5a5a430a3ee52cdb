//! Messages as ROS 1 writes them: little-endian, packed, lengths before strings and lists.

use crate::geometry::Pose;
use crate::robot::ros::message::heading_of;
use crate::robot::ros::{Header, Kind, Message, Odometry, Picture, Scan, Transform};

/// Why bytes are no such message.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CodecError {
    /// They end early, or a length in them cannot be.
    #[error("{0} bytes are too few for what they announce")]
    Short(usize),
    /// They go on.
    #[error("{0} bytes are left over")]
    Long(usize),
}

/// The MD5 sum by which two nodes know that they mean the same type.
pub fn sum(kind: Kind) -> &'static str {
    match kind {
        Kind::Twist => "9f195f881246fdfa2798d1d3eebca84a",
        Kind::TwistStamped => "98d34b0043a2093cf9d9345ab6eef12e",
        Kind::Odometry => "cd5e73d190d741a2f92e81eda573aca7",
        Kind::Scan => "90c7ef2dc6895d81024acba2ac42f369",
        Kind::Range => "c005c34273dc426c67a020a87bc24148",
        Kind::Cloud => "d8e9c3f5afbdd8a130fd1d2763945fca",
        Kind::Transforms => "94810edda583a504dfda3829e70d7eec",
        Kind::Clock => "a9c97c1d230cfc112e270351a944ee47",
        Kind::Text => "992ce8a1687cec8c8bd883ec73ca41d1",
        Kind::Flag => "8b94c1b53db61fb6aed406028ad6332a",
        Kind::Number => "fdb28210bfa9d7c91146260178d9a584",
        Kind::Picture => "060021388200f6f0f447d0fcd9c64743",
        Kind::Camera => "c9a58c1b0b154e0e6da7578cb991d214",
        Kind::Path => "6227e2b7e9cce15051f669a5e197bbf7",
    }
}

/// Bytes being written.
#[derive(Default)]
struct Out(Vec<u8>);

impl Out {
    fn u32(&mut self, value: usize) {
        self.0.extend(u32::try_from(value).unwrap_or(u32::MAX).to_le_bytes());
    }

    fn f64s(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.0.extend(value.to_le_bytes()));
    }

    fn f32s(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.0.extend((*value as f32).to_le_bytes()));
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len());
        self.0.extend(text.as_bytes());
    }

    fn time(&mut self, seconds: f64) {
        let whole = seconds.max(0.0).floor();
        self.u32(whole as usize);
        self.u32(((seconds.max(0.0) - whole) * 1e9) as usize);
    }

    /// Subscribers do not look at the sequence number.
    fn header(&mut self, header: &Header) {
        self.u32(0);
        self.time(header.stamp_s);
        self.text(&header.frame);
    }

    fn twist(&mut self, linear: f64, angular: f64) {
        self.f64s(&[linear, 0.0, 0.0, 0.0, 0.0, angular]);
    }

    fn pose(&mut self, pose: Pose) {
        let (sin, cos) = (pose.heading / 2.0).sin_cos();
        self.f64s(&[pose.x, pose.y, 0.0, 0.0, 0.0, sin, cos]);
    }

    fn picture(&mut self, picture: &Picture) {
        self.header(&picture.header);
        self.u32(picture.height as usize);
        self.u32(picture.width as usize);
        self.text(&picture.encoding);
        self.0.push(0);
        self.u32(picture.data.len() / picture.height.max(1) as usize);
        self.u32(picture.data.len());
        self.0.extend(&picture.data);
    }

    fn camera(&mut self, header: &Header, [width, height]: [u32; 2], [fx, fy, cx, cy]: [f64; 4]) {
        self.header(header);
        self.u32(height as usize);
        self.u32(width as usize);
        self.text("plumb_bob");
        self.u32(5);
        self.f64s(&[0.0; 5]);
        self.f64s(&[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]);
        self.f64s(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        self.f64s(&[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]);
        // Binning, and the whole sensor as region of interest.
        self.0.extend([0; 25]);
    }

    fn scan(&mut self, scan: &Scan) {
        self.header(&scan.header);
        let last = scan.first_rad + scan.step_rad * scan.ranges_m.len().saturating_sub(1) as f64;
        self.f32s(&[scan.first_rad, last, scan.step_rad, 0.0, 0.0, scan.least_m, scan.most_m]);
        self.u32(scan.ranges_m.len());
        scan.ranges_m.iter().for_each(|range| self.0.extend(range.to_le_bytes()));
        self.u32(0);
    }

    fn transform(&mut self, transform: &Transform) {
        self.header(&transform.header);
        self.text(&transform.child);
        self.f64s(&transform.translation);
        self.f64s(&transform.rotation);
    }

    fn odometry(&mut self, odometry: &Odometry) {
        self.header(&odometry.header);
        self.text(&odometry.child);
        self.pose(odometry.pose);
        self.f64s(&[0.0; 36]);
        self.twist(odometry.velocity.0, odometry.velocity.1);
        self.f64s(&[0.0; 36]);
    }
}

/// The bytes of a message, without the length that goes before them on a line.
pub fn encode(message: &Message) -> Vec<u8> {
    let mut out = Out::default();
    match message {
        Message::Twist(linear, angular) => out.twist(*linear, *angular),
        Message::TwistStamped(header, linear, angular) => {
            out.header(header);
            out.twist(*linear, *angular);
        }
        Message::Odometry(odometry) => out.odometry(odometry),
        Message::Scan(scan) => out.scan(scan),
        Message::Range(header, [view, least, most, range]) => {
            out.header(header);
            out.0.push(0);
            out.f32s(&[*view, *least, *most, *range]);
        }
        Message::Cloud(header, points) => {
            out.header(header);
            out.u32(points.len());
            points.iter().flatten().for_each(|value| out.0.extend(value.to_le_bytes()));
            out.u32(0);
        }
        Message::Transforms(transforms) => {
            out.u32(transforms.len());
            transforms.iter().for_each(|transform| out.transform(transform));
        }
        Message::Clock(seconds) => out.time(*seconds),
        Message::Text(text) => out.text(text),
        Message::Flag(flag) => out.0.push(u8::from(*flag)),
        Message::Number(number) => out.f64s(&[*number]),
        Message::Picture(picture) => out.picture(picture),
        Message::Camera(header, size, lens) => out.camera(header, *size, *lens),
        Message::Path(header, poses) => {
            out.header(header);
            out.u32(poses.len());
            for pose in poses {
                out.header(header);
                out.pose(*pose);
            }
        }
    }
    out.0
}

/// Bytes being read.
struct In<'a>(&'a [u8]);

impl<'a> In<'a> {
    fn bytes(&mut self, count: usize) -> Result<&'a [u8], CodecError> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(CodecError::Short(self.0.len()))?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], CodecError> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    fn u32(&mut self) -> Result<u32, CodecError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn f32(&mut self) -> Result<f32, CodecError> {
        Ok(f32::from_le_bytes(self.array()?))
    }

    fn f64s<const N: usize>(&mut self) -> Result<[f64; N], CodecError> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = f64::from_le_bytes(self.array()?);
        }
        Ok(values)
    }

    /// A list, of which each takes at least `least` bytes: no more is set aside than has come.
    fn list<T>(
        &mut self,
        least: usize,
        mut one: impl FnMut(&mut Self) -> Result<T, CodecError>,
    ) -> Result<Vec<T>, CodecError> {
        let count = self.u32()? as usize;
        if count.saturating_mul(least) > self.0.len() {
            return Err(CodecError::Short(self.0.len()));
        }
        (0..count).map(|_| one(self)).collect()
    }

    fn text(&mut self) -> Result<String, CodecError> {
        let count = self.u32()? as usize;
        Ok(String::from_utf8_lossy(self.bytes(count)?).into_owned())
    }

    fn time(&mut self) -> Result<f64, CodecError> {
        Ok(f64::from(self.u32()?) + f64::from(self.u32()?) * 1e-9)
    }

    fn header(&mut self) -> Result<Header, CodecError> {
        self.u32()?;
        let stamp_s = self.time()?;
        // The leading slash of old says nothing.
        Ok(Header { stamp_s, frame: self.text()?.trim_start_matches('/').to_string() })
    }

    fn twist(&mut self) -> Result<(f64, f64), CodecError> {
        let [linear, _, _, _, _, angular] = self.f64s()?;
        Ok((linear, angular))
    }

    fn pose(&mut self) -> Result<Pose, CodecError> {
        let [x, y, _, qx, qy, qz, qw] = self.f64s()?;
        Ok(Pose::new(x, y, heading_of([qx, qy, qz, qw])))
    }

    fn odometry(&mut self) -> Result<Odometry, CodecError> {
        let (header, child) = (self.header()?, self.text()?);
        let pose = self.pose()?;
        self.f64s::<36>()?;
        let velocity = self.twist()?;
        self.f64s::<36>()?;
        Ok(Odometry { header, child, pose, velocity })
    }

    fn scan(&mut self) -> Result<Scan, CodecError> {
        let header = self.header()?;
        let mut settings = [0.0; 7];
        for setting in &mut settings {
            *setting = f64::from(self.f32()?);
        }
        let [first_rad, _, step_rad, _, _, least_m, most_m] = settings;
        let ranges_m = self.list(4, Self::f32)?;
        self.list(4, Self::f32)?;
        Ok(Scan { header, first_rad, step_rad, least_m, most_m, ranges_m })
    }

    fn range(&mut self) -> Result<Message, CodecError> {
        let header = self.header()?;
        self.bytes(1)?;
        let mut values = [0.0; 4];
        for value in &mut values {
            *value = f64::from(self.f32()?);
        }
        Ok(Message::Range(header, values))
    }

    fn cloud(&mut self) -> Result<Message, CodecError> {
        let header = self.header()?;
        let points = self.list(12, |bytes| Ok([bytes.f32()?, bytes.f32()?, bytes.f32()?]))?;
        self.list(8, |bytes| {
            bytes.text()?;
            bytes.list(4, Self::f32)
        })?;
        Ok(Message::Cloud(header, points))
    }

    fn transform(&mut self) -> Result<Transform, CodecError> {
        let (header, child) = (self.header()?, self.text()?);
        let (translation, rotation) = (self.f64s()?, self.f64s()?);
        let child = child.trim_start_matches('/').to_string();
        Ok(Transform { header, child, translation, rotation })
    }

    fn picture(&mut self) -> Result<Picture, CodecError> {
        let header = self.header()?;
        let (height, width) = (self.u32()?, self.u32()?);
        let encoding = self.text()?;
        self.bytes(5)?;
        let count = self.u32()? as usize;
        let data = self.bytes(count)?.to_vec();
        Ok(Picture { header, width, height, encoding, data })
    }

    fn camera(&mut self) -> Result<Message, CodecError> {
        let header = self.header()?;
        let (height, width) = (self.u32()?, self.u32()?);
        self.text()?;
        self.list(8, Self::f64s::<1>)?;
        let [fx, _, cx, _, fy, cy, ..] = self.f64s::<9>()?;
        self.f64s::<21>()?;
        self.bytes(25)?;
        Ok(Message::Camera(header, [width, height], [fx, fy, cx, cy]))
    }

    fn path(&mut self) -> Result<Message, CodecError> {
        let header = self.header()?;
        let poses = self.list(72, |bytes| {
            bytes.header()?;
            bytes.pose()
        })?;
        Ok(Message::Path(header, poses))
    }
}

/// The message in these bytes.
///
/// # Errors
/// When they are too few or too many for one of this kind.
pub fn decode(kind: Kind, bytes: &[u8]) -> Result<Message, CodecError> {
    let mut bytes = In(bytes);
    let message = match kind {
        Kind::Twist => bytes.twist().map(|(linear, angular)| Message::Twist(linear, angular))?,
        Kind::TwistStamped => {
            let header = bytes.header()?;
            bytes.twist().map(|(linear, angular)| Message::TwistStamped(header, linear, angular))?
        }
        Kind::Odometry => Message::Odometry(bytes.odometry()?),
        Kind::Scan => Message::Scan(bytes.scan()?),
        Kind::Range => bytes.range()?,
        Kind::Cloud => bytes.cloud()?,
        Kind::Transforms => Message::Transforms(bytes.list(72, In::transform)?),
        Kind::Clock => Message::Clock(bytes.time()?),
        Kind::Text => Message::Text(bytes.text()?),
        Kind::Flag => Message::Flag(bytes.array::<1>()? != [0]),
        Kind::Number => Message::Number(bytes.f64s::<1>()?[0]),
        Kind::Picture => Message::Picture(bytes.picture()?),
        Kind::Camera => bytes.camera()?,
        Kind::Path => bytes.path()?,
    };
    if bytes.0.is_empty() { Ok(message) } else { Err(CodecError::Long(bytes.0.len())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One message of each kind.
    fn messages() -> Vec<Message> {
        let header = Header { stamp_s: 12.5, frame: "odom".into() };
        let pose = Pose::new(1.0, -2.0, 0.5);
        vec![
            Message::Twist(0.3, -0.5),
            Message::TwistStamped(header.clone(), 0.3, -0.5),
            Message::Odometry(Odometry {
                header: header.clone(),
                child: "base_link".into(),
                pose,
                velocity: (0.25, 0.5),
            }),
            Message::Scan(Scan {
                header: header.clone(),
                first_rad: -1.5,
                step_rad: 0.5,
                least_m: 0.125,
                most_m: 8.0,
                ranges_m: vec![1.0, 2.0],
            }),
            Message::Range(header.clone(), [0.25, 0.5, 4.0, 1.5]),
            Message::Cloud(header.clone(), vec![[1.0, 2.0, 3.0]]),
            Message::Transforms(vec![Transform::flat(header.clone(), "base_link", pose)]),
            Message::Clock(3.25),
            Message::Text("the mug".into()),
            Message::Flag(true),
            Message::Number(12.5),
            Message::Picture(Picture {
                header: header.clone(),
                width: 1,
                height: 2,
                encoding: "rgb8".into(),
                data: vec![7; 6],
            }),
            Message::Camera(header.clone(), [640, 480], [525.0, 525.0, 319.5, 239.5]),
            Message::Path(header, vec![Pose::new(0.0, 1.0, 0.0)]),
        ]
    }

    #[test]
    fn every_kind_is_read_as_it_was_written() {
        assert_eq!(messages().iter().map(Message::kind).collect::<Vec<_>>(), Kind::ALL);
        for message in messages() {
            let read = decode(message.kind(), &encode(&message)).expect("readable");
            // A heading goes through a quaternion.
            assert_eq!(format!("{read:.9?}"), format!("{message:.9?}"));
        }
    }

    #[test]
    fn bytes_too_few_too_many_or_of_another_endianness_are_no_message() {
        for message in messages() {
            let bytes = encode(&message);
            for cut in 0..bytes.len() {
                assert!(decode(message.kind(), &bytes[..cut]).is_err(), "{:?} {cut}", message.kind());
            }
            let longer = [bytes.as_slice(), &[0]].concat();
            assert_eq!(decode(message.kind(), &longer), Err(CodecError::Long(1)));
        }
        let mut swapped = encode(&Message::Text("the mug".into()));
        swapped[..4].reverse();
        assert!(matches!(decode(Kind::Text, &swapped), Err(CodecError::Short(_))));
    }
}
