//! Vectors against plain arithmetic, on every instruction set of this machine; and one sea on all of them.
#![allow(clippy::expect_used, reason = "a test may panic")]
mod sea_common;
use half::f16;
use sea_common::{cascades, settings};
use swell::jobs::Workers;
use swell::sea::gradient::length;
use swell::sea::simd::{
    Aligned, Channels, ChannelsMut, Float, Isa, Kernel, MAX_LANES, Simd, Strided, StridedMut, Texels,
};
use swell::sea::{Sea, SeaMaps, SeaSettings, Spectrum};

/// 0, 1, 2, .. from `first`.
fn count<S: Simd>(simd: S, first: usize) -> S::F32 {
    let numbers: [f32; MAX_LANES] = std::array::from_fn(|lane| (first + lane) as f32);
    simd.load(&numbers)
}

fn lanes<V: Float>(value: V) -> Vec<f32> {
    let mut lanes = [f32::NAN; MAX_LANES];
    value.store(&mut lanes);
    lanes[..V::LANES].to_vec()
}

/// What moves lanes about.
struct Shuffles;

impl Kernel for Shuffles {
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let l = S::LANES;
        let mut rows = [simd.splat(0.0); MAX_LANES];
        for (row, vector) in rows.iter_mut().enumerate() {
            *vector = count(simd, row * MAX_LANES);
        }
        simd.transpose(&mut rows);
        for (row, vector) in rows[..l].iter().enumerate() {
            let truth: Vec<f32> = (0..l).map(|lane| (lane * MAX_LANES + row) as f32).collect();
            assert_eq!(lanes(*vector), truth, "{l} lanes, transposed row {row}");
        }
        let mirrored = lanes(count(simd, 1).mirrored(count(simd, 100)));
        let truth: Vec<f32> =
            (0..l).map(|lane| if lane == 0 { 100.0 } else { (1 + l - lane) as f32 }).collect();
        assert_eq!(mirrored, truth);
        let sums = lanes(count(simd, 0).pair_sums(count(simd, l), simd.splat(0.25)));
        let truth: Vec<f32> = (0..l).map(|lane| (4 * lane + 1) as f32 / 4.0).collect();
        assert_eq!(sums, truth);
        let table: Vec<[f32; 2]> = (0..300).map(|i| [i as f32, -(i as f32)]).collect();
        let indices: [u16; MAX_LANES] = std::array::from_fn(|lane| (lane * 71 % 300) as u16);
        let [first, second] = simd.pairs(&table, &indices);
        let truth: Vec<f32> = indices[..l].iter().map(|&index| f32::from(index)).collect();
        assert_eq!(lanes(first), truth);
        assert_eq!(lanes(-second), truth);
        assert_eq!(
            lanes(count(simd, 1) / simd.splat(3.0)),
            (1..=l).map(|i| i as f32 / 3.0).collect::<Vec<_>>()
        );
    }
}

/// Texels read here and there: all finite halves, in every place of a texel.
struct Reads<'a>(&'a [[f16; 4]]);

impl Kernel for Reads<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let map = Texels::new(self.0);
        let count = self.0.len() - 1;
        for first in 0..count as u32 {
            // Lanes far apart, the last ones beyond the end: indices are modulo the number of texels less one.
            let indices: [u32; MAX_LANES] = std::array::from_fn(|lane| first + 4099 * lane as u32);
            let got = simd.texel_pairs(map, &indices).map(|texels| texels.map(lanes));
            for (after, got) in got.iter().enumerate() {
                for (place, got) in got.iter().enumerate() {
                    for (lane, got) in got.iter().enumerate() {
                        let truth = self.0[indices[lane] as usize % count + after][place].to_f32();
                        assert_eq!(got.to_bits(), truth.to_bits(), "lane {lane}, number {place}: {truth}");
                    }
                }
            }
        }
    }
}

#[test]
fn texels_are_read_at_any_place() {
    let half = |bits: u16| {
        let half = f16::from_bits(bits);
        if half.is_finite() { half } else { f16::from_bits(bits ^ 0x4000) }
    };
    let texels: Vec<[f16; 4]> = (0..=u16::MAX)
        .chain([7])
        .map(|bits| [half(bits), half(bits.wrapping_mul(3)), half(!bits), half(bits.rotate_left(5))])
        .collect();
    for isa in Isa::available() {
        isa.run(Reads(&texels));
    }
}

