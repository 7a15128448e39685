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
