// What --debug shows instead of water.
#include "waves.wgsl"

// A colour for each level of the quadtree, told apart by hue and lightness. Twin: lod::level_color.
fn level_color(level: f32) -> vec3f {
    var colors = array<vec3f, 9>(
        vec3f(0.30, 0.30, 0.30),
        vec3f(0.00, 0.17, 0.45),
        vec3f(0.09, 0.46, 0.81),
        vec3f(0.00, 0.34, 0.17),
        vec3f(0.87, 0.77, 0.05),
        vec3f(0.79, 0.35, 0.00),
        vec3f(0.66, 0.11, 0.00),
        vec3f(0.60, 0.19, 0.39),
        vec3f(0.90, 0.90, 0.90),
    );
    return colors[u32(level) % 9u];
}

fn normal_at(in: Varyings) -> vec3f {
    let tilt = surface_at(in).tilt;
    return normalize(vec3f(tilt.x, 1.0, tilt.y));
}

// The patch's level, shaded by the waves.
@fragment
fn lod_main(in: Varyings) -> @location(0) vec4f {
    let light = 0.35 + 0.65 * saturate(dot(normal_at(in), frame.sun.xyz) + 0.3);
    return vec4f(level_color(in.level) * light, 1.0);
}

// The dark surface under the wireframe's lines.
@fragment
fn base_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(level_color(in.level) * 0.06, 1.0);
}

@fragment
fn line_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(level_color(in.level), 1.0);
}

// Normals as colours: x red, z green, up blue.
@fragment
fn normal_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(normal_at(in).xzy * 0.5 + 0.5, 1.0);
}

// Compression 1 - J: blue where the surface is stretched or still, white where foam begins, red beyond.
@fragment
fn jacobian_main(in: Varyings) -> @location(0) vec4f {
    let surface = surface_at(in);
    let c = surface.compression / max(frame.foam_range.x / frame.foam_range.y, 0.01);
    let calm = mix(vec3f(0.02, 0.05, 0.2), vec3f(0.9), saturate(c));
    return vec4f(mix(calm, vec3f(0.8, 0.05, 0.02), saturate(c - 1.0)), 1.0);
}

// Height as a colour: blue troughs, white at rest, red crests; +-4 RMS heights are the ends.
@fragment
fn height_main(in: Varyings) -> @location(0) vec4f {
    let h = clamp(in.height * frame.foam_range.w, -1.0, 1.0);
    let low = mix(vec3f(0.8), vec3f(0.02, 0.1, 0.6), saturate(-h));
    return vec4f(mix(low, vec3f(0.7, 0.05, 0.02), saturate(h)), 1.0);
}

// Height in metres.
@fragment
fn metres_main(in: Varyings) -> @location(0) vec4f {
    return vec4f(in.height, 0.0, 0.0, 1.0);
}
