// How water looks: reflection of sky and sun, light from below and through crests, foam, haze.
// The reasons and the sources are in docs/water.md.
#include "light.wgsl"

const PI: f32 = 3.14159265;
// Reflectance of water seen along its normal.
const F0: f32 = 0.02;

struct Surface {
    // Sum over cascades of dh/dx and dh/dz.
    slope: vec2f,
    // Sum of the squared roughnesses (GGX alpha) of what the maps' mips have averaged away.
    alpha_squared: f32,
    // Sum over cascades of 1 - J now.
    compression: f32,
}

fn add_gradient(surface: ptr<function, Surface>, texel: vec4f, cascade: u32) {
    let n = texel.xy * 2.0 - 1.0;
    let up = sqrt(max(1.0 - dot(n, n), 0.04));
    let slope = to_world(-n / up, frame.cascades[cascade].axes);
    let root = 1.0 - texel.w;
    let alpha = root * root;
    (*surface).slope += slope;
    (*surface).alpha_squared += alpha * alpha;
    (*surface).compression += max(2.0 - 2.0 * texel.z, 0.0);
}

fn surface_at(rest: vec2f) -> Surface {
    var s: Surface;
    add_gradient(&s, textureSample(gradient_0, oblique, map_coordinates(rest, 0u)), 0u);
    if CASCADES > 1u {
        add_gradient(&s, textureSample(gradient_1, oblique, map_coordinates(rest, 1u)), 1u);
    }
    if CASCADES > 2u {
        add_gradient(&s, textureSample(gradient_2, oblique, map_coordinates(rest, 2u)), 2u);
    }
    if CASCADES > 3u {
        add_gradient(&s, textureSample(gradient_3, oblique, map_coordinates(rest, 3u)), 3u);
    }
    s.slope *= frame.deep.w;
    return s;
}

fn fresnel(cosine: f32) -> f32 {
    let m = 1.0 - saturate(cosine);
    let m2 = m * m;
    return F0 + (1.0 - F0) * m2 * m2 * m;
}

// The mean normal of the facets that can be seen: at grazing angles those that lean towards the viewer, so a rough sea
// reflects sky from well above the horizon. For Gaussian slopes of variance s2 the mean seen slope is s2 tan(angle),
// and at most sqrt(pi/2) s.
fn visible_normal(n: vec3f, v: vec3f, s2: f32) -> vec3f {
    let cosine = dot(n, v);
    let across = v - n * cosine;
    let lean = s2 / (max(cosine, 0.0) + 0.8 * sqrt(s2));
    return normalize(n + across * lean + v * max(0.02 - cosine, 0.0));
}

// GGX distribution times Smith visibility.
fn sun_lobe(n: vec3f, v: vec3f, l: vec3f, alpha_squared: f32) -> f32 {
    let h = normalize(v + l);
    let nh = saturate(dot(n, h));
    let nl = saturate(dot(n, l));
    let nv = max(dot(n, v), 0.02);
    let d = nh * nh * (alpha_squared - 1.0) + 1.0;
    let distribution = alpha_squared / (PI * d * d);
    let smith = nl * sqrt(nv * nv * (1.0 - alpha_squared) + alpha_squared)
        + nv * sqrt(nl * nl * (1.0 - alpha_squared) + alpha_squared);
    return distribution * 0.5 / max(smith, 1.0e-4) * fresnel(dot(v, h)) * nl;
}

// Compression that the displacement maps remember: finer than the mesh could carry it here.
fn remembered(rest: vec2f) -> f32 {
    var sum = textureSample(displacement_0, tiling, map_coordinates(rest, 0u)).w;
    if CASCADES > 1u {
        sum += textureSample(displacement_1, tiling, map_coordinates(rest, 1u)).w;
    }
    if CASCADES > 2u {
        sum += textureSample(displacement_2, tiling, map_coordinates(rest, 2u)).w;
    }
    if CASCADES > 3u {
        sum += textureSample(displacement_3, tiling, map_coordinates(rest, 3u)).w;
    }
    return sum;
}

// Colour of foam (its albedo) and in w how much of the surface it hides: the compression's range, broken up by the
// pattern. From afar the pattern's mips are grey, and the edge is soft, so that the mean cover stays as it is.
fn foam_at(rest: vec2f, compression: f32, distance: f32) -> vec4f {
    let amount = smoothstep(0.0, 1.0, (compression - frame.foam_range.x) * frame.foam_range.y);
    // A whole number of repeats a patch of the first cascade: the pattern lies still on the water wherever the origin is.
    let pattern = textureSample(foam_pattern, tiling, map_coordinates(rest, 0u) * frame.foam_range.z).r;
    let soft = mix(0.14, 0.5, saturate(distance * 0.006));
    let cover = saturate((pattern + amount - 1.0) / (2.0 * soft) + 0.5) * saturate(amount * 8.0);
    return vec4f(frame.foam.rgb * (0.7 + 0.3 * pattern), cover);
}

fn shade(in: Varyings) -> vec3f {
    // The centre of a pixel cut by the horizon may lie beyond infinity, where 1/w is negative and what is interpolated
    // comes back from behind.
    let to_eye = (frame.eyes[in.view].xyz - in.position) * select(-1.0, 1.0, in.clip.w > 0.0);
    let distance = length(to_eye);
    let v = to_eye / distance;
    let surface = surface_at(in.rest);
    let n = normalize(vec3f(-surface.slope.x, 1.0, -surface.slope.y));
    let alpha_squared = clamp(surface.alpha_squared - frame.sky_light.w, 0.0004, 0.5);
    let seen = visible_normal(n, v, 0.5 * alpha_squared);
    let l = frame.sun.xyz;

    let reflectance = fresnel(dot(seen, v));
    let mip = max(frame.air.z + 0.5 * log2(alpha_squared), 0.0);
    let reflected = sky_radiance(reflect(-v, seen), mip);
    let glitter = frame.sun_light.rgb * sun_lobe(n, v, l, alpha_squared);

    let daylight = frame.sun_light.rgb * saturate(dot(n, l)) + frame.sky_light.rgb;
    let below = frame.deep.rgb * daylight / PI;
    let towards_sun = saturate(-dot(l, v));
    let crest = max(in.position.y, 0.0) * frame.scatter.w;
    let facing = 0.5 - 0.5 * dot(l, n);
    let through = frame.scatter.rgb * frame.sun_light.rgb
        * (crest * towards_sun * towards_sun * facing * facing * facing);

    let white = foam_at(in.rest, remembered(in.rest), distance);
    let water = mix(below + through, reflected, reflectance) + glitter;
    let color = mix(water, white.rgb * daylight / PI, white.w);
    return tone_map(haze(color, v, distance));
}