/// Texels in half precision and in bytes.
struct Stores<'a>(&'a [f32]);

impl Kernel for Stores<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        for values in self.0.windows(MAX_LANES + 3).step_by(5) {
            let mut texels = [simd.splat(0.0); 4];
            for (channel, texel) in texels.iter_mut().enumerate() {
                *texel = simd.load(&values[channel..]);
            }
            let mut halves = [[f16::ZERO; 4]; MAX_LANES];
            S::F32::store_halves(texels, &mut halves);
            for (lane, texel) in halves[..S::LANES].iter().enumerate() {
                for (channel, &half) in texel.iter().enumerate() {
                    let truth = f16::from_f32(values[channel + lane]);
                    assert_eq!(half.to_bits(), truth.to_bits(), "{} as half", values[channel + lane]);
                }
            }
        }
        let mut bytes = [[7; 4]; MAX_LANES];
        let mut texels = [count(simd, 0); 4];
        texels[1] = texels[1] + simd.splat(239.0);
        texels[2] = texels[2] * simd.splat(0.5);
        texels[3] = simd.splat(254.6);
        texels[0] = texels[0] - simd.splat(3.0);
        S::F32::store_bytes(texels, &mut bytes);
        for (lane, texel) in bytes[..S::LANES].iter().enumerate() {
            // Ties to even.
            let tie = (lane as f32 * 0.5).round_ties_even() as u8;
            assert_eq!(*texel, [lane.saturating_sub(3) as u8, lane as u8 + 239, tie, 255]);
        }
        assert!(bytes[S::LANES..].iter().all(|texel| *texel == [7; 4]), "wrote too far");
    }
}

struct Length([f32; 3]);

impl Kernel for Length {
    type Output = f32;
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f32 {
        lanes(length(simd, self.0.map(|component| simd.splat(component))))[0]
    }
}

#[test]
fn lanes_go_where_they_should() {
    for isa in Isa::available() {
        isa.run(Shuffles);
    }
}

#[test]
fn texels_are_rounded_as_the_standard_says() {
    // Every half, the middle between it and the next, and what is next to that; subnormal, too small and too large ones too.
    let mut values = vec![0.0, -0.0, 1e-10, -3e-8, 65519.0, 65520.0, 1e9, -1e30];
    for bits in (0..0x7c00_u16).step_by(3) {
        let (low, high) = (f16::from_bits(bits).to_f32(), f16::from_bits(bits + 1).to_f32());
        let middle = 0.5 * (low + high);
        let next = |value: f32, step: i32| f32::from_bits(value.to_bits().wrapping_add_signed(step));
        values.extend([low, -middle, next(middle, 1), -next(middle.max(1e-20), -1)]);
    }
    values.retain(|value| value.is_finite());
    for isa in Isa::available() {
        isa.run(Stores(&values));
    }
}

#[test]
fn normals_may_be_divided_by_their_length() {
    for isa in Isa::available() {
        assert_eq!(isa.run(Length([2.0, 3.0, -6.0])), 7.0, "{isa}");
        let none = isa.run(Length([0.0; 3]));
        assert!(none > 0.0 && (1.0 / none).is_finite(), "{isa}: {none}");
    }
}

struct Beyond(usize);

