// The sun's map: where a position is on it, and whether the sun reaches it. What the map is: docs/shadows.md.
#include "frame.wgsl"

@group(0) @binding(20) var sun_map: texture_depth_2d;
// 1 where what is asked about is at least as high as what the map has; the mean of four texels. Beyond the map all is 1.
@group(0) @binding(21) var sun_reaches: sampler_comparison;

// Texture coordinates and depth.
fn on_sun_map(position: vec3f) -> vec3f {
    let map = frame.sun_map;
    return vec3f(
        dot(map.along.xyz, position) + map.along.w,
        map.across.x * position.x + map.across.z * position.z + map.across.w,
        map.across.y * position.y + map.reach.x,
    );
}

fn sun_map_clip(position: vec3f) -> vec4f {
    let place = on_sun_map(position);
    return vec4f(2.0 * place.xy - 1.0, place.z, 1.0);
}

// Share of shadow that is left at a distance from the eye.
fn shadow_reach(distance: f32) -> f32 {
    return saturate(frame.sun_map.reach.y - frame.sun_map.reach.z * distance);
}

// Share of the sun's light that arrives, over three texels by three. Asked for in uniform control flow.
fn sun_arriving(place: vec3f) -> f32 {
    // What the surface asked about rises over a texel and a half, so that it is not shaded by what goes on beside it.
    let right = dpdx(place);
    let down = dpdy(place);
    let rise = abs(right.z * down.y - right.y * down.z) + abs(right.x * down.z - right.z * down.x);
    let area = max(abs(right.x * down.y - right.y * down.x), 1e-12);
    // Far away a pixel's centre may lie metres beside the triangle, and its height on the triangle's plane is as wrong.
    let raised = place.z + rise * frame.sun_map.texels.z / area + abs(right.z) + abs(down.z);
    // Between four texels, whence single texels to the next ones.
    let corner = place.xy - frame.sun_map.texels.xy;
    let sum = textureSampleCompareLevel(sun_map, sun_reaches, corner, raised)
        + textureSampleCompareLevel(sun_map, sun_reaches, corner, raised, vec2i(1, 0))
        + textureSampleCompareLevel(sun_map, sun_reaches, corner, raised, vec2i(0, 1))
        + textureSampleCompareLevel(sun_map, sun_reaches, corner, raised, vec2i(1, 1));
    return 0.25 * sum;
}

// Shares of the sun's light that reach the water and that come through it. A crest lets through what its own thickness
// would shade: only what stands so much higher on the way to the sun takes that away.
fn sun_on_water(place: vec3f, distance: f32) -> vec2f {
    let through = textureSampleCompareLevel(sun_map, sun_reaches, place.xy, place.z + frame.sun_map.reach.w);
    return 1.0 - shadow_reach(distance) * (1.0 - vec2f(sun_arriving(place), through));
}
