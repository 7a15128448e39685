//! What scene files that are in order turn into.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use swell::lod::{Quality, SignalSettings, Tessellation};
use swell::raft::{BuoySettings, Horizon, RaftSettings, Rider};
use swell::scene::{Scene, ShadowSettings, Shadows, SkySource, WAVE_LIMITS};
use swell::sea::{NormalKind, Sea, Spectrum, Surface, split_bands};

fn parse(text: &str) -> Scene {
    Scene::parse(text, "x.toml").unwrap()
}

#[test]
fn an_empty_file_is_a_scene_of_one_cascade_with_all_waves() {
    let scene = parse("");
    assert_eq!(scene.sea.cascades.len(), 1);
    let cascade = &scene.sea.cascades[0];
    assert_eq!(cascade.band, [0.0, f64::INFINITY]);
    assert_eq!(cascade.resolution, 256);
    assert_eq!(cascade.reference_resolution, 256);
    assert_eq!(cascade.spectrum, Spectrum::Jonswap);
    assert_eq!(scene.sea.repeat_period, 200.0);
    assert_eq!(scene.sky.source, SkySource::Daylight { turbidity: 3.0, clouds: 0.0 });
    assert_eq!(scene.lod.quality, Quality::Medium);
    assert_eq!(scene.lod.levels, None);
    assert_eq!(scene.lod.tessellation, Tessellation::Grid);
    assert_eq!(scene.raft, RaftSettings::default());
    assert_eq!(scene.buoys, []);
}

#[test]
fn headsets_have_shadows_only_where_the_scene_says_so() {
    for (text, anywhere, in_headset) in [
        ("", Shadows::Off, Shadows::Off),
        ("[water]\nshadows = 'screen'\n", Shadows::Screen, Shadows::Off),
        ("[water]\nshadows = 'on'\n", Shadows::On, Shadows::On),
    ] {
        let scene = parse(text);
        let worn = scene.in_headset();
        assert_eq!((scene.water.shadows.shadows, worn.water.shadows.shadows), (anywhere, in_headset));
        let water = swell::scene::WaterSettings { shadows: scene.water.shadows, ..worn.water };
        assert_eq!(Scene { water, ..worn }, scene, "and nothing else");
    }
}

#[test]
fn headsets_are_told_of_more_waves_than_they_have_time_for_and_get_them_all() {
    let octaves =
        |count: usize| format!("[[layer]]\nmodel = 'fbm'\noctaves = {count}\n[[layer]]\n[[layer.wave]]\n");
    let [least, most] = WAVE_LIMITS.map(|limit| limit.waves);
    assert!(least < most, "the table goes from the smaller one to the larger one");
    let fits = parse(&octaves(least - 1));
    assert_eq!((fits.in_headset().warnings, fits.sea.models.len()), (vec![], 2));
    for count in [least + 1, most + 1] {
        let scene = parse(&octaves(count - 1));
        let worn = scene.in_headset();
        let warning = format!(
            "{count} waves and octaves are more than a frame has time for: at most {least} on a Quest 2 at 72 Hz, {most} on a \
             Quest 3 at 90 Hz; give fewer, or frames come late"
        );
        assert_eq!(worn.warnings, [warning]);
        assert_eq!(worn.in_headset(), worn, "told once");
        assert_eq!(Scene { warnings: vec![], ..worn }, scene, "no wave is left out");
    }
}

