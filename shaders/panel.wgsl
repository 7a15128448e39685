// The panel over the picture: egui's triangles. It takes two of the bindings that frame.wgsl declares for other things, since a
// layout lists what all shaders together use; its own sets have these two alone.
@group(0) @binding(1) var texels: texture_2d<f32>;
@group(0) @binding(12) var smoothly: sampler;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) uv: vec2f,
    @location(1) color: vec4f,
}

// `at` is in normalised device coordinates. Colours are encoded as sRGB and multiplied with alpha, as the pass blends them.
@vertex
fn vertex_main(@location(0) at: vec2f, @location(1) uv: vec2f, @location(2) color: vec4f) -> Corner {
    var out: Corner;
    out.clip = vec4f(at, 0.0, 1.0);
    out.uv = uv;
    out.color = color;
    return out;
}

@fragment
fn fragment_main(in: Corner) -> @location(0) vec4f {
    return in.color * textureSample(texels, smoothly, in.uv);
}
