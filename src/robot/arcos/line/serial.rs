//! A serial line, opened for us alone.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serialport::{ErrorKind, SerialPort, TTYPort};

use super::Line;

/// The rates of the robot, in the order in which they are tried.
pub const BAUD_RATES: [u32; 5] = [9600, 38400, 19200, 115_200, 57600];
/// A write that takes longer has failed.
const WRITE_WITHIN: Duration = Duration::from_millis(500);

/// A serial line.
pub struct SerialLine {
    device: PathBuf,
    /// The rate the user insists on.
    fixed: Option<u32>,
    baud: u32,
    port: Option<TTYPort>,
    /// The same device, opened before it was ours alone: for another process.
    second: Option<File>,
    opened: Instant,
}

impl SerialLine {
    /// Opens a device, 8N1, raw, without flow control, refusing to share it.
    ///
    /// # Errors
    /// When there is no such device, or someone else has it open.
    pub fn open(device: &Path, baud: Option<u32>) -> io::Result<Self> {
        let baud_now = baud.unwrap_or(BAUD_RATES[0]);
        let (second, port) = open_port(device, baud_now)?;
        let (device, opened) = (device.to_path_buf(), Instant::now());
        Ok(Self { device, fixed: baud, baud: baud_now, port: Some(port), second: Some(second), opened })
    }

    fn port(&mut self) -> io::Result<&mut TTYPort> {
        let gone = || io::Error::new(io::ErrorKind::NotConnected, "the line is not open");
        self.port.as_mut().ok_or_else(gone)
    }
}

fn open_port(device: &Path, baud: u32) -> io::Result<(File, TTYPort)> {
    // What the library says of a device it cannot open depends on its version: ask the system first.
    let second = std::fs::OpenOptions::new().read(true).write(true).open_nonblocking(device);
    let second = second.map_err(|error| explain(device, error))?;
    if !rustix::termios::isatty(&second) {
        let text = format!("no serial line ({})", present_devices());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
    }
    let name = device.to_string_lossy();
    let port = serialport::new(name, baud).timeout(WRITE_WITHIN).open_native().map_err(|error| match error.kind() {
        ErrorKind::Io(kind) => explain(device, io::Error::new(kind, error.description)),
        ErrorKind::NoDevice => busy(device, &error.description),
        _ => io::Error::other(error.description),
    })?;
    Ok((second, port))
}

trait OpenNonblocking {
    fn open_nonblocking(&mut self, device: &Path) -> io::Result<std::fs::File>;
}

impl OpenNonblocking for std::fs::OpenOptions {
    /// Without waiting for a carrier.
    fn open_nonblocking(&mut self, device: &Path) -> io::Result<std::fs::File> {
        use std::os::unix::fs::OpenOptionsExt;
        self.custom_flags((rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY).bits() as i32).open(device)
    }
}

/// What is wrong with a device, and what mends it.
fn explain(device: &Path, error: io::Error) -> io::Error {
    let text = match error.kind() {
        io::ErrorKind::PermissionDenied => {
            let group = std::fs::metadata(device).ok().and_then(|meta| group_name(meta.gid()));
            // Nobody should join root for a cable.
            match group.filter(|group| group != "root") {
                Some(group) => {
                    format!(
                        "no permission; its group is `{group}`: run `sudo usermod -aG {group} $USER` and log in again"
                    )
                }
                None => {
                    let device = device.display();
                    format!(
                        "no permission; it is root's alone: run `sudo chgrp dialout {device} && sudo chmod g+rw {device}`, then `sudo usermod -aG dialout $USER`, and log in again"
                    )
                }
            }
        }
        io::ErrorKind::NotFound => {
            format!("no such device; is the adapter plugged in? ({})", present_devices())
        }
        io::ErrorKind::ResourceBusy => return busy(device, "busy"),
        _ => error.to_string(),
    };
    io::Error::new(error.kind(), text)
}

fn busy(device: &Path, what: &str) -> io::Error {
    let text = match holder(device) {
        Some((process, name)) => format!("the line is held by {name} (process {process}); end it first"),
        None if device.exists() => {
            format!("{what}: another program may hold the line, see `fuser {}`", device.display())
        }
        None => return explain(device, io::ErrorKind::NotFound.into()),
    };
    io::Error::new(io::ErrorKind::ResourceBusy, text)
}

