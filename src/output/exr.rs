//! Maps as OpenEXR images: 32-bit floats, uncompressed, so that all images of one shape have one length.
use exr::math::{RoundingMode, Vec2};
use exr::prelude::*;
use std::io::{self, Seek, Write};

/// Writes an image of `width` x `height` pixels with the channels R, G, B, row by row from the top.
///
/// # Errors
/// Those of `into`, and one unless `pixels` has `width * height` elements.
pub fn write_rgb(
    into: &mut (impl Write + Seek + ?Sized),
    [width, height]: [usize; 2],
    pixels: &[[f32; 3]],
) -> io::Result<()> {
    check_count(pixels.len(), width * height)?;
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = pixels[at.y() * width + at.x()];
        (r, g, b)
    });
    let layer = Layer::new((width, height), LayerAttributes::default(), Encoding::UNCOMPRESSED, channels);
    Image::from_layer(layer).write().non_parallel().to_buffered(into).map_err(io_error)
}

/// Writes a square image with its mip chain, in OpenEXR's own tiled mip-map form, with the channels R, G, B, A.
///
/// `levels` holds the levels one after the other: `size * size` pixels, then a quarter as many, down to one.
///
/// # Errors
/// Those of `into`, and one unless `levels` has as many elements as the chain of a power of two `size` has pixels.
pub fn write_rgba_mips(
    into: &mut (impl Write + Seek + ?Sized),
    size: usize,
    levels: &[[f32; 4]],
) -> io::Result<()> {
    let sides = || (0..=size.max(1).ilog2()).map(|level| size >> level);
    check_count(levels.len(), sides().map(|side| side * side).sum())?;
    let channel = |index: usize, name: &str| {
        let mut begin = 0;
        let level_data = sides().map(|side| {
            let level = &levels[begin..begin + side * side];
            begin += side * side;
            FlatSamples::F32(level.iter().map(|pixel| pixel[index]).collect())
        });
        let level_data = level_data.collect();
        AnyChannel::new(name, Levels::Mip { rounding_mode: RoundingMode::Down, level_data })
    };
    let list =
        ["R", "G", "B", "A"].into_iter().enumerate().map(|(index, name)| channel(index, name)).collect();
    // One tile a level: maps are read whole.
    let encoding = Encoding { blocks: Blocks::Tiles(Vec2(size, size)), ..Encoding::UNCOMPRESSED };
    let layer = Layer::new((size, size), LayerAttributes::default(), encoding, AnyChannels::sort(list));
    Image::from_layer(layer).write().non_parallel().to_buffered(into).map_err(io_error)
}

fn check_count(given: usize, wanted: usize) -> io::Result<()> {
    if given == wanted {
        return Ok(());
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, format!("{given} pixels given for an image of {wanted}")))
}

fn io_error(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn an_image_reads_back_as_it_was() {
        let pixels: Vec<[f32; 3]> = (0..12).map(|i| [i as f32, -0.5 * i as f32, 1e-6]).collect();
        let mut bytes = Cursor::new(Vec::new());
        write_rgb(&mut bytes, [4, 3], &pixels).unwrap();
        bytes.set_position(0);
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .rgb_channels(
                |size, _| vec![[0.0; 3]; size.area()],
                |read, at, (r, g, b): (f32, f32, f32)| read[at.y() * 4 + at.x()] = [r, g, b],
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(bytes)
            .unwrap();
        assert_eq!(image.layer_data.channel_data.pixels, pixels);
    }

    #[test]
    fn a_mip_chain_reads_back_level_by_level() {
        let pixels: Vec<[f32; 4]> = (0..21).map(|i| [i as f32, 100.0 + i as f32, 0.25, -1.0]).collect();
        let mut bytes = Cursor::new(Vec::new());
        write_rgba_mips(&mut bytes, 4, &pixels).unwrap();
        bytes.set_position(0);
        let image = read()
            .no_deep_data()
            .all_resolution_levels()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(bytes)
            .unwrap();
        let channels = &image.layer_data.channel_data.list;
        let names: Vec<_> = channels.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["A", "B", "G", "R"]);
        let red: Vec<f32> =
            channels[3].sample_data.levels_as_slice().iter().flat_map(FlatSamples::values_as_f32).collect();
        assert_eq!(red, (0..21).map(|i| i as f32).collect::<Vec<_>>());
        assert_eq!(channels[3].sample_data.levels_as_slice().len(), 3);
    }

    #[test]
    fn a_wrong_number_of_pixels_is_refused() {
        assert!(write_rgb(&mut Cursor::new(Vec::new()), [2, 2], &[[0.0; 3]; 3]).is_err());
        assert!(write_rgba_mips(&mut Cursor::new(Vec::new()), 4, &[[0.0; 4]; 16]).is_err());
    }
}
