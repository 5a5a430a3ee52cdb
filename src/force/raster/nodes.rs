//! The table of nodes of a correlation: where they lie, and what counts on them.

/// Nodes of zeros around the box, so that rays need no care at its edge.
const MARGIN: i32 = 2;
/// Where the nodes of a table lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shifts {
    /// Shift of the first node without margin.
    pub(super) low: (i32, i32),
    /// Shift of the last node without margin.
    pub(super) high: (i32, i32),
}

impl Shifts {
    pub(super) fn stride(&self) -> usize {
        (self.high.0 - self.low.0 + 1 + 2 * MARGIN) as usize
    }

    pub(super) fn rows(&self) -> usize {
        (self.high.1 - self.low.1 + 1 + 2 * MARGIN) as usize
    }

    /// The place of a shift in the table; the shift may lie in the margin.
    pub(super) fn index(&self, x: i32, y: i32) -> usize {
        (y - self.low.1 + MARGIN) as usize * self.stride() + (x - self.low.0 + MARGIN) as usize
    }

    /// The place of the shift (0, 0), which may lie outside the table.
    pub(super) fn origin(&self) -> i64 {
        i64::from(MARGIN - self.low.1) * self.stride() as i64 + i64::from(MARGIN - self.low.0)
    }

    pub(super) fn contains(&self, x: i32, y: i32) -> bool {
        (self.low.0..=self.high.0).contains(&x) && (self.low.1..=self.high.1).contains(&y)
    }
}

/// An integer that wraps: running sums may pass their range on the way to a result that is within it.
pub(super) trait Count: Copy + Default {
    fn plus(self, other: Self) -> Self;
    fn of(value: i64) -> Self;
    fn value(self) -> f64;
}

impl Count for i32 {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    fn of(value: i64) -> Self {
        value as Self
    }
    #[inline(always)]
    fn value(self) -> f64 {
        f64::from(self)
    }
}

impl Count for i64 {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    fn of(value: i64) -> Self {
        value
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self as f64
    }
}