/// Another process that has the device open, and its name, by what /proc shows of it.
fn holder(device: &Path) -> Option<(u32, String)> {
    let device = std::fs::canonicalize(device).ok()?;
    let processes = std::fs::read_dir("/proc").ok()?.filter_map(Result::ok);
    let mut ids = processes.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    let id = ids.find(|id| *id != std::process::id() && holds(*id, &device))?;
    let name = std::fs::read_to_string(format!("/proc/{id}/comm")).unwrap_or_default();
    Some((id, name.trim().to_string()))
}

fn holds(process: u32, device: &Path) -> bool {
    let open = std::fs::read_dir(format!("/proc/{process}/fd")).into_iter().flatten().filter_map(Result::ok);
    open.filter_map(|entry| std::fs::read_link(entry.path()).ok()).any(|target| target == device)
}

fn group_name(id: u32) -> Option<String> {
    let groups = std::fs::read_to_string("/etc/group").ok()?;
    let fields = groups.lines().map(|line| line.split(':').collect::<Vec<_>>());
    fields.filter(|f| f.len() > 2).find(|f| f[2].parse() == Ok(id)).map(|f| f[0].to_string())
}

/// Which serial devices there are, for people.
fn present_devices() -> String {
    let present = serial_devices();
    if present.is_empty() {
        "no serial device is there".to_string()
    } else {
        format!("there is {}", present.join(", "))
    }
}

fn serial_devices() -> Vec<String> {
    let entries = std::fs::read_dir("/dev").into_iter().flatten().filter_map(Result::ok);
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let serial = |name: &String| ["ttyUSB", "ttyACM"].iter().any(|kind| name.starts_with(kind));
    let mut found: Vec<String> = names.filter(serial).map(|name| format!("/dev/{name}")).collect();
    found.sort();
    found
}

impl Line for SerialLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        let device = self.device.clone();
        let port = self.port()?;
        port.set_timeout(wait.max(Duration::from_millis(1)))?;
        match port.read(buffer) {
            Ok(0) => Err(io::Error::new(io::ErrorKind::BrokenPipe, "the adapter is gone")),
            Ok(count) => Ok(count),
            Err(error) if matches!(error.kind(), io::ErrorKind::TimedOut | io::ErrorKind::Interrupted) => Ok(0),
            Err(error) if !device.exists() => Err(io::Error::new(error.kind(), "the adapter was unplugged")),
            Err(error) => Err(error),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let port = self.port()?;
        port.set_timeout(WRITE_WITHIN)?;
        port.write_all(bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        // As long as anyone holds the device it stays closed to whoever opens it anew.
        (self.port, self.second) = (None, None);
        let (second, port) = open_port(&self.device, self.baud)?;
        (self.second, self.port) = (Some(second), Some(port));
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
        self.port()?.set_baud_rate(baud).map_err(io::Error::from)
    }

    fn baud_is_fixed(&self) -> bool {
        self.fixed.is_some()
    }

    fn share(&self) -> io::Result<OwnedFd> {
        self.second.as_ref().ok_or(io::ErrorKind::NotConnected)?.as_fd().try_clone_to_owned()
    }

    fn name(&self) -> String {
        format!("serial:{}", self.device.display())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_that_may_not_be_used_names_its_group_and_how_to_join_it() {
        let device = tempfile::NamedTempFile::new().expect("a file");
        let group = group_name(device.path().metadata().expect("there").gid()).expect("a group with a name");
        let error = explain(device.path(), io::ErrorKind::PermissionDenied.into());
        let text = match group.as_str() {
            "root" => "it is root's alone: run `sudo chgrp dialout".to_string(),
            group => format!("its group is `{group}`: run `sudo usermod -aG {group} $USER` and log in again"),
        };
        assert!(error.kind() == io::ErrorKind::PermissionDenied && error.to_string().contains(&text), "{error}");
    }

    #[test]
    fn what_is_no_serial_line_is_refused() {
        let error = SerialLine::open(Path::new("/dev/null"), None).err().expect("refused");
        assert!(error.to_string().contains("no serial line"), "{error}");
    }

    #[test]
    fn a_device_whose_group_cannot_be_told_is_taken_to_be_of_the_usual_one() {
        let error = explain(Path::new("no/such/device"), io::ErrorKind::PermissionDenied.into());
        assert!(error.to_string().contains("usermod -aG dialout"), "{error}");
    }
}
