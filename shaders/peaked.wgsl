// y = 2 A ((sin f + 1) / 2)^K. Twin: src/sea/waves/peaked.rs.

// Height for amplitude 1, and its derivative by the phase.
fn peaked_profile(sine: f32, cosine: f32, sharpness: f32) -> vec2f {
    // Never 0, whose powers devices may get wrong.
    let base = max(0.5 * sine + 0.5, 1.0e-7);
    return vec2f(2.0 * base, sharpness * cosine) * pow(base, sharpness - 1.0);
}
