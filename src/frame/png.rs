//! Frames as PNG files.

use super::RgbdFrame;

impl RgbdFrame {
    /// The colour picture as a PNG file; empty when there is none.
    pub fn color_png(&self) -> Vec<u8> {
        rgb_png(self.width, self.height, &self.color)
    }

    /// The colour picture at half its size and in 16 steps a channel, so that many fit into one page.
    pub fn thumbnail_png(&self) -> Vec<u8> {
        const STEP: u32 = 17;
        let (width, height) = (self.width / 2, self.height / 2);
        if self.color.len() < self.width * self.height {
            return Vec::new();
        }
        let pixel = |i: usize| {
            let corner = 2 * (i / width) * self.width + 2 * (i % width);
            let four = [corner, corner + 1, corner + self.width, corner + self.width + 1].map(|at| self.color[at]);
            std::array::from_fn(|channel| {
                let mean = four.iter().map(|pixel| u32::from(pixel[channel])).sum::<u32>() / 4;
                ((mean + STEP / 2) / STEP * STEP) as u8
            })
        };
        let pixels: Vec<[u8; 3]> = (0..width * height).map(pixel).collect();
        // Equal neighbours of few colours pack better as they are than as differences: a third of the bytes.
        let how = (png::Compression::Balanced, png::Filter::NoFilter);
        encode(width, height, png::ColorType::Rgb, png::BitDepth::Eight, pixels.as_flattened(), Some(how))
    }

    /// The depth picture as a 16-bit grey PNG file, in the frame's units.
    pub fn depth_png(&self) -> Vec<u8> {
        grey_png(self.width, self.height, &self.depth)
    }
}

/// A colour PNG file.
pub fn rgb_png(width: usize, height: usize, pixels: &[[u8; 3]]) -> Vec<u8> {
    encode(width, height, png::ColorType::Rgb, png::BitDepth::Eight, pixels.as_flattened(), None)
}

/// A 16-bit grey PNG file: depth, or a mask of item ids.
pub fn grey_png(width: usize, height: usize, values: &[u16]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    encode(width, height, png::ColorType::Grayscale, png::BitDepth::Sixteen, &bytes, None)
}

/// How a picture is packed, where it is not the quick way.
type Packing = (png::Compression, png::Filter);

fn encode(
    width: usize,
    height: usize,
    color: png::ColorType,
    depth: png::BitDepth,
    data: &[u8],
    packing: Option<Packing>,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.set_compression(packing.map_or(png::Compression::Fast, |(compression, _)| compression));
    packing.iter().for_each(|(_, filter)| encoder.set_filter(*filter));
    // Writing to memory cannot fail; were it to, an empty file says so.
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(data));
    if written.is_err() {
        bytes.clear();
    }
    bytes
}
