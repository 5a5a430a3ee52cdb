//! Where a piece may stand: inside its room, clear of the way in and of the others.

use crate::geometry::{Pose, wrap_angle};
use crate::map::RoomMap;
use crate::simulation::Item;

/// Whether a piece stands inside its room, clear of the way in and of the others.
pub(super) fn is_free(map: &RoomMap, items: &[Item], i: usize, entry: Pose) -> bool {
    const WAY_IN_M: f64 = 0.55;
    let footprint = items[i].footprint();
    let centre = items[i].pose().position();
    let Some(room) = map.room_at(centre) else { return false };
    let outline = room.polygon();
    let inside = footprint.corners().iter().all(|&corner| outline.contains(corner))
        && !outline.corners().iter().any(|&corner| footprint.contains(corner));
    inside
        && footprint.distance_to(entry.position()) > WAY_IN_M
        && map.doors.iter().all(|door| footprint.distance_to(door.middle()) > door.width / 2.0 + 0.1)
        && items.iter().enumerate().all(|(j, other)| {
            let apart = (other.pose().position() - centre).norm() > 3.0;
            j == i || apart || footprint.distance(&other.footprint()) > 0.02
        })
}

/// The same heading in (−180, 180].
pub(super) fn degrees(radians: f64) -> f64 {
    rounded(wrap_angle(radians).to_degrees())
}

/// Files are read by people: a centimetre is enough.
pub(super) fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
