//! What a scene's author is told about waves: errors, warnings, what `swell info` says and what `swell bake` refuses; and the
//! scenes that come along.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use swell::commands::{BakeOptions, Clock, CommandError, SceneSummary, bake, bake::Format};
use swell::scene::Scene;
use swell::sea::waves::{Kind, Model, Wave, evaluate};

const WAVES: &str = "[sea]\nmodel = 'waves'\n";

#[track_caller]
fn check(text: &str, message: &str) {
    match Scene::parse(text, "x.toml") {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => assert_eq!(error.to_string(), message),
    }
}

#[track_caller]
fn check_wave(keys: &str, message: &str) {
    check(&format!("{WAVES}[[sea.wave]]\n{keys}\n"), message);
}

fn waves(text: &str) -> Vec<Wave> {
    let scene = Scene::parse(text, "x.toml").unwrap();
    scene.sea.models.iter().flat_map(Model::waves).copied().collect()
}

#[test]
fn ranges_and_words() {
    check(
        "[sea]\nmodel = 'wave'\n",
        "x.toml:2:9: sea.model = 'wave' is not one of: \"fft\", \"waves\", \"fbm\"",
    );
    check_wave(
        "kind = 'round'",
        "x.toml:4:8: sea.wave.kind = 'round' is not one of: \"sine\", \"peaked\", \"gerstner\", \"circular\"",
    );
    check_wave("wavelength = 0", "x.toml:4:14: sea.wave.wavelength = 0 is out of range: 0.05 to 10000 m");
    check_wave(
        "kind = 'peaked'\nsharpness = 0.5",
        "x.toml:5:13: sea.wave.sharpness = 0.5 is out of range: 1 to 32",
    );
    check("[sea]\nmodel = 'fbm'\noctaves = 65\n", "x.toml:3:11: sea.octaves = 65 is out of range: 1 to 64");
    check(
        "[sea]\nmodel = 'fbm'\nkernel = 'cos'\n",
        "x.toml:3:10: sea.kernel = 'cos' is not one of: \"sine\", \"exp-sine\", \"gerstner\"",
    );
    check("[[layer]]\nmodel = 'fft'\n", "x.toml:2:9: layer.model = 'fft' is not one of: \"waves\", \"fbm\"");
    check(
        "[[layer]]\nmodel = 'fbm'\n[layer.foam]\nangle_amount = 0\n",
        "x.toml:4:16: layer.foam.angle_amount = 0 is out of range: 0.001 to 1",
    );
}

#[test]
fn keys_of_another_model_are_led_to_it() {
    check(
        "[[sea.wave]]\n",
        "x.toml:1:7: sea.wave is not a key of a scene; wave belongs under [sea] with model = \"waves\"",
    );
    check(
        &format!("{WAVES}wind_speed = 3\n"),
        "x.toml:3:1: sea.wind_speed is not a key of a scene; wind_speed belongs under [sea] with model = \"fft\"",
    );
    check(
        "[sea]\nmodel = 'fbm'\n[[sea.cascade]]\n",
        "x.toml:3:7: sea.cascade is not a key of a scene; cascade belongs under [sea] with model = \"fft\"",
    );
    check(
        "[[layer]]\noctaves = 3\n",
        "x.toml:2:1: layer.octaves is not a key of a scene; octaves belongs under [[layer]] with model = \"fbm\"",
    );
    check(
        "[sea]\nmodel = 'fbm'\namplitud = 3\n",
        "x.toml:3:1: sea.amplitud is not a key of a scene; did you mean amplitude?",
    );
}

#[test]
fn keys_that_a_kind_has_no_use_for() {
    check_wave("sharpness = 2", "x.toml:4:13: sea.wave.sharpness = 2 is for the kinds peaked and circular");
    check_wave("kind = 'peaked'\nq = 0.5", "x.toml:5:5: sea.wave.q = 0.5 is for the kind gerstner");
    check_wave("centre = [1, 2]", "x.toml:4:10: sea.wave.centre = [1, 2] is for the kind circular");
    check_wave(
        "kind = 'circular'\ndirection_deg = 3",
        "x.toml:5:17: sea.wave.direction_deg = 3 is for the kinds sine, peaked and gerstner",
    );
}

#[test]
fn gerstner_waves_say_how_steep_they_are_once() {
    check_wave(
        "kind = 'gerstner'\namplitude = 0.5",
        "x.toml:5:13: sea.wave.amplitude = 0.5 needs q beside it; or give steepness in its place",
    );
    check_wave(
        "kind = 'gerstner'\nq = 0.5",
        "x.toml:5:5: sea.wave.q = 0.5 needs amplitude beside it; or give steepness in its place",
    );
    check_wave(
        "kind = 'gerstner'\nsteepness = 0.5\namplitude = 1",
        "x.toml:5:13: sea.wave.steepness = 0.5 says it all: leave out amplitude and q, or give both in its place",
    );
}

