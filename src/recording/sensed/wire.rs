//! The two ways ROS writes a message down: CDR (ROS 2) and ROS 1's own.
//!
//! ROS 2 (OMG CDR, XTypes 1.3 §7.4): a 4-byte encapsulation header, then each
//! primitive aligned to its size, counted from byte 4; strings end in a zero
//! byte that counts. ROS 1: no header, no alignment, no zero byte, always
//! little endian.

/// Why the bytes of a message make no sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum WireError {
    #[error("the message ends too early")]
    Short,
    #[error("its CDR representation is not plain CDR")]
    Representation,
}

/// A cursor over the bytes of one message.
pub(super) struct Wire<'a> {
    bytes: &'a [u8],
    at: usize,
    /// CDR, aligned and with zero-terminated strings; else ROS 1.
    cdr: bool,
    big_endian: bool,
}

impl<'a> Wire<'a> {
    pub(super) fn ros1(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, cdr: false, big_endian: false }
    }

    pub(super) fn cdr(bytes: &'a [u8]) -> Result<Self, WireError> {
        match bytes {
            [0, kind @ (0 | 1), _, _, rest @ ..] => Ok(Self { bytes: rest, at: 0, cdr: true, big_endian: *kind == 0 }),
            [_, _, _, _, ..] => Err(WireError::Representation),
            _ => Err(WireError::Short),
        }
    }

    pub(super) fn is_ros1(&self) -> bool {
        !self.cdr
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], WireError> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len()).ok_or(WireError::Short)?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    fn primitive<const N: usize>(&mut self) -> Result<[u8; N], WireError> {
        if self.cdr {
            self.at = self.at.next_multiple_of(N);
        }
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N)?);
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    pub(super) fn u8(&mut self) -> Result<u8, WireError> {
        Ok(self.primitive::<1>()?[0])
    }

    pub(super) fn u32(&mut self) -> Result<u32, WireError> {
        Ok(u32::from_le_bytes(self.primitive()?))
    }

    pub(super) fn f64(&mut self) -> Result<f64, WireError> {
        Ok(f64::from_le_bytes(self.primitive()?))
    }

    pub(super) fn f64s<const N: usize>(&mut self) -> Result<[f64; N], WireError> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64()?;
        }
        Ok(values)
    }

    /// A sequence of bytes, or the bytes of a string.
    pub(super) fn bytes(&mut self) -> Result<&'a [u8], WireError> {
        let length = self.u32()? as usize;
        self.take(length)
    }

    pub(super) fn string(&mut self) -> Result<String, WireError> {
        let bytes = self.bytes()?;
        let text = if self.cdr { bytes.strip_suffix(b"\0").unwrap_or(bytes) } else { bytes };
        Ok(String::from_utf8_lossy(text).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cdr_aligns_from_the_byte_after_its_header() {
        // A byte, three of padding, then 7 as u32, padding to 8, then 1.0.
        let bytes = [&[0, 1, 0, 0, 9, 0, 0, 0, 7, 0, 0, 0][..], &1.0_f64.to_le_bytes()].concat();
        let mut wire = Wire::cdr(&bytes).expect("plain CDR");
        assert_eq!((wire.u8(), wire.u32(), wire.f64()), (Ok(9), Ok(7), Ok(1.0)));
        assert_eq!(wire.u8(), Err(WireError::Short));
    }

    #[test]
    fn a_length_beyond_the_message_is_an_error() {
        assert_eq!(Wire::ros1(&[255, 255, 255, 255, 1]).bytes(), Err(WireError::Short));
    }
}
