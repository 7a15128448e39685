//! Pictures in memory, and how different two of them look.
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageFloat, FlipImageRgb8, FlipPool};
use std::path::Path;

/// sRGB pixels, rows from the top.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    pub size: [u32; 2],
    pub rgb: Vec<u8>,
}

/// FLIP (Andersson et al. 2020): 0 is the same to an observer at a desk, 1 as different as can be.
pub struct Difference {
    pub mean: f32,
    /// 99 % of the pixels differ less than this.
    pub high: f32,
    map: FlipImageFloat,
}

impl Picture {
    /// From a frame's RGBA bytes: `views` of `size` one after the other become one picture, side by side.
    pub fn from_frame(size: [u32; 2], views: u32, rgba: &[u8]) -> Self {
        let row = 4 * size[0] as usize;
        assert_eq!(rgba.len(), row * (size[1] * views) as usize);
        let mut rgb = Vec::with_capacity(rgba.len() / 4 * 3);
        for y in 0..size[1] {
            for view in 0..views {
                let start = (view * size[1] + y) as usize * row;
                rgb.extend(rgba[start..start + row].chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]));
            }
        }
        Self { size: [size[0] * views, size[1]], rgb }
    }

    /// The `index`-th of `count` parts beside each other.
    pub fn part(&self, index: u32, count: u32) -> Self {
        let width = self.size[0] / count;
        let [row, start, part] = [self.size[0], index * width, width].map(|pixels| 3 * pixels as usize);
        let rgb = self.rgb.chunks_exact(row).flat_map(|row| row[start..start + part].to_vec()).collect();
        Self { size: [width, self.size[1]], rgb }
    }

    pub fn load(path: &Path) -> Self {
        let image = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8();
        Self { size: image.dimensions().into(), rgb: image.into_raw() }
    }

    pub fn save(&self, path: &Path) {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        image::save_buffer(path, &self.rgb, self.size[0], self.size[1], image::ColorType::Rgb8).unwrap();
    }

    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let at = 3 * (y * self.size[0] + x) as usize;
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }

    /// How many different colours there are.
    pub fn colours(&self) -> usize {
        self.rgb.chunks_exact(3).collect::<std::collections::HashSet<_>>().len()
    }

    pub fn difference(&self, other: &Self) -> Difference {
        assert_eq!(self.size, other.size);
        let [a, b] = [self, other]
            .map(|picture| FlipImageRgb8::with_data(picture.size[0], picture.size[1], &picture.rgb));
        let map = nv_flip::flip(a, b, DEFAULT_PIXELS_PER_DEGREE);
        let mut pool = FlipPool::from_image(&map);
        Difference { mean: pool.mean(), high: pool.get_percentile(0.99, false), map }
    }
}

impl Difference {
    /// Bright where the pictures differ.
    pub fn picture(&self) -> Picture {
        let image = self.map.apply_color_lut(&nv_flip::magma_lut());
        // FLIP's images are BGR.
        Picture { size: [image.width(), image.height()], rgb: image.to_vec() }
    }
}
