//! A map of half-precision texels, read here and there.
use half::f16;

/// 2^112, what a half's exponent falls short of a single's.
pub const REBIAS: f32 = 5_192_296_858_534_827_628_530_496_329_220_096.0;

/// What a half's bits become in a single before it is multiplied by [`REBIAS`]: its sign, and 15 bits three places on.
pub const MOVED_HALF: u32 = 0x8fff_e000;

/// Texels of four 16-bit floats: a power of two of them, and one more, which is read only after the last of those.
#[derive(Clone, Copy, Debug)]
pub struct Texels<'a> {
    texels: &'a [[f16; 4]],
    /// The power of two less one.
    mask: u32,
}

impl<'a> Texels<'a> {
    /// Those of a map.
    ///
    /// # Panics
    /// When their number is not one more than a power of two, or that is greater than 2^31.
    pub const fn new(texels: &'a [[f16; 4]]) -> Self {
        let most = texels.len().wrapping_sub(1);
        assert!(most.is_power_of_two() && most <= 1 << 31, "one more than a power of two of texels");
        Self { texels, mask: (most - 1) as u32 }
    }

    /// The texel at `index` modulo the power of two.
    #[inline(always)]
    pub fn get(self, index: u32) -> [f16; 4] {
        self.texels[(index & self.mask) as usize]
    }

    /// That one and the one after it.
    #[inline(always)]
    pub(super) fn pair(self, index: u32) -> [[f16; 4]; 2] {
        let at = (index & self.mask) as usize;
        [self.texels[at], self.texels[at + 1]]
    }

    /// Where it is: 128 bits that may be read.
    #[inline(always)]
    pub(super) fn at(self, index: u32) -> *const [f16; 4] {
        // SAFETY: what is left of the index is less than the number of texels less one.
        unsafe { self.texels.as_ptr().add((index & self.mask) as usize) }
    }
}
