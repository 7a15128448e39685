//! FFTW 3, single precision, planned PATIENT, in its three ways to three real fields.
//!
//! Every array is from FFTW's own allocator, so its SIMD codelets apply. Plans may destroy their input, as complex to
//! real must and as is fastest for the rest; the input is copied in anew before each call, outside the time, which also
//! leaves it in the cache. Input and output are different arrays: the safe interface has no transforms in place, and
//! those are no faster here (`docs/performance.md`).
use super::label;
use crate::commands::bench::BenchError;
use crate::commands::bench::fields::{half_spectrum, paired};
use crate::commands::bench::harness::{Body, Case};
use crate::commands::bench::sea::transform_work;
use fftw::array::AlignedVec;
use fftw::error::Error;
use fftw::plan::{C2CPlan, C2CPlan32, C2RPlan, C2RPlan32};
use fftw::types::{Flag, Sign, c32};

/// One transform of the whole grid.
enum Transform {
    Complex { plan: C2CPlan32, input: Input, output: AlignedVec<c32> },
    Real { plan: C2RPlan32, input: Input, output: AlignedVec<f32> },
}

/// A spectrum, and the array that it is copied to before each transform.
struct Input {
    kept: Vec<c32>,
    array: AlignedVec<c32>,
}

impl Input {
    /// Rows of the first `halves` components of `wave(half, whole)`.
    fn new(n: usize, halves: usize, wave: impl Fn(usize, usize) -> [f32; 2]) -> Self {
        let wave = |at: usize| {
            let [re, im] = wave(at % halves, at / halves);
            c32::new(re, im)
        };
        let kept: Vec<c32> = (0..n * halves).map(wave).collect();
        Self { array: AlignedVec::new(kept.len()), kept }
    }

    fn refill(&mut self) {
        self.array.copy_from_slice(&self.kept);
    }
}

const FLAGS: Flag = Flag::PATIENT.union(Flag::DESTROYINPUT);

impl Transform {
    /// a + i b of fields `a` and `b`, or a alone.
    fn complex(n: usize, a: usize, b: Option<usize>) -> Result<Self, Error> {
        let mut input = Input::new(n, n, |half, whole| paired(n, a, b, half, whole));
        let mut output = AlignedVec::new(n * n);
        let plan = C2CPlan::new(&[n, n], &mut input.array, &mut output, Sign::Backward, FLAGS)?;
        Ok(Self::Complex { plan, input, output })
    }

    /// One real field from half its spectrum.
    fn real(n: usize, field: usize) -> Result<Self, Error> {
        let mut input = Input::new(n, n / 2 + 1, |half, whole| half_spectrum(n, field, half, whole));
        let mut output = AlignedVec::new(n * n);
        let plan = C2RPlan::new(&[n, n], &mut input.array, &mut output, FLAGS)?;
        Ok(Self::Real { plan, input, output })
    }

    fn refill(&mut self) {
        match self {
            Self::Complex { input, .. } | Self::Real { input, .. } => input.refill(),
        }
    }

    /// The real fields that it gave: one or two, row by row.
    #[cfg(test)]
    fn fields(&self) -> Vec<Vec<f32>> {
        match self {
            Self::Complex { output, .. } => {
                vec![output.iter().map(|c| c.re).collect(), output.iter().map(|c| c.im).collect()]
            }
            Self::Real { output, .. } => vec![output.to_vec()],
        }
    }

    fn run(&mut self) -> Result<(), Error> {
        match self {
            Self::Complex { plan, input, output } => plan.c2c(&mut input.array, output),
            Self::Real { plan, input, output } => plan.c2r(&mut input.array, output),
        }
    }
}

/// Transforms that together give the three fields.
struct Way {
    n: usize,
    transforms: Vec<Transform>,
}

impl Body for Way {
    fn prepare(&mut self) {
        self.transforms.iter_mut().for_each(Transform::refill);
    }

    fn run(&mut self) -> Result<(), BenchError> {
        self.transforms.iter_mut().try_for_each(Transform::run).map_err(|error| failed(self.n, &error))
    }
}

fn failed(n: usize, error: &Error) -> BenchError {
    BenchError::Rival { rival: "FFTW", n, reason: error.to_string() }
}

/// The names of the ways and their transforms.
fn ways(n: usize) -> Result<[(&'static str, Vec<Transform>); 3], Error> {
    Ok([
        ("fftw3_2c2c", vec![Transform::complex(n, 0, Some(1))?, Transform::complex(n, 2, None)?]),
        ("fftw3_c2c_c2r", vec![Transform::complex(n, 0, Some(1))?, Transform::real(n, 2)?]),
        ("fftw3_3c2r", vec![Transform::real(n, 0)?, Transform::real(n, 1)?, Transform::real(n, 2)?]),
    ])
}

/// The three ways as cases; planning them takes seconds.
///
/// # Errors
/// [`BenchError::Rival`] when FFTW has no plan.
pub fn cases(n: usize) -> Result<Vec<Case>, BenchError> {
    let ways = ways(n).map_err(|error| failed(n, &error))?;
    let case = |(name, all)| Case::new(label(name, n), transform_work(n), Way { n, transforms: all });
    Ok(ways.into_iter().map(case).collect())
}

/// What the ways give for the three fields, by way.
#[cfg(test)]
pub fn results(n: usize) -> Vec<Vec<Vec<f32>>> {
    let ways = ways(n).unwrap().into_iter();
    ways.map(|(_, transforms)| {
        let mut way = Way { n, transforms };
        way.prepare();
        way.run().unwrap();
        way.transforms.iter().flat_map(Transform::fields).collect()
    })
    .collect()
}
