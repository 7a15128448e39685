//! How many multiplications and additions an instruction set does at most, in vectors of the length that columns are
//! transformed on: the roof over them.
use super::samples::Samples;
use crate::sea::simd::{Float, Isa, Kernel, Simd};
use std::hint::black_box;
use std::time::Instant;

/// Chains that do not wait for each other: latency times width of a core with two multipliers, and half as many again.
const CHAINS: usize = 12;
/// Links of a chain in one sample: some ten microseconds.
const LINKS: usize = 4096;
const SAMPLES: usize = 200;

struct Chains;

impl Kernel for Chains {
    type Output = f32;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f32 {
        let (factor, term) = (simd.splat(black_box(0.999)), simd.splat(black_box(0.001)));
        let mut chains = [simd.splat(black_box(1.0)); CHAINS];
        for _ in 0..LINKS {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, term);
            }
        }
        let mut sum = chains[0];
        for chain in &chains[1..] {
            sum = sum + *chain;
        }
        let mut lanes = [0.0; crate::sea::simd::MAX_LANES];
        sum.store(&mut lanes);
        lanes[0]
    }
}

/// The chains once, on the best instruction set.
pub fn chains() {
    black_box(Isa::best().run(Chains));
}

/// Billions of operations a second of one thread, a multiplication and its addition counted as two. The fastest sample
/// counts: nothing but the machine's other work makes one slower.
pub fn measure(isa: Isa) -> f64 {
    let mut times = Samples::default();
    for _ in 0..SAMPLES {
        let start = Instant::now();
        black_box(isa.run(Chains));
        times.push(start.elapsed());
    }
    let operations = (2 * CHAINS * LINKS * isa.lanes()) as f64;
    times.summary().map_or(0.0, |time| 1e-3 * operations / time.min)
}
