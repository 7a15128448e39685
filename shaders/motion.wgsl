// Motion vectors for space warp (XR_FB_space_warp): where a point of a surface is in normalised device coordinates, less
// where the same point was in the frame before. Vulkan's coordinates: y down, depth reversed.
#include "body.wgsl"
#include "patch.wgsl"
#include "waves.wgsl"

struct MotionVaryings {
    @builtin(position) clip: vec4f,
    @location(0) now: vec4f,
    @location(1) before: vec4f,
}

// The same solid in the frame before.
struct Before {
    @location(6) x: vec4f,
    @location(7) y: vec4f,
    @location(8) z: vec4f,
    @location(9) place: vec4f,
}

fn moved(now: vec4f, before: vec4f) -> MotionVaryings {
    return MotionVaryings(now, now, before);
}

// A point of the sea is its rest point. What changes with the viewer alone does not move.
@vertex
fn patch_main(in: Patch, @builtin(view_index) view: u32) -> MotionVaryings {
    let rest = rest_position(in);
    let still = vec3f(rest.x, 0.0, rest.y);
    let now = still + displacement(rest);
    let before = still + displacement_before(rest);
    return moved(
        frame.views[view].projection * vec4f(now, 1.0),
        frame.previous_view_projection[view] * vec4f(before, 1.0),
    );
}

@vertex
fn skirt_main(@location(0) vertex: vec4f, @builtin(view_index) view: u32) -> MotionVaryings {
    return moved(frame.views[view].projection * vertex, frame.previous_view_projection[view] * vertex);
}

@vertex
fn solid_main(in: Solid, was: Before, @builtin(view_index) view: u32) -> MotionVaryings {
    let earlier = Solid(in.vertex, in.normal, was.x, was.y, was.z, was.place);
    return moved(
        frame.views[view].projection * vec4f(body_position(in), 1.0),
        frame.previous_view_projection[view] * vec4f(body_position(earlier), 1.0),
    );
}

// The sky is infinitely far: only turning the head moves it.
@vertex
fn sky_main(@builtin(vertex_index) index: u32, @builtin(view_index) view: u32) -> MotionVaryings {
    let corner = vec2f(f32((index & 1u) * 4u), f32((index & 2u) * 2u)) - 1.0;
    let now = vec4f(corner, 0.0, 1.0);
    let ray = (frame.clip_to_ray[view] * now).xyz;
    return moved(now, frame.previous_view_projection[view] * vec4f(ray, 0.0));
}

@fragment
fn fragment_main(in: MotionVaryings) -> @location(0) vec4f {
    // What was behind the eye was nowhere in the picture before.
    let seen = in.now.w > 0.0 && in.before.w > 0.0;
    let motion = in.now.xyz / in.now.w - in.before.xyz / in.before.w;
    return vec4f(select(vec3f(0.0), motion, seen), 1.0);
}
