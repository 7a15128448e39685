//! A map of half-precision texels, read here and there.
use half::f16;

/// 2^112, what a half's exponent falls short of a single's.
pub const REBIAS: f32 = 5_192_296_858_534_827_628_530_496_329_220_096.0;

/// What a half's bits become in a single before it is multiplied by [`REBIAS`]: its sign, and 15 bits three places on.
pub const MOVED_HALF: u32 = 0x8fff_e000;

/// Texels of four 16-bit floats, a power of two of them.
#[derive(Clone, Copy, Debug)]
pub struct Texels<'a> {
    texels: &'a [[f16; 4]],
    /// Their number less one.
    mask: u32,
}

impl<'a> Texels<'a> {
    /// Those of a map.
    ///
    /// # Panics
    /// When their number is not a power of two, or greater than 2^31.
    pub const fn new(texels: &'a [[f16; 4]]) -> Self {
        assert!(texels.len().is_power_of_two() && texels.len() <= 1 << 31, "a power of two of texels");
        Self { texels, mask: (texels.len() - 1) as u32 }
    }

    /// The texel at `index` modulo their number.
    #[inline(always)]
    pub fn get(self, index: u32) -> [f16; 4] {
        self.texels[(index & self.mask) as usize]
    }

    /// Where it is: 64 bits that may be read.
    #[inline(always)]
    pub(super) fn at(self, index: u32) -> *const [f16; 4] {
        // SAFETY: what is left of the index is less than the number of texels.
        unsafe { self.texels.as_ptr().add((index & self.mask) as usize) }
    }
}
