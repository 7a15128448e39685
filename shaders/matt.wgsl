// Looks of solids: unit meshes, turned and stretched, of one matt colour each.
#include "body.wgsl"
#include "light.wgsl"

struct SolidVaryings {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) @interpolate(flat) color: vec3f,
    @location(3) @interpolate(flat) view: u32,
}

// Light that the sea sends up besides its own colour: the sky mirrored in a rough sea, as a share of the daylight.
const MIRRORED: f32 = 0.06;

fn solid_seen(in: Solid, view: u32) -> SolidVaryings {
    var out: SolidVaryings;
    out.position = body_position(in);
    // Normals shrink where the thing is stretched.
    out.normal = in.x.xyz * (in.normal.x / dot(in.x.xyz, in.x.xyz))
        + in.y.xyz * (in.normal.y / dot(in.y.xyz, in.y.xyz))
        + in.z.xyz * (in.normal.z / dot(in.z.xyz, in.z.xyz));
    out.clip = frame.views[view].projection * vec4f(out.position, 1.0);
    // Depth is near / distance, so this divides the distance that depth stands for by 1 + w, everywhere alike.
    out.clip.z *= 1.0 + in.place.w;
    out.color = vec3f(in.x.w, in.y.w, in.z.w);
    out.view = view;
    return out;
}

// sun: share of its light that reaches it.
fn matt(in: SolidVaryings, sun: f32) -> vec3f {
    let to_eye = frame.views[in.view].eye.xyz - in.position;
    let distance = length(to_eye);
    let n = normalize(in.normal);
    let l = frame.sun.xyz;
    // From above the sky lights it, from below the sea, which is lit by both.
    let sea = (frame.sky_light.rgb + frame.sun_light.rgb * max(l.y, 0.0)) * (PI * frame.deep.rgb + MIRRORED);
    let daylight = frame.sun_light.rgb * (saturate(dot(n, l)) * sun) + mix(sea, frame.sky_light.rgb, 0.5 + 0.5 * n.y);
    let color = in.color * daylight / PI;
    return tone_map(haze(color, -to_eye / distance, distance));
}
