// The displaced surface of a sea whose waves are formulas, or a spectral one with such waves added: in the place of
// waves.wgsl.
#include "maps.wgsl"
#include "sum.wgsl"

struct Varyings {
    @builtin(position) clip: vec4f,
    // As in waves.wgsl.
    @location(0) maps_01: vec4f,
    @location(4) maps_23: vec4f,
    @location(5) pattern: vec2f,
    @location(1) from_eye: vec3f,
    @location(2) height: f32,
    @location(3) @interpolate(flat) level: f32,
    // Where the water is when the sea is at rest.
    @location(6) rest: vec2f,
}

struct Surface {
    // As in waves.wgsl, of everything.
    tilt: vec2f,
    alpha_squared: f32,
    compression: f32,
    // Foam of the formulas, 0 to 1, and what it leaves of reflections.
    foam: f32,
    gloss: f32,
}

// Varyings where shadows fall: without the level, and with the place on the sun's map.
struct Shadowed {
    @builtin(position) clip: vec4f,
    @location(0) maps_01: vec4f,
    @location(4) maps_23: vec4f,
    @location(5) pattern: vec2f,
    @location(1) from_eye: vec3f,
    @location(2) height: f32,
    @location(3) on_map: vec3f,
    @location(6) rest: vec2f,
}

fn shadowed(in: Varyings, on_map: vec3f) -> Shadowed {
    return Shadowed(in.clip, in.maps_01, in.maps_23, in.pattern, in.from_eye, in.height, on_map, in.rest);
}

fn seen_shadowed(in: Shadowed) -> Varyings {
    return Varyings(in.clip, in.maps_01, in.maps_23, in.pattern, in.from_eye, in.height, 0.0, in.rest);
}

fn seen_from(position: vec3f, rest: vec2f, view: u32) -> Varyings {
    var out: Varyings;
    out.maps_01 = places_01(rest);
    out.maps_23 = places_23(rest);
    out.clip = to_clip(position, view);
    out.pattern = rest * waves.scale.w + waves.pattern.xy;
    out.from_eye = position - frame.views[view].eye.xyz;
    out.height = position.y;
    out.rest = rest;
    return out;
}

// What the mesh can carry of the formulas.
fn carried(rest: vec2f, before: f32, log_distance: f32) -> vec3f {
    return displacement_of_models(rest, before, mesh_filter(exp2(log_distance) * waves.scale.x));
}

fn displacement(rest: vec2f) -> vec3f {
    let log_distance = log_distance_of(rest);
    let sum = displacement_by_maps(displacement_0, displacement_1, displacement_2, displacement_3, rest, log_distance);
    return (sum + carried(rest, 0.0, log_distance)) * border_keeps(rest);
}

fn displacement_before(rest: vec2f) -> vec3f {
    let log_distance = log_distance_of(rest);
    let sum = displacement_by_maps(previous_0, previous_1, previous_2, previous_3, rest, log_distance);
    return (sum + carried(rest, 1.0, log_distance)) * border_keeps(rest);
}

fn surface_at(in: Varyings) -> Surface {
    var s: Surface;
    s.alpha_squared = waves.scale.z;
    add_gradients(&s, in);
    let sum = sample_models(in.rest, pixel_filter(in.rest));
    let normal = normal_of(sum);
    let detail = waves.scale.y;
    // Where a loop turns the surface over, it is taken to stand upright.
    s.tilt += normal.xz * (detail / max(normal.y, 0.2 * length(normal)));
    s.alpha_squared += sum.lost * detail * detail;
    s.compression += 1.0 - normal.y;
    s.foam = sum.foam;
    s.gloss = sum.gloss;
    return s;
}

fn foaminess(in: Varyings, surface: Surface) -> f32 {
    return max(foam_of(remembered(in)), surface.foam);
}

fn gloss(surface: Surface) -> f32 {
    return surface.gloss;
}
