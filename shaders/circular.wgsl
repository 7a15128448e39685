// Rings: phase by the distance to a centre, at which the amplitude is none. Twin: src/sea/waves/circular.rs.
#include "wave.wgsl"

const PI_OF_RINGS: f32 = 3.14159265;

// Height and slope outwards where the amplitude is bounded, from those where it is whole.
fn bounded(profile: vec2f, k: f32, distance: f32) -> vec2f {
    let rate = k / PI_OF_RINGS;
    let s = min(rate * distance, 1.0);
    let bound = s * s * (3.0 - 2.0 * s);
    return profile * bound + vec2f(0.0, 6.0 * s * (1.0 - s) * rate * profile.x);
}

// A ring at `rest`: distance from the centre and how much further that is than the origin's, metres, and outwards.
struct Ring {
    distance: f32,
    further: f32,
    outwards: vec2f,
}

fn ring_at(wave: Wave, rest: vec2f) -> Ring {
    let from_centre = wave.along + rest;
    let distance = length(from_centre);
    // Less the origin's, without the loss of subtracting it: large numbers do not meet.
    let further = dot(wave.along + from_centre, rest) / max(distance + length(wave.along), 1.0e-9);
    return Ring(distance, further, from_centre / max(distance, 1.0e-9));
}
