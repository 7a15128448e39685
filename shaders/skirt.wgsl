// The flat sea beyond the quadtree, out to infinity: vertices with w = 0 are directions.
#include "waves.wgsl"

@vertex
fn vertex_main(@location(0) vertex: vec4f, @builtin(view_index) view: u32) -> Varyings {
    // A long way to infinity: what is interpolated towards such a vertex is then true up to about its length, where
    // haze has long swallowed everything.
    let place = vertex * select(1.0, 1.0e7, vertex.w == 0.0);
    var out = seen_from(place.xyz, place.xz, view);
    out.clip = frame.views[view].projection * place;
    out.level = 0.0;
    return out;
}
