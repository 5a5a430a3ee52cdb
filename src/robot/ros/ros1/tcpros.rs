//! TCPROS: the head of a connection, and messages with their length before them.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::net::TcpStream;

/// The longest head, bytes; definitions of messages are in it.
const LONGEST_HEAD: usize = 1 << 20;
/// The longest message, bytes: a cloud of a laser scanner takes a tenth of it.
pub const LONGEST: usize = 64 << 20;

/// What the two sides tell each other before the first message.
pub type Head = BTreeMap<String, String>;

fn bad(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what.to_string())
}

/// Sends the head of a connection.
///
/// # Errors
/// When the connection fails.
pub fn send_head(mut stream: &TcpStream, fields: &[(&str, &str)]) -> io::Result<()> {
    let mut head = Vec::new();
    for (name, value) in fields {
        head.extend(((name.len() + 1 + value.len()) as u32).to_le_bytes());
        head.extend(format!("{name}={value}").bytes());
    }
    let length = (head.len() as u32).to_le_bytes();
    stream.write_all(&[length.as_slice(), &head].concat())
}

/// Reads the head of a connection.
///
/// # Errors
/// When it is none, or the connection fails.
pub fn read_head(stream: &TcpStream) -> io::Result<Head> {
    let bytes = read_block(stream, LONGEST_HEAD, || true)?;
    let mut rest = bytes.as_slice();
    let mut head = Head::new();
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_le_bytes(*length) as usize;
        let (field, after) = after.split_at_checked(length).ok_or(bad("a head that is cut off"))?;
        let field = String::from_utf8_lossy(field);
        let (name, value) = field.split_once('=').ok_or(bad("a head without `=`"))?;
        head.insert(name.to_string(), value.to_string());
        rest = after;
    }
    Ok(head)
}

/// Reads a length and so many bytes, for as long as `goes_on` says so each time the connection's time-out passes.
///
/// # Errors
/// When the length is more than `most`, the connection ends, or nothing more is wanted.
pub fn read_block(stream: &TcpStream, most: usize, goes_on: impl Fn() -> bool) -> io::Result<Vec<u8>> {
    let mut length = [0; 4];
    read_all(stream, &mut length, &goes_on)?;
    let length = u32::from_le_bytes(length) as usize;
    if length > most {
        return Err(bad(&format!(
            "a message of {length} bytes is announced: more than {most}, or the wrong endianness"
        )));
    }
    // No more is set aside than comes.
    let mut bytes = Vec::new();
    while bytes.len() < length {
        let from = bytes.len();
        bytes.resize(length.min(from + (1 << 20)), 0);
        read_all(stream, &mut bytes[from..], &goes_on)?;
    }
    Ok(bytes)
}

fn read_all(mut stream: &TcpStream, mut rest: &mut [u8], goes_on: &impl Fn() -> bool) -> io::Result<()> {
    while !rest.is_empty() {
        match stream.read(rest) {
            Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(count) => rest = &mut rest[count..],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) && goes_on() => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
