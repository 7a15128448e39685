// How water looks after Blinn and Phong: a deep colour, a mirror, a highlight, foam, haze. In the place of water.wgsl.
#include "light.wgsl"
#include "models.wgsl"

// Reflectance of water seen along its normal.
const F0: f32 = 0.02;

// What is mirrored from a direction: the sun, as large as the scene says and with its halo, over one colour or the sky's cube.
// sun: share of its light that arrives. Rough water, of alpha squared `rough`, mirrors the cube dimly; `lost` is the part that pixels have averaged away.
fn mirrored(direction: vec3f, rough: f32, lost: f32, sun: f32) -> vec3f {
    let look = waves.look;
    var around = waves.ambient.rgb * frame.sky_light.rgb;
    if waves.ambient.w > 0.0 {
        around = sky_radiance(direction, frame.air.z + 0.5 * log2(rough));
    }
    // Slopes that are finer than a pixel spread the sun: over alpha squared, measured as its size is.
    let size = look.z + lost;
    let within = saturate((dot(direction, frame.sun.xyz) - 1.0) / size + 1.0);
    return mix(around, frame.sun_light.rgb / PI, pow(within, look.w) * (look.z / size) * sun);
}

// sun: shares of its light that reach the surface (x) and come through the crest (y), of which there is none here.
fn shade(in: Varyings, sun: vec2f) -> vec3f {
    let surface = surface_at(in);
    let square = dot(in.from_eye, in.from_eye);
    let distance = sqrt(square);
    // As in water.wgsl: behind the horizon everything is the other way round.
    let ray = in.from_eye * select(-1.0, 1.0, in.clip.w > 0.0) / distance;
    let normal = normalize(vec3f(surface.tilt.x, 1.0, surface.tilt.y));
    let l = frame.sun.xyz;
    // A normal that leans away from the viewer is on a face that is not seen.
    let n_v = max(-dot(normal, ray), 0.0);
    let facing = normalize(normal - min(-dot(normal, ray), 0.0) * -ray);
    let m = 1.0 - n_v;
    let reflectance = F0 + (1.0 - F0) * (m * m * m * m * m);
    // The highlight and the sun have sizes of their own: only what pixels have averaged away widens them.
    let rough = clamp(surface.alpha_squared, 1.0e-6, 1.0);
    let lost = saturate(surface.alpha_squared - waves.own.x);

    let of_maps = foam_of(remembered(in));
    let foam = foaminess(in, surface);
    let left = gloss(surface) * (1.0 - of_maps);
    let color = mix(frame.deep.rgb, frame.foam.rgb, foam);
    let matt = color * (frame.sky_light.rgb + frame.sun_light.rgb * (saturate(dot(facing, l)) * sun.x));
    // Variances of the highlight's normals, 1 / exponent, and of those averaged away add up.
    let exponent = 1.0 / (1.0 / waves.look.x + 0.5 * lost);
    let halfway = normalize(l - ray);
    let highlight = pow(saturate(dot(facing, halfway)), exponent) * waves.look.y * exponent / waves.look.x;
    let shine = mirrored(reflect(ray, facing), rough, lost, sun.x) * reflectance
        + frame.sun_light.rgb * (highlight * sun.x / PI);
    let kept = air_keeps(distance);
    return tone_map((matt + shine * left) * kept + horizon(ray) * (1.0 - kept));
}
