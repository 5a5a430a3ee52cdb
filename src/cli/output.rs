//! Bytes out: standard output, or a file that appears whole or not at all.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, poll};
use rustix::time::Timespec;
use tempfile::NamedTempFile;

use super::{Common, Failure, Reporter, on_interrupt};
use crate::files;

/// How long an interrupt waits for a write: a reader that has stalled must not keep us alive.
const STUCK_AFTER: Duration = Duration::from_millis(500);

/// Where records go. Each write holds whole lines, so an interrupt between writes cuts none.
pub struct Sink {
    name: String,
    target: Target,
}

enum Target {
    Stream(Box<dyn Write + Send>),
    File { temporary: NamedTempFile, path: PathBuf, force: bool },
    Closed,
}

/// A sink that the interrupt handler can close.
#[derive(Clone)]
pub struct SharedSink(Arc<Mutex<Sink>>);

impl SharedSink {
    /// Writes whole lines and hands them on at once.
    ///
    /// # Errors
    /// When the output takes no more.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        self.with(|sink| sink.write(bytes))
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// When the file cannot be put in its place.
    pub fn finish(&self) -> Result<(), Failure> {
        self.with(Sink::finish)
    }

    /// Gives up: nothing half-written stays.
    pub fn discard(&self) {
        self.with(|sink| sink.target = Target::Closed);
    }

    /// Gives up when the process is told to stop: after the write that is under way, but without waiting for one
    /// that is stuck. The sink is not kept alive for that, so that it is also given up when a run ends early.
    /// What is then not there is said.
    pub fn discard_on_interrupt(&self, reporter: Reporter) {
        let sink = Arc::downgrade(&self.0);
        on_interrupt(move || {
            let Some(sink) = sink.upgrade() else { return };
            let give_up = Instant::now() + STUCK_AFTER;
            while Instant::now() < give_up {
                if let Ok(mut sink) = sink.try_lock() {
                    if matches!(sink.target, Target::File { .. }) {
                        reporter.fatal(&format!("interrupted: {} was not written", sink.name));
                    }
                    sink.target = Target::Closed;
                    return;
                }
                std::thread::sleep(Duration::from_millis(5));
            }
        });
    }

    fn with<T>(&self, act: impl FnOnce(&mut Sink) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Opens what `--output` names, or standard output.
///
/// # Errors
/// When the file exists and is not to be overwritten, or its folder cannot be written to.
pub fn open_output(common: &Common) -> Result<SharedSink, Failure> {
    let sink = match &common.output {
        None => Sink { name: "standard output".to_string(), target: Target::Stream(Box::new(io::stdout())) },
        Some(path) if is_standard_output(path) => {
            Sink { name: path.display().to_string(), target: Target::Stream(Box::new(io::stdout())) }
        }
        Some(path) => Sink { name: path.display().to_string(), target: open_file(path, common.force)? },
    };
    Ok(SharedSink(Arc::new(Mutex::new(sink))))
}

/// The names by which the system knows standard output, whatever it is: a file behind it is not to be replaced.
fn is_standard_output(path: &Path) -> bool {
    ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].iter().any(|name| path == Path::new(name))
}

/// Whether whoever read standard output has gone.
pub fn is_output_closed() -> bool {
    let out = io::stdout();
    let mut watched = [PollFd::new(&out, PollFlags::empty())];
    poll(&mut watched, Some(&Timespec::default())).is_ok() && watched[0].revents().contains(PollFlags::ERR)
}

fn open_file(path: &Path, force: bool) -> Result<Target, Failure> {
    let named = |e: io::Error| Failure::Failed(format!("{}: {e}", path.display()));
    match path.metadata() {
        // A device or a FIFO cannot be renamed onto.
        Ok(found) if !found.is_file() && !found.is_dir() => {
            let stream = OpenOptions::new().write(true).open(path).map_err(named)?;
            return Ok(Target::Stream(Box::new(stream)));
        }
        Ok(_) if !force => {
            return Err(Failure::Usage(format!("{} exists; name another file or give --force", path.display())));
        }
        _ => {}
    }
    Ok(Target::File { temporary: files::temporary_beside(path)?, path: path.to_path_buf(), force })
}

impl Sink {
    fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let written = match &mut self.target {
            Target::Stream(stream) => stream.write_all(bytes).and_then(|()| stream.flush()),
            Target::File { temporary, .. } => temporary.write_all(bytes),
            Target::Closed => Ok(()),
        };
        written.map_err(|error| Failure::writing(&self.name, &error))
    }

    fn finish(&mut self) -> Result<(), Failure> {
        let Target::File { temporary, path, force } = std::mem::replace(&mut self.target, Target::Closed) else {
            return Ok(());
        };
        Ok(files::persist(temporary, &path, force)?)
    }
}
