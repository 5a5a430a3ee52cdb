//! A furnished room.

use crate::geometry::{Polygon, Pose, vec2};
use crate::map::{Room, RoomMap};
use crate::simulation::Dice;
use crate::simulation::camera::{Faces, Finish, Texture};
use crate::simulation::families::Piece;

const FLOORS: [([u8; 3], Texture); 7] = [
    ([168, 142, 112], Texture::Boards),
    ([120, 88, 62], Texture::Boards),
    ([196, 176, 148], Texture::Boards),
    ([150, 148, 142], Texture::Tiles),
    ([205, 200, 190], Texture::Tiles),
    ([130, 124, 116], Texture::Cloth),
    ([110, 118, 132], Texture::Cloth),
];
const WALLS: [[u8; 3]; 6] =
    [[222, 216, 204], [238, 238, 234], [200, 206, 196], [206, 196, 178], [180, 192, 206], [226, 208, 200]];

/// A piece at its place.
pub(super) struct Placed {
    pub piece: Piece,
    pub pose: Pose,
    /// Metres above the floor: the height of what it stands on.
    pub lift: f64,
    /// The number of what it stands on.
    pub on: Option<usize>,
    /// Whether it is a small thing a person might ask for.
    pub target: bool,
}

impl Placed {
    pub fn footprint(&self) -> Polygon {
        Polygon::rectangle(self.pose, self.piece.size.length, self.piece.size.width)
    }
}

/// A rectangular room about the origin.
pub(super) struct FurnishedRoom {
    /// Half its extent along x and y, metres.
    pub half: (f64, f64),
    pub height: f64,
    pub placed: Vec<Placed>,
}

impl FurnishedRoom {
    fn corners(&self) -> [[f64; 2]; 4] {
        let (x, y) = self.half;
        [[-x, -y], [x, -y], [x, y], [-x, y]]
    }

    /// What the renderer draws, its walls and floor in random colours.
    pub fn faces(&self, dice: &mut Dice) -> Faces {
        let mut faces = Faces::default();
        let (color, texture) = dice.pick(&FLOORS);
        let (low, high) = (vec2(-self.half.0, -self.half.1), vec2(self.half.0, self.half.1));
        faces.add_level(low, high, 0.0, Finish::new(color, texture));
        faces.add_level(low, high, self.height, Finish::new([240, 240, 238], Texture::Plain));
        let wall = Finish::new(dice.pick(&WALLS), Texture::Plain);
        let corners = self.corners().map(|[x, y]| vec2(x, y));
        for i in 0..4 {
            faces.add_wall(corners[i], corners[(i + 1) % 4], self.height, wall);
        }
        for (id, placed) in (1..).zip(&self.placed) {
            for part in &placed.piece.parts {
                faces.add_frustum(&part.placed(placed.pose, placed.lift), id);
            }
        }
        faces
    }

    /// The room as a robot may know it.
    pub fn map(&self) -> RoomMap {
        let room =
            Room { name: "room".to_string(), synonyms: Vec::new(), passage: false, outline: self.corners().to_vec() };
        RoomMap {
            name: "training".to_string(),
            wall_height: self.height,
            start: Pose::default(),
            rooms: vec![room],
            doors: Vec::new(),
            ..RoomMap::apartment()
        }
    }
}
