// Patches of the quadtree: where their vertices are at rest.
#include "frame.wgsl"

struct Immediate {
    // Which edges of the patch meet a coarser one: east 1, north 2, west 4, south 8.
    pattern: u32,
}
var<immediate> draw: Immediate;

struct Patch {
    // Column and row in the patch's grid.
    @location(0) vertex: vec2u,
    // Centre x and z, side, weight of the morph inside.
    @location(1) place: vec4f,
    // Weights on the edges: east, north, west, south.
    @location(2) edges: vec4f,
}

// Where a vertex of a patch is: on its grid, or slid towards the next coarser one. Twin: lod::morph.
fn rest_position(in: Patch) -> vec2f {
    let cells = u32(frame.lod.x);
    var weight = in.place.w;
    var edge = 0u;
    if in.vertex.x == cells {
        weight = in.edges.x;
        edge = 1u;
    } else if in.vertex.x == 0u {
        weight = in.edges.z;
        edge = 4u;
    }
    if in.vertex.y == cells {
        weight = in.edges.y;
        edge = 2u;
    } else if in.vertex.y == 0u {
        weight = in.edges.w;
        edge = 8u;
    }
    // A stitched edge only has the coarser patch's vertices, and moves as that patch moves it.
    let halve = select(0u, 1u, (edge & draw.pattern) != 0u);
    let number = in.vertex >> vec2u(halve);
    // Odd numbers slide to the even one between multiples of four: 1 and 3 to 2.
    let odd = vec2f(number & vec2u(1u));
    let slide = odd * (1.0 - vec2f(number & vec2u(2u))) * weight;
    let place = (vec2f(number) + slide) * f32(1u << halve);
    return in.place.xy + (place / frame.lod.x - 0.5) * in.place.z;
}
