//! Reading a file while it is still being written.

use std::io::{self, Read};
use std::time::Duration;

/// How often a file that has ended for now is looked at again.
const AGAIN: Duration = Duration::from_millis(20);

/// Waits at the end of a source for more, for as long as `goes_on` says so.
pub struct Follow<R, F> {
    source: R,
    goes_on: F,
}

impl<R: Read, F: FnMut() -> bool> Follow<R, F> {
    /// Follows `source`; `goes_on` is asked each time its end has been reached.
    pub fn new(source: R, goes_on: F) -> Self {
        Self { source, goes_on }
    }
}

impl<R: Read, F: FnMut() -> bool> Read for Follow<R, F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let read = self.source.read(buffer)?;
            if read > 0 || buffer.is_empty() || !(self.goes_on)() {
                return Ok(read);
            }
            std::thread::sleep(AGAIN);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::VecDeque;

    struct InPieces(VecDeque<&'static [u8]>);

    impl Read for InPieces {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.0.pop_front().unwrap_or_default().read(buffer)
        }
    }

    #[test]
    fn an_end_for_now_is_waited_out() {
        let mut asked = 0;
        let mut text = String::new();
        let pieces = InPieces(VecDeque::from([&b"ab"[..], b"", b"c"]));
        let goes_on = || {
            asked += 1;
            asked < 2
        };
        Follow::new(pieces, goes_on).read_to_string(&mut text).expect("reads");
        assert_eq!(text, "abc");
    }
}
