//! Pictures from the bytes of PNG and JPEG files.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, OutputInfo, Transformations};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

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

/// Decodes a colour picture, PNG or JPEG; grey becomes red = green = blue. An error says what is wrong.
pub fn decode_color(bytes: &[u8]) -> Result<Picture<[u8; 3]>, String> {
    if bytes.starts_with(b"\xff\xd8") {
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
pub fn decode_depth(bytes: &[u8]) -> Result<Picture<u16>, String> {
    let (info, buffer) = decode_png(bytes, Transformations::IDENTITY)?;
    if info.color_type != ColorType::Grayscale || info.bit_depth != BitDepth::Sixteen {
        return Err("not a 16-bit grey PNG; depth must keep its millimetres".to_string());
    }
    let pixels = buffer.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
    Ok(Picture { width: info.width as usize, height: info.height as usize, pixels })
}

fn decode_png(bytes: &[u8], transformations: Transformations) -> Result<(OutputInfo, Vec<u8>), String> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(transformations);
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().ok_or("the picture is too large")?;
    let mut buffer = vec![0; size];
    let info = reader.next_frame(&mut buffer).map_err(|e| e.to_string())?;
    buffer.truncate(info.buffer_size());
    Ok((info, buffer))
}

fn decode_jpeg(bytes: &[u8]) -> Result<Picture<[u8; 3]>, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let buffer = decoder.decode().map_err(|e| format!("{e:?}"))?;
    let info = decoder.info().ok_or("a JPEG without a header")?;
    let pixels = buffer.as_chunks::<3>().0.to_vec();
    Ok(Picture { width: usize::from(info.width), height: usize::from(info.height), pixels })
}
