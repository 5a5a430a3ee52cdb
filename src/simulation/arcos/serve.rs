//! The served robot on real lines, by the wall clock.

use std::fmt;
use std::io;
use std::net::TcpListener;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::{Duration, Instant};

use super::Server;
use crate::robot::arcos::codec::Packet;
use crate::robot::arcos::line::{BAUD_RATES, Line, PtyLine, TcpLine};

/// How long the loop waits for bytes before it lets the simulation go on.
const WAIT: Duration = Duration::from_millis(5);
/// Who sends more than this without beginning to synchronise is no client, bytes.
const MOST_BEFORE_SYNC: usize = 4096;

/// Where a simulated robot is served: `tcp:HOST:PORT` or `pty:PATH[@BAUD]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServeAddress {
    /// Listens there; one client at a time.
    Tcp(String),
    /// Makes a pseudo-terminal, with a symbolic link to it at this path, at this rate.
    Pty(PathBuf, u32),
}

impl fmt::Display for ServeAddress {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Tcp(host) => write!(f, "tcp:{host}"),
            Self::Pty(path, baud) => write!(f, "pty:{}@{baud}", path.display()),
        }
    }
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

/// A place where clients are listened to.
pub enum Place {
    /// A port.
    Tcp(TcpListener),
    /// A pseudo-terminal.
    Pty(PtyLine),
}

impl ServeAddress {
    /// Opens the place, so that clients find it.
    ///
    /// # Errors
    /// When the address cannot be listened at, or the link cannot be made.
    pub fn listen(&self) -> io::Result<Place> {
        Ok(match self {
            Self::Pty(path, baud) => Place::Pty(PtyLine::create(path, *baud)?),
            Self::Tcp(host) => {
                let listener = TcpListener::bind(host)?;
                listener.set_nonblocking(true)?;
                Place::Tcp(listener)
            }
        })
    }
}

/// Serves the robot at `address` until `goes_on` says no, which is asked every few milliseconds with the robot at hand.
///
/// # Errors
/// When the address cannot be listened at, or the line fails.
pub fn serve(server: &mut Server, address: &ServeAddress, goes_on: impl FnMut(&mut Server) -> bool) -> io::Result<()> {
    serve_at(server, address.listen()?, goes_on)
}

/// The same at a place that is open already.
///
/// # Errors
/// When the line fails.
pub fn serve_at(server: &mut Server, place: Place, mut goes_on: impl FnMut(&mut Server) -> bool) -> io::Result<()> {
    match place {
        Place::Pty(mut line) => {
            while goes_on(server) {
                exchange(server, &mut line)?;
            }
        }
        Place::Tcp(listener) => {
            let mut clients = Clients { listener, began: Instant::now(), served: None, waiting: Vec::new() };
            while goes_on(server) {
                clients.exchange(server)?;
            }
        }
    }
    Ok(())
}

/// Who is connected: one is served, and who begins to synchronise takes its place.
struct Clients {
    listener: TcpListener,
    began: Instant,
    served: Option<TcpLine>,
    /// Connected, with what they have sent so far.
    waiting: Vec<(TcpLine, Vec<u8>)>,
}

impl Clients {
    fn exchange(&mut self, server: &mut Server) -> io::Result<()> {
        match self.listener.accept() {
            Ok((stream, _)) => {
                stream.set_nonblocking(false)?;
                self.waiting.push((TcpLine::accepted(stream, self.began)?, Vec::new()));
            }
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
            Err(error) => return Err(error),
        }
        self.hand_over(server);
        let Some(line) = &mut self.served else {
            std::thread::sleep(WAIT);
            server.advance_to(self.began.elapsed());
            server.take_output();
            return Ok(());
        };
        if exchange(server, line).is_err() {
            // The end of a connection is the end of its session.
            self.served = None;
            server.hang_up("the connection has ended");
        }
        Ok(())
    }

    /// Hears those who wait. A connection alone takes the robot from nobody: its first number does.
    fn hand_over(&mut self, server: &mut Server) {
        let mut buffer = [0; 512];
        self.waiting.retain_mut(|(line, sent)| match line.read(&mut buffer, Duration::ZERO) {
            Ok(count) => {
                sent.extend_from_slice(&buffer[..count]);
                sent.len() <= MOST_BEFORE_SYNC
            }
            Err(_) => false,
        });
        let sync = Packet::new(0, Vec::new()).to_bytes();
        let next = self.waiting.iter().position(|(_, sent)| sent.windows(sync.len()).any(|window| window == sync));
        if let Some(next) = next {
            let (line, sent) = self.waiting.remove(next);
            if self.served.replace(line).is_some() {
                server.hang_up("another client takes over");
            }
            server.receive(&sent);
        }
    }
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
