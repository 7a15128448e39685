// The sea and what floats on it where shadows fall on them.
#include "patch.wgsl"
#include "waves.wgsl"
#include "water.wgsl"
#include "matt.wgsl"
#include "shadows.wgsl"

@vertex
fn patch_main(in: Patch, @builtin(view_index) view: u32) -> Shadowed {
    let rest = rest_position(in);
    let position = vec3f(rest.x, 0.0, rest.y) + displacement(rest);
    return shadowed(seen_from(position, rest, view), on_sun_map(position));
}

@fragment
fn water_main(in: Shadowed) -> @location(0) vec4f {
    let square = dot(in.from_eye, in.from_eye);
    let sun = sun_on_water(in.on_map, square * inverseSqrt(square));
    return vec4f(shade(seen_shadowed(in), sun), 1.0);
}

@vertex
fn solid_main(in: Solid, @builtin(view_index) view: u32) -> SolidVaryings {
    return solid_seen(in, view);
}

@fragment
fn matt_main(in: SolidVaryings) -> @location(0) vec4f {
    let distance = length(frame.views[in.view].eye.xyz - in.position);
    let shadow = shadow_reach(distance) * (1.0 - sun_arriving(on_sun_map(in.position)));
    return vec4f(matt(in, 1.0 - shadow), 1.0);
}
