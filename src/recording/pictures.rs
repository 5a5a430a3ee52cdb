//! Pixels of recorded pictures: depth in millimetres, colour as red, green, blue.

use super::rvl::decode_rvl;
use super::sensed::Image;
use crate::frame::{Picture, decode_color, decode_depth};

/// Metres per unit of the depth that comes out.
pub(super) const DEPTH_UNIT_M: f64 = 0.001;

/// The header that ROS's compressed_depth_image_transport puts before the PNG, bytes.
const COMPRESSED_DEPTH_HEADER: usize = 12;

/// No depth camera sees farther, metres; and 16 bits of millimetres hold no more.
const FARTHEST_M: f32 = 65.5;

const PNG_MAGIC: &[u8] = b"\x89PNG";

/// Decodes a depth picture: 16UC1 in millimetres or 32FC1 in metres, raw or compressedDepth.
pub(super) fn depth(image: &Image) -> Result<Picture<u16>, String> {
    match image {
        Image::Raw { width, height, step, encoding, big_endian, data, .. } => {
            let size = (*width as usize, *height as usize, *step as usize);
            match encoding.to_ascii_lowercase().as_str() {
                "16uc1" | "mono16" => {
                    pixels(
                        size,
                        data,
                        |bytes: [u8; 2]| {
                            if *big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) }
                        },
                    )
                }
                "32fc1" => metres(&pixels(size, data, |bytes: [u8; 4]| {
                    if *big_endian { f32::from_be_bytes(bytes) } else { f32::from_le_bytes(bytes) }
                })?),
                other => Err(format!("depth encoding `{other}` is not read; 16UC1 and 32FC1 are")),
            }
        }
        Image::Compressed { format, data, .. } => {
            let format = format.to_ascii_lowercase();
            let float = format.starts_with("32fc1");
            let packed = if data.starts_with(PNG_MAGIC) {
                data.as_slice()
            } else {
                data.get(COMPRESSED_DEPTH_HEADER..).ok_or("a compressedDepth picture without its header")?
            };
            let mut picture = if packed.starts_with(PNG_MAGIC) {
                decode_depth(packed)?
            } else if format.contains("rvl") {
                decode_rvl(packed)?
            } else {
                return Err(format!("its packing `{format}` is not read; PNG and RVL are"));
            };
            if float {
                dequantize(&mut picture, data)?;
            }
            Ok(picture)
        }
    }
}

/// compressedDepth packs 32FC1 as inverse depth: z = a / (v − b), with a and b as floats in the header.
fn dequantize(picture: &mut Picture<u16>, data: &[u8]) -> Result<(), String> {
    let float = |at: usize| data.get(at..at + 4).and_then(|b| b.try_into().ok()).map(f32::from_le_bytes);
    let (Some(a), Some(b)) = (float(4), float(8)) else {
        return Err("a compressedDepth picture without its header".to_string());
    };
    for value in picture.pixels.iter_mut().filter(|value| **value != 0) {
        *value = millimetres(a / (f32::from(*value) - b));
    }
    Ok(())
}

/// Depths of floats in metres; an error when they are none.
fn metres(picture: &Picture<f32>) -> Result<Picture<u16>, String> {
    let given: Vec<f32> = picture.pixels.iter().copied().filter(|v| v.is_finite() && *v > 0.0).collect();
    let far = given.iter().filter(|value| **value > FARTHEST_M).count();
    if 2 * far > given.len() {
        return Err(format!(
            "most of its depths lie beyond {FARTHEST_M} m; perhaps the floats are millimetres: 32FC1 holds metres"
        ));
    }
    let pixels = picture.pixels.iter().map(|value| millimetres(*value)).collect();
    Ok(Picture { width: picture.width, height: picture.height, pixels })
}

/// What is no distance becomes 0, that is, nothing came back.
fn millimetres(metres: f32) -> u16 {
    let value = (f64::from(metres) / DEPTH_UNIT_M).round();
    if value.is_finite() && value > 0.0 && value <= f64::from(u16::MAX) { value as u16 } else { 0 }
}

/// Decodes a colour picture: rgb8, bgr8, rgba8, bgra8, mono8, raw; or jpeg, png.
pub(super) fn color(image: &Image) -> Result<Picture<[u8; 3]>, String> {
    let (width, height, step, encoding, data) = match image {
        Image::Raw { width, height, step, encoding, data, .. } => (width, height, step, encoding, data),
        // The format names what was compressed as well ("rgb8; jpeg compressed bgr8"); the decoder gives red, green, blue.
        Image::Compressed { data, format, .. } => {
            return decode_color(data).map_err(|error| format!("`{format}`: {error}; jpeg and png are read"));
        }
    };
    let size = (*width as usize, *height as usize, *step as usize);
    match encoding.to_ascii_lowercase().as_str() {
        "rgb8" | "8uc3" => pixels(size, data, |[r, g, b]: [u8; 3]| [r, g, b]),
        "bgr8" => pixels(size, data, |[b, g, r]: [u8; 3]| [r, g, b]),
        "rgba8" => pixels(size, data, |[r, g, b, _]: [u8; 4]| [r, g, b]),
        "bgra8" => pixels(size, data, |[b, g, r, _]: [u8; 4]| [r, g, b]),
        "mono8" | "8uc1" => pixels(size, data, |[v]: [u8; 1]| [v; 3]),
        other => {
            Err(format!("colour encoding `{other}` is not read; rgb8, bgr8, rgba8, bgra8, mono8, jpeg and png are"))
        }
    }
}

/// Row by row, whatever stands at the end of each.
fn pixels<const N: usize, T>(
    (width, height, step): (usize, usize, usize),
    data: &[u8],
    pixel: impl Fn([u8; N]) -> T,
) -> Result<Picture<T>, String> {
    let row = width.checked_mul(N).filter(|&row| row > 0 && row <= step).ok_or("a step shorter than a row")?;
    let needed = step.checked_mul(height).filter(|&needed| needed > 0 && needed <= data.len());
    if needed.is_none() {
        return Err(format!("{} bytes are too few for {width} × {height} pixels", data.len()));
    }
    let rows = data.chunks_exact(step).take(height);
    let pixels = rows.flat_map(|bytes| bytes[..row].as_chunks::<N>().0.iter().map(|&bytes| pixel(bytes))).collect();
    Ok(Picture { width, height, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::sensed::Header;

    fn raw(encoding: &str, width: u32, step: u32, data: &[u8]) -> Image {
        let header = Header { stamp_ns: 0, frame: String::new() };
        let (encoding, data) = (encoding.to_string(), data.to_vec());
        Image::Raw { header, width, height: 1, step, encoding, big_endian: false, data }
    }

    #[test]
    fn bgr_is_turned_and_padding_left_out() {
        let picture = color(&raw("bgr8", 1, 4, &[1, 2, 3, 99])).expect("decodes");
        assert_eq!(picture.pixels, [[3, 2, 1]]);
    }

    #[test]
    fn metres_become_millimetres_and_no_distance_zero() {
        let data: Vec<u8> = [1.2345_f32, f32::NAN, -1.0].iter().flat_map(|v| v.to_le_bytes()).collect();
        assert_eq!(depth(&raw("32FC1", 3, 12, &data)).expect("decodes").pixels, [1235, 0, 0]);
    }

    #[test]
    fn what_is_not_read_is_named() {
        assert!(color(&raw("yuv422", 1, 2, &[0, 0])).expect_err("unread").contains("`yuv422` is not read"));
    }
}