#[test]
fn every_key_reaches_its_own_field() {
    let scene = parse(
        "[sea]\nmodel = 'fft'\nresolution = 64\npatch_size = 2\nwind_speed = 3\nwind_direction_deg = 90\n\
         alignment = 0.4\nchoppiness = 0.5\nsmall_wave_suppression = 0.6\nrepeat_period = 70\nroughness = 0.8\nbreaking = 0.7\n\
         amplitude = 9\nseed = 0x10\nspectrum = 'tma'\nfetch = 1_100\npeak_enhancement = 1.2\ndepth = 13\ngravity = 1.4\n\
         normals = 'sheet'\nfoam = { threshold = 1.5, width = 1.6, fade_time = 17 }\n\
         [lod]\nsize = 512\nquality = 'ultra'\nlevels = 3\nmax_height = 4\nreach = 5\nskirt_extent = 6\ntessellation = 'signal'\n\
         signal = { threshold = 100, density = 7, fresnel = [0.25, 0.75], distance = [8, 9] }\n\
         [sky]\nturbidity = 2\nclouds = 0.25\nsun_azimuth_deg = -180\nsun_elevation_deg = 90\nsun_intensity = 3\nexposure = -4\nvisibility = 500\n\
         [water]\ndeep_color = [0.1, 0.2, 0.3]\nscatter_color = [0.4, 0.5, 0.6]\nscatter = 7\nfoam_color = [0.8, 0.9, 1]\ndetail = 2.5\n\
         shadows = 'screen'\nshadow_resolution = 512\nshadow_distance = 90\n\
         [camera]\neye = [1, 2, 3]\nlook = [4, 5, 6]\nfov_deg = 90\neye_separation = 0.5\n\
         [raft]\nlength = 3\nwidth = 4\nfreeboard = 0.5\nheave_frequency = 0.6\nheave_damping = 0.75\ntilt_frequency = 0.8\n\
         tilt_damping = 0.9\nhorizon = 'still'\nheld_heave = 0.25\nglide_speed = 11\nglide_acceleration = 12\ndead_zone = 0.3\n\
         snap_turn_deg = 90\nsmooth_turn_deg = 180\nvignette = 0.4\n\
         [[buoy]]\nat = [1, -2]\nradius = 3\ncolor = [0.1, 0.2, 0.3]\nheight = 4\n[[buoy]]\n",
    );
    let sea = &scene.sea;
    let c = &sea.cascades[0];
    assert_eq!((c.resolution, c.reference_resolution, c.patch_size, c.wind_speed), (64, 64, 2.0, 3.0));
    assert_eq!((c.wind_direction, c.alignment, c.choppiness), (FRAC_PI_2, 0.4, 0.5));
    assert_eq!((c.small_wave_suppression, c.roughness, c.breaking), (0.6, 0.8, 0.7));
    assert_eq!((c.amplitude, c.seed), (9.0, 16));
    assert_eq!((c.spectrum, c.fetch, c.peak_enhancement, c.depth), (Spectrum::Tma, 1100.0, 1.2, 13.0));
    assert_eq!((sea.gravity, sea.repeat_period, sea.normals), (1.4, 70.0, NormalKind::Sheet));
    assert_eq!((sea.foam.threshold, sea.foam.width, sea.foam.fade_time), (1.5, 1.6, 17.0));
    let lod = &scene.lod;
    assert_eq!((lod.size, lod.quality, lod.levels), (512.0, Quality::Ultra, Some(3)));
    assert_eq!((lod.max_height, lod.reach, lod.skirt_extent), (Some(4.0), 5.0, 6.0));
    // No wave is as high as the threshold.
    let signal = SignalSettings { frequency: 0.0, density: 7.0, fresnel: [0.25, 0.75], distance: [8.0, 9.0] };
    assert_eq!(lod.tessellation, Tessellation::Signal(signal));
    let sky = &scene.sky;
    assert_eq!(sky.source, SkySource::Daylight { turbidity: 2.0, clouds: 0.25 });
    assert_eq!((sky.sun_azimuth, sky.sun_elevation, sky.sun_intensity), (-PI, FRAC_PI_2, 3.0));
    assert_eq!((sky.exposure, sky.visibility), (-4.0, 500.0));
    let water = &scene.water;
    assert_eq!((water.deep_color, water.scatter_color), ([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]));
    assert_eq!((water.scatter, water.foam_color, water.detail), (7.0, [0.8, 0.9, 1.0], 2.5));
    let shadows = ShadowSettings { shadows: Shadows::Screen, resolution: 512, distance: 90.0 };
    assert_eq!(water.shadows, shadows);
    let camera = &scene.camera;
    assert_eq!((camera.eye, camera.look), ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]));
    assert_eq!((camera.fov_y, camera.eye_separation), (FRAC_PI_2, 0.5));
    let raft = RaftSettings {
        length: 3.0,
        width: 4.0,
        freeboard: 0.5,
        heave_frequency: 0.6,
        heave_damping: 0.75,
        tilt_frequency: 0.8,
        tilt_damping: 0.9,
        horizon: Horizon::Still,
        held_heave: 0.25,
        glide_speed: 11.0,
        glide_acceleration: 12.0,
        dead_zone: 0.3,
        snap_turn: FRAC_PI_2,
        smooth_turn: PI,
        vignette: 0.4,
    };
    assert_eq!(scene.raft, raft);
    let given = BuoySettings { at: [1.0, -2.0], radius: 3.0, color: [0.1, 0.2, 0.3], height: 4.0 };
    let absent = BuoySettings { at: [0.0, -20.0], radius: 0.5, color: [0.8, 0.12, 0.02], height: 2.0 };
    assert_eq!(scene.buoys, [given, absent]);
}

