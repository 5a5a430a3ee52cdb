//! Pictures from the bytes of PNG and JPEG files.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, Limits, OutputInfo, Transformations};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::limits::PICTURE_PIXELS;

/// A picture: pixels across and down, and the pixels row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<T> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Row by row.
    pub pixels: Vec<T>,
}

/// Pixels across and down, as the head of a PNG or JPEG file tells them, before memory is taken for any.
///
/// # Errors
/// When the head cannot be read, or tells of no pixels or more than [`PICTURE_PIXELS`].
pub fn picture_size(bytes: &[u8]) -> Result<(usize, usize), String> {
    let (width, height) = if is_jpeg(bytes) {
        jpeg_decoder(bytes)?.dimensions().ok_or("a JPEG without a size")?
    } else {
        let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: PICTURE_PIXELS.count() });
        let head = decoder.read_header_info().map_err(|e| e.to_string())?;
        (head.width as usize, head.height as usize)
    };
    if width == 0 || height == 0 {
        return Err(format!("a picture of {width} × {height} pixels"));
    }
    PICTURE_PIXELS.check(width.saturating_mul(height)).map_err(|error| format!("{width} × {height}: {error}"))?;
    Ok((width, height))
}

/// Decodes a colour picture, PNG or JPEG; grey becomes red = green = blue.
///
/// # Errors
/// When it is too large, cut, or damaged in any way that shows; the message says what is wrong.
pub fn decode_color(bytes: &[u8]) -> Result<Picture<[u8; 3]>, String> {
    if is_jpeg(bytes) {
        return decode_jpeg(bytes);
    }
    let plain = Transformations::EXPAND | Transformations::STRIP_16;
    let (info, buffer) = decode_png(bytes, plain)?;
    let channels = info.color_type.samples();
    let pixel = |p: &[u8]| if channels < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
    let pixels = buffer.chunks_exact(channels).map(pixel).collect();
    Ok(Picture { width: info.width as usize, height: info.height as usize, pixels })
}

/// Decodes a depth picture: 16-bit grey PNG, in units of the file.
///
/// # Errors
/// When it is something else, too large, cut or damaged; the message says what is wrong.
pub fn decode_depth(bytes: &[u8]) -> Result<Picture<u16>, String> {
    let (info, buffer) = decode_png(bytes, Transformations::IDENTITY)?;
    if info.color_type != ColorType::Grayscale || info.bit_depth != BitDepth::Sixteen {
        return Err("not a 16-bit grey PNG; depth must keep its millimetres".to_string());
    }
    let pixels = buffer.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
    Ok(Picture { width: info.width as usize, height: info.height as usize, pixels })
}

fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xd8")
}

/// What a decoder may hold beside the pixels that come out: palettes, profiles, a row or two.
const BESIDE_BYTES: usize = 1 << 24;

fn decode_png(bytes: &[u8], transformations: Transformations) -> Result<(OutputInfo, Vec<u8>), String> {
    picture_size(bytes)?;
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: BESIDE_BYTES });
    decoder.set_transformations(transformations);
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().ok_or("the picture is too large")?;
    let mut buffer = vec![0; size];
    let info = reader.next_frame(&mut buffer).map_err(|e| e.to_string())?;
    buffer.truncate(info.buffer_size());
    Ok((info, buffer))
}

/// A decoder that has read the head. It is strict: half a picture with grey below is worse than none.
fn jpeg_decoder(bytes: &[u8]) -> Result<JpegDecoder<ZCursor<&[u8]>>, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|e| format!("{e:?}"))?;
    Ok(decoder)
}

fn decode_jpeg(bytes: &[u8]) -> Result<Picture<[u8; 3]>, String> {
    let (width, height) = picture_size(bytes)?;
    let end = jpeg_end(bytes).ok_or("a JPEG without its end: it is cut off")?;
    let open = is_of_one_scan(bytes).then(|| [&bytes[..end], &[0; READ_AHEAD]].concat());
    let buffer = jpeg_decoder(open.as_deref().unwrap_or(bytes))?.decode();
    let buffer = buffer.map_err(|e| format!("a damaged JPEG: {e:?}"))?;
    let pixels = buffer.as_chunks::<3>().0.to_vec();
    if pixels.len() != width * height {
        return Err(format!("a JPEG of {width} × {height} with {} pixels", pixels.len()));
    }
    Ok(Picture { width, height, pixels })
}

