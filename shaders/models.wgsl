// Waves that are formulas, as numbers. Rust twins: sea::waves::ModelsUniform, and draw::waves for what is added to it here.
// What a wave of each kind is, is in the file of its name, beside a twin in src/sea/waves.

const MAX_MODELS: u32 = 4u;
const MAX_WAVES: u32 = 96u;

// Kinds of waves; rings have 4 more.
const SINE: u32 = 0u;
const PEAKED: u32 = 1u;
const EXP_SINE: u32 = 2u;
const GERSTNER: u32 = 3u;
const RING: u32 = 4u;
const PEAKED_RING: u32 = 5u;
// The lean of a model without foam.
const NO_FOAM: u32 = 2u;

struct Wave {
    // Unit direction (x, z); of rings from the centre to the frame's origin, metres.
    along: vec2f,
    // Radians a metre.
    k: f32,
    // At the origin now, radians.
    phase: f32,
    // Metres up, and sideways.
    amplitude: f32,
    horizontal: f32,
    sharpness: f32,
    kind: u32,
}

struct Model {
    first: u32,
    count: u32,
    // 0 foam on upright normals, 1 on leaning ones.
    lean: u32,
    per_max_height: f32,
    range: vec2f,
    height_amount: f32,
    height_falloff: f32,
    angle_amount: f32,
    angle_falloff: f32,
    // Least and greatest share of reflections that foam takes.
    reflection: vec2f,
}

// What drawing wants of a wave besides.
struct Fineness {
    // Phase in the frame before, less that of now, as both are at the origin; radians.
    before: f32,
    // Mean height, metres: what is left where the wave is finer than can be shown.
    mean: f32,
    // Variance of its slope.
    variance: f32,
    // How many times as fine as its wavelength its crests are, over TAU.
    per_turn: f32,
}

struct Waves {
    count: u32,
    waves_count: u32,
    unused: vec2u,
    models: array<Model, MAX_MODELS>,
    waves: array<Wave, MAX_WAVES>,
    fineness: array<Fineness, MAX_WAVES>,
    // x: metres between vertices for each metre from the head; y: factor on slopes; z: the water's own squared roughness
    // where no cascade has it; w: repeats of the foam's pattern a metre.
    scale: vec4f,
    // x, y: where the origin is in the foam's pattern.
    pattern: vec4f,
    // For Blinn-Phong. x: exponent of the highlight; y: its strength; z: the mirrored sun's size, 1 - cosine; w: its falloff.
    look: vec4f,
    // rgb: colour that is mirrored where the sun is not, over pi; w: 1 where the sky's cube is instead.
    ambient: vec4f,
    // x: the water's own squared roughness.
    own: vec4f,
}

@group(0) @binding(18) var<uniform> waves: Waves;
