//! Pictures as PNG (ISO/IEC 15948): 8 bits a channel, RGB, sRGB.
//!
//! A clip is written many times and read once, so speed matters more than size: fdeflate compresses. And a clip's
//! pictures allocate nothing once the first is written.

use fdeflate::Compressor;
use std::io::{self, Write};

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
/// Bytes of a pixel.
const PIXEL: usize = 3;
/// Rendering intent of the sRGB chunk: perceptual.
const PERCEPTUAL: u8 = 0;
/// Longest code of fdeflate, in bits, for one byte of data.
const LONGEST_CODE: usize = 12;

/// Writes pictures as PNG; its memory is used again for the next.
#[derive(Debug, Default)]
pub struct PngEncoder {
    /// RGB of the row above.
    above: Vec<u8>,
    /// RGB of the row.
    row: Vec<u8>,
    /// The row, filtered, after the number of its filter; the best so far and one more.
    filtered: [Vec<u8>; 2],
    file: Vec<u8>,
}

impl PngEncoder {
    /// The bytes of a file that shows sRGB pixels (RGBA, rows from the top, `views` pictures one after the other) side
    /// by side as one RGB picture.
    ///
    /// # Errors
    /// Fewer pixels than that; a picture that no PNG can hold.
    pub fn side_by_side(
        &mut self,
        [width, height]: [u32; 2],
        views: u32,
        pixels: &[u8],
    ) -> io::Result<&[u8]> {
        let row = 4 * width as usize;
        let line = PIXEL * (width * views) as usize;
        let Self { above, row: below, filtered, file } = self;
        above.clear();
        above.resize(line, 0);
        below.clear();
        below.reserve(line);
        for filtered in &mut *filtered {
            filtered.resize(line + 1, 0);
        }
        file.clear();
        // The most that there can be: a picture more colourful than all before must not make it grow.
        file.reserve((line + 1) * height as usize * LONGEST_CODE / 8 + 1024);
        file.extend(SIGNATURE);
        let [w, h] = [width * views, height].map(u32::to_be_bytes);
        // 8 bits, truecolour, and the only compression, filters and order of rows there are (not interlaced).
        let header = [w[0], w[1], w[2], w[3], h[0], h[1], h[2], h[3], 8, 2, 0, 0, 0];
        chunk(file, *b"IHDR", &header)?;
        chunk(file, *b"sRGB", &[PERCEPTUAL])?;
        filled_chunk(file, *b"IDAT", |file| {
            let mut compressor = Compressor::new(file)?;
            for y in 0..height as usize {
                below.clear();
                for view in 0..views as usize {
                    let start = (view * height as usize + y) * row;
                    let pixels = pixels.get(start..start + row).ok_or(io::ErrorKind::UnexpectedEof)?;
                    below.extend(pixels.chunks_exact(4).flat_map(|pixel| &pixel[..3]));
                }
                compressor.write_data(best_filtered(below, above, filtered))?;
                std::mem::swap(above, below);
            }
            compressor.finish().map(drop)
        })?;
        chunk(file, *b"IEND", &[])?;
        Ok(file)
    }
}

/// The row `below` the row `above`, as the filter leaves it that makes its bytes smallest in all, signs aside: the choice
/// that section 12.7 recommends. Filters are those of section 9.2.
fn best_filtered<'a>(below: &[u8], above: &[u8], filtered: &'a mut [Vec<u8>; 2]) -> &'a [u8] {
    let mut least = u64::MAX;
    let least = &mut least;
    try_filter(0, |_, _, _| 0, below, above, filtered, least);
    try_filter(1, |left, _, _| left, below, above, filtered, least);
    try_filter(2, |_, above, _| above, below, above, filtered, least);
    try_filter(3, |left, above, _| left.midpoint(above), below, above, filtered, least);
    try_filter(4, paeth, below, above, filtered, least);
    &filtered[0]
}

