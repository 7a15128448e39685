//! Pictures as PNG.

use std::io::{self, Write};

/// Writes sRGB pixels (RGBA, rows from the top, `views` pictures one after the other) side by side as one RGB picture.
///
/// # Errors
/// Those of `into`.
pub fn write_side_by_side(
    into: &mut (impl Write + ?Sized),
    [width, height]: [u32; 2],
    views: u32,
    pixels: &[u8],
) -> io::Result<()> {
    let mut encoder = png::Encoder::new(into, width * views, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // A clip is written many times and read once: speed matters more than size.
    encoder.set_compression(png::Compression::Fast);
    let row = 4 * width as usize;
    let mut rgb = Vec::with_capacity(3 * (width * views * height) as usize);
    for y in 0..height as usize {
        for view in 0..views as usize {
            let start = (view * height as usize + y) * row;
            let line = pixels.get(start..start + row).ok_or(io::ErrorKind::UnexpectedEof)?;
            rgb.extend(line.chunks_exact(4).flat_map(|pixel| &pixel[..3]));
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    Ok(writer.finish()?)
}
