// Patches of the quadtree: where their vertices are at rest.
#include "frame.wgsl"

struct Patch {
    // Its place in a patch of side 1 about its centre (x, y), and the way it slides towards the next coarser grid (z, w).
    @location(0) vertex: vec4f,
    // 1 for the weight it slides by: inside; on the edges east, north, west, south.
    @location(1) inside: f32,
    @location(2) on_edge: vec4f,
    // Centre x and z, side, weight of the morph inside.
    @location(3) place: vec4f,
    // Weights on the edges: east, north, west, south.
    @location(4) edges: vec4f,
}

// Where a vertex of a patch is: on its grid, or slid towards the next coarser one. Twin: lod::morph; draw::patch_grid
// works out the slides.
fn rest_position(in: Patch) -> vec2f {
    let weight = in.inside * in.place.w + dot(in.on_edge, in.edges);
    return in.place.xy + (in.vertex.xy + in.vertex.zw * weight) * in.place.z;
}
