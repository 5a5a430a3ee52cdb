//! Masks in PNG files: bright is inside.

use std::io::Cursor;
use std::path::Path;

use png::{ColorType, Transformations};

use super::raster::Raster;
use crate::limits::{PICTURE_FILE_BYTES, PICTURE_PIXELS};

/// Reads a mask; the message of an error names the file.
pub(super) fn read_mask(path: &Path, cell: f64) -> Result<Raster, String> {
    let named = |message: String| format!("{}: {message}", path.display());
    let bytes = PICTURE_FILE_BYTES.read(path).map_err(|error| named(error.to_string()))?;
    let (width, height, levels) = decode(&bytes).map_err(named)?;
    Raster::from_levels(width, height, levels, 255, cell).map_err(|error| named(error.to_string()))
}

fn decode(bytes: &[u8]) -> Result<(usize, usize, Vec<u8>), String> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let unreadable = |error: png::DecodingError| format!("not a readable PNG image: {error}");
    let header = decoder.read_header_info().map_err(unreadable)?;
    let (width, height) = (header.width as usize, header.height as usize);
    // Before memory is taken for it.
    PICTURE_PIXELS.check(width.saturating_mul(height)).map_err(|error| format!("{error}; scale the mask down"))?;
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let size = reader.output_buffer_size().ok_or("the image is too large for this machine")?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels).map_err(unreadable)?;
    let levels = pixels[..frame.buffer_size()].chunks_exact(frame.color_type.samples());
    Ok((width, height, levels.map(|pixel| brightness(pixel, frame.color_type)).collect()))
}

/// Brightness as ITU-R BT.601 weighs it, times opacity.
fn brightness(pixel: &[u8], color: ColorType) -> u8 {
    let luma = |rgb: &[u8]| (299 * u32::from(rgb[0]) + 587 * u32::from(rgb[1]) + 114 * u32::from(rgb[2]) + 500) / 1000;
    let faded = |level: u32, alpha: u8| ((level * u32::from(alpha) + 127) / 255) as u8;
    match color {
        ColorType::Grayscale | ColorType::Indexed => pixel[0],
        ColorType::GrayscaleAlpha => faded(u32::from(pixel[0]), pixel[1]),
        ColorType::Rgb => luma(pixel) as u8,
        ColorType::Rgba => faded(luma(pixel), pixel[3]),
    }
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    fn written(color: ColorType, pixels: &[u8]) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("mask.png");
        let mut encoder = png::Encoder::new(File::create(&path).expect("a file"), 2, 1);
        encoder.set_color(color);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(pixels)).expect("an image");
        (folder, path)
    }

    #[test]
    fn grey_and_colour_masks_read_as_brightness() {
        let (_folder, path) = written(ColorType::Grayscale, &[0, 51]);
        assert!((read_mask(&path, 1.0).expect("a mask").membership(1, 0) - 0.2).abs() < 1e-12);
        let (_folder, path) = written(ColorType::Rgba, &[255, 255, 255, 0, 255, 255, 255, 255]);
        let mask = read_mask(&path, 1.0).expect("a mask");
        assert_eq!((mask.membership(0, 0), mask.membership(1, 0)), (0.0, 1.0));
    }

    #[test]
    fn what_is_no_picture_is_named() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("notes.png");
        std::fs::write(&path, "no picture").expect("written");
        assert!(read_mask(&path, 1.0).expect_err("no picture").contains("notes.png: not a readable PNG image"));
        assert!(read_mask(&folder.path().join("missing.png"), 1.0).expect_err("missing").contains("missing.png: "));
    }
}
