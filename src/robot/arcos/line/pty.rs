//! The robot's end of a pseudo-terminal: a serial line between two programs.

use std::io::{self, Read, Write};
use std::os::fd::AsFd;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, poll};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use super::Line;

/// A pseudo-terminal with a name of our choice.
///
/// It keeps to a rate, as a real line does: bytes take their time, and when
/// the client's rate is another they arrive as rubbish.
pub struct PtyLine {
    path: PathBuf,
    master: std::fs::File,
    /// Kept open: without a holder of the other end, reading fails between two clients.
    _slave: std::fs::File,
    baud: u32,
    opened: Instant,
}

impl PtyLine {
    /// Makes a pseudo-terminal that clients open as `path`, a symbolic link; an old link to a pseudo-terminal is replaced, anything else is not.
    ///
    /// # Errors
    /// When the system gives none, or the link cannot be made.
    pub fn create(path: &Path, baud: u32) -> io::Result<Self> {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let name = ptsname(&master, Vec::new())?;
        let device = PathBuf::from(name.to_string_lossy().into_owned());
        let slave = std::fs::OpenOptions::new().read(true).write(true).open(&device)?;
        let mut settings = tcgetattr(&slave)?;
        settings.make_raw();
        settings.set_speed(baud)?;
        tcsetattr(&slave, OptionalActions::Now, &settings)?;
        match std::fs::symlink_metadata(path) {
            Ok(found) if found.is_symlink() && names_a_terminal(path) => std::fs::remove_file(path)?,
            Ok(_) => return Err(io::Error::new(io::ErrorKind::AlreadyExists, "a file is there; name another path")),
            Err(_) => {}
        }
        std::os::unix::fs::symlink(&device, path)?;
        let master = std::fs::File::from(master);
        Ok(Self { path: path.to_path_buf(), master, _slave: slave, baud, opened: Instant::now() })
    }

    /// The rate at which the client talks.
    fn client_baud(&self) -> u32 {
        tcgetattr(&self.master).map_or(self.baud, |settings| settings.output_speed())
    }

    /// What a receiver at another rate makes of bytes.
    fn garble(&self, bytes: &mut [u8]) {
        if self.client_baud() != self.baud {
            bytes.iter_mut().for_each(|byte| *byte = byte.rotate_left(3) ^ 0x5A);
        }
    }
}

/// Whether a link was made by such a server: it leads to a pseudo-terminal, though that may be gone.
fn names_a_terminal(path: &Path) -> bool {
    std::fs::read_link(path).is_ok_and(|target| target.starts_with("/dev/pts"))
}

impl Drop for PtyLine {
    fn drop(&mut self) {
        if names_a_terminal(&self.path) {
            // Nobody is left to be told.
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

impl Line for PtyLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        let wait =
            rustix::time::Timespec { tv_sec: wait.as_secs() as i64, tv_nsec: i64::from(wait.subsec_nanos()) as _ };
        let mut waiting = [PollFd::from_borrowed_fd(self.master.as_fd(), PollFlags::IN)];
        match poll(&mut waiting, Some(&wait)) {
            Ok(0) | Err(rustix::io::Errno::INTR) => return Ok(0),
            polled => polled?,
        };
        let count = self.master.read(buffer)?;
        self.garble(&mut buffer[..count]);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut bytes = bytes.to_vec();
        self.garble(&mut bytes);
        let mut room = [PollFd::from_borrowed_fd(self.master.as_fd(), PollFlags::OUT)];
        // A client that reads nothing loses bytes, as on a real line.
        if poll(&mut room, Some(&rustix::time::Timespec::default()))? == 0 {
            return Ok(());
        }
        self.master.write_all(&bytes)?;
        // Ten bits a byte.
        std::thread::sleep(Duration::from_secs_f64(bytes.len() as f64 * 10.0 / f64::from(self.baud)));
        Ok(())
    }

    fn reopen(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn now(&self) -> Duration {
        self.opened.elapsed()
    }

    fn baud(&self) -> Option<u32> {
        Some(self.baud)
    }

    fn set_baud(&mut self, baud: u32) -> io::Result<()> {
        self.baud = baud;
        Ok(())
    }

    fn name(&self) -> String {
        format!("pty:{}", self.path.display())
    }
}