#[test]
fn what_is_too_much() {
    let many = |count| format!("{WAVES}{}", "[[sea.wave]]\n".repeat(count));
    assert_eq!(waves(&many(32)).len(), 32);
    check(
        &many(33),
        "x.toml:35:1: sea.wave = [[sea.wave]] is one wave too many: at most 32, layers included",
    );
    check(
        "[sea]\nmodel = 'fbm'\noctaves = 40\n[[layer]]\nmodel = 'fbm'\noctaves = 25\n",
        "x.toml:4:1: layer = [[layer]] brings the octaves of all models to 65: at most 64",
    );
    Scene::parse(&"[[layer]]\n".repeat(4), "x.toml").unwrap();
    check(
        &"[[layer]]\n".repeat(5),
        "x.toml:5:1: layer = [[layer]] is one model too many: at most 4, that of [sea] included",
    );
    check(
        &format!("{WAVES}{}", "[[layer]]\n".repeat(4)),
        "x.toml:6:1: layer = [[layer]] is one model too many: at most 4, that of [sea] included",
    );
    check(
        "[sea]\nmodel = 'fbm'\noctaves = 40\nfrequency_ramp = 2\n",
        "x.toml:4:18: sea.frequency_ramp = 2 leads to 164926744166 rad/m in the last octave, more than 1000; give less, or fewer octaves",
    );
    check(
        "[sea]\nmodel = 'fbm'\n[sea.foam]\nrange = [0.5, 0.5]\n",
        "x.toml:4:9: sea.foam.range = [0.5, 0.5] does not ascend: give the lesser one first",
    );
}

fn steep(loops: &str) -> String {
    format!(
        "[sea]\nmodel = 'waves'\nloops = '{loops}'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 8\nsteepness = 0.9\n\
         [[sea.wave]]\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 5\namplitude = 0.1\nq = 1.2\n"
    )
}

#[test]
fn waves_that_loop_are_named_limited_or_refused() {
    let sums = "the steepness of sea.wave 1 (0.9), sea.wave 3 (0.6) sums to 1.5, more than 1";
    let allowed = Scene::parse(&steep("allow"), "x.toml").unwrap();
    assert_eq!(
        allowed.warnings,
        [format!(
            "x.toml:4:1: {sums}: the surface may loop through itself; give less, or sea.loops = \"limit\""
        )]
    );
    check(&steep("refuse"), &format!("x.toml:3:9: sea.loops = 'refuse' refuses this sea: {sums}; give less"));

    let limited = Scene::parse(&steep("limit"), "x.toml").unwrap();
    assert!(limited.warnings.is_empty());
    let [a, sine, b] = limited.sea.models[0].waves() else { panic!("three waves") };
    assert!((a.steepness() + b.steepness() - 1.0).abs() < 1e-12);
    assert!((a.steepness() - 0.6).abs() < 1e-12, "all are scaled alike");
    // The form with steepness scales height and width, that with q the width alone.
    assert!((a.amplitude - 0.6 / a.k).abs() < 1e-12 && b.amplitude == 0.1);
    assert_eq!((sine.kind, sine.amplitude), (Kind::Sine, 0.1));
}

#[test]
fn steepness_of_layers_counts_and_a_sum_of_one_does_not_loop() {
    let one = "[[sea.wave]]\nkind = 'gerstner'\nsteepness = 0.5\n";
    assert!(Scene::parse(&format!("{WAVES}{one}{one}"), "x").unwrap().warnings.is_empty());
    let layered =
        format!("{WAVES}{one}[[layer]]\nmodel = 'fbm'\nkernel = 'gerstner'\noctaves = 1\namplitude = 2\n");
    let warnings = Scene::parse(&layered, "x.toml").unwrap().warnings;
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0].contains("sea.wave 1 (0.5), the octaves of a [[layer]] (0.6) sums to 1.1"),
        "{warnings:?}"
    );
}

