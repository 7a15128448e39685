//! The inverse transform of eq (1) in two dimensions: three real fields from half their spectra.
//!
//! field(x) = sum over k of field(k) e^{+i k.x}, unscaled. [`columns`] runs along v for each tile of ku, [`rows`] along u for
//! each unit of rows; [`layout`] says how the numbers lie in between.
pub mod butterfly;
pub mod columns;
pub mod layout;
pub mod rows;
mod three_fields;
pub mod twiddles;

pub use three_fields::ThreeFields;

/// Runs a [`crate::sea::simd::Kernel`] `$kernel<R1, R2, M>` on `$isa`, compiled for each size `$n`, N = R1 x R2 = 16 x M, as
/// [`layout::Layout::new`] and [`rows`] cut them.
macro_rules! run_sized {
    ($isa:expr, $n:expr, $kernel:ident { $($field:ident $(: $value:expr)?),* $(,)? }) => {
        match $n {
            16 => $isa.run($kernel::<4, 4, 1> { $($field $(: $value)?),* }),
            32 => $isa.run($kernel::<4, 8, 2> { $($field $(: $value)?),* }),
            64 => $isa.run($kernel::<8, 8, 4> { $($field $(: $value)?),* }),
            128 => $isa.run($kernel::<8, 16, 8> { $($field $(: $value)?),* }),
            256 => $isa.run($kernel::<16, 16, 16> { $($field $(: $value)?),* }),
            512 => $isa.run($kernel::<16, 32, 32> { $($field $(: $value)?),* }),
            n => unreachable!("a layout of {n} points"),
        }
    };
}
pub(in crate::sea) use run_sized;
