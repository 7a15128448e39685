//! The sea written for reading: one scalar `f64` function per stage, named like the stage it explains, straight from the
//! printed equations. Slow, allocating, and what the tests compare with.
pub mod displacement;
pub mod evolve;
pub mod fft;
pub mod gradient;
pub mod mips;
pub mod spectrum;
