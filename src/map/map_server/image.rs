//! The image of a `map_server` pair: how bright each pixel is.
//!
//! PGM in both forms (P5 and P2), by the netpbm manual, and PNG. Other
//! readers of PGM lose the largest value, on which every level depends, or
//! take a first pixel that looks like a space for one.

use std::io::Cursor;

use png::{ColorType, Decoder, Transformations};

use crate::limits::MAP_CELLS;

/// The brightness that map savers write where nothing is known.
pub(super) const UNKNOWN: f32 = 205.0 / 255.0;

/// Pixels row by row from the top left.
#[derive(Debug, PartialEq)]
pub(super) struct Image {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Pixel>,
}

/// One pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pixel {
    /// Share of full brightness.
    pub bright: f32,
    /// Share of full opacity.
    pub opaque: f32,
}

impl Image {
    /// Decodes a PGM or PNG file.
    ///
    /// # Errors
    /// When the bytes are neither PGM nor PNG, or fewer than their head promises.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        match bytes {
            [b'P', b'5', ..] => pgm(bytes, true),
            [b'P', b'2', ..] => pgm(bytes, false),
            [0x89, b'P', b'N', b'G', ..] => decode_png(bytes),
            [b'P', b'6' | b'3', ..] => Err("it has colours; save it as grey levels (PGM or PNG)".to_string()),
            _ => Err("neither a PGM nor a PNG; save it as one of them".to_string()),
        }
    }
}

fn require_few(width: usize, height: usize) -> Result<usize, String> {
    let cells = width.saturating_mul(height);
    if cells == 0 {
        return Err(format!("{width} × {height} cells are no map"));
    }
    MAP_CELLS.check(cells).map_err(|error| format!("{width} × {height}: {error}; scale the map down"))?;
    Ok(cells)
}

/// The words of a PGM's head, comments left out.
struct Words<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl Words<'_> {
    fn number(&mut self, what: &str) -> Result<usize, String> {
        loop {
            match self.bytes.get(self.at) {
                Some(b'#') => {
                    let line = self.bytes[self.at..].iter().position(|&b| b == b'\n' || b == b'\r');
                    self.at = line.map_or(self.bytes.len(), |end| self.at + end);
                }
                Some(byte) if byte.is_ascii_whitespace() || *byte == 0x0b => self.at += 1,
                _ => break,
            }
        }
        let digits = self.bytes[self.at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let text = &self.bytes[self.at..self.at + digits];
        self.at += digits;
        let number = str::from_utf8(text).ok().and_then(|text| text.parse().ok());
        number.ok_or_else(|| format!("not a PGM that can be read: no {what} at byte {}", self.at + 1))
    }
}

fn pgm(bytes: &[u8], binary: bool) -> Result<Image, String> {
    let mut words = Words { bytes, at: 2 };
    let (width, height, most) = (words.number("width")?, words.number("height")?, words.number("largest value")?);
    let cells = require_few(width, height)?;
    if !(1..=65535).contains(&most) {
        return Err(format!("a largest value of {most}; a PGM has 1 to 65535"));
    }
    // The level that stands for "unknown" is that of 205 of 255, as near as the levels of this file come to it.
    let unknown = if most < 100 { usize::MAX } else { (205 * most + 127) / 255 };
    let share = |level: usize| if level == unknown { UNKNOWN } else { level.min(most) as f32 / most as f32 };
    let pixel = |level: usize| Pixel { bright: share(level), opaque: 1.0 };
    let pixels: Vec<Pixel> = if binary {
        // One white space stands between the head and the pixels; the next may be a pixel.
        let data = bytes.get(words.at + 1..).unwrap_or_default();
        if most < 256 {
            data.iter().take(cells).map(|&level| pixel(level.into())).collect()
        } else {
            let pairs = data.as_chunks::<2>().0.iter().take(cells);
            pairs.map(|&pair| pixel(u16::from_be_bytes(pair).into())).collect()
        }
    } else {
        (0..cells).map(|_| words.number("pixel").map(pixel)).collect::<Result<_, _>>()?
    };
    if pixels.len() < cells {
        return Err(format!("the image is cut off: {} of {width} × {height} pixels are there", pixels.len()));
    }
    Ok(Image { width, height, pixels })
}

