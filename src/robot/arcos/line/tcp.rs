//! The same bytes over TCP: a serial-to-network bridge, or a simulator.

use std::io::{self, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::os::fd::OwnedFd;
use std::time::{Duration, Instant};

use super::Line;

/// A host that does not answer within this is not there.
const CONNECT_WITHIN: Duration = Duration::from_secs(5);
/// A write that takes longer has failed.
const WRITE_WITHIN: Duration = Duration::from_millis(500);

/// A TCP connection.
pub struct TcpLine {
    /// `HOST:PORT` to connect to again; none for a connection that was accepted.
    host: Option<String>,
    stream: Option<TcpStream>,
    opened: Instant,
}

impl TcpLine {
    /// Connects to `HOST:PORT`.
    ///
    /// # Errors
    /// When the host is not found or refuses.
    pub fn connect(host: &str) -> io::Result<Self> {
        Ok(Self { host: Some(host.to_string()), stream: Some(dial(host)?), opened: Instant::now() })
    }

    /// A connection someone made to us, on a clock that began at `opened`.
    ///
    /// # Errors
    /// When the connection cannot be set to the manners of a line.
    pub fn accepted(stream: TcpStream, opened: Instant) -> io::Result<Self> {
        Ok(Self { host: None, stream: Some(prepared(stream)?), opened })
    }

    fn stream(&mut self) -> io::Result<&mut TcpStream> {
        let gone = || io::Error::new(io::ErrorKind::NotConnected, "the connection is not open");
        self.stream.as_mut().ok_or_else(gone)
    }
}

fn dial(host: &str) -> io::Result<TcpStream> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "the host has no address");
    for address in host.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, CONNECT_WITHIN) {
            Ok(stream) => return prepared(stream),
            Err(error) if error.kind() == io::ErrorKind::ConnectionRefused => {
                let text = "nobody listens there; is the robot's bridge, or `drive --serve`, running?";
                last = io::Error::new(error.kind(), text);
            }
            Err(error) => last = error,
        }
    }
    Err(last)
}

fn prepared(stream: TcpStream) -> io::Result<TcpStream> {
    stream.set_nodelay(true)?;
    stream.set_write_timeout(Some(WRITE_WITHIN))?;
    Ok(stream)
}

impl Line for TcpLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        let stream = self.stream()?;
        stream.set_read_timeout(Some(wait.max(Duration::from_millis(1))))?;
        match stream.read(buffer) {
            Ok(0) => Err(io::Error::new(io::ErrorKind::BrokenPipe, "the other side has closed the connection")),
            Ok(count) => Ok(count),
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut | io::ErrorKind::Interrupted => Ok(0),
                _ => Err(error),
            },
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.stream()?.write_all(bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        self.stream = None;
        let host = self.host.as_deref().ok_or(io::ErrorKind::NotConnected)?;
        self.stream = Some(dial(host)?);
        Ok(())
    }

    fn now(&self) -> Duration {
        self.opened.elapsed()
    }

    fn share(&self) -> io::Result<OwnedFd> {
        let stream = self.stream.as_ref().ok_or(io::ErrorKind::NotConnected)?;
        Ok(stream.try_clone()?.into())
    }

    fn name(&self) -> String {
        format!("tcp:{}", self.host.as_deref().unwrap_or("client"))
    }
}