/// The flagship's peak is near 0.08 rad/m with metres of amplitude; behind it amplitudes fall with the wave number.
#[test]
fn the_signal_ends_where_octaves_are_lower_than_the_threshold() {
    let frequency = |threshold: f64| {
        let text = format!(
            "[lod]\ntessellation = 'signal'\n[lod.signal]\nthreshold = {threshold}\n[sea]\nwind_speed = 14\nfetch = 110_000\npatch_size = 421\n"
        );
        match parse(&text).lod.tessellation {
            Tessellation::Signal(signal) => signal.frequency,
            Tessellation::Grid => panic!("the grid"),
        }
    };
    let frequencies = [0.5, 0.1, 0.05].map(frequency);
    assert!(
        frequencies.is_sorted() && frequencies[0] >= 0.125 / TAU && frequencies[2] < 2.0,
        "{frequencies:?}"
    );
    assert!(
        frequencies[1] >= 2.0 * frequencies[0] && frequencies[1] < 16.0 * frequencies[0],
        "{frequencies:?}"
    );
    assert_eq!(frequency(50.0), 0.0);
}

#[test]
fn cascades_override_the_sea_and_come_largest_first() {
    let scene = parse(
        "[sea]\nwind_speed = 7\nresolution = 128\nseed = 40\n\
         [[sea.cascade]]\npatch_size = 10\nrotation_deg = 90\nresolution = 32\n\
         [[sea.cascade]]\npatch_size = 300\nwind_speed = 8\n\
         [[sea.cascade]]\npatch_size = 50\nseed = 5\n",
    );
    let cascades = &scene.sea.cascades;
    let of = |f: fn(&swell::sea::CascadeSettings) -> f64| cascades.iter().map(f).collect::<Vec<_>>();
    assert_eq!(of(|c| c.patch_size), [300.0, 50.0, 10.0]);
    assert_eq!(of(|c| c.wind_speed), [8.0, 7.0, 7.0]);
    assert_eq!(of(|c| c.rotation), [0.0, 0.0, FRAC_PI_2]);
    assert_eq!(of(|c| c.resolution as f64), [128.0, 128.0, 32.0]);
    assert_eq!(of(|c| c.reference_resolution as f64), [128.0; 3]);
    assert_eq!(of(|c| c.seed as f64), [41.0, 5.0, 40.0]);
    let bands: Vec<_> = cascades.iter().map(|c| c.band).collect();
    assert_eq!(bands, split_bands(&[(300.0, 128), (50.0, 128), (10.0, 32)]));
}

#[test]
fn bands_given_are_kept() {
    let scene =
        parse("[[sea.cascade]]\nband = [0, 0.5]\n[[sea.cascade]]\npatch_size = 20\nband = [0.5, inf]\n");
    assert_eq!(scene.sea.cascades[0].band, [0.0, 0.5]);
    assert_eq!(scene.sea.cascades[1].band, [0.5, f64::INFINITY]);
}

#[test]
fn a_cubemap_is_found_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sky.png"), b"").unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, "[sky]\nmodel = 'cubemap'\nfile = 'sky.png'\n").unwrap();
    let scene = Scene::load(&path).unwrap();
    assert_eq!(scene.sky.source, SkySource::Cubemap { file: folder.path().join("sky.png") });
}

#[test]
fn the_scenes_that_come_along_are_in_order() {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/");
    for name in ["open_ocean.toml", "calm.toml", "storm.toml"] {
        let scene = Scene::load(format!("{scenes}{name}")).unwrap();
        let finest = scene.lod.size / 2f64.powi(scene.lod.levels.unwrap() as i32);
        assert_eq!(finest, 16.0, "{name}");
        Sea::new(&scene.sea).unwrap();
        // Bands join: the sum of the cascades is the whole spectrum.
        assert_eq!(scene.sea.cascades.len(), 3);
        assert_eq!(scene.sea.cascades[0].band[0], 0.0);
        assert_eq!(scene.sea.cascades[2].band[1], f64::INFINITY);
        for pair in scene.sea.cascades.windows(2) {
            assert_eq!(pair[0].band[1], pair[1].band[0], "{name}");
        }
    }
    let flagship = Scene::load(format!("{scenes}open_ocean.toml")).unwrap();
    assert_eq!(Scene::flagship().unwrap(), flagship);
    assert_eq!(flagship.sea.cascades[0].wind_speed, 14.0);
    assert_eq!(flagship.camera.eye[1], 4.0);
    // Significant wave heights, four standard deviations, are those the scenes' comments promise.
    for (name, height, tolerance) in [("open_ocean", 3.0, 0.3), ("calm", 0.4, 0.1), ("storm", 7.0, 1.0)] {
        let scene = Scene::load(format!("{scenes}{name}.toml")).unwrap();
        let significant = 4.0 * scene.sea.expected_rms_height();
        assert!((significant - height).abs() < tolerance, "{name}: {significant} m");
    }
}

