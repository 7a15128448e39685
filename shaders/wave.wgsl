// One wave at a point, and what waves add up to there. Twins: src/sea/waves/wave.rs and sample.rs.
#include "models.wgsl"

const TAU: f32 = 6.2831853;

struct Sample {
    // Metres.
    displacement: vec3f,
    // Slopes dh/dx and dh/dz over the sea at rest.
    slope: vec2f,
    // Sideways: dDx/dx, dDx/dz (which is dDz/dx), dDz/dz.
    stretch: vec3f,
    // Variance of slopes that are finer than can be shown.
    lost: f32,
    // Foam cover, 0 to 1.
    foam: f32,
    // Share of reflections that foam leaves.
    gloss: f32,
}

// What cannot be shown: waves whose phase changes so much between neighbours.
struct Filter {
    // From a vertex or pixel to its neighbours, metres.
    along: vec2f,
    across: vec2f,
    // Square of the turns between neighbours at which a wave begins to fade, and one over how much more ends it.
    begin: f32,
    fade: f32,
}

// Shows everything.
fn no_filter() -> Filter {
    return Filter(vec2f(0.0), vec2f(0.0), 0.0, 1.0);
}

// For a mesh whose vertices are `spacing` apart: five a wave show it whole, two not at all.
fn mesh_filter(spacing: f32) -> Filter {
    return Filter(vec2f(spacing, 0.0), vec2f(0.0, spacing), 0.04, 1.0 / 0.21);
}

// For pixels: a wave of four has lost a twelfth, one of less than two nearly all.
fn pixel_filter(rest: vec2f) -> Filter {
    return Filter(dpdx(rest), dpdy(rest), 0.0, 1.0 / 0.36);
}

// A wave at a point.
struct Local {
    // Sine and cosine of its phase.
    sine: f32,
    cosine: f32,
    // Direction in which it grows, of unit length.
    along: vec2f,
    // Share that the filter keeps.
    kept: f32,
}

// Share that a filter keeps of a wave of number `k`, whose crests are `per_turn` times as fine, over a turn, as it is.
fn share(k: f32, along: vec2f, per_turn: f32, filtered: Filter) -> f32 {
    let steps = vec2f(dot(along, filtered.along), dot(along, filtered.across)) * (k * per_turn);
    let beyond = saturate((dot(steps, steps) - filtered.begin) * filtered.fade);
    return 1.0 - beyond * beyond * (3.0 - 2.0 * beyond);
}

fn local(phase: f32, along: vec2f, kept: f32) -> Local {
    // Between -pi and pi, beyond which devices need not be exact.
    let near = phase - TAU * round(phase / TAU);
    return Local(sin(near), cos(near), along, kept);
}

// Height and its derivative along the wave, metres and a slope, of a wave that moves water up and down alone.
fn add_height(sum: ptr<function, Sample>, at: Local, profile: vec2f) {
    (*sum).displacement.y += profile.x;
    (*sum).slope += at.along * profile.y;
}

// Normal of the displaced surface, of no particular length: binormal x tangent, both summed over all waves. Its y is
// the Jacobian, by which the surface is stretched.
fn normal_of(sum: Sample) -> vec3f {
    let tangent = vec3f(1.0 + sum.stretch.x, sum.slope.x, sum.stretch.y);
    let binormal = vec3f(sum.stretch.y, sum.slope.y, 1.0 + sum.stretch.z);
    return cross(binormal, tangent);
}
