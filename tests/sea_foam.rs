//! Foam remembers, and is still a pure function of the time.
mod sea_common;
use proptest::prelude::*;
use sea_common::{cascades, maps, settings};
use swell::sea::foam::{self, Fading, MAX_COMPRESSION, Memory, foam};
use swell::sea::simd::{Float, Isa, Kernel, MAX_LANES, Simd};
use swell::sea::{FoamSettings, Sea, SeaSettings, Spectrum};

fn steep() -> SeaSettings {
    let mut sea = settings(Spectrum::Jonswap);
    sea.cascades[0].resolution = 32;
    sea.cascades[0].wind_speed = 12.0;
    sea.cascades[0].choppiness = 1.5;
    sea.foam.fade_time = 0.6;
    // 70 s are 700 ticks; a prime number of seconds would do as well.
    sea.repeat_period = 70.0;
    sea
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn maps_do_not_depend_on_the_way_there(times in prop::collection::vec(-80.0..150.0_f64, 1..5), last in 0..1500_u32) {
        // On ticks, between them, and across the loop's end.
        let last = f64::from(last) * 0.05;
        let settings = steep();
        let mut sea = Sea::new(&settings).expect("valid");
        let mut wandered = sea.new_maps_with_planes();
        for time in times {
            sea.step(time, &mut wandered).expect("a step");
        }
        for back in [3.0, 0.31, 0.1, 0.05, 0.0] {
            sea.step(last - back, &mut wandered).expect("a step");
        }
        prop_assert!(wandered == maps(&settings, last), "at {last} s");
    }
}

#[test]
fn what_a_tick_left_is_gone_after_the_window() {
    for (fade_time, period) in [(0.3, 200.0), (4.0, 200.0), (60.0, 200.0), (600.0, 33.3)] {
        let settings = FoamSettings { fade_time, ..FoamSettings::default() };
        let fading = Fading::new(&settings, period).expect("a memory");
        let left = |ticks| (0..ticks).fold(MAX_COMPRESSION, |m, _| Isa::best().run(Fade(m, fading.decay)));
        assert_eq!(left(fading.window), 0.0);
        assert!(left(fading.window - 1) > 0.0);
        let seconds = fading.window as f64 * period / fading.ticks as f64;
        assert!((seconds / fade_time - 2.0).abs() < 0.01 + 0.2 / fade_time, "{seconds} s");
    }
    assert_eq!(Fading::new(&FoamSettings { fade_time: 0.0, ..FoamSettings::default() }, 200.0), None);
}

#[test]
fn gaps_longer_than_the_memory_forget_it() {
    let fading =
        Fading::new(&FoamSettings { fade_time: 1.0, ..FoamSettings::default() }, 200.0).expect("a memory");
    let mut memory = Memory { tick: Some(1990), ..Memory::new(2) };
    memory.texels.fill(1.0);
    assert_eq!(memory.begin(1995, &fading), 5);
    assert_eq!(memory.begin(4, &fading), 14, "across the end of the loop");
    assert_eq!(*memory.texels, [1.0; 4]);
    assert_eq!(memory.begin(1000, &fading), fading.window);
    assert_eq!(*memory.texels, [0.0; 4]);
}

#[test]
fn foam_lingers_where_the_surface_was_squeezed_and_fades() {
    let mut remembering = steep();
    remembering.cascades[0].resolution = 64;
    remembering.cascades[0].small_wave_suppression = 0.3;
    remembering.cascades[0].choppiness = 1.3;
    remembering.foam.fade_time = 4.0;
    let mut forgetful = remembering.clone();
    forgetful.foam.fade_time = 0.0;
    let at = |settings: &SeaSettings, time| -> Vec<f32> {
        maps(settings, time).cascades[0].displacement[..64 * 64].iter().map(|t| t[3].to_f32()).collect()
    };
    // The memory at 8.03 s by hand: what every tick of the last eight seconds left, faded.
    let mut expected = at(&forgetful, 8.03);
    for tick in 0..=80 {
        let age = (8.03 - f64::from(tick) * 0.1) as f32;
        for (sum, now) in expected.iter_mut().zip(at(&forgetful, f64::from(tick) * 0.1)) {
            *sum = sum.max(now - age / 4.0);
        }
    }
    let found = at(&remembering, 8.03);
    assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 2e-3), "memory");
    let [kept, now] = [found, at(&forgetful, 8.03)].map(|values| values.iter().sum::<f32>());
    assert!(kept > 1.1 * now, "nothing lingers: {kept}, {now} without a memory");
}

/// The kernels' arithmetic, one lane of it.
struct Compression(f32, f32);

impl Kernel for Compression {
    type Output = f32;
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f32 {
        let mut lanes = [0.0; MAX_LANES];
        let breaking = simd.splat(self.1);
        foam::compression(simd, simd.splat(self.0), breaking, breaking).store(&mut lanes);
        lanes[0]
    }
}

struct Fade(f32, f32);

impl Kernel for Fade {
    type Output = f32;
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f32 {
        let mut lanes = [0.0; MAX_LANES];
        foam::fade(simd.splat(self.0), simd.splat(self.1), simd.splat(0.0)).store(&mut lanes);
        lanes[0]
    }
}

fn compression(jacobian: f32, breaking: f32) -> f32 {
    Isa::best().run(Compression(jacobian, breaking))
}

#[test]
fn compression_and_cover_have_their_known_values() {
    let whole = |jacobian| compression(jacobian, 1.0);
    assert_eq!([1.5, 1.0, 0.25, 0.0, -0.5, -7.0].map(whole), [0.0, 0.0, 0.75, 1.0, 1.5, 2.0]);
    assert_eq!(compression(0.0, 0.25), 0.25);
    let settings = FoamSettings { threshold: 0.4, width: 0.4, fade_time: 1.0 };
    assert_eq!(foam(&settings, 0.4), 0.0);
    assert!((foam(&settings, 0.6) - 0.5).abs() < 1e-12);
    assert_eq!(foam(&settings, 0.9), 1.0);
    let sharp = FoamSettings { width: 0.0, ..settings };
    assert_eq!([foam(&sharp, 0.39), foam(&sharp, 0.4)], [0.0, 1.0]);
    assert!(
        maps(&cascades(), 1.0).cascades.iter().all(|c| c.displacement.iter().all(|t| t[3].to_f32() <= 2.0))
    );
}
