//! Why rings are no areal object.

/// What keeps a list of rings from being an areal object.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// No ring at all.
    #[error("the shape is empty; give it at least one ring of three corners")]
    Empty,
    /// Fewer than three different corners.
    #[error("ring {0} has fewer than three corners")]
    TooFewCorners(usize),
    /// First and last position differ.
    #[error("ring {0} is open; its last position must repeat its first")]
    Open(usize),
    /// NaN or infinite.
    #[error("ring {0} has a coordinate that is not a finite number, at position {1}")]
    NotFinite(usize, usize),
    /// Two edges cross, or run along each other.
    #[error("ring {0} crosses itself, at edges {1} and {2}")]
    SelfCrossing(usize, usize, usize),
    /// Two edges that do not follow each other share a point.
    #[error("ring {0} crosses itself at a corner, ({1}, {2}); make two rings of it")]
    SelfTouching(usize, f64, f64),
    /// A hole is not within its outer ring, or shares a line with it.
    #[error("the hole, ring {0}, reaches beyond its ring {1} or runs along it; draw the outer ring round what is left")]
    HoleOutside(usize, usize),
    /// Two holes share an area or a line.
    #[error("the holes, rings {0} and {1}, overlap or share a border; join them into one")]
    HolesOverlap(usize, usize),
    /// Two parts share an area or a line.
    #[error("the parts with rings {0} and {1} overlap or share a border; join them into one")]
    PartsOverlap(usize, usize),
    /// Rings that touch each other cut a part in two.
    #[error("ring {0} touches others of its part so often that they cut it in two; make two parts of it")]
    Disconnected(usize),
    /// More corners than are taken.
    #[error("{0}")]
    TooMany(String),
    /// All corners on a line.
    #[error("ring {0} has no area")]
    NoArea(usize),
}
