// Opaque things that float on the sea.
#include "matt.wgsl"

@vertex
fn vertex_main(in: Solid, @builtin(view_index) view: u32) -> SolidVaryings {
    return solid_seen(in, view);
}

@fragment
fn fragment_main(in: SolidVaryings) -> @location(0) vec4f {
    return vec4f(matt(in, 1.0), 1.0);
}
