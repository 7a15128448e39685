// How water looks: reflection of sky and sun, light from below and through crests, foam, haze.
// The reasons and the sources are in docs/water.md.
#include "light.wgsl"

// Reflectance of water seen along its normal.
const F0: f32 = 0.02;

fn fresnel(cosine: f32) -> f32 {
    let m = saturate(1.0 - cosine);
    let m2 = m * m;
    return F0 + (1.0 - F0) * (m2 * m2 * m);
}

// GGX distribution times Smith visibility times the cosine towards the sun, from the cosines between normal, view and
// light alone: the half vector is (v + l) / |v + l|, and |v + l|^2 = 2 + 2 v.l.
fn sun_lobe(n_v: f32, n_l: f32, v_l: f32, alpha_squared: f32) -> f32 {
    // The square of v.h, and a little more: never 0.
    let square = 0.5000005 + 0.5 * v_l;
    let inverse = inverseSqrt(square);
    let twice_n_h = (n_v + n_l) * inverse;
    let lit = saturate(n_l);
    let seen = max(n_v, 0.02);
    let rest = 1.0 - alpha_squared;
    let d = twice_n_h * twice_n_h * (0.25 * alpha_squared - 0.25) + 1.0;
    let smith = lit * sqrt(seen * seen * rest + alpha_squared)
        + seen * sqrt(lit * lit * rest + alpha_squared);
    return fresnel(square * inverse) / (2.0 * PI) * lit * alpha_squared / (d * d * smith);
}

struct Foam {
    // Share of the surface that it hides.
    cover: f32,
    // Of its albedo.
    brightness: f32,
}

// An amount of foam, 0 to 1, broken up by the pattern. From afar the pattern's mips are grey, and the edge is soft, so that
// the mean cover stays as it is.
fn foam_at(in: Varyings, amount: f32, distance: f32) -> Foam {
    let gaps = textureSample(foam_pattern, tiling, in.pattern).r;
    let soft = mix(0.28, 1.0, saturate(distance * 0.006));
    let cover = saturate((amount - gaps) / soft + 0.5) * saturate(amount * 8.0);
    return Foam(cover, 1.0 - 0.3 * gaps);
}

// Cosines and weights are worked out first, and colours added up by them at the end: one number is a third of a colour.
fn shade(in: Varyings) -> vec3f {
    let surface = surface_at(in);
    let square = dot(in.from_eye, in.from_eye);
    let inverse = inverseSqrt(square);
    let distance = square * inverse;
    // The centre of a pixel cut by the horizon may lie beyond infinity, where 1/w is negative and what is interpolated
    // comes back from behind.
    let ray = in.from_eye * select(-inverse, inverse, in.clip.w > 0.0);
    let far = horizon(ray);
    let kept = air_keeps(distance);
    let l = frame.sun.xyz;
    let upright = vec3f(surface.tilt.x, 1.0, surface.tilt.y);
    let length = inverseSqrt(dot(surface.tilt, surface.tilt) + 1.0);
    let n_v = -dot(upright, ray) * length;
    let n_l = dot(upright, l) * length;
    let v_l = -dot(ray, l);
    let alpha_squared = max(saturate(surface.alpha_squared), 0.0004);
    let alpha = sqrt(alpha_squared);

    // The mean normal of the facets that can be seen, across n + along v: at grazing angles those that lean towards the
    // viewer, so a rough sea reflects sky from well above the horizon. For Gaussian slopes of variance s2, here half of
    // alpha squared, the mean seen slope is s2 tan(angle), and at most sqrt(pi/2) s.
    let lean = 0.5 * alpha_squared / (max(n_v, 0.0) + 0.565685 * alpha);
    let across = 1.0 - n_v * lean;
    let along = lean + saturate(0.02 - n_v);
    // Its cosine towards the viewer, and the square of its length.
    let towards = across * n_v + along;
    let seen_square = across * across + along * (towards + across * n_v);
    let reflectance = fresnel(towards * inverseSqrt(seen_square));
    let mirrored = upright * (2.0 * towards * across * length) + ray * (seen_square - 2.0 * towards * along);
    let reflected = sky_radiance(mirrored, frame.air.z + log2(alpha));

    let against_sun = saturate(-v_l);
    let facing = 0.5 - 0.5 * n_l;
    let both = against_sun * facing;
    let through = max(in.height, 0.0) * facing * (both * both);

    let foam = foam_at(in, foaminess(in, surface), distance);
    let water = kept - kept * foam.cover;
    let below = water - water * reflectance;
    let white = kept * foam.cover * foam.brightness;
    let mirror = water * gloss(surface);
    let glitter = mirror * sun_lobe(n_v, n_l, v_l, alpha_squared);

    let matt = frame.deep.rgb * below + frame.foam.rgb * white;
    let of_sun = matt * saturate(n_l) + (frame.scatter.rgb * (through * below) + glitter);
    return tone_map(
        frame.sun_light.rgb * of_sun + frame.sky_light.rgb * matt + reflected * (mirror * reflectance)
            + far * (1.0 - kept)
    );
}
