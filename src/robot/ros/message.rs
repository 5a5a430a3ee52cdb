//! What is said over ROS, in plain types of our own: metres, radians, seconds.

use crate::geometry::Pose;

/// When and in which frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// Seconds on the robot's clock.
    pub stamp_s: f64,
    /// The frame's name.
    pub frame: String,
}

/// Where the wheels believe the base is, and how it moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Odometry {
    /// When, and in which frame the pose is.
    pub header: Header,
    /// The base's own frame.
    pub child: String,
    /// On the floor.
    pub pose: Pose,
    /// m/s ahead, rad/s counter-clockwise.
    pub velocity: (f64, f64),
}

/// One turn of a laser scanner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scan {
    /// When, and in whose frame.
    pub header: Header,
    /// Bearing of the first beam, radians.
    pub first_rad: f64,
    /// From one beam to the next, radians.
    pub step_rad: f64,
    /// Nearer than this nothing is measured, metres.
    pub least_m: f64,
    /// Farther than this nothing is measured, metres.
    pub most_m: f64,
    /// Metres, a beam each; what is no number was not measured.
    pub ranges_m: Vec<f32>,
}

/// Where a frame is within another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transform {
    /// When, and in which frame.
    pub header: Header,
    /// Whose place it is.
    pub child: String,
    /// Metres.
    pub translation: [f64; 3],
    /// Unit quaternion: x, y, z, w.
    pub rotation: [f64; 4],
}

impl Transform {
    /// A place on the floor.
    pub fn flat(header: Header, child: &str, pose: Pose) -> Self {
        let (sin, cos) = (pose.heading / 2.0).sin_cos();
        Self { header, child: child.into(), translation: [pose.x, pose.y, 0.0], rotation: [0.0, 0.0, sin, cos] }
    }

    /// The place on the floor, seen from above.
    pub fn pose(&self) -> Pose {
        Pose::new(self.translation[0], self.translation[1], heading_of(self.rotation))
    }
}

/// A picture, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// When, and in whose frame.
    pub header: Header,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Such as `rgb8` or `16UC1`.
    pub encoding: String,
    /// Little-endian.
    pub data: Vec<u8>,
}

/// A message.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// m/s ahead, rad/s counter-clockwise.
    Twist(f64, f64),
    /// The same, with its time.
    TwistStamped(Header, f64, f64),
    /// Where the wheels believe it is.
    Odometry(Odometry),
    /// A laser scanner's turn.
    Scan(Scan),
    /// One range sensor: field of view (rad), least, most and measured range (m).
    Range(Header, [f64; 4]),
    /// Points, metres, in the header's frame.
    Cloud(Header, Vec<[f32; 3]>),
    /// Places of frames.
    Transforms(Vec<Transform>),
    /// Seconds on the simulated clock.
    Clock(f64),
    /// Words.
    Text(String),
    /// Yes or no.
    Flag(bool),
    /// A number.
    Number(f64),
    /// Colour or depth.
    Picture(Picture),
    /// A camera: width, height and fx, fy, cx, cy.
    Camera(Header, [u32; 2], [f64; 4]),
    /// A way.
    Path(Header, Vec<Pose>),
}

/// What kind of message it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `geometry_msgs/Twist`
    Twist,
    /// `geometry_msgs/TwistStamped`
    TwistStamped,
    /// `nav_msgs/Odometry`
    Odometry,
    /// `sensor_msgs/LaserScan`
    Scan,
    /// `sensor_msgs/Range`
    Range,
    /// `sensor_msgs/PointCloud`
    Cloud,
    /// `tf2_msgs/TFMessage`
    Transforms,
    /// `rosgraph_msgs/Clock`
    Clock,
    /// `std_msgs/String`
    Text,
    /// `std_msgs/Bool`
    Flag,
    /// `std_msgs/Float64`
    Number,
    /// `sensor_msgs/Image`
    Picture,
    /// `sensor_msgs/CameraInfo`
    Camera,
    /// `nav_msgs/Path`
    Path,
}

impl Kind {
    /// All there are.
    pub const ALL: [Self; 14] = [
        Self::Twist,
        Self::TwistStamped,
        Self::Odometry,
        Self::Scan,
        Self::Range,
        Self::Cloud,
        Self::Transforms,
        Self::Clock,
        Self::Text,
        Self::Flag,
        Self::Number,
        Self::Picture,
        Self::Camera,
        Self::Path,
    ];

    /// ROS's name of the type, without the `msg` of ROS 2.
    pub fn name(self) -> &'static str {
        match self {
            Self::Twist => "geometry_msgs/Twist",
            Self::TwistStamped => "geometry_msgs/TwistStamped",
            Self::Odometry => "nav_msgs/Odometry",
            Self::Scan => "sensor_msgs/LaserScan",
            Self::Range => "sensor_msgs/Range",
            Self::Cloud => "sensor_msgs/PointCloud",
            Self::Transforms => "tf2_msgs/TFMessage",
            Self::Clock => "rosgraph_msgs/Clock",
            Self::Text => "std_msgs/String",
            Self::Flag => "std_msgs/Bool",
            Self::Number => "std_msgs/Float64",
            Self::Picture => "sensor_msgs/Image",
            Self::Camera => "sensor_msgs/CameraInfo",
            Self::Path => "nav_msgs/Path",
        }
    }

    /// The kind with this name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl Message {
    /// What kind it is.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Twist(..) => Kind::Twist,
            Self::TwistStamped(..) => Kind::TwistStamped,
            Self::Odometry(_) => Kind::Odometry,
            Self::Scan(_) => Kind::Scan,
            Self::Range(..) => Kind::Range,
            Self::Cloud(..) => Kind::Cloud,
            Self::Transforms(_) => Kind::Transforms,
            Self::Clock(_) => Kind::Clock,
            Self::Text(_) => Kind::Text,
            Self::Flag(_) => Kind::Flag,
            Self::Number(_) => Kind::Number,
            Self::Picture(_) => Kind::Picture,
            Self::Camera(..) => Kind::Camera,
            Self::Path(..) => Kind::Path,
        }
    }
}

/// The heading of a rotation, seen from above, radians.
pub(super) fn heading_of([x, y, z, w]: [f64; 4]) -> f64 {
    (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
}
