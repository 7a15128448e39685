// The displaced surface at a vertex, from the displacement maps.
#include "frame.wgsl"

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

// The surface at `position`, which is at `rest` when the sea is.
fn seen_from(position: vec3f, rest: vec2f, view: u32) -> Varyings {
    var out: Varyings;
    out.maps_01 = vec4f(map_coordinates(rest, 0u), 0.0, 0.0);
    if CASCADES > 1u {
        out.maps_01 = vec4f(out.maps_01.xy, map_coordinates(rest, 1u));
    }
    if CASCADES > 2u {
        out.maps_23 = vec4f(map_coordinates(rest, 2u), 0.0, 0.0);
    }
    if CASCADES > 3u {
        out.maps_23 = vec4f(out.maps_23.xy, map_coordinates(rest, 3u));
    }
    out.clip = to_clip(position, view);
    // A whole number of repeats a patch of the first cascade: the pattern lies still on the water wherever the origin is.
    out.pattern = out.maps_01.xy * frame.foam_range.z;
    out.from_eye = position - frame.views[view].eye.xyz;
    out.height = position.y;
    return out;
}

fn displace_by(map: texture_2d<f32>, cascade: u32, rest: vec2f, log_distance: f32) -> vec3f {
    let c = frame.cascades[cascade];
    // The mip whose texels are as wide as the grid's cells, so that waves the grid cannot carry are not in it.
    let mip = log_distance - c.log_reach;
    let d = textureSampleLevel(map, tiling, map_coordinates(rest, cascade), mip);
    let xz = to_world(d.xz, c.axes);
    return vec3f(xz.x, d.y, xz.y);
}

// Displacement (x, y, z) of the rest point, from the maps of one moment.
fn displacement_in(
    map_0: texture_2d<f32>,
    map_1: texture_2d<f32>,
    map_2: texture_2d<f32>,
    map_3: texture_2d<f32>,
    rest: vec2f,
) -> vec3f {
    let from_head = vec3f(rest.x, 0.0, rest.y) - frame.head.xyz;
    // Half the logarithm of a square is the logarithm, without a root.
    let log_distance = 0.5 * log2(clamp(dot(from_head, from_head), frame.lod.z, frame.lod.w));
    var sum = displace_by(map_0, 0u, rest, log_distance);
    if CASCADES > 1u {
        sum += displace_by(map_1, 1u, rest, log_distance);
    }
    if CASCADES > 2u {
        sum += displace_by(map_2, 2u, rest, log_distance);
    }
    if CASCADES > 3u {
        sum += displace_by(map_3, 3u, rest, log_distance);
    }
    // Flat at the quadtree's border, where the skirt goes on. Twin: lod::border_fade.
    let border = saturate(max(abs(rest.x), abs(rest.y)) * frame.lod.x - 2.5);
    return sum * (1.0 - border * border * (3.0 - 2.0 * border));
}

// Displacement now.
fn displacement(rest: vec2f) -> vec3f {
    return displacement_in(displacement_0, displacement_1, displacement_2, displacement_3, rest);
}
