// Light: the sky's texture, haze and the tone map.
#include "frame.wgsl"

// Light of the sky (without the sun's disc) from a direction, at a mip.
fn sky_radiance(direction: vec3f, mip: f32) -> vec3f {
    return textureSampleLevel(sky, clamped, direction, mip).rgb;
}

// What is left of light after a distance of air, and what the air adds: the horizon's own colour, so that the sea
// ends in the sky without a line (Koschmieder's law).
fn haze(color: vec3f, view: vec3f, distance: f32) -> vec3f {
    let kept = exp(-frame.air.x * distance);
    let horizon = sky_radiance(vec3f(-view.x, max(-view.y, 0.012), -view.z), 0.0);
    return mix(horizon, color, kept);
}

// Narkowicz's fit to the ACES film curve (2016); the sRGB encoding is the image format's.
fn tone_map(radiance: vec3f) -> vec3f {
    let x = radiance * frame.air.y;
    return saturate((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14));
}
