//! The part of a log that is wanted, by time.

/// From and to, seconds since the log's first message; open where not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Window {
    start_s: Option<f64>,
    end_s: Option<f64>,
    first_ns: Option<u64>,
}

impl Window {
    /// A window from `start_s` to `end_s`, both within it.
    pub fn new(start_s: Option<f64>, end_s: Option<f64>) -> Self {
        Self { start_s, end_s, first_ns: None }
    }

    /// Whether a message logged at that time lies in the window. The first one asked for sets the log's zero.
    pub fn holds(&mut self, log_ns: u64) -> bool {
        let first = *self.first_ns.get_or_insert(log_ns);
        let at_s = (i128::from(log_ns) - i128::from(first)) as f64 / 1e9;
        self.start_s.is_none_or(|start| at_s >= start) && self.end_s.is_none_or(|end| at_s <= end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_count_from_the_first_message() {
        let mut window = Window::new(Some(1.0), Some(2.0));
        let held = [5_000_000_000, 6_000_000_000, 7_000_000_000, 7_000_000_001].map(|ns| window.holds(ns));
        assert_eq!(held, [false, true, true, false]);
    }
}
