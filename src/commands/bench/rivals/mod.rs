//! What others pay for the same three fields. FFTW and RustFFT are there where the feature `rivals` is; the paper's own
//! algorithm always is.
#[cfg(feature = "rivals")]
mod fftw;
mod printed;
#[cfg(feature = "rivals")]
mod rustfft;

use super::harness::{Case, Label};
use super::{BenchError, selection::Selection};

/// The rivals of size `n`.
///
/// # Errors
/// A rival that does not do this size.
pub fn cases(selection: &Selection, n: usize) -> Result<Vec<Case>, BenchError> {
    let mut cases = Vec::new();
    #[cfg(feature = "rivals")]
    {
        if selection.wants("fftw3") {
            cases.extend(fftw::cases(n)?);
        }
        if selection.wants("rustfft2") {
            cases.push(rustfft::case(n));
        }
    }
    if selection.wants("paper_step") && n <= printed::LARGEST {
        cases.push(printed::case(n));
    }
    Ok(cases)
}

fn label(name: &str, n: usize) -> Label {
    Label { name: name.to_owned(), n, cascades: 1, threads: 1, isa: "" }
}

#[cfg(test)]
#[cfg(feature = "rivals")]
mod tests {
    use super::*;
    use crate::commands::bench::{fields::spectrum, sea};
    use crate::sea::simd::Isa;

    /// By definition, at the point (x along the half components, y along the whole ones).
    fn defined(n: usize, field: usize, [x, y]: [usize; 2]) -> f64 {
        let term = |at: usize| {
            let (half, whole) = (at % n, at / n);
            let [re, im] = spectrum(n, field, half, whole).map(f64::from);
            let (sin, cos) =
                (std::f64::consts::TAU * ((half * x + whole * y) % n) as f64 / n as f64).sin_cos();
            re * cos - im * sin
        };
        (0..n * n).map(term).sum()
    }

    fn ours(n: usize, isa: Isa) -> Vec<Vec<f32>> {
        let mut fields = sea::filled(n, isa).unwrap();
        fields.inverse();
        (0..3).map(|field| (0..n).flat_map(|v| fields.row(field, v)).copied().collect()).collect()
    }

    #[test]
    fn everybody_transforms_the_same_fields() {
        let n = 32;
        let mut all = fftw::results(n);
        all.push(rustfft::results(n));
        all.extend(Isa::available().map(|isa| ours(n, isa)));
        for (way, fields) in all.iter().enumerate() {
            for (field, plane) in fields.iter().take(3).enumerate() {
                for [x, y] in [[0, 0], [1, 0], [0, 1], [5, 30], [31, 17]] {
                    let (is, wanted) = (f64::from(plane[y * n + x]), defined(n, field, [x, y]));
                    assert!(
                        (is - wanted).abs() < 1e-3,
                        "way {way}, field {field} at {x}, {y}: {is}, not {wanted}"
                    );
                }
            }
            assert!(fields.len() >= 3);
        }
    }
}
