//! Each stage against its scalar reference and the printed equations.
mod sea_common;
use half::f16;
use sea_common::{SPECTRA, cascades, maps, planes, settings};
use swell::sea::fft::layout::{Layout, TILE};
use swell::sea::gradient::normal_length;
use swell::sea::mips::{Absorb, BandMaps, Pyramid};
use swell::sea::philox::{gaussian, philox4x32};
use swell::sea::reference::{displacement::displacement, gradient, mips, spectrum as reference};
use swell::sea::simd::{Aligned, Isa, Kernel, Simd};
use swell::sea::spectrum::{PackedSpectrum, power, signed};
use swell::sea::{
    CascadeSettings, NormalKind, Spectrum, expected_variance, mip_levels, mip_offset, split_bands,
};

#[test]
fn philox_gives_random123s_known_answers() {
    let pi = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
    let cases = [
        ([0; 4], [0; 2], [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]),
        ([!0; 4], [!0; 2], [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]),
        (pi, [0xa409_3822, 0x299f_31d0], [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]),
    ];
    for (counter, key, words) in cases {
        assert_eq!(philox4x32(counter, key), words);
    }
}

#[test]
fn gaussians_are_gaussian() {
    let values: Vec<f64> =
        (-100..100).flat_map(|i| (0..100).flat_map(move |j| gaussian(9, i, j, 2))).collect();
    let moment = |p: i32| values.iter().map(|v| v.powi(p)).sum::<f64>() / values.len() as f64;
    // Standard errors at 40 000 values: 0.005, 0.007, 0.05.
    assert!(moment(1).abs() < 0.02 && (moment(2) - 1.0).abs() < 0.03 && (moment(4) - 3.0).abs() < 0.2);
    let pairs: f64 = values.chunks(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / 20_000.0;
    assert!(pairs.abs() < 0.03);
}

#[test]
fn packed_amplitudes_are_the_references() {
    for spectrum in SPECTRA {
        let sea = settings(spectrum);
        let cascade = &sea.cascades[0];
        let n = cascade.resolution;
        let layout = Layout::new(n).expect("a layout");
        let packed =
            PackedSpectrum::new(cascade, sea.gravity, sea.repeat_period, 3, layout).expect("a spectrum");
        let waves = reference::spectrum(cascade, sea.gravity, sea.repeat_period, 3);
        let largest = waves.iter().map(|w| w.along[0].abs()).fold(0.0, f64::max);
        for ku in 0..n / 2 {
            let (tile, lane) = (packed.tile(ku / TILE), ku % TILE);
            assert_eq!(tile.first_ku, ku - lane);
            for kv in 0..n {
                let centred = |i: usize| (signed(i, n) + n as i32 / 2) as usize;
                let wave = &waves[centred(kv) * n + centred(ku)];
                let [[a, b], [c, d]] = [wave.along, wave.against];
                let truth = [a + c, b + d, b - d, c - a];
                let got = [0, 1, 2, 3].map(|part| f64::from(tile.amplitudes[(4 * kv + part) * TILE + lane]));
                assert!(truth.iter().zip(got).all(|(t, g)| (t - g).abs() < 1e-6 * largest), "{ku} {kv}");
                if got != [0.0; 4] {
                    let at = kv.min(n - kv) * TILE + lane;
                    let omega = f64::from(packed.harmonics[usize::from(tile.harmonic[at])])
                        * std::f64::consts::TAU
                        / sea.repeat_period;
                    assert!((omega - wave.omega).abs() < 1e-9, "omega at {ku} {kv}");
                    let length = (ku as f64).hypot(f64::from(signed(kv, n)));
                    let inverse = f64::from(tile.inverse[at]);
                    assert!((inverse * length / cascade.choppiness - 1.0).abs() < 1e-7, "1/k at {ku} {kv}");
                }
            }
        }
    }
}

#[test]
fn a_finer_grid_keeps_the_waves_it_had() {
    let mut cascade = settings(Spectrum::Jonswap).cascades[0].clone();
    cascade.small_wave_suppression = 0.0;
    let still_coarse = swell::sea::spectrum::initial_amplitude(&cascade, 9.81, 0, 3, -5);
    cascade.resolution = 512;
    assert_eq!(still_coarse, swell::sea::spectrum::initial_amplitude(&cascade, 9.81, 0, 3, -5));
    assert_ne!(still_coarse, swell::sea::spectrum::initial_amplitude(&cascade, 9.81, 1, 3, -5));
}

#[test]
fn spectra_have_their_known_properties() {
    for spectrum in SPECTRA {
        let cascade = settings(spectrum).cascades[0].clone();
        assert_eq!(power(&cascade, 9.81, 0, 0), 0.0, "eq (14)");
        // alpha = 1: one per cent of the energy runs against the wind (8), none across it (7).
        let ratio = power(&cascade, 9.81, -4, 2) / power(&cascade, 9.81, 4, -2);
        assert!((ratio - 0.01).abs() < 1e-12, "{ratio}");
        assert!(power(&cascade, 9.81, 0, 4) < 1e-60);
    }
    // Phillips by hand, eqs (3)-(11).
    let cascade = settings(Spectrum::Phillips).cascades[0].clone();
    let k = std::f64::consts::TAU / 80.0 * 6.0;
    let largest = 49.0 / 9.81;
    let cutoff = 0.001 * (20.0_f64 / 0.001).powf(0.6);
    let by_hand =
        64_f64.powf(-0.5) * (std::f64::consts::E / 80.0).powi(2) * (-1.0 / (k * largest).powi(2)).exp()
            / k.powi(4)
            * (-(k * cutoff).powi(2)).exp()
            * 0.09;
    assert!((power(&cascade, 9.81, 6, 0) / by_hand - 1.0).abs() < 1e-12);
    // TMA in deep water is JONSWAP; in shallow water it is lower.
    let jonswap = settings(Spectrum::Jonswap).cascades[0].clone();
    let tma = |depth| CascadeSettings { spectrum: Spectrum::Tma, depth, ..jonswap.clone() };
    let deep = expected_variance(&tma(1000.0), 9.81) / expected_variance(&jonswap, 9.81);
    assert!((deep - 1.0).abs() < 1e-9, "{deep}");
    assert!(expected_variance(&tma(2.0), 9.81) < 0.5 * expected_variance(&jonswap, 9.81));
}

#[test]
fn variance_of_a_fine_grid_is_the_integral_of_the_frequency_spectrum() {
    // m0 = integral of S: a trapezium over omega, independent of direction and grid.
    let cascade = CascadeSettings {
        patch_size: 600.0,
        resolution: 512,
        small_wave_suppression: 0.0,
        ..Default::default()
    };
    let (wind, fetch, g) = (10.0_f64, 1e5_f64, 9.81_f64);
    let peak = 22.0 * (g * g / (wind * fetch)).cbrt();
    let alpha = 0.076 * (wind * wind / (fetch * g)).powf(0.22);
    let s = |w: f64| {
        let sigma = if w <= peak { 0.07 } else { 0.09 };
        let r = (-((w - peak) / (sigma * peak)).powi(2) / 2.0).exp();
        alpha * g * g * w.powi(-5) * (-1.25 * (peak / w).powi(4)).exp() * 3.3_f64.powf(r)
    };
    let highest = (g * std::f64::consts::TAU / 600.0 * 256.0).sqrt();
    let steps = 200_000;
    let dw = (highest - 0.2) / f64::from(steps);
    let integral: f64 = (0..steps).map(|i| s(0.2 + (f64::from(i) + 0.5) * dw) * dw).sum();
    let sum = expected_variance(&cascade, g);
    assert!((sum / integral - 1.0).abs() < 0.02, "{sum} m^2, integral {integral} m^2");
}

#[test]
fn gradients_and_bytes_are_the_references() {
    for normals in [NormalKind::Exact, NormalKind::Sheet] {
        let mut sea = settings(Spectrum::Jonswap);
        sea.normals = normals;
        sea.cascades[0].roughness = 0.3;
        let cascade = &sea.cascades[0];
        let n = cascade.resolution;
        let map = &maps(&sea, 21.0).cascades[0];
        let (field, _) = displacement(cascade, sea.gravity, sea.repeat_period, 0, 21.0);
        let mut level = gradient::gradient(&field, cascade, normals);
        let mut side = n;
        for m in 0..mip_levels(n) {
            let stored = &map.gradient[mip_offset(n, m)..mip_offset(n, m + 1)];
            assert_eq!(stored.len(), level.len());
            for (at, (bytes, texel)) in stored.iter().zip(&level).enumerate() {
                for (byte, truth) in bytes.iter().zip(gradient::unrounded(*texel)) {
                    // Half a unit of rounding, and f32's error seen through a square root.
                    assert!(
                        (f64::from(*byte) - truth).abs() < 0.52,
                        "level {m}, texel {at}: {byte}, {truth}"
                    );
                }
            }
            if side > 1 {
                level = mips::halve(&level, side);
                side /= 2;
            }
        }
    }
}

/// A texel of a mip level as bytes.
struct Pack([f32; 4], f32);

impl Kernel for Pack {
    type Output = [u8; 4];
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [u8; 4] {
        const SIDE: usize = 16;
        let pyramid = &Pyramid::new(2 * SIDE, self.1, 127.5);
        let mut kept = Aligned::zeros(Pyramid::scratch_len(2 * SIDE));
        {
            let (_, mut row) = pyramid.level_1(simd, 0, &mut kept);
            for (channel, value) in self.0.into_iter().enumerate() {
                for vector in 0..SIDE.div_ceil(S::LANES) {
                    row.store(vector, channel, simd.splat(value));
                }
            }
        }
        let (mut halves, mut bytes) = ([[f16::ZERO; 4]; SIDE], [[0; 4]; SIDE]);
        let mut maps = BandMaps {
            displacement: std::array::from_fn(|_| Default::default()),
            gradient: std::array::from_fn(|_| Default::default()),
        };
        (maps.displacement[1], maps.gradient[1]) = (&mut halves, &mut bytes);
        simd.run(Absorb { pyramid, level: 1, row: 0, top: 1, kept: &mut kept, maps: &mut maps });
        assert!(bytes.iter().all(|texel| *texel == bytes[0]));
        bytes[0]
    }
}

#[test]
fn packing_is_as_printed() {
    for isa in Isa::available() {
        let pack = |texel, length| isa.run(Pack(texel, length));
        assert_eq!(pack([0.0, 1.0, 0.0, 1.0], 1.0), [128, 128, 255, 255], "{isa}");
        assert_eq!(pack([1.0, 0.0, 0.0, -1.0], 1.0), [255, 128, 0, 255], "{isa}");
        assert_eq!(pack([0.0, 0.0, -0.5, 0.0], 1.0), [128, 0, 128, 0], "{isa}");
        assert_eq!(pack([0.0, 0.0, 0.0, f32::INFINITY], 1.0), [128, 128, 255, 0], "{isa}");
        // Lengths of 2/3 and less are as rough as water gets. At t = 1/2: r = 1 - 0.5 (0.85 + 0.075) = 0.5375.
        assert_eq!(pack([0.0, 0.66, 0.0, 0.0], 1.0)[3], 0, "{isa}");
        assert_eq!(
            pack([0.0, 1.0, 0.0, 0.0], 5.0 / 6.0)[3],
            (255.0 * (1.0 - 0.5375_f32.sqrt())).round() as u8
        );
    }
    assert_eq!([normal_length(0.0), normal_length(1.0)], [1.0, 0.5]);
}

#[test]
fn displacement_mips_average_all_four_channels() {
    for map in &maps(&cascades(), 2.0).cascades {
        let n = map.resolution;
        let planes = [&planes(map).du, &planes(map).height, &planes(map).dv];
        for (at, texel) in map.displacement[..n * n].iter().enumerate() {
            assert!((0..3).all(|i| texel[i] == f16::from_f32(planes[i][at])));
        }
        for level in 1..mip_levels(n) {
            let upper: Vec<[f64; 4]> = map.displacement[mip_offset(n, level - 1)..mip_offset(n, level)]
                .iter()
                .map(|texel| texel.map(f64::from))
                .collect();
            let stored = &map.displacement[mip_offset(n, level)..mip_offset(n, level + 1)];
            for (texel, truth) in stored.iter().zip(mips::halve(&upper, n >> (level - 1))) {
                for (got, truth) in texel.iter().zip(truth) {
                    // Halves of up to 4 m are 2^-9 m apart; five of them are rounded.
                    assert!((f64::from(*got) - truth).abs() < 2e-3, "level {level}: {got} {truth}");
                }
            }
        }
    }
}

#[test]
fn offsets_follow_eq_55() {
    for n in [16, 32, 64, 128, 256, 512] {
        assert_eq!(mip_levels(n), n.ilog2() as usize + 1);
        for level in 0..=mip_levels(n) {
            assert_eq!(mip_offset(n, level), mips::offset(n, level), "N = {n}, level {level}");
        }
    }
}

#[test]
fn bands_join() {
    let patches = [(400.0, 256), (61.0, 256), (11.0, 128)];
    let bands = split_bands(&patches);
    assert_eq!(bands[0][0], 0.0);
    assert_eq!(bands[2][1], f64::INFINITY);
    for (pair, size) in bands.windows(2).zip([61.0, 11.0]) {
        assert_eq!(pair[0][1], pair[1][0]);
        let waves = pair[1][0] * size / std::f64::consts::TAU;
        assert!(waves > 2.0, "only {waves} waves along {size} m");
    }
    // Of the same grid, two bands hold what the whole holds.
    let whole = CascadeSettings { resolution: 64, ..Default::default() };
    let [low, high] =
        [[0.0, 0.4], [0.4, f64::INFINITY]].map(|band| CascadeSettings { band, ..whole.clone() });
    for i in -31..32 {
        for j in -31..32 {
            let [a, b, c] = [&low, &high, &whole].map(|part| power(part, 9.81, i, j));
            assert!((a == 0.0 || b == 0.0) && a + b == c);
        }
    }
    // Of different grids, nearly: the sum over coarse and fine waves approximates one integral.
    let patch = |size: f64, band| CascadeSettings {
        patch_size: size,
        resolution: 256,
        band,
        small_wave_suppression: 0.0,
        ..whole.clone()
    };
    let parts = expected_variance(&patch(400.0, [0.0, 0.5]), 9.81)
        + expected_variance(&patch(93.0, [0.5, f64::INFINITY]), 9.81);
    let all = expected_variance(&patch(400.0, [0.0, f64::INFINITY]), 9.81);
    assert!((parts / all - 1.0).abs() < 0.02, "{parts} {all}");
}
