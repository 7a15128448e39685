//! Foam: where the surface was squeezed together, and for how long that shows. See `docs/foam.md`.
use super::{
    clock::Phase,
    settings::FoamSettings,
    simd::{Aligned, Float, Simd},
};

/// Largest compression remembered. A surface folded over once has J >= -1 nearly everywhere.
pub const MAX_COMPRESSION: f32 = 2.0;

/// Ticks of the memory per second, at least.
const TICKS_PER_SECOND: f64 = 10.0;

/// Share `breaking` of the compression 1 - J of a surface element, 0 where it is stretched, at most [`MAX_COMPRESSION`].
///
/// J comes as an `area` that is `breaking` J when multiplied by `scale`.
#[inline(always)]
pub fn compression<S: Simd>(simd: S, area: S::F32, scale: S::F32, breaking: S::F32) -> S::F32 {
    let share = area.neg_mul_add(scale, breaking);
    share.max(simd.splat(0.0)).min(simd.splat(MAX_COMPRESSION))
}

/// Foam cover, 0..=1, of a `compression` summed over cascades: smoothstep from the threshold over the width.
pub fn foam(settings: &FoamSettings, compression: f64) -> f64 {
    let above = compression - settings.threshold;
    if settings.width <= 0.0 {
        return if above >= 0.0 { 1.0 } else { 0.0 };
    }
    let x = (above / settings.width).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// When and how fast the memory fades.
///
/// At ticks, fixed fractions of the repeat period, every texel's memory m of the compression c becomes
/// max(m - `decay`, c). Each step is monotone in m, so the memory is the maximum of what every tick left, and what a
/// tick left is gone after at most `window` more: exactly, in f32. The memory at a tick is therefore a pure function of
/// the last `window` compressions, wherever the run began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fading {
    /// Ticks in a repeat period.
    pub ticks: u64,
    /// Compression forgotten per tick.
    pub decay: f32,
    /// Compression forgotten per repeat period.
    pub decay_per_period: f64,
    /// Ticks after which [`MAX_COMPRESSION`] is forgotten.
    pub window: u64,
}

impl Fading {
    /// `None` when the foam keeps no memory.
    pub fn new(settings: &FoamSettings, period: f64) -> Option<Self> {
        if settings.fade_time <= 0.0 {
            return None;
        }
        let ticks = (period * TICKS_PER_SECOND).ceil().max(1.0) as u64;
        let decay_per_period = period / settings.fade_time;
        let decay = (decay_per_period / ticks as f64) as f32;
        let mut window = 0;
        let mut left = MAX_COMPRESSION;
        while left > 0.0 {
            left -= decay;
            window += 1;
        }
        Some(Self { ticks, decay, decay_per_period, window })
    }
}

/// What a cascade remembers.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// Compression left at every grid point, N x N.
    pub texels: Aligned<f32>,
    /// The tick it stands at; `None` when it must be built anew.
    pub tick: Option<u64>,
}

impl Memory {
    /// No memory of `n` x `n` points.
    pub fn new(n: usize) -> Self {
        Self { texels: Aligned::zeros(n * n), tick: None }
    }

    /// How many ticks, the last being `to`, must be taken in; forgets everything first where that is cheaper.
    pub fn begin(&mut self, to: u64, fading: &Fading) -> u64 {
        let gap = self.tick.map(|tick| (to + fading.ticks - tick) % fading.ticks);
        match gap {
            Some(gap) if gap <= fading.window => gap,
            _ => {
                self.texels.fill(0.0);
                fading.window
            }
        }
    }
}

/// How a frame reads the memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameFoam {
    /// What the memory has lost since it was written.
    pub lost: f32,
    /// Whether the result is the new memory: the frame falls on the tick after the memory's.
    pub keep: bool,
}

impl FrameFoam {
    /// A frame at `phase` whose memory stands at the tick before it, or at it.
    pub fn after_tick(fading: &Fading, tick: u64, phase: Phase) -> Self {
        let since = phase.since(Phase::of_tick(tick, fading.ticks));
        Self { lost: (since * fading.decay_per_period) as f32, keep: false }
    }
}

/// The compression to be seen, from what is remembered and what is there now.
#[inline(always)]
pub fn fade<V: Float>(remembered: V, lost: V, now: V) -> V {
    (remembered - lost).max(now)
}