fn decode_png(bytes: &[u8]) -> Result<Image, String> {
    let unreadable = |error: png::DecodingError| format!("not a PNG that can be read: {error}");
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let header = decoder.read_header_info().map_err(unreadable)?;
    let (width, height) = (header.width as usize, header.height as usize);
    require_few(width, height)?;
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let mut buffer = vec![0; reader.output_buffer_size().ok_or("the image is too large")?];
    let frame = reader.next_frame(&mut buffer).map_err(unreadable)?;
    let share = |level: f32| level / 255.0;
    let mean = |rgb: &[u8]| share(rgb.iter().map(|&v| f32::from(v)).sum::<f32>() / rgb.len() as f32);
    let pixel = |p: &[u8]| match frame.color_type {
        ColorType::GrayscaleAlpha | ColorType::Rgba => {
            let (alpha, color) = p.split_last().unwrap_or((&255, &[0]));
            Pixel { bright: mean(color), opaque: share(f32::from(*alpha)) }
        }
        _ => Pixel { bright: mean(p), opaque: 1.0 },
    };
    let pixels = buffer[..frame.buffer_size()].chunks_exact(frame.color_type.samples()).map(pixel).collect();
    Ok(Image { width, height, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brightness(bytes: &[u8]) -> Vec<f32> {
        Image::decode(bytes).expect("an image").pixels.iter().map(|pixel| pixel.bright).collect()
    }

    #[test]
    fn levels_are_shares_of_the_largest_value_the_file_names() {
        assert_eq!(brightness(b"P5 3 1 100\n\x00\x32\x64"), [0.0, 0.5, 1.0]);
        assert_eq!(brightness(b"P2\n# by hand\n3 1\n# comment\n4\n0 2 4"), [0.0, 0.5, 1.0]);
        assert_eq!(brightness(b"P5 1 1 65535\n\xff\xff"), [1.0]);
        assert_eq!(brightness(b"P5 1 1 1\n\x01"), [1.0]);
    }

    #[test]
    fn a_first_pixel_that_is_a_space_is_a_pixel() {
        assert_eq!(brightness(b"P5 2 1 100\n\x20\x0a"), [0.32, 0.1]);
    }

    #[test]
    fn an_image_that_is_cut_large_or_coloured_is_refused_by_name() {
        let error = |bytes: &[u8]| Image::decode(bytes).expect_err("no map");
        assert!(error(b"P5 2 2 255\n\x00\x00\x00").contains("3 of 2 \u{d7} 2 pixels"));
        assert!(error(b"P5 99999 99999 255\n").contains("cells are more than the 16777216"));
        assert!(error(b"P5 0 9 255\n").contains("0 \u{d7} 9 cells are no map"));
        assert!(error(b"P5 99999999999999999999 1 255\n").contains("no width at byte"));
        assert!(error(b"P5 1 1 0\n\0").contains("a largest value of 0"));
        assert!(error(b"P6 1 1 255\n\0\0\0").contains("colours"));
        assert!(error(b"GIF89a").contains("neither a PGM nor a PNG"));
    }

    #[test]
    fn a_png_is_read_with_its_opacity() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(ColorType::GrayscaleAlpha);
        encoder.write_header().and_then(|mut w| w.write_image_data(&[255, 255, 0, 0])).expect("written");
        let pixels = [Pixel { bright: 1.0, opaque: 1.0 }, Pixel { bright: 0.0, opaque: 0.0 }];
        assert_eq!(Image::decode(&bytes).expect("an image").pixels, pixels);
    }
}