impl Kernel for Beyond {
    type Output = ();
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let mut numbers = Aligned::<f32>::zeros(4 * S::LANES);
        assert_eq!(numbers.as_ptr() as usize % 64, 0);
        match self.0 {
            0 => drop(Strided::new(simd, &numbers, 1, S::LANES, 4)),
            1 => drop(Strided::new(simd, &numbers, 0, S::LANES, 4).load(4)),
            2 => drop(Strided::reaching(simd, &numbers, 0, S::LANES, 3, 1).load_after(0, 2)),
            3 => drop(StridedMut::new(simd, &mut numbers, usize::MAX - 3, 2, 2)),
            4 => {
                StridedMut::reaching(simd, &mut numbers, 0, S::LANES, 3, 1).store_after(0, 2, simd.splat(1.0))
            }
            5 => drop(Strided::reaching(simd, &numbers, 0, S::LANES, 3, 1).load_halves(0, 0, 2)),
            6 => drop(Strided::reaching(simd, &numbers, 0, S::LANES, 3, 1).load_halves(0, 1, 1)),
            7 => drop(Channels::<S, 2>::new(simd, &numbers, 1, S::LANES, 3)),
            8 => drop(Channels::<S, 2>::new(simd, &numbers, 0, S::LANES, 1).load(0, 2)),
            9 => drop(ChannelsMut::<S, 2>::new(simd, &mut numbers, 0, usize::MAX, 1)),
            10 => ChannelsMut::<S, 2>::new(simd, &mut numbers, 0, S::LANES, 1).store(1, 0, simd.splat(1.0)),
            11 => drop(simd.pairs(&[[0.0; 2]; 3], &[3; MAX_LANES])),
            12 => drop(simd.texel_pairs(Texels::new(&[[f16::ZERO; 4]; 5]), &[3; MAX_LANES][..S::LANES - 1])),
            13 => drop(Texels::new(&[[f16::ZERO; 4]; 4])),
            14 => {
                let _ = Strided::reaching(simd, &numbers, 0, S::LANES, 2, S::LANES).load_neighbours(0, 0);
            }
            _ => {
                let short = Strided::reaching(simd, &numbers, 0, S::LANES, 2, S::LANES);
                let _ = short.load_neighbours(1, S::LANES);
            }
        }
    }
}

#[test]
fn nothing_is_read_or_written_beyond_a_slice() {
    for isa in Isa::available() {
        for case in 0..16 {
            let caught = std::panic::catch_unwind(|| isa.run(Beyond(case)));
            assert!(caught.is_err(), "{isa}, case {case}");
        }
    }
}

#[test]
fn names_are_read_and_others_refused() {
    for isa in Isa::available() {
        assert_eq!(isa.name().parse(), Ok(isa));
    }
    let error = "mmx".parse::<Isa>().expect_err("no such set").to_string();
    assert!(error.contains("'mmx'") && error.contains("scalar"), "{error}");
}

fn stepped(settings: &SeaSettings, isa: Isa, threads: usize) -> SeaMaps {
    Workers::new(threads).expect("threads").run(|| {
        let mut sea = Sea::with_isa(settings, isa).expect("valid");
        let mut maps = sea.new_maps_with_planes();
        for time in [3.0, 3.05] {
            sea.step(time, &mut maps).expect("a step");
        }
        maps
    })
}

/// Seas of every size, with foam's memory and without.
fn seas() -> Vec<SeaSettings> {
    let sized = [16, 32, 64, 128, 256, 512].map(|n| {
        let mut sea = settings(Spectrum::Jonswap);
        sea.cascades[0].resolution = n;
        sea
    });
    sized.into_iter().chain([cascades()]).collect()
}

#[test]
fn fused_instruction_sets_make_one_sea_with_any_number_of_threads() {
    for (index, sea) in seas().iter().enumerate() {
        let mut first: [Option<(Isa, SeaMaps)>; 2] = [None, None];
        for isa in Isa::available() {
            for threads in [1, 2, 3] {
                let maps = stepped(sea, isa, threads);
                match &first[usize::from(isa.rounds_products())] {
                    Some((other, same)) => {
                        assert!(*same == maps, "sea {index}: {isa}, {threads} threads, differs from {other}");
                    }
                    slot => {
                        assert!(slot.is_none());
                        first[usize::from(isa.rounds_products())] = Some((isa, maps));
                    }
                }
            }
        }
    }
}

/// FNV-1a.
fn digest(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes
        .into_iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[test]
fn a_headset_and_a_desktop_share_one_sea() {
    // The same constant on x86 and on ARM: the maps of a step, bit for bit.
    let Some(isa) = Isa::available().find(|isa| !isa.rounds_products()) else {
        panic!("this machine has no instruction set with fused multiply-add, which this test is about");
    };
    let maps = stepped(&cascades(), isa, 1);
    let digests: Vec<u64> = maps
        .cascades
        .iter()
        .map(|cascade| {
            let halves = cascade.displacement.iter().flatten().flat_map(|half| half.to_le_bytes());
            digest(halves.chain(cascade.gradient.iter().flatten().copied()))
        })
        .collect();
    assert_eq!(digests, EXPECTED, "on {isa}");
}

/// Made on AVX-512; what changes the sea's arithmetic changes it.
const EXPECTED: [u64; 3] = [10978533496912486910, 5207610665110530085, 4593365475886502888];
