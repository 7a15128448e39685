// y = A sin f. Twin: src/sea/waves/sine.rs.

// Height for amplitude 1, and its derivative by the phase.
fn sine_profile(sine: f32, cosine: f32) -> vec2f {
    return vec2f(sine, cosine);
}
