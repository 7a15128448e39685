// A model's foam, by height and by normal. Twin: src/sea/waves/fbm.rs, whose octaves are waves like others here.
#include "wave.wgsl"

fn unit_power(base: f32, exponent: f32) -> f32 {
    return pow(saturate(base), exponent);
}

// Foam cover, 0 to 1, where the model alone is at this height, metres, and its unit normal's upward part is `up`.
fn fbm_cover(model: Model, height: f32, up: f32) -> f32 {
    let share = saturate(height * model.per_max_height);
    let within = (share - model.range.x) / (model.range.y - model.range.x);
    let high = unit_power((within - 1.0 + model.height_amount) / model.height_amount, model.height_falloff);
    let upright = saturate((saturate(up) - 1.0 + model.angle_amount) / model.angle_amount);
    let angle = select(upright, 1.0 - upright, model.lean == 1u);
    return mix(high, unit_power(angle, model.angle_falloff), high);
}
