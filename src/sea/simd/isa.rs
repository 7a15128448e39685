//! Which instruction sets this processor has, and running a kernel on one.
#[cfg(target_arch = "aarch64")]
use super::neon::Neon;
use super::{Simd, scalar::Scalar};
#[cfg(target_arch = "x86_64")]
use super::{avx2::Avx2, avx512::Avx512, sse::Sse};
use std::{fmt, str::FromStr};

/// Work that is written once for all instruction sets.
pub trait Kernel {
    /// What it returns.
    type Output;
    /// Does it. Implementations are `#[inline(always)]`, see [`super`].
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// An instruction set that this processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isa(Set);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Set {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Sse(Sse),
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
    Scalar(Scalar),
}

impl Isa {
    /// Every one, the fastest first; plain Rust is always among them.
    pub fn available() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let vectors =
            [Avx512::detect().map(Set::Avx512), Avx2::detect().map(Set::Avx2), Sse::detect().map(Set::Sse)];
        #[cfg(target_arch = "aarch64")]
        let vectors = [Neon::detect().map(Set::Neon)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let vectors: [Option<Set>; 0] = [];
        vectors.into_iter().flatten().chain([Set::Scalar(Scalar)]).map(Self)
    }

    /// The fastest one.
    pub fn best() -> Self {
        Self::available().next().unwrap_or(Self(Set::Scalar(Scalar)))
    }

    /// The word for it: `avx512`, `avx2`, `sse`, `neon` or `scalar`.
    pub const fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(_) => "avx512",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Set::Sse(_) => "sse",
            #[cfg(target_arch = "aarch64")]
            Set::Neon(_) => "neon",
            Set::Scalar(_) => "scalar",
        }
    }

    /// Lanes of its vectors.
    pub const fn lanes(self) -> usize {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(_) => Avx512::LANES,
            #[cfg(target_arch = "x86_64")]
            Set::Avx2(_) => Avx2::LANES,
            #[cfg(target_arch = "x86_64")]
            Set::Sse(_) => Sse::LANES,
            #[cfg(target_arch = "aarch64")]
            Set::Neon(_) => Neon::LANES,
            Set::Scalar(_) => Scalar::LANES,
        }
    }

    /// Whether products are rounded before they are added, so that bits differ from those of sets that need not.
    pub const fn rounds_products(self) -> bool {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(_) | Set::Avx2(_) => false,
            #[cfg(target_arch = "x86_64")]
            Set::Sse(_) => true,
            #[cfg(target_arch = "aarch64")]
            Set::Neon(_) => false,
            Set::Scalar(_) => true,
        }
    }

    /// Runs `kernel` compiled for this instruction set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(simd) => simd.run(kernel),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2(simd) => simd.run(kernel),
            #[cfg(target_arch = "x86_64")]
            Set::Sse(simd) => simd.run(kernel),
            #[cfg(target_arch = "aarch64")]
            Set::Neon(simd) => simd.run(kernel),
            Set::Scalar(simd) => simd.run(kernel),
        }
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// There is no such instruction set here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("'{name}' is no instruction set of this processor: {}", list())]
pub struct NoSuchIsa {
    /// What was asked for.
    pub name: String,
}

fn list() -> String {
    Isa::available().map(Isa::name).collect::<Vec<_>>().join(", ")
}

impl FromStr for Isa {
    type Err = NoSuchIsa;

    fn from_str(name: &str) -> Result<Self, NoSuchIsa> {
        Self::available().find(|isa| isa.name() == name).ok_or_else(|| NoSuchIsa { name: name.to_owned() })
    }
}
