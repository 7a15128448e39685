// What the maps of the spectral sea say. Whoever includes this has a `Varyings` with places in the maps and a `Surface`.
#include "frame.wgsl"

fn displace_by(map: texture_2d<f32>, cascade: u32, rest: vec2f, log_distance: f32) -> vec3f {
    let c = frame.cascades[cascade];
    // The mip whose texels are as wide as the grid's cells, so that waves the grid cannot carry are not in it.
    let mip = log_distance - c.log_reach;
    let d = textureSampleLevel(map, tiling, map_coordinates(rest, cascade), mip);
    let xz = to_world(d.xz, c.axes);
    return vec3f(xz.x, d.y, xz.y);
}

// Logarithm of a rest point's distance from the head, within the bounds of the vertex spacing.
fn log_distance_of(rest: vec2f) -> f32 {
    let from_head = vec3f(rest.x, 0.0, rest.y) - frame.head.xyz;
    // Half the logarithm of a square is the logarithm, without a root.
    return 0.5 * log2(clamp(dot(from_head, from_head), frame.lod.z, frame.lod.w));
}

// Displacement (x, y, z) of the rest point, from the maps of one moment.
fn displacement_by_maps(
    map_0: texture_2d<f32>,
    map_1: texture_2d<f32>,
    map_2: texture_2d<f32>,
    map_3: texture_2d<f32>,
    rest: vec2f,
    log_distance: f32,
) -> vec3f {
    var sum = vec3f(0.0);
    if CASCADES > 0u {
        sum = displace_by(map_0, 0u, rest, log_distance);
    }
    if CASCADES > 1u {
        sum += displace_by(map_1, 1u, rest, log_distance);
    }
    if CASCADES > 2u {
        sum += displace_by(map_2, 2u, rest, log_distance);
    }
    if CASCADES > 3u {
        sum += displace_by(map_3, 3u, rest, log_distance);
    }
    return sum;
}

// What is left of waves near the quadtree's border, where the skirt goes on flat. Twin: lod::border_fade.
fn border_keeps(rest: vec2f) -> f32 {
    let border = saturate(max(abs(rest.x), abs(rest.y)) * frame.lod.x - 2.5);
    return 1.0 - border * border * (3.0 - 2.0 * border);
}

fn add_gradient(surface: ptr<function, Surface>, texel: vec4f, cascade: u32) {
    // to_world of the normal's level part, 2 texel - 1, in one step.
    let c = frame.cascades[cascade];
    let level = to_world(texel.xy, c.twice_axes) + c.middle;
    (*surface).tilt += level * inverseSqrt(max(1.0 - level.x * level.x - level.y * level.y, 0.04));
    let root = 1.0 - texel.w;
    let alpha = root * root;
    (*surface).alpha_squared += alpha * alpha;
    (*surface).compression += max(2.0 - 2.0 * texel.z, 0.0);
}

fn add_gradients(surface: ptr<function, Surface>, in: Varyings) {
    if CASCADES > 0u {
        add_gradient(surface, textureSample(gradient_0, oblique, in.maps_01.xy), 0u);
    }
    if CASCADES > 1u {
        add_gradient(surface, textureSample(gradient_1, oblique, in.maps_01.zw), 1u);
    }
    if CASCADES > 2u {
        add_gradient(surface, textureSample(gradient_2, oblique, in.maps_23.xy), 2u);
    }
    if CASCADES > 3u {
        add_gradient(surface, textureSample(gradient_3, oblique, in.maps_23.zw), 3u);
    }
}

// Compression that the displacement maps remember: finer than the mesh could carry it here.
fn remembered(in: Varyings) -> f32 {
    var sum = 0.0;
    if CASCADES > 0u {
        sum = textureSample(displacement_0, tiling, in.maps_01.xy).w;
    }
    if CASCADES > 1u {
        sum += textureSample(displacement_1, tiling, in.maps_01.zw).w;
    }
    if CASCADES > 2u {
        sum += textureSample(displacement_2, tiling, in.maps_23.xy).w;
    }
    if CASCADES > 3u {
        sum += textureSample(displacement_3, tiling, in.maps_23.zw).w;
    }
    return sum;
}

// Places of a rest point in the maps of the cascades 0 and 1, and 2 and 3.
fn places_01(rest: vec2f) -> vec4f {
    var places = vec4f(0.0);
    if CASCADES > 0u {
        places = vec4f(map_coordinates(rest, 0u), 0.0, 0.0);
    }
    if CASCADES > 1u {
        places = vec4f(places.xy, map_coordinates(rest, 1u));
    }
    return places;
}

fn places_23(rest: vec2f) -> vec4f {
    var places = vec4f(0.0);
    if CASCADES > 2u {
        places = vec4f(map_coordinates(rest, 2u), 0.0, 0.0);
    }
    if CASCADES > 3u {
        places = vec4f(places.xy, map_coordinates(rest, 3u));
    }
    return places;
}

// How much foam a compression is, 0 to 1.
fn foam_of(compression: f32) -> f32 {
    let range = frame.foam_range;
    let along = saturate(compression * range.y - range.x);
    return along * along * (3.0 - 2.0 * along);
}
