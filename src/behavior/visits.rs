//! Which rooms are searched, how often, and how carefully.

/// How carefully a room is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Care {
    /// Everything, from elsewhere too, and everything once more.
    Whole,
    /// What shows itself, once: it may be in another room.
    Once,
    /// From elsewhere, and everything once more.
    Again,
}

/// The rooms in the order in which they are searched: where nobody said which, each once before any is searched again.
pub(super) fn visits<'r>(rooms: &[&'r str]) -> Vec<(&'r str, Care)> {
    if let [room] = rooms {
        return vec![(room, Care::Whole)];
    }
    [Care::Once, Care::Again].into_iter().flat_map(|care| rooms.iter().map(move |room| (*room, care))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_rooms_each_is_searched_once_before_any_is_searched_again() {
        let order = visits(&["bedroom", "kitchen"]);
        let rooms: Vec<&str> = order.iter().map(|(room, _)| *room).collect();
        assert_eq!(rooms, ["bedroom", "kitchen", "bedroom", "kitchen"]);
        assert_eq!((order[1].1, order[2].1), (Care::Once, Care::Again));
        assert_eq!(visits(&["bedroom"]), [("bedroom", Care::Whole)]);
    }
}
