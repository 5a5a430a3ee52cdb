//! RVL, the packing of depth by its changes (A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017).

use crate::frame::Picture;

/// Columns and rows come before the packed pixels, bytes.
const SIZES: usize = 8;
/// More pixels than any depth camera has are damage.
const MOST_PIXELS: usize = 1 << 26;

/// Nibbles of a stream of 32-bit words, the highest first.
struct Nibbles<'a> {
    words: &'a [u8],
    word: u32,
    left: u32,
}

impl Nibbles<'_> {
    fn next(&mut self) -> Option<u32> {
        if self.left == 0 {
            let (word, rest) = self.words.split_first_chunk::<4>()?;
            (self.word, self.words, self.left) = (u32::from_le_bytes(*word), rest, 8);
        }
        let nibble = self.word >> 28;
        self.word <<= 4;
        self.left -= 1;
        Some(nibble)
    }

    /// Three bits a nibble, the lowest first; the fourth says that more come.
    fn number(&mut self) -> Option<u32> {
        let mut value = 0;
        for shift in (0..32).step_by(3) {
            let nibble = self.next()?;
            value |= (nibble & 7) << shift;
            if nibble & 8 == 0 {
                return Some(value);
            }
        }
        None
    }
}

/// Unpacks a picture: columns, rows, then runs of zeros and of changes. An error says what is wrong.
pub(super) fn decode_rvl(data: &[u8]) -> Result<Picture<u16>, String> {
    let size = |at: usize| data.get(at..at + 4).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize);
    let (Some(width), Some(height)) = (size(0), size(4)) else { return Err("an RVL picture without its size".into()) };
    let pixels = width.checked_mul(height).filter(|count| (1..=MOST_PIXELS).contains(count));
    let count = pixels.ok_or_else(|| format!("an RVL picture of {width} × {height} pixels"))?;
    let mut nibbles = Nibbles { words: &data[SIZES..], word: 0, left: 0 };
    let pixels = runs(&mut nibbles, count).ok_or("an RVL picture that ends too early")?;
    Ok(Picture { width, height, pixels })
}

fn runs(nibbles: &mut Nibbles, count: usize) -> Option<Vec<u16>> {
    let mut pixels: Vec<u16> = Vec::new();
    let mut previous = 0_i32;
    while pixels.len() < count {
        let left = count - pixels.len();
        let zeros = nibbles.number()? as usize;
        pixels.resize(pixels.len() + zeros.min(left), 0);
        let left = count - pixels.len();
        let changes = nibbles.number()? as usize;
        for _ in 0..changes.min(left) {
            let packed = nibbles.number()?;
            let change = (packed >> 1) as i32 ^ -((packed & 1) as i32);
            previous = previous.wrapping_add(change);
            pixels.push(previous as u16);
        }
        if zeros == 0 && changes == 0 {
            return None;
        }
    }
    Some(pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Packs as the paper's code does.
    fn packed(width: u32, height: u32, pixels: &[u16]) -> Vec<u8> {
        let mut nibbles: Vec<u32> = Vec::new();
        let mut number = |mut value: u32| {
            loop {
                let more = u32::from(value > 7) << 3;
                nibbles.push(value & 7 | more);
                value >>= 3;
                if more == 0 {
                    break;
                }
            }
        };
        let (mut at, mut previous) = (0, 0_i32);
        while at < pixels.len() {
            let run = |from: usize, zero: bool| pixels[from..].iter().take_while(|p| (**p == 0) == zero).count();
            let zeros = run(at, true);
            let changes = run(at + zeros, false);
            number(zeros as u32);
            number(changes as u32);
            for pixel in &pixels[at + zeros..at + zeros + changes] {
                let change = i32::from(*pixel) - previous;
                number(((change << 1) ^ (change >> 31)) as u32);
                previous = i32::from(*pixel);
            }
            at += zeros + changes;
        }
        let words = nibbles.chunks(8).map(|word| (0..8).fold(0, |sum, i| sum << 4 | word.get(i).unwrap_or(&0)));
        let head = [width.to_le_bytes(), height.to_le_bytes()].concat();
        head.into_iter().chain(words.flat_map(u32::to_le_bytes)).collect()
    }

    #[test]
    fn what_is_packed_comes_back() {
        let pixels = [0, 0, 1500, 1502, 1490, 0, 65_535, 1, 0, 0, 0, 800];
        assert_eq!(decode_rvl(&packed(4, 3, &pixels)).expect("whole").pixels, pixels);
    }

    #[test]
    fn a_picture_that_is_cut_or_of_an_impossible_size_is_refused() {
        let whole = packed(4, 1, &[1000, 2000, 3000, 4000]);
        assert!(decode_rvl(&whole[..12]).is_err() && decode_rvl(&whole[..3]).is_err());
        assert!(decode_rvl(&[255; 32]).expect_err("too large").contains("pixels"));
    }
}
