// The displaced surface at a vertex, from the displacement maps.
#include "frame.wgsl"

struct Varyings {
    @builtin(position) clip: vec4f,
    // Where the water is when the sea is at rest: what the maps are addressed by.
    @location(0) rest: vec2f,
    @location(1) position: vec3f,
    // Level of the patch, for --debug.
    @location(2) @interpolate(flat) level: f32,
    @location(3) @interpolate(flat) view: u32,
}

fn displace_by(map: texture_2d<f32>, cascade: u32, rest: vec2f, log_spacing: f32) -> vec3f {
    let c = frame.cascades[cascade];
    // The mip whose texels are as wide as the grid's cells, so that waves the grid cannot carry are not in it.
    let mip = max(log_spacing - c.log_texel, 0.0);
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
    let distance = length(vec3f(rest.x, 0.0, rest.y) - frame.head.xyz);
    let log_spacing = log2(clamp(frame.lod.z * distance, frame.lod.w, frame.air.w));
    var sum = displace_by(map_0, 0u, rest, log_spacing);
    if CASCADES > 1u {
        sum += displace_by(map_1, 1u, rest, log_spacing);
    }
    if CASCADES > 2u {
        sum += displace_by(map_2, 2u, rest, log_spacing);
    }
    if CASCADES > 3u {
        sum += displace_by(map_3, 3u, rest, log_spacing);
    }
    // Flat at the quadtree's border, where the skirt goes on. Twin: lod::border_fade.
    let border = max(abs(rest.x), abs(rest.y)) / (0.5 * frame.lod.y);
    return sum * (1.0 - smoothstep(0.7, 0.98, border));
}

// Displacement now.
fn displacement(rest: vec2f) -> vec3f {
    return displacement_in(displacement_0, displacement_1, displacement_2, displacement_3, rest);
}
