//! The three fields that everybody transforms: spectra of real fields, the same numbers for all.
//!
//! A real field's spectrum is given by one half: a wave vector has a component `half` in 0..=n/2 and a component `whole` in
//! 0..n, in the transform's order.

/// The spectrum of `field` (0 height, 1 and 2 displacement along u and v) at a wave vector: of order 1, so that nothing is
/// denormal or overflows, and Hermitian where both (0, k) and (0, -k) are in the half.
pub fn half_spectrum(n: usize, field: usize, half: usize, whole: usize) -> [f32; 2] {
    if half == n / 2 || whole == n / 2 || (half, whole) == (0, 0) {
        return [0.0; 2];
    }
    if half == 0 && whole > n / 2 {
        let [re, im] = half_spectrum(n, field, 0, n - whole);
        return [re, -im];
    }
    // Two numbers without pattern from three: a multiplicative hash.
    let mixed = (((field * n + half) * n + whole) as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    [mixed >> 40, mixed >> 16 & 0xff_ffff].map(|bits| bits as f32 / (1 << 23) as f32 - 1.0)
}

/// The same for any `half` in 0..n: what is not in the half is the conjugate of what lies opposite.
#[cfg(any(feature = "rivals", test))]
pub fn spectrum(n: usize, field: usize, half: usize, whole: usize) -> [f32; 2] {
    if half <= n / 2 {
        return half_spectrum(n, field, half, whole);
    }
    let [re, im] = half_spectrum(n, field, n - half, (n - whole) % n);
    [re, -im]
}

/// The spectrum of the complex field a + i b of two real ones; without `b`, that of a.
#[cfg(feature = "rivals")]
pub fn paired(n: usize, a: usize, b: Option<usize>, half: usize, whole: usize) -> [f32; 2] {
    let a = spectrum(n, a, half, whole);
    let b = b.map_or([0.0; 2], |b| spectrum(n, b, half, whole));
    [a[0] - b[1], a[1] + b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fields_are_real() {
        let n = 16;
        for (half, whole) in (0..n * n).map(|at| (at % n, at / n)) {
            let [re, im] = spectrum(n, 1, half, whole);
            assert_eq!(spectrum(n, 1, (n - half) % n, (n - whole) % n), [re, -im], "{half} {whole}");
        }
    }
}
