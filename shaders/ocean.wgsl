// The sea: patches of the quadtree, displaced, then shaded.
#include "waves.wgsl"
#include "water.wgsl"

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

@vertex
fn vertex_main(in: Patch, @builtin(view_index) view: u32) -> Varyings {
    let rest = rest_position(in);
    var out: Varyings;
    out.rest = rest;
    out.position = vec3f(rest.x, 0.0, rest.y) + displacement(rest);
    out.clip = frame.view_projection[view] * vec4f(out.position, 1.0);
    out.level = round(log2(frame.lod.y / in.place.z));
    out.view = view;
    return out;
}

@fragment
fn fragment_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(shade(in), 1.0);
}
