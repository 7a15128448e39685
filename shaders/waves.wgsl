// The displaced surface of a spectral sea, from its maps. analytic.wgsl takes this file's place where other waves add to it.
#include "maps.wgsl"

struct Varyings {
    @builtin(position) clip: vec4f,
    // Where the water is when the sea is at rest, in the maps of the cascades 0 and 1, and 2 and 3.
    @location(0) maps_01: vec4f,
    @location(4) maps_23: vec4f,
    // Where foam's pattern is looked up.
    @location(5) pattern: vec2f,
    // From the eye to the surface.
    @location(1) from_eye: vec3f,
    // Of the surface over the sea at rest.
    @location(2) height: f32,
    // Level of the patch, for --debug.
    @location(3) @interpolate(flat) level: f32,
}

struct Surface {
    // Sum over cascades of -dh/dx and -dh/dz.
    tilt: vec2f,
    // Sum of the squared roughnesses (GGX alpha) of what the maps' mips have averaged away, the water's own counted once.
    alpha_squared: f32,
    // Sum over cascades of 1 - J now.
    compression: f32,
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
}

fn shadowed(in: Varyings, on_map: vec3f) -> Shadowed {
    return Shadowed(in.clip, in.maps_01, in.maps_23, in.pattern, in.from_eye, in.height, on_map);
}

fn seen_shadowed(in: Shadowed) -> Varyings {
    return Varyings(in.clip, in.maps_01, in.maps_23, in.pattern, in.from_eye, in.height, 0.0);
}

// The surface at `position`, which is at `rest` when the sea is.
fn seen_from(position: vec3f, rest: vec2f, view: u32) -> Varyings {
    var out: Varyings;
    out.maps_01 = places_01(rest);
    out.maps_23 = places_23(rest);
    out.clip = to_clip(position, view);
    // A whole number of repeats a patch of the first cascade: the pattern lies still on the water wherever the origin is.
    out.pattern = out.maps_01.xy * frame.foam_range.z;
    out.from_eye = position - frame.views[view].eye.xyz;
    out.height = position.y;
    return out;
}

// Displacement (x, y, z) of the rest point now.
fn displacement(rest: vec2f) -> vec3f {
    let sum = displacement_by_maps(
        displacement_0, displacement_1, displacement_2, displacement_3, rest, log_distance_of(rest));
    return sum * border_keeps(rest);
}

// The same in the frame before. Detail is chosen for the head now in both.
fn displacement_before(rest: vec2f) -> vec3f {
    let sum = displacement_by_maps(previous_0, previous_1, previous_2, previous_3, rest, log_distance_of(rest));
    return sum * border_keeps(rest);
}

fn surface_at(in: Varyings) -> Surface {
    var s: Surface;
    s.alpha_squared = -frame.sky_light.w;
    add_gradients(&s, in);
    return s;
}

// Share of the surface where foam is to be, 0 to 1.
fn foaminess(in: Varyings, surface: Surface) -> f32 {
    return foam_of(remembered(in));
}

// What foam leaves of reflections besides what it hides.
fn gloss(surface: Surface) -> f32 {
    return 1.0;
}
