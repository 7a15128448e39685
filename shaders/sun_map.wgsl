// What casts shadows, drawn into the sun's map: depth alone.
#include "body.wgsl"
#include "patch.wgsl"
#include "waves.wgsl"
#include "shadows.wgsl"

@vertex
fn patch_main(in: Patch) -> @builtin(position) vec4f {
    let rest = rest_position(in);
    return sun_map_clip(vec3f(rest.x, 0.0, rest.y) + displacement(rest));
}

@vertex
fn solid_main(in: Solid) -> @builtin(position) vec4f {
    return sun_map_clip(body_position(in));
}