/// Filters a row with what `predict` expects of a byte from those to the left, above, and above that; keeps the result
/// where its sum is below the `least` so far. A function for each filter: only so are they vectors.
fn try_filter(
    number: u8,
    predict: impl Fn(u8, u8, u8) -> u8,
    below: &[u8],
    above: &[u8],
    [best, other]: &mut [Vec<u8>; 2],
    least: &mut u64,
) {
    other[0] = number;
    // To the left of the first pixel all is 0.
    for ((byte, &is), &above) in other[1..].iter_mut().zip(below).zip(above).take(PIXEL) {
        *byte = is.wrapping_sub(predict(0, above, 0));
    }
    let left = below.iter().zip(&below[PIXEL..]).zip(above.iter().zip(&above[PIXEL..]));
    for (byte, ((&left, &is), (&corner, &above))) in other[1 + PIXEL..].iter_mut().zip(left) {
        *byte = is.wrapping_sub(predict(left, above, corner));
    }
    let sum = other[1..].iter().map(|byte| u64::from(byte.cast_signed().unsigned_abs())).sum();
    if sum < *least {
        *least = sum;
        std::mem::swap(best, other);
    }
}

/// Section 9.4: whichever is nearest to left + above - corner.
fn paeth(left: u8, above: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, above, corner].map(i16::from);
    let [to_a, to_b, to_c] = [b - c, a - c, a + b - 2 * c].map(i16::abs);
    if to_a <= to_b && to_a <= to_c {
        left
    } else if to_b <= to_c {
        above
    } else {
        corner
    }
}

/// Appends a chunk to `file`: length, `name`, `content`, checksum.
fn chunk(file: &mut Vec<u8>, name: [u8; 4], content: &[u8]) -> io::Result<()> {
    filled_chunk(file, name, |file| file.write_all(content))
}

/// The same with what `fill` appends.
fn filled_chunk(
    file: &mut Vec<u8>,
    name: [u8; 4],
    fill: impl FnOnce(&mut Vec<u8>) -> io::Result<()>,
) -> io::Result<()> {
    let start = file.len();
    file.extend([0; 4]);
    file.extend(name);
    fill(file)?;
    let length =
        u32::try_from(file.len() - start - 8).ok().filter(|&length| length <= i32::MAX.cast_unsigned());
    let length = length.ok_or_else(|| io::Error::other("a picture of more than 2 GiB"))?;
    file[start..start + 4].copy_from_slice(&length.to_be_bytes());
    let checksum = crc32fast::hash(&file[start + 4..]);
    file.extend(checksum.to_be_bytes());
    Ok(())
}

/// Writes one picture as [`PngEncoder::side_by_side`] makes it.
///
/// # Errors
/// Those of `into`, and of the encoder.
pub fn write_side_by_side(
    into: &mut (impl Write + ?Sized),
    size: [u32; 2],
    views: u32,
    pixels: &[u8],
) -> io::Result<()> {
    into.write_all(PngEncoder::default().side_by_side(size, views, pixels)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What another decoder makes of it.
    fn decoded(file: &[u8]) -> image::RgbImage {
        image::load_from_memory_with_format(file, image::ImageFormat::Png).unwrap().into_rgb8()
    }

    #[test]
    fn pictures_come_back_as_they_were() {
        let mut encoder = PngEncoder::default();
        for ([width, height], views) in [([7_u32, 5_u32], 2_u32), ([64, 33], 1), ([1, 1], 1)] {
            let count = 4 * width * height * views;
            let pixels: Vec<u8> = (0..count).map(|i| (i.wrapping_mul(i) >> 3) as u8).collect();
            let picture = decoded(encoder.side_by_side([width, height], views, &pixels).unwrap());
            assert_eq!(picture.dimensions(), (width * views, height));
            for (x, y, image::Rgb(rgb)) in picture.enumerate_pixels() {
                let at = 4 * ((x / width * height + y) * width + x % width) as usize;
                assert_eq!(rgb[..], pixels[at..at + 3], "{x} {y}");
            }
        }
    }

    #[test]
    fn noise_does_not_outgrow_what_is_set_aside() {
        let mut encoder = PngEncoder::default();
        let grey = [128; 4 * 200 * 100];
        encoder.side_by_side([200, 100], 1, &grey).unwrap();
        let room = encoder.file.capacity();
        let mut state = 1_u32;
        let noise = grey.map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        });
        encoder.side_by_side([200, 100], 1, &noise).unwrap();
        assert_eq!(encoder.file.capacity(), room);
    }

    #[test]
    fn too_few_pixels_are_an_error() {
        assert!(PngEncoder::default().side_by_side([4, 4], 1, &[0; 63]).is_err());
    }
}
