// What every shader sees. Its Rust twin is src/draw/uniforms.rs; the build checks that the sizes agree.
// Positions are metres relative to the frame's origin, the snapped point near the eye that the CPU subtracts in f64.

override CASCADES: u32 = 4u;

struct Cascade {
    // Texture coordinates of the origin, half a texel included.
    offset: vec2f,
    // Cosine and sine of the cascade's rotation.
    axes: vec2f,
    // The same over L.
    axes_per_length: vec2f,
    // log2 of the distance at which vertices are a texel apart.
    log_reach: f32,
    unused: f32,
    // From a texel of the gradient map, 0 to 1, to the level part of the normal in the world, times the scene's detail:
    // twice the axes, and what 0.5 becomes, negated.
    twice_axes: vec2f,
    middle: vec2f,
}

// Of 128 bytes, so that what is found by a view's number is found by one shift.
struct View {
    // From positions relative to the origin to clip space.
    projection: mat4x4f,
    // Where it is, relative to the origin.
    eye: vec4f,
    // From tangents of angles to the right and up (x, y) to clip space: factors in xy, then summands in zw.
    scale: vec4f,
    unused: array<vec4f, 2>,
}

// The sun's map, of what stands highest on the way to the sun: shadows.wgsl.
struct SunMap {
    // u is along.xyz . position + along.w.
    along: vec4f,
    // v is across.x x + across.z z + across.w; depth is across.y y + reach.x.
    across: vec4f,
    // x: see above; y, z: shadows are there as far as y - z distance, 0 to 1; w: depth that light comes through water.
    reach: vec4f,
    // x, y: half a texel along u and v; z: a texel and a half.
    texels: vec4f,
}

struct Frame {
    views: array<View, 2>,
    // The same for the frame before, from positions relative to this frame's origin.
    previous_view_projection: array<mat4x4f, 2>,
    // From clip space (x, y, 0, 1) to a direction.
    clip_to_ray: array<mat4x4f, 2>,
    // The head: where level of detail is measured from, the same for both views.
    head: vec4f,
    cascades: array<Cascade, 4>,
    // xyz towards the sun; w: cosine of its disc's radius.
    sun: vec4f,
    // rgb: illuminance at right angles to the sun.
    sun_light: vec4f,
    // rgb: illuminance of the sea plane by the sky alone; w: the water's own squared roughness, as often as the sum
    // over cascades counts it too much.
    sky_light: vec4f,
    // rgb: diffuse reflectance of deep water over pi.
    deep: vec4f,
    // rgb: colour of light through crests times its strength over the sea's RMS height.
    scatter: vec4f,
    // rgb: albedo of foam over pi.
    foam: vec4f,
    // x, y: foam's range is y compression - x, from 0 where it begins to 1; z: repeats of the foam's pattern a patch of the first
    // cascade; w: 1 / (4 RMS heights).
    foam_range: vec4f,
    // x: 1 / metres over which waves fade at the quadtree's border; y: side of the quadtree; z, w: squares of the distances
    // between which the vertex spacing grows with distance.
    lod: vec4f,
    // x: halvings a metre of what the air lets through; z: finest sky mip for alpha 1.
    air: vec4f,
    // Factors of the tone map, exposure in them.
    tone: vec4f,
    // x, y: angles from a view's axis where the vignette begins and where it is complete, radians.
    vignette: vec4f,
    sun_map: SunMap,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var displacement_0: texture_2d<f32>;
@group(0) @binding(2) var displacement_1: texture_2d<f32>;
@group(0) @binding(3) var displacement_2: texture_2d<f32>;
@group(0) @binding(4) var displacement_3: texture_2d<f32>;
@group(0) @binding(5) var gradient_0: texture_2d<f32>;
@group(0) @binding(6) var gradient_1: texture_2d<f32>;
@group(0) @binding(7) var gradient_2: texture_2d<f32>;
@group(0) @binding(8) var gradient_3: texture_2d<f32>;
@group(0) @binding(9) var sky: texture_cube<f32>;
@group(0) @binding(10) var foam_pattern: texture_2d<f32>;
@group(0) @binding(11) var tiling: sampler;
@group(0) @binding(12) var clamped: sampler;
// Repeats, and keeps detail at grazing angles.
@group(0) @binding(13) var oblique: sampler;
// The maps of the frame before, for motion vectors. A cascade lies still in the world, so both are addressed alike.
@group(0) @binding(14) var previous_0: texture_2d<f32>;
@group(0) @binding(15) var previous_1: texture_2d<f32>;
@group(0) @binding(16) var previous_2: texture_2d<f32>;
@group(0) @binding(17) var previous_3: texture_2d<f32>;

// Clip space of a point. Depth is the near plane's distance over the point's own, with which the matrix has nothing to do.
fn to_clip(position: vec3f, view: u32) -> vec4f {
    let projection = frame.views[view].projection;
    let clip = projection * vec4f(position, 1.0);
    return vec4f(clip.xy, projection[3].z, clip.w);
}

// From a direction or position along a cascade's axes (u, v) to the world's (x, z); docs/conventions.md.
fn to_world(uv: vec2f, axes: vec2f) -> vec2f {
    return vec2f(uv.x * axes.x + uv.y * axes.y, uv.y * axes.x - uv.x * axes.y);
}

fn to_cascade(xz: vec2f, axes: vec2f) -> vec2f {
    return vec2f(xz.x * axes.x - xz.y * axes.y, xz.x * axes.y + xz.y * axes.x);
}

fn map_coordinates(xz: vec2f, cascade: u32) -> vec2f {
    let c = frame.cascades[cascade];
    return c.offset + to_cascade(xz, c.axes_per_length);
}
