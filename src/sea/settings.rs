//! What a sea is made from: checked, resolved parameters, in SI units and radians.

/// Which statistical description of a wind sea the amplitudes follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spectrum {
    /// "VR Ocean" eqs (3)-(5), as printed: `amplitude` scales it, its height is not calibrated.
    Phillips,
    /// Hasselmann et al. 1973: a sea still growing over a finite fetch.
    Jonswap,
    /// Bouws et al. 1985: JONSWAP in water of finite depth.
    Tma,
}

/// Which normal the gradient map holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalKind {
    /// Cross product of the displaced surface's full tangents.
    Exact,
    /// "VR Ocean" eq (47): the normal of the undisplaced height sheet.
    Sheet,
}

/// Foam that appears where the surface is squeezed together and fades afterwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamSettings {
    /// Compression 1 - J, summed over cascades, at which foam begins.
    pub threshold: f64,
    /// Further compression, above `threshold`, at which foam is whole.
    pub width: f64,
    /// Seconds in which a compression of 1 fades to nothing; 0 keeps no memory.
    pub fade_time: f64,
}

/// One periodic patch of sea carrying one band of wave numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct CascadeSettings {
    /// Grid points along each side, N: a power of two in 16..=512.
    pub resolution: usize,
    /// Side of the periodic patch, L, metres.
    pub patch_size: f64,
    /// Angle of the cascade's own axes, radians counter-clockwise seen from above (see `docs/conventions.md`).
    pub rotation: f64,
    /// Wave numbers carried, rad/m, half open: `band[0] <= k < band[1]`.
    pub band: [f64; 2],
    /// N of eq (5)'s normalisation: the sea's own resolution, so that bands of different N still join.
    pub reference_resolution: usize,
    /// The spectrum's shape.
    pub spectrum: Spectrum,
    /// Wind speed, m/s; 0 gives a flat sea.
    pub wind_speed: f64,
    /// Direction the wind blows towards, radians from +X counter-clockwise seen from above (pi/2 is -Z).
    pub wind_direction: f64,
    /// Alpha of eqs (6)-(9), 0 (all directions) ..= 1 (with the wind).
    pub alignment: f64,
    /// Lambda of eq (25), scales the horizontal displacement.
    pub choppiness: f64,
    /// Beta of eq (11), 0 (none) ..= 1 (everything below a quarter of the patch).
    pub small_wave_suppression: f64,
    /// Roughness of the water itself at scales below the map, 0..=1, eq (49).
    pub roughness: f64,
    /// Factor on every displacement.
    pub amplitude: f64,
    /// Distance over which the wind has blown, metres (JONSWAP, TMA).
    pub fetch: f64,
    /// JONSWAP's gamma, 1 (Pierson-Moskowitz shape) ..= 7.
    pub peak_enhancement: f64,
    /// Water depth, metres (TMA).
    pub depth: f64,
    /// Seed of the Gaussian numbers.
    pub seed: u64,
}

/// A whole sea: cascades with disjoint bands whose displacements add up.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaSettings {
    /// One or more (at most [`MAX_CASCADES`]), by descending patch size.
    pub cascades: Vec<CascadeSettings>,
    /// Acceleration of gravity, m/s^2.
    pub gravity: f64,
    /// T of eq (16), seconds: the animation closes after it.
    pub repeat_period: f64,
    /// Foam.
    pub foam: FoamSettings,
    /// Normals of the gradient map.
    pub normals: NormalKind,
}

/// The renderer binds one pair of maps for each, so their number is fixed.
pub const MAX_CASCADES: usize = 4;
