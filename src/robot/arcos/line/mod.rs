//! What carries the bytes: serial, TCP or a pseudo-terminal.

mod address;
mod pty;
mod serial;
mod tcp;

use std::io;
use std::os::fd::OwnedFd;
use std::time::Duration;

pub use address::{Address, AddressError};
pub use pty::PtyLine;
pub use serial::{BAUD_RATES, SerialLine};
pub use tcp::TcpLine;

/// One end of a line, with a clock: real for real lines, virtual in memory.
pub trait Line {
    /// Reads what has arrived, waiting at most `wait` for the first byte; 0 when nothing came.
    ///
    /// A line that is closed or gone is an error, never 0.
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize>;

    /// Sends all bytes.
    fn write(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Closes and opens it again.
    fn reopen(&mut self) -> io::Result<()>;

    /// Time on the line's clock.
    fn now(&self) -> Duration;

    /// Lets time pass.
    fn sleep(&mut self, time: Duration) {
        std::thread::sleep(time);
    }

    /// Bits a second, where that means anything.
    fn baud(&self) -> Option<u32> {
        None
    }

    /// Changes the rate.
    fn set_baud(&mut self, _baud: u32) -> io::Result<()> {
        Ok(())
    }

    /// Whether the rate was given by the user and is not ours to change.
    fn baud_is_fixed(&self) -> bool {
        true
    }

    /// The same line for another process, to write to.
    fn share(&self) -> io::Result<OwnedFd> {
        Err(io::ErrorKind::Unsupported.into())
    }

    /// What to call it in messages.
    fn name(&self) -> String;
}

impl<T: Line + ?Sized> Line for Box<T> {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        (**self).read(buffer, wait)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        (**self).write(bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        (**self).reopen()
    }

    fn now(&self) -> Duration {
        (**self).now()
    }

    fn sleep(&mut self, time: Duration) {
        (**self).sleep(time);
    }

    fn baud(&self) -> Option<u32> {
        (**self).baud()
    }

    fn set_baud(&mut self, baud: u32) -> io::Result<()> {
        (**self).set_baud(baud)
    }

    fn baud_is_fixed(&self) -> bool {
        (**self).baud_is_fixed()
    }

    fn share(&self) -> io::Result<OwnedFd> {
        (**self).share()
    }

    fn name(&self) -> String {
        (**self).name()
    }
}
