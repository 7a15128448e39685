// The models' answers as numbers: draws a texel for each rest point. For the test that compares them with Rust's.
#include "sum.wgsl"

struct Probed {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) rest: vec2f,
}

// A rest point, and where its texel is in clip space.
@vertex
fn vertex_main(@location(0) point: vec4f) -> Probed {
    return Probed(vec4f(point.zw, 0.5, 1.0), point.xy);
}

// Displacement, and foam.
@fragment
fn displacement_main(in: Probed) -> @location(0) vec4f {
    let sum = sample_models(in.rest, no_filter());
    return vec4f(sum.displacement, sum.foam);
}

// Normal of unit length, and what foam leaves of reflections.
@fragment
fn normal_main(in: Probed) -> @location(0) vec4f {
    let sum = sample_models(in.rest, no_filter());
    return vec4f(normalize(normal_of(sum)), sum.gloss);
}
