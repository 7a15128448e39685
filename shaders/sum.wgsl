// All models, added up. Twin: src/sea/waves/mod.rs. A wave that the filter leaves nothing of costs no sine.
#include "sine.wgsl"
#include "peaked.wgsl"
#include "exp_sine.wgsl"
#include "gerstner.wgsl"
#include "circular.wgsl"
#include "fbm.wgsl"

fn add_wave(sum: ptr<function, Sample>, index: u32, rest: vec2f, before: f32, filtered: Filter) {
    let wave = waves.waves[index];
    let fine = waves.fineness[index];
    var along = wave.along;
    var distance = 0.0;
    var further: f32;
    if wave.kind >= RING {
        let ring = ring_at(wave, rest);
        along = ring.outwards;
        distance = ring.distance;
        further = ring.further;
    } else {
        further = dot(along, rest);
    }
    let kept = share(wave.k, along, fine.per_turn, filtered);
    (*sum).lost += fine.variance * (1.0 - kept * kept);
    if kept <= 0.0 {
        (*sum).displacement.y += fine.mean;
        return;
    }
    let at = local(wave.k * further + wave.phase + before * fine.before, along, kept);
    var profile: vec2f;
    switch wave.kind {
        case GERSTNER: {
            add_gerstner(sum, wave, at);
            return;
        }
        case PEAKED, PEAKED_RING: {
            profile = peaked_profile(at.sine, at.cosine, wave.sharpness);
        }
        case EXP_SINE: {
            profile = exp_sine_profile(at.sine, at.cosine);
        }
        default: {
            profile = sine_profile(at.sine, at.cosine);
        }
    }
    profile *= vec2f(wave.amplitude, wave.amplitude * wave.k);
    profile = vec2f(mix(fine.mean, profile.x, at.kept), profile.y * at.kept);
    if wave.kind >= RING {
        profile = bounded(profile, wave.k, distance);
    }
    add_height(sum, at, profile);
}

// Displacement alone. `before` is 0 now, 1 in the frame before.
fn displacement_of_models(rest: vec2f, before: f32, filtered: Filter) -> vec3f {
    var sum = Sample();
    for (var i = 0u; i < waves.waves_count; i++) {
        add_wave(&sum, i, rest, before, filtered);
    }
    return sum.displacement;
}

fn sample_models(rest: vec2f, filtered: Filter) -> Sample {
    var all = Sample();
    all.gloss = 1.0;
    for (var m = 0u; m < waves.count; m++) {
        let model = waves.models[m];
        var sum = Sample();
        for (var i = model.first; i < model.first + model.count; i++) {
            add_wave(&sum, i, rest, 0.0, filtered);
        }
        if model.lean != NO_FOAM {
            let foam = fbm_cover(model, sum.displacement.y, normalize(normal_of(sum)).y);
            all.foam = min(all.foam + foam, 1.0);
            all.gloss *= 1.0 - clamp(foam, model.reflection.x, model.reflection.y);
        }
        all.displacement += sum.displacement;
        all.slope += sum.slope;
        all.stretch += sum.stretch;
        all.lost += sum.lost;
    }
    return all;
}
