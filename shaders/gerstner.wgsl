// Points on circles or ellipses: Q A cos f along the wave, A sin f up. Twin: src/sea/waves/gerstner.rs.
#include "wave.wgsl"

fn add_gerstner(sum: ptr<function, Sample>, wave: Wave, at: Local) {
    let horizontal = wave.horizontal * at.kept;
    let amplitude = wave.amplitude * at.kept;
    let level = at.along * (horizontal * at.cosine);
    (*sum).displacement += vec3f(level.x, amplitude * at.sine, level.y);
    (*sum).slope += at.along * (wave.k * amplitude * at.cosine);
    (*sum).stretch -= at.along.xxy * at.along.xyy * (wave.k * horizontal * at.sine);
}
