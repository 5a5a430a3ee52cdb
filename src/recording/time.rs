//! Times of a log: whole nanoseconds, since the Unix epoch or since the trial began.

use foxglove::messages::Timestamp;

const PER_SECOND: u64 = 1_000_000_000;

/// Seconds as nanoseconds; what lies before zero is zero.
pub fn nanoseconds(seconds: f64) -> u64 {
    (seconds.max(0.0) * 1e9).round() as u64
}

pub(super) fn timestamp(nanoseconds: u64) -> Timestamp {
    let seconds = (nanoseconds / PER_SECOND).min(u64::from(u32::MAX));
    Timestamp::new(seconds as u32, (nanoseconds % PER_SECOND) as u32)
}

pub(super) fn of_timestamp(stamp: Option<Timestamp>) -> Option<u64> {
    stamp.map(|stamp| u64::from(stamp.sec()) * PER_SECOND + u64::from(stamp.nsec()))
}

pub(super) fn of_parts(seconds: u32, nanoseconds: u32) -> u64 {
    u64::from(seconds) * PER_SECOND + u64::from(nanoseconds)
}