/// Share of the sea under foam at 10 s, from points that repeat with no patch.
fn foam_cover(scene: &Scene) -> f64 {
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(10.0, &mut maps).unwrap();
    let points = (0..100).flat_map(|i| (0..100).map(move |j| [7.31 * f64::from(i), 7.77 * f64::from(j)]));
    points.map(|[x, z]| Surface::at_rest(&maps, x, z).foam).sum::<f64>() / 1e4
}

#[test]
fn foam_covers_as_much_as_the_wind_makes() {
    // Monahan and O'Muircheartaigh 1980: 3.84e-6 U^3.41, here within a factor of two, which is their own scatter.
    for (name, wind) in [("open_ocean", 14.0f64), ("storm", 25.0)] {
        let scene = Scene::load(format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let measured = 3.84e-6 * wind.powf(3.41);
        let cover = foam_cover(&scene);
        assert!((0.5..2.0).contains(&(cover / measured)), "{name}: {cover}, measured at sea {measured}");
    }
    let calm = Scene::load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/calm.toml")).unwrap();
    assert!(foam_cover(&calm) < 0.002);
}

#[test]
fn whatever_the_schema_allows_makes_a_sea() {
    let extremes = [
        "resolution = 16\npatch_size = 1\nwind_speed = 60\nfetch = 5e6\npeak_enhancement = 7\nchoppiness = 3\namplitude = 1000",
        "resolution = 512\npatch_size = 10000\nwind_speed = 1e-9\nfetch = 100\ndepth = 0.5\nspectrum = 'tma'\namplitude = 0",
        "repeat_period = 10\ngravity = 100\nwind_speed = 0\nfoam = { threshold = 0, width = 0.001, fade_time = 600 }",
        "repeat_period = 3600\ngravity = 0.1\nspectrum = 'phillips'\nalignment = 1\nsmall_wave_suppression = 1\nroughness = 1",
    ];
    for extreme in extremes {
        let scene = parse(&format!("[sea]\n{extreme}\n"));
        Sea::new(&scene.sea).unwrap();
        assert!(scene.lod.reach.is_finite() && scene.lod.max_height.unwrap().is_finite());
    }
}

#[test]
fn whatever_the_schema_allows_makes_a_raft() {
    let extremes = [
        "length = 0.5\nwidth = 0.5\nfreeboard = 0\nheave_frequency = 0.1\nheave_damping = 0.05\ntilt_frequency = 0.1\n\
         tilt_damping = 0.05\nheld_heave = 0\nglide_speed = 0\nglide_acceleration = 0.1\ndead_zone = 0\nsnap_turn_deg = 1\n\
         smooth_turn_deg = 0\nvignette = 0",
        "length = 20\nwidth = 20\nfreeboard = 5\nheave_frequency = 10\nheave_damping = 1\ntilt_frequency = 10\n\
         tilt_damping = 1\nheld_heave = 1\nglide_speed = 20\nglide_acceleration = 100\ndead_zone = 0.9\nsnap_turn_deg = 90\n\
         smooth_turn_deg = 360\nvignette = 1\n[camera]\neye = [1e9, 0, -1e9]",
    ];
    for extreme in extremes {
        let scene = parse(&format!("[raft]\n{extreme}\n"));
        Rider::new(&scene.raft, scene.camera.ground(), scene.camera.heading()).unwrap();
    }
}

#[test]
fn a_rider_begins_under_the_camera_and_looks_where_it_looks() {
    let heading = |x: f64, z: f64| {
        let camera =
            parse(&format!("[camera]\neye = [100, 4, -30]\nlook = [{}, 0, {}]", 100.0 + x, z - 30.0)).camera;
        assert_eq!(camera.ground().to_array(), [100.0, -30.0]);
        camera.heading()
    };
    assert_eq!(heading(0.0, -1.0), 0.0);
    assert_eq!(heading(-1.0, 0.0), FRAC_PI_2);
    assert_eq!(heading(1.0, 0.0), -FRAC_PI_2);
    assert_eq!(heading(0.0, 0.0), 0.0);
    assert!((heading(-1.0, -1.0) - TAU / 8.0).abs() < 1e-12);
}