#[test]
fn info_tells_speeds_periods_and_the_loop() {
    let summary = |text: &str| SceneSummary::new(&Scene::parse(text, "x.toml").unwrap());
    let text = |summary: &SceneSummary| {
        let mut out = Vec::new();
        summary.write_text(&mut out).unwrap();
        String::from_utf8(out).unwrap()
    };
    // The tutorial's own pair: the long wave is twice as fast, its period is the loop.
    let pair = format!(
        "{WAVES}gravity = 9.8\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 64\nsteepness = 0.25\n[[sea.wave]]\nwavelength = 16\n"
    );
    let pair = summary(&pair);
    assert!(pair.cascades.is_empty(), "no spectrum, no patches");
    assert_eq!(
        text(&pair).lines().skip(1).collect::<Vec<_>>(),
        [
            "    waves 1: gerstner, wavelength 64.000 m, amplitude 2.546 m, speed 9.991 m/s, period 6.406 s, steepness 0.250",
            "    waves 2: sine, wavelength 16.000 m, amplitude 0.100 m, speed 4.996 m/s, period 3.203 s",
            "    loop of 6.406 s",
        ]
    );
    let none = summary(&format!("{WAVES}[[sea.wave]]\nwavelength = 64\n[[sea.wave]]\nwavelength = 17\n"));
    assert_eq!(none.loop_length, None);
    assert!(
        text(&none)
            .ends_with("    no loop: the periods have no common multiple; sea.loop_period makes one\n")
    );
    let made = summary(&format!(
        "{WAVES}loop_period = 12\n[[sea.wave]]\nwavelength = 64\n[[sea.wave]]\nwavelength = 17\nspeed = -4\n"
    ));
    assert!((made.loop_length.unwrap() - 12.0).abs() < 1e-9, "{:?}", made.loop_length);
    assert!(made.models[0].waves[1].speed < 0.0 && made.models[0].waves[1].period.unwrap() > 0.0);
    let still = summary(&format!("{WAVES}[[sea.wave]]\nspeed = 0\n"));
    assert_eq!((still.loop_length, still.models[0].waves[0].period), (Some(0.0), None));
    assert!(text(&still).contains("speed 0.000 m/s, stands still"));
    assert!(!text(&summary("")).contains("loop"), "a spectral sea is told about as before");
    let many = text(&summary("[sea]\nmodel = 'fbm'\noctaves = 40\n"));
    assert!(
        many.lines().last().unwrap().starts_with("    in a headset: 40 waves and octaves are more"),
        "{many}"
    );
}

#[test]
fn formulas_are_not_baked() {
    let folder = tempfile::tempdir().unwrap();
    let options = BakeOptions {
        out: folder.path().join("out"),
        frames: "1".parse().unwrap(),
        clock: Clock::new(0.0, 30.0).unwrap(),
        format: Format::Npy,
        threads: 1,
    };
    for (text, what) in [(WAVES, "a [sea] model that is a formula"), ("[[layer]]\n", "a [[layer]]")] {
        let error = CommandError::from(bake(&Scene::parse(text, "x").unwrap(), &options).unwrap_err());
        assert_eq!(
            error.to_string(),
            format!(
                "nothing to bake: maps are of the spectrum alone, and this sea has {what}, which no map holds; ask `swell query` for \
                 its points"
            )
        );
        assert_eq!(error.exit_status(), 2);
        assert!(!options.out.exists(), "nothing half-written");
    }
}

#[test]
fn the_scenes_that_come_along_are_in_order() {
    for (name, waves, finest, loop_length) in [
        ("gerstner", 3, 16.0, Some(17.8)),
        ("sum_of_sines", 4, 16.0, None),
        ("pond", 4, 4.0, None),
        ("fbm_sea", 32, 16.0, None),
    ] {
        let scene = Scene::load(format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
        assert_eq!(scene.warnings, Vec::<String>::new(), "{name}");
        assert!(!scene.sea.spectral && scene.sea.models.len() == 1);
        assert_eq!(scene.lod.size / 2_f64.powi(scene.lod.levels.unwrap() as i32), finest, "{name}");
        let summary = SceneSummary::new(&scene);
        assert_eq!(summary.models[0].waves.len(), waves, "{name}");
        match (summary.loop_length, loop_length) {
            (Some(found), Some(wanted)) => assert!((found - wanted).abs() < 1e-9, "{name}: {found}"),
            (found, wanted) => assert_eq!(found, wanted, "{name}"),
        }
        // Nobody stands under water.
        assert!(scene.lod.max_height.unwrap() < scene.camera.eye[1], "{name}");
    }
}

#[test]
fn foam_of_the_fractal_sea_is_here_and_there() {
    let scene = Scene::load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/fbm_sea.toml")).unwrap();
    let points = (0..60).flat_map(|i| (0..60).map(move |j| [1.31 * f64::from(i), 1.77 * f64::from(j)]));
    let cover = points.map(|q| evaluate(&scene.sea.models, q, 10.0).foam).sum::<f64>() / 3600.0;
    assert!((0.01..0.15).contains(&cover), "{cover}");
}
