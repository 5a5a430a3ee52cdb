//! The served robot on real lines, by the wall clock.

use std::io;
use std::net::TcpListener;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

use super::Server;
use crate::robot::arcos::line::{BAUD_RATES, Line, PtyLine, TcpLine};

/// How long the loop waits for bytes before it lets the simulation go on.
const WAIT: Duration = Duration::from_millis(5);

/// Where a simulated robot is served: `tcp:HOST:PORT` or `pty:PATH[@BAUD]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServeAddress {
    /// Listens there; one client at a time.
    Tcp(String),
    /// Makes a pseudo-terminal, with a symbolic link to it at this path, at this rate.
    Pty(PathBuf, u32),
}

impl FromStr for ServeAddress {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            Some(("tcp", host)) if host.contains(':') => Ok(Self::Tcp(host.to_string())),
            Some(("pty", path)) if !path.is_empty() => {
                let (path, baud) = path.rsplit_once('@').unwrap_or((path, "9600"));
                let known = baud.parse().ok().filter(|baud| BAUD_RATES.contains(baud));
                let baud =
                    known.ok_or(format!("`{baud}` is no rate of this robot (9600, 19200, 38400, 57600, 115200)"))?;
                Ok(Self::Pty(PathBuf::from(path), baud))
            }
            _ => Err(format!("`{text}` is nowhere to serve: it is tcp:127.0.0.1:8101 or pty:/tmp/p3dx[@38400]")),
        }
    }
}

/// Serves the robot until `goes_on` says no, which is asked every few milliseconds with the robot at hand.
pub fn serve(
    server: &mut Server,
    address: &ServeAddress,
    mut goes_on: impl FnMut(&mut Server) -> bool,
) -> io::Result<()> {
    match address {
        ServeAddress::Pty(path, baud) => {
            let mut line = PtyLine::create(path, *baud)?;
            while goes_on(server) {
                exchange(server, &mut line)?;
            }
        }
        ServeAddress::Tcp(host) => {
            let listener = TcpListener::bind(host)?;
            listener.set_nonblocking(true)?;
            serve_tcp(server, &listener, goes_on)?;
        }
    }
    Ok(())
}

/// A connection that breaks is a line that is silent: the robot's watchdog sees to it.
fn serve_tcp(
    server: &mut Server,
    listener: &TcpListener,
    mut goes_on: impl FnMut(&mut Server) -> bool,
) -> io::Result<()> {
    let began = Instant::now();
    let mut client: Option<TcpLine> = None;
    while goes_on(server) {
        // A newcomer takes the place of a client that has not said good-bye.
        match listener.accept() {
            Ok((stream, _)) => {
                stream.set_nonblocking(false)?;
                client = Some(TcpLine::accepted(stream, began)?);
            }
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
            Err(error) => return Err(error),
        }
        match &mut client {
            Some(line) => {
                if exchange(server, line).is_err() {
                    client = None;
                }
            }
            None => {
                std::thread::sleep(WAIT);
                server.advance_to(began.elapsed());
                server.take_output();
            }
        }
    }
    Ok(())
}

fn exchange(server: &mut Server, line: &mut dyn Line) -> io::Result<()> {
    let mut buffer = [0; 512];
    let count = line.read(&mut buffer, WAIT)?;
    server.advance_to(line.now());
    server.receive(&buffer[..count]);
    let output = server.take_output();
    if !output.is_empty() {
        line.write(&output)?;
    }
    if let Some(baud) = server.take_baud() {
        line.set_baud(baud)?;
    }
    Ok(())
}
