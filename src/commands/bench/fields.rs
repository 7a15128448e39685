//! The three fields that everybody transforms: half spectra of real fields, the same numbers for all.

/// The spectrum of `field` (0 height, 1 and 2 displacement along u and v) at (`ku`, `kv`), `ku` in 0..n in the transform's order, `kv` in 0..=n/2: of order 1, so that
/// nothing is denormal or overflows, and Hermitian where both (ku, 0) and (-ku, 0) are in the half.
pub fn half_spectrum(n: usize, field: usize, ku: usize, kv: usize) -> [f32; 2] {
    if ku == n / 2 || kv == n / 2 || (ku, kv) == (0, 0) {
        return [0.0; 2];
    }
    if kv == 0 && ku > n / 2 {
        let [re, im] = half_spectrum(n, field, n - ku, 0);
        return [re, -im];
    }
    // Two numbers without pattern from three: a multiplicative hash.
    let mixed = (((field * n + ku) * n + kv) as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    [mixed >> 40, mixed >> 16 & 0xff_ffff].map(|bits| bits as f32 / (1 << 23) as f32 - 1.0)
}

/// The same at any (`ku`, `kv`) in 0..n: what is not in the half is the conjugate of what lies opposite.
#[cfg(feature = "rivals")]
pub fn spectrum(n: usize, field: usize, ku: usize, kv: usize) -> [f32; 2] {
    if kv <= n / 2 {
        return half_spectrum(n, field, ku, kv);
    }
    let [re, im] = half_spectrum(n, field, (n - ku) % n, n - kv);
    [re, -im]
}

/// The spectrum of the complex field a + i b of two real ones; without `b`, that of a.
#[cfg(feature = "rivals")]
pub fn paired(n: usize, a: usize, b: Option<usize>, ku: usize, kv: usize) -> [f32; 2] {
    let a = spectrum(n, a, ku, kv);
    let b = b.map_or([0.0; 2], |b| spectrum(n, b, ku, kv));
    [a[0] - b[1], a[1] + b[0]]
}
