// Light: the sky's texture, haze and the tone map.
#include "frame.wgsl"

const PI: f32 = 3.14159265;

// Light of the sky (without the sun's disc) from a direction, at a mip.
fn sky_radiance(direction: vec3f, mip: f32) -> vec3f {
    return textureSampleLevel(sky, clamped, direction, mip).rgb;
}

// Share of light that is left after a distance of air (Koschmieder's law).
fn air_keeps(distance: f32) -> f32 {
    return exp2(-frame.air.x * distance);
}

// Height of a ray of length 1 that still sees the horizon's colour.
const HORIZON: f32 = 0.012;

// What the air adds in its place: the horizon's own colour, so that the sea ends in the sky without a line.
fn horizon(ray: vec3f) -> vec3f {
    return sky_radiance(vec3f(ray.x, max(ray.y, HORIZON), ray.z), 0.0);
}

fn haze(color: vec3f, ray: vec3f, distance: f32) -> vec3f {
    return mix(horizon(ray), color, air_keeps(distance));
}

// Narkowicz's fit to the ACES film curve (2016), x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), of radiance times exposure,
// divided out: 2.51 / 2.43 less what is linear above the line. The sRGB encoding is the image format's.
fn tone_map(radiance: vec3f) -> vec3f {
    let tone = frame.tone;
    let below = radiance * (radiance * tone.y + tone.z) + 0.14;
    return saturate((radiance * tone.x - 0.144609) / below + 1.032922);
}
