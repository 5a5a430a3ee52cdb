//! Bytes that are no lines of text: what they are, and what makes lines of them.

/// How files of other kinds begin, and what mends each.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"\x1f\x8b", "this is gzip; unpack it first, as `gunzip -c FILE | chunk`"),
    (b"\x28\xb5\x2f\xfd", "this is zstd; unpack it first, as `zstd -dc FILE | chunk`"),
    (b"\xfd7zXZ", "this is xz; unpack it first, as `xz -dc FILE | chunk`"),
    (b"BZh", "this is bzip2; unpack it first, as `bzip2 -dc FILE | chunk`"),
    (b"PK\x03\x04", "this is a zip archive, or a spreadsheet; save what is in it as text, or as CSV for `chunk --csv`"),
    (b"%PDF", "this is a PDF; copy the text out of it"),
    (b"\x89MCAP", "this is an MCAP log; name it by --from"),
    (b"\xff\xfe", "this is UTF-16; convert it first, as `iconv -f UTF-16 -t UTF-8 FILE | chunk`"),
    (b"\xfe\xff", "this is UTF-16; convert it first, as `iconv -f UTF-16 -t UTF-8 FILE | chunk`"),
];

/// What is wrong with a line that is no text, and at which byte; `first` says that an input begins with it.
pub(super) fn foreign(bytes: &[u8], first: bool) -> Option<(usize, &'static str)> {
    let known = BEGINNINGS.iter().find(|(beginning, _)| first && bytes.starts_with(beginning));
    if let Some((_, mend)) = known {
        return Some((0, mend));
    }
    // Two letters of ASCII in UTF-16 are four bytes, of which two are zero.
    let zero = bytes.iter().position(|&byte| byte == 0)?;
    Some((zero, "a zero byte, as UTF-16 has them; convert the file, as `iconv -f UTF-16LE -t UTF-8 FILE | chunk`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packed_file_is_told_by_its_first_bytes_and_only_there() {
        assert!(foreign(b"\x1f\x8b\x08", true).is_some_and(|(_, mend)| mend.contains("gunzip")));
        assert_eq!(foreign(b"BZh is a sound", false), None);
        assert_eq!(foreign("the mug is on the table".as_bytes(), true), None);
    }

    #[test]
    fn utf_16_is_told_with_its_mark_and_without() {
        assert!(foreign(b"g\0o\0", true).is_some_and(|(at, mend)| at == 1 && mend.contains("UTF-16LE")));
        assert!(foreign(b"\xff\xfeg\0", true).is_some_and(|(at, _)| at == 0));
    }
}
