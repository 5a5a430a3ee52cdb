//! Frames as PNG files.

use super::RgbdFrame;

impl RgbdFrame {
    /// The colour picture as a PNG file; empty when there is none.
    pub fn color_png(&self) -> Vec<u8> {
        rgb_png(self.width, self.height, &self.color)
    }

    /// The depth picture as a 16-bit grey PNG file, in the frame's units.
    pub fn depth_png(&self) -> Vec<u8> {
        grey_png(self.width, self.height, &self.depth)
    }
}

/// A colour PNG file.
pub fn rgb_png(width: usize, height: usize, pixels: &[[u8; 3]]) -> Vec<u8> {
    encode(width, height, png::ColorType::Rgb, png::BitDepth::Eight, pixels.as_flattened())
}

/// A 16-bit grey PNG file: depth, or a mask of item ids.
pub fn grey_png(width: usize, height: usize, values: &[u16]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    encode(width, height, png::ColorType::Grayscale, png::BitDepth::Sixteen, &bytes)
}

fn encode(width: usize, height: usize, color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.set_compression(png::Compression::Fast);
    // Writing to memory cannot fail; were it to, an empty file says so.
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(data));
    if written.is_err() {
        bytes.clear();
    }
    bytes
}
