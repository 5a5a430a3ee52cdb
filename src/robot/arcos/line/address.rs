//! Where a robot is: one form for every kind of line.

use std::fmt;
use std::io;
use std::path::PathBuf;
use std::str::FromStr;

use super::{BAUD_RATES, Line, SerialLine, TcpLine};

/// `sim`, `serial:DEVICE[@BAUD]` or `tcp:HOST:PORT`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The simulated robot, in this process.
    #[default]
    Sim,
    /// A serial device; without a rate, all of the robot's are tried.
    Serial {
        /// Such as `/dev/ttyUSB0`.
        device: PathBuf,
        /// Bits a second.
        baud: Option<u32>,
    },
    /// The same bytes over TCP.
    Tcp(String),
}

/// An address that cannot be one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{address}` is no robot's address: {why}; it is sim, serial:/dev/ttyUSB0, serial:/dev/ttyUSB0@38400 or tcp:HOST:8101"
)]
pub struct AddressError {
    address: String,
    why: String,
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let error = |why: &str| AddressError { address: text.to_string(), why: why.to_string() };
        match text.split_once(':') {
            None if text == "sim" => Ok(Self::Sim),
            Some(("serial", rest)) => serial(rest).map_err(|why| error(&why)),
            Some(("tcp", rest)) => match rest.rsplit_once(':') {
                Some((host, port)) if !host.is_empty() && port.parse::<u16>().is_ok_and(|port| port > 0) => {
                    Ok(Self::Tcp(rest.to_string()))
                }
                _ => Err(error("after tcp: comes HOST:PORT")),
            },
            _ => Err(error("it begins with none of the three kinds")),
        }
    }
}

fn serial(rest: &str) -> Result<Address, String> {
    let (device, baud) = match rest.rsplit_once('@') {
        None => (rest, None),
        Some((device, baud)) => {
            let known = baud.parse().ok().filter(|baud| BAUD_RATES.contains(baud));
            let wrong = || format!("`{baud}` is no rate of this robot (9600, 19200, 38400, 57600, 115200)");
            (device, Some(known.ok_or_else(wrong)?))
        }
    };
    if device.is_empty() {
        return Err("after serial: comes the device".to_string());
    }
    Ok(Address::Serial { device: PathBuf::from(device), baud })
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sim => write!(f, "sim"),
            Self::Serial { device, baud: None } => write!(f, "serial:{}", device.display()),
            Self::Serial { device, baud: Some(baud) } => write!(f, "serial:{}@{baud}", device.display()),
            Self::Tcp(host) => write!(f, "tcp:{host}"),
        }
    }
}

impl Address {
    /// Opens the line there; nothing for the simulated robot, which has none.
    ///
    /// # Errors
    /// When the device or host cannot be opened.
    pub fn open(&self) -> io::Result<Option<Box<dyn Line + Send>>> {
        Ok(match self {
            Self::Sim => None,
            Self::Serial { device, baud } => Some(Box::new(SerialLine::open(device, *baud)?)),
            Self::Tcp(host) => Some(Box::new(TcpLine::connect(host)?)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_is_read_and_printed_alike() {
        for text in ["sim", "serial:/dev/ttyUSB0", "serial:/dev/ttyS0@38400", "tcp:robot.local:8101", "tcp:[::1]:8101"]
        {
            assert_eq!(text.parse::<Address>().map(|address| address.to_string()), Ok(text.to_string()));
        }
    }

    #[test]
    fn what_is_no_address_says_what_one_is() {
        for (text, why) in [
            ("ttyUSB0", "none of the three kinds"),
            ("serial:", "comes the device"),
            ("serial:/dev/ttyUSB0@31337", "no rate of this robot"),
            ("tcp:localhost", "HOST:PORT"),
            ("tcp:localhost:99999", "HOST:PORT"),
        ] {
            let error = text.parse::<Address>().expect_err(text).to_string();
            assert!(error.contains(why) && error.contains("serial:/dev/ttyUSB0@38400"), "{error}");
        }
    }
}
