// How water looks: reflection of sky and sun, light from below and through crests, foam, haze.
// The reasons and the sources are in docs/water.md.
#include "light.wgsl"

// Reflectance of water seen along its normal.
const F0: f32 = 0.02;

// Schlick's reflectance at a cosine, times a factor.
fn fresnel(cosine: f32, factor: f32) -> f32 {
    let m = saturate(1.0 - cosine);
    let m2 = m * m;
    return factor * F0 + factor * (1.0 - F0) * (m2 * m2 * m);
}

// GGX distribution times Smith visibility times the cosine towards the sun, from the cosines between normal, view and
// light alone: the half vector is (v + l) / |v + l|, and |v + l|^2 = 2 + 2 v.l.
fn sun_lobe(n_v: f32, n_l: f32, v_l: f32, alpha_squared: f32) -> f32 {
    // The square of v.h, and a little more: never 0.
    let square = 0.5000005 + 0.5 * v_l;
    let seen = max(n_v, 0.02);
    let rest = 1.0 - alpha_squared;
    let inverse = inverseSqrt(square);
    // Where the sun does not shine all is 0 in the end: its cosine may be cut off for n.h too.
    let lit = saturate(n_l);
    let twice_n_h = (n_v + lit) * inverse;
    let smith = lit * sqrt(seen * seen * rest + alpha_squared)
        + seen * sqrt(lit * lit * rest + alpha_squared);
    // Four times what GGX divides by: 16 of the 8 / pi are its square, and 1 / (2 pi) is left.
    let d = 4.0 - twice_n_h * twice_n_h * rest;
    return fresnel(square * inverse, 8.0 / PI) * lit * alpha_squared / (d * d * smith);
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
    let soft = mix(0.28, 1.0, saturate(distance * 0.006));
    let gaps = textureSample(foam_pattern, tiling, in.pattern).r;
    let cover = saturate((amount - gaps) / soft + 0.5) * saturate(amount * 8.0);
    return Foam(cover, 1.0 - 0.3 * gaps);
}

// Cosines and weights are worked out first, and colours added up by them at the end: one number is a third of a colour.
// Statements stand in the order that leaves Mesa's compiler the fewest waits: docs/quest.md.
// sun: shares of its light that reach the surface (x) and come through the crest (y), 1 where nothing casts a shadow.
fn shade(in: Varyings, sun: vec2f) -> vec3f {
    let l = frame.sun.xyz;
    let square = dot(in.from_eye, in.from_eye);
    let inverse = inverseSqrt(square);
    let surface = surface_at(in);
    let length = inverseSqrt(dot(surface.tilt, surface.tilt) + 1.0);
    // The centre of a pixel cut by the horizon may lie beyond infinity, where 1/w is negative and what is interpolated
    // comes back from behind.
    let ray = in.from_eye * select(-inverse, inverse, in.clip.w > 0.0);
    let v_l = -dot(ray, l);
    let distance = square * inverse;
    let upright = vec3f(surface.tilt.x, 1.0, surface.tilt.y);
    let alpha_squared = max(saturate(surface.alpha_squared), 0.0004);
    let n_l = dot(upright, l) * length;
    let facing = 0.5 - 0.5 * n_l;
    let n_v = -dot(upright, ray) * length;
    let alpha = sqrt(alpha_squared);
    let against_sun = saturate(-v_l);
    // As `horizon`, without a look at the height: sea that stands above the horizon is near, and has no haze.
    let far = sky_radiance(vec3f(ray.x, HORIZON, ray.z), 0.0);

    // The mean normal of the facets that can be seen, across n + along v: at grazing angles those that lean towards the
    // viewer, so a rough sea reflects sky from well above the horizon. For Gaussian slopes of variance s2, here half of
    // alpha squared, the mean seen slope is s2 tan(angle), and at most sqrt(pi/2) s.
    let lean = 0.5 * alpha_squared / (max(n_v, 0.0) + 0.565685 * alpha);
    let across = 1.0 - n_v * lean;
    let along = lean + saturate(0.02 - n_v);
    // The visible normal's cosine towards the viewer is `towards`, and the square of its length `seen_square`, whose two
    // parts are the factors of the mirrored ray as well.
    let straight = across * across - along * along;
    let both = against_sun * facing;
    let towards = across * n_v + along;
    let twice = 2.0 * towards;
    let mirrored = upright * (twice * across * length) + ray * straight;
    let amount = foaminess(in, surface);
    let reflected = sky_radiance(mirrored, frame.air.z + log2(alpha));
    let seen_square = straight + along * twice;
    let kept = air_keeps(distance);
    let through = max(in.height, 0.0) * facing * (both * both);
    let reflectance = fresnel(towards * inverseSqrt(seen_square), 1.0);
    let foam = foam_at(in, amount, distance);

    let water = kept - kept * foam.cover;
    let below = water - water * reflectance;
    let mirror = water * gloss(surface);
    let white = kept * foam.cover * foam.brightness;
    let matt = frame.deep.rgb * below + frame.foam.rgb * white;
    let glitter = mirror * sun_lobe(n_v, n_l, v_l, alpha_squared);
    let of_sun = matt * (saturate(n_l) * sun.x) + (frame.scatter.rgb * (through * below * sun.y) + glitter * sun.x);
    return tone_map(
        frame.sun_light.rgb * of_sun + frame.sky_light.rgb * matt + reflected * (mirror * reflectance)
            + far * (1.0 - kept)
    );
}
