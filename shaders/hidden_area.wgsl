// The parts of a view that the headset's lenses do not show: black, and nearer than anything.
#include "frame.wgsl"

// A corner: the tangents of its angles from the view's axis (x, y), and the view it belongs to.
@vertex
fn vertex_main(@location(0) corner: vec3f, @builtin(view_index) view: u32) -> @builtin(position) vec4f {
    let scale = frame.views[view].scale;
    // In the other view all corners fall on one point, so nothing is drawn.
    let mine = u32(corner.z) == view;
    return select(vec4f(2.0, 2.0, 0.0, 1.0), vec4f(corner.xy * scale.xy + scale.zw, 1.0, 1.0), mine);
}

@fragment
fn fragment_main() -> @location(0) vec4f {
    return vec4f(0.0, 0.0, 0.0, 1.0);
}
