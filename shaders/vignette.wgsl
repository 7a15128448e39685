// The comfort vignette: darkness around the view's axis, as a ring that leaves the middle alone.
#include "frame.wgsl"

// The Rust twins are in src/draw/vignette.rs.
const SEGMENTS: f32 = 64.0;

struct Rim {
    @builtin(position) clip: vec4f,
    // 0 where darkness begins, 1 where it is complete.
    @location(0) out: f32,
}

// Two rings of quads, each of two triangles: from the inner angle to the outer one, and from there out of sight.
@vertex
fn vertex_main(@builtin(vertex_index) index: u32, @builtin(view_index) view: u32) -> Rim {
    var corners = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let corner = corners[index % 6u];
    let quad = index / 6u;
    let ring = (quad & 1u) + (corner >> 1u);
    let around = f32((quad >> 1u) + (corner & 1u)) * (6.28318531 / SEGMENTS);
    let radii = vec3f(tan(frame.vignette.x), tan(frame.vignette.y), 20.0);
    let scale = frame.views[view].scale;
    var out: Rim;
    out.clip = vec4f(vec2f(cos(around), sin(around)) * radii[ring] * scale.xy + scale.zw, 0.0, 1.0);
    out.out = min(f32(ring), 1.0);
    return out;
}

@fragment
fn fragment_main(in: Rim) -> @location(0) vec4f {
    return vec4f(0.0, 0.0, 0.0, smoothstep(0.0, 1.0, in.out));
}
