// The sea: patches of the quadtree, displaced, then shaded.
#include "patch.wgsl"
#include "waves.wgsl"
#include "water.wgsl"

@vertex
fn vertex_main(in: Patch, @builtin(view_index) view: u32) -> Varyings {
    let rest = rest_position(in);
    var out = seen_from(vec3f(rest.x, 0.0, rest.y) + displacement(rest), rest, view);
    out.level = round(log2(frame.lod.y / in.place.z));
    return out;
}

@fragment
fn fragment_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(shade(in, vec2f(1.0)), 1.0);
}
