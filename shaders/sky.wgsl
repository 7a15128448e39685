// The sky: one triangle at infinite distance, drawn last where nothing else was.
#include "light.wgsl"

struct SkyVaryings {
    @builtin(position) clip: vec4f,
    @location(0) ray: vec3f,
}

@vertex
fn vertex_main(@builtin(vertex_index) index: u32, @builtin(view_index) view: u32) -> SkyVaryings {
    let corner = vec2f(f32((index & 1u) * 4u), f32((index & 2u) * 2u)) - 1.0;
    var out: SkyVaryings;
    out.clip = vec4f(corner, 0.0, 1.0);
    out.ray = (frame.clip_to_ray[view] * vec4f(corner, 0.0, 1.0)).xyz;
    return out;
}

@fragment
fn fragment_main(in: SkyVaryings) -> @location(0) vec4f {
    let ray = normalize(in.ray);
    let radius = frame.sun.w;
    // The disc's edge is a little soft, so that it does not shimmer.
    let disc = smoothstep(radius, mix(radius, 1.0, 0.3), dot(ray, frame.sun.xyz));
    let radiance = sky_radiance(ray, 0.0) + frame.sun_light.rgb * (disc * frame.sun_light.w);
    return vec4f(tone_map(radiance), 1.0);
}
