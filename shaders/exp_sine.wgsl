// y = A exp(sin f - 1). Twin: src/sea/waves/exp_sine.rs.

// Height for amplitude 1, and its derivative by the phase.
fn exp_sine_profile(sine: f32, cosine: f32) -> vec2f {
    return vec2f(1.0, cosine) * exp(sine - 1.0);
}
