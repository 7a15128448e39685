// The flat sea beyond the quadtree, out to infinity: vertices with w = 0 are directions.
#include "waves.wgsl"

@vertex
fn vertex_main(@location(0) vertex: vec4f, @builtin(view_index) view: u32) -> Varyings {
    var out: Varyings;
    out.clip = frame.view_projection[view] * vertex;
    // A point at infinity cannot be interpolated to: the far end is put where haze has swallowed everything.
    let far = select(1.0, 1.0e5, vertex.w == 0.0);
    out.position = vertex.xyz * far;
    out.rest = out.position.xz;
    out.compression = 0.0;
    out.level = 0.0;
    out.view = view;
    return out;
}
