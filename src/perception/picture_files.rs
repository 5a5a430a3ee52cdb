//! Pictures from files: depth as 16-bit PNG, colour as PNG or JPEG.

use std::io::Cursor;
use std::path::Path;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::frame_files::FrameError;

/// Pixels across and down, and the pixels row by row.
type Sized<T> = (usize, usize, Vec<T>);

/// Reads a depth picture, in units of the file.
pub fn load_depth(path: &Path) -> Result<Sized<u16>, FrameError> {
    let name = path.display().to_string();
    let (info, buffer) = decode_png(&read(path)?, png::Transformations::IDENTITY, &name)?;
    if info.color_type != png::ColorType::Grayscale || info.bit_depth != png::BitDepth::Sixteen {
        return Err(FrameError::NotDepth(name));
    }
    let values = buffer.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
    Ok((info.width as usize, info.height as usize, values))
}

/// Reads a colour picture.
pub fn load_color(path: &Path) -> Result<Sized<[u8; 3]>, FrameError> {
    let name = path.display().to_string();
    let bytes = read(path)?;
    if bytes.starts_with(b"\xff\xd8") {
        return decode_jpeg(bytes, &name);
    }
    let plain = png::Transformations::EXPAND | png::Transformations::STRIP_16;
    let (info, buffer) = decode_png(&bytes, plain, &name)?;
    let channels = info.color_type.samples();
    let pixel = |p: &[u8]| if channels < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
    Ok((info.width as usize, info.height as usize, buffer.chunks_exact(channels).map(pixel).collect()))
}

fn read(path: &Path) -> Result<Vec<u8>, FrameError> {
    std::fs::read(path).map_err(|e| FrameError::Unreadable(path.display().to_string(), e.to_string()))
}

fn decode_png(
    bytes: &[u8],
    transformations: png::Transformations,
    name: &str,
) -> Result<(png::OutputInfo, Vec<u8>), FrameError> {
    let unreadable = |e: String| FrameError::Unreadable(name.to_string(), e);
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(transformations);
    let mut reader = decoder.read_info().map_err(|e| unreadable(e.to_string()))?;
    let size = reader.output_buffer_size().ok_or_else(|| unreadable("the picture is too large".to_string()))?;
    let mut buffer = vec![0; size];
    let info = reader.next_frame(&mut buffer).map_err(|e| unreadable(e.to_string()))?;
    buffer.truncate(info.buffer_size());
    Ok((info, buffer))
}

fn decode_jpeg(bytes: Vec<u8>, name: &str) -> Result<Sized<[u8; 3]>, FrameError> {
    let unreadable = |e: String| FrameError::Unreadable(name.to_string(), e);
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let pixels = decoder.decode().map_err(|e| unreadable(e.to_string()))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| unreadable("a JPEG without a size".to_string()))?;
    Ok((width, height, pixels.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect()))
}