/// How far the decoder reads ahead, bytes.
const READ_AHEAD: usize = 16;

/// Where the marker of a JPEG's end stands behind its last scan; cameras may write bytes behind it, and a thumbnail in
/// the head has an end of its own.
fn jpeg_end(bytes: &[u8]) -> Option<usize> {
    let last_scan = bytes.windows(2).rposition(|pair| pair == b"\xff\xda").unwrap_or(0);
    bytes[last_scan..].windows(2).position(|pair| pair == b"\xff\xd9").map(|at| last_scan + at)
}

/// Whether a JPEG is a baseline one of a single scan, as cameras write them.
///
/// Behind the end's marker the decoder makes up grey for pixels that are missing. Without the marker it says that the
/// data are exhausted; but only where one scan holds everything does it do without.
fn is_of_one_scan(bytes: &[u8]) -> bool {
    let has = |marker: &[u8; 2]| bytes.windows(2).any(|pair| pair == marker);
    bytes.windows(2).filter(|pair| pair == b"\xff\xda").count() == 1 && has(b"\xff\xc0") && !has(b"\xff\xc2")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A JPEG of 16 × 16 pixels, red above and blue below.
    const SMALL: &[u8] = include_bytes!("../../fixtures/hostile/small.jpg");

    /// The file with another size in its frame header.
    fn claiming(width: u16, height: u16) -> Vec<u8> {
        let mut bytes = SMALL.to_vec();
        let frame = bytes.windows(2).position(|pair| pair == b"\xff\xc0").expect("a frame header");
        bytes[frame + 5..frame + 7].copy_from_slice(&height.to_be_bytes());
        bytes[frame + 7..frame + 9].copy_from_slice(&width.to_be_bytes());
        bytes
    }

    fn png_claiming(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = crate::frame::rgb_png(1, 1, &[[1, 2, 3]]);
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        let sum = crc32fast::hash(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&sum.to_be_bytes());
        bytes
    }

    #[test]
    fn a_sound_jpeg_is_read() {
        let picture = decode_color(SMALL).expect("sound");
        assert_eq!((picture.width, picture.height, picture.pixels.len()), (16, 16, 256));
        assert!(picture.pixels[0][0] > 200 && picture.pixels[255][2] > 200);
        let mut longer = SMALL.to_vec();
        longer.extend(b"what some cameras write behind the end");
        assert_eq!(decode_color(&longer), Ok(picture));
    }

    #[test]
    fn a_jpeg_cut_off_anywhere_is_refused() {
        for length in 2..SMALL.len() - 1 {
            assert!(decode_color(&SMALL[..length]).is_err(), "{length} of {} bytes", SMALL.len());
        }
    }

    #[test]
    fn a_jpeg_that_ends_before_its_last_pixel_is_refused() {
        // 64 × 48 pixels of noise, so that each takes bytes.
        let noise = include_bytes!("../../fixtures/hostile/noise.jpg");
        assert!(decode_color(noise).is_ok());
        let scan = noise.windows(2).position(|pair| pair == b"\xff\xda").expect("a scan") + 14;
        for share in 1..8 {
            let mut bytes = noise.to_vec();
            bytes.drain(scan + (noise.len() - scan) * share / 8..noise.len() - 2);
            assert!(decode_color(&bytes).is_err(), "{share} of 8");
        }
    }

    #[test]
    fn a_picture_that_claims_too_many_pixels_is_refused_by_its_head() {
        for bytes in [claiming(16383, 16383), png_claiming(20_000, 20_000)] {
            let error = decode_color(&bytes).expect_err("too large");
            assert!(error.contains("pixels are more than the 16777216"), "{error}");
            assert_eq!(picture_size(&bytes), Err(error));
        }
        assert_eq!(picture_size(&png_claiming(640, 480)), Ok((640, 480)));
        assert!(decode_color(&claiming(0, 16)).is_err() && decode_color(&png_claiming(0, 0)).is_err());
    }
}
