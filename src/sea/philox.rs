//! Counter-based random numbers: the same for a wave vector whatever else is computed, in any order, on any thread.
//!
//! Philox4x32-10 of Salmon et al. 2011, "Parallel Random Numbers: As Easy as 1, 2, 3".

/// Multipliers of the two halves of a round.
const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
/// Weyl increments of the key: the golden ratio and sqrt(3) - 1.
const INCREMENTS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
const ROUNDS: usize = 10;

/// Four random words for a `counter` under a `key`.
pub fn philox4x32(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
    let mut state = counter;
    let mut key = key;
    for _ in 0..ROUNDS {
        let first = u64::from(MULTIPLIERS[0]) * u64::from(state[0]);
        let second = u64::from(MULTIPLIERS[1]) * u64::from(state[2]);
        state = [
            (second >> 32) as u32 ^ state[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ state[3] ^ key[1],
            first as u32,
        ];
        key = [key[0].wrapping_add(INCREMENTS[0]), key[1].wrapping_add(INCREMENTS[1])];
    }
    state
}

/// The complex Gaussian of wave vector `2 pi / L (i, j)` of a cascade: independent parts of variance 1, eq (12).
///
/// The grid's resolution is not an input: a finer grid adds waves and keeps those it had.
pub fn gaussian(seed: u64, i: i32, j: i32, cascade: u32) -> [f64; 2] {
    let words = philox4x32([i as u32, j as u32, cascade, 0], [seed as u32, (seed >> 32) as u32]);
    let u1 = unit(words[0], words[1]);
    let u2 = unit(words[2], words[3]);
    let radius = (-2.0 * libm::log(u1)).sqrt();
    let angle = std::f64::consts::TAU * u2;
    [radius * libm::sin(angle), radius * libm::cos(angle)]
}

/// Number `index` of a sequence of its own for each `seed`: strictly between 0 and 1.
pub fn uniform(seed: u64, index: u32) -> f64 {
    // The last word keeps these counters apart from those of `gaussian`.
    let words = philox4x32([index, 0, 0, 1], [seed as u32, (seed >> 32) as u32]);
    unit(words[0], words[1])
}

/// A number strictly between 0 and 1 from 52 of 64 random bits.
fn unit(high: u32, low: u32) -> f64 {
    let bits = (u64::from(high) << 32 | u64::from(low)) >> 12;
    (bits as f64 + 0.5) / (1_u64 << 52) as f64
}
