//! What a scene file's author is told about each kind of mistake: place, key, value and range.
use swell::scene::{MAX_BYTES, Scene};

/// The message for `text`, which must be refused.
fn refused(text: &str) -> String {
    match Scene::parse(text, "x.toml") {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => error.to_string(),
    }
}

#[track_caller]
fn check(text: &str, message: &str) {
    assert_eq!(refused(text), message);
}

#[test]
fn out_of_range_names_place_value_and_range() {
    check(
        "# a comment\n\n[sea]\n  wind_speed = -3\n",
        "x.toml:4:16: sea.wind_speed = -3 is out of range: 0 to 60 m/s",
    );
    check("[lod]\nlevels = 11\n", "x.toml:2:10: lod.levels = 11 is out of range: 2 to 10");
    check("[sea]\nseed = -1\n", "x.toml:2:8: sea.seed = -1 is out of range: 0 to 9223372036854775807");
    check(
        "[sea.foam]\nfade_time = 99999999999999999999999999999999999999999999999999\n",
        "x.toml:2:13: sea.foam.fade_time = 99999999999999999999999999999999999999999999999999 is out of range: 0 to 600 s",
    );
    check(
        "[water]\ndeep_color = [0.1, 1.5, 0.1]\n",
        "x.toml:2:20: water.deep_color = 1.5 is out of range: 0 to 1",
    );
    check(
        "[sky]\nsun_elevation_deg = -5.1\n",
        "x.toml:2:21: sky.sun_elevation_deg = -5.1 is out of range: -5 to 90 degrees",
    );
    check(
        "[raft]\nsmooth_turn_deg = 361\n",
        "x.toml:2:19: raft.smooth_turn_deg = 361 is out of range: 0 to 360 degrees/s",
    );
    check(
        "[[buoy]]\n[[buoy]]\nat = [0, -2e9]\n",
        "x.toml:3:10: buoy.at = -2e9 is out of range: -1000000000 to 1000000000 m",
    );
}

#[test]
fn both_ends_of_a_range_are_inside() {
    let scene = Scene::parse("[sea]\nwind_speed = 60\nalignment = 0\nresolution = 16\n", "x.toml").unwrap();
    assert_eq!(scene.sea.cascades[0].wind_speed, 60.0);
    assert_eq!(scene.sea.cascades[0].alignment, 0.0);
    assert_eq!(scene.sea.cascades[0].resolution, 16);
    Scene::parse("[sea]\nwind_speed = 60.00001\n", "x.toml").unwrap_err();
}

#[test]
fn numbers_that_are_none() {
    check(
        "[sea]\nwind_speed = nan\n",
        "x.toml:2:14: sea.wind_speed = nan is not a finite number: 0 to 60 m/s",
    );
    check(
        "[sea]\nwind_speed = -inf\n",
        "x.toml:2:14: sea.wind_speed = -inf is not a finite number: 0 to 60 m/s",
    );
    check(
        "[sea]\nwind_speed = 1e400\n",
        "x.toml:2:14: sea.wind_speed = 1e400 is not a finite number: 0 to 60 m/s",
    );
    check(
        "[camera]\neye = [0, inf, 0]\n",
        "x.toml:2:11: camera.eye = inf is not a finite number: -1000000000 to 1000000000 m",
    );
}

#[test]
fn resolution_is_a_power_of_two() {
    check("[sea]\nresolution = 100\n", "x.toml:2:14: sea.resolution = 100 is not a power of two: 16 to 512");
    check("[sea]\nresolution = 1024\n", "x.toml:2:14: sea.resolution = 1024 is out of range: 16 to 512");
    check(
        "[sea]\nresolution = 256.0\n",
        "x.toml:2:14: sea.resolution = 256.0 is a number with a fraction; give a power of two: 16 to 512",
    );
}

#[test]
fn wrong_types() {
    check(
        "[sea]\nwind_speed = \"fast\"\n",
        "x.toml:2:14: sea.wind_speed = \"fast\" is a string; give a number: 0 to 60 m/s",
    );
    check("sea = 3\n", "x.toml:1:7: sea = 3 is a whole number; give a table, [sea]");
    check(
        "[camera]\neye = [1, 2]\n",
        "x.toml:2:7: camera.eye = [1, 2] is an array; give three numbers: -1000000000 to 1000000000 m",
    );
    check(
        "[sea.cascade]\npatch_size = 3\n",
        "x.toml:1:1: sea.cascade = [sea.cascade] is a table; give tables, each headed [[sea.cascade]]",
    );
    check(
        "[[buoy]]\nat = [1, 2, 3]\n",
        "x.toml:2:6: buoy.at = [1, 2, 3] is an array; give two numbers: -1000000000 to 1000000000 m",
    );
    check("[buoy]\n", "x.toml:1:1: buoy = [buoy] is a table; give tables, each headed [[buoy]]");
    check(
        "[sea]\nspectrum = 1\n",
        "x.toml:2:12: sea.spectrum = 1 is a whole number; give a word: \"phillips\", \"jonswap\", \"tma\"",
    );
}

#[test]
fn unknown_words_list_the_words_there_are() {
    check(
        "[sea]\nspectrum = \"pierson\"\n",
        "x.toml:2:12: sea.spectrum = \"pierson\" is not one of: \"phillips\", \"jonswap\", \"tma\"",
    );
    check(
        "[raft]\nhorizon = \"held\"\n",
        "x.toml:2:11: raft.horizon = \"held\" is not one of: \"rides\", \"still\"",
    );
    check(
        "[sea]\nmodel = \"sines\"\n",
        "x.toml:2:9: sea.model = \"sines\" is not one of: \"fft\", \"waves\", \"fbm\"",
    );
}

#[test]
fn unknown_keys_suggest_the_one_meant() {
    check(
        "[sea]\nwindspeed = 3\n",
        "x.toml:2:1: sea.windspeed is not a key of a scene; did you mean wind_speed?",
    );
    check(
        "[[buoy]]\nmast = 3\n",
        "x.toml:2:1: buoy.mast is not a key of a scene; here may stand: at, radius, color, height",
    );
    check("[sae]\nwind_speed = 3\n", "x.toml:1:2: sae is not a key of a scene; did you mean sea?");
    check(
        "wind_speed = 3\n",
        "x.toml:1:1: wind_speed is not a key of a scene; wind_speed belongs under [sea] with model = \"fft\"",
    );
    check(
        "[sea.foam]\nexplosions = 3\n",
        "x.toml:2:1: sea.foam.explosions is not a key of a scene; here may stand: threshold, width, fade_time",
    );
}

#[test]
fn syntax_errors_and_keys_given_twice_have_a_place() {
    assert!(refused("[sea]\nwind_speed = \n").starts_with("x.toml:2:"));
    assert!(refused("[sea\n").starts_with("x.toml:1:5: "));
    let twice = refused("[sea]\nseed = 1\nseed = 2\n");
    assert!(twice.starts_with("x.toml:3:1: duplicate key"), "{twice}");
    assert!(refused(&"[".repeat(100_000)).starts_with("x.toml:1:"));
    assert!(refused(&format!("a = {}", "[".repeat(100_000))).starts_with("x.toml:1:"));
}

#[test]
fn columns_count_characters_and_lines_may_end_in_crlf() {
    check(
        "[sea]\r\nspectrum = \"h\u{f6}he\"\r\n",
        "x.toml:2:12: sea.spectrum = \"h\u{f6}he\" is not one of: \"phillips\", \"jonswap\", \"tma\"",
    );
    check(
        "camera = { look = [0, 0, 0], \"\u{f6}\" = 1 }",
        "x.toml:1:30: camera.\u{f6} is not a key of a scene; here may stand: eye, look, fov_deg, eye_separation",
    );
}

#[test]
fn the_first_mistake_in_the_file_is_told() {
    let message = refused("[water]\nscatter = -1\n[camera]\nfov_deg = 0\n[sea]\nseed = -1\n");
    assert!(message.starts_with("x.toml:2:11: water.scatter"), "{message}");
}

#[test]
fn contradictions() {
    check(
        "[camera]\neye = [1, 2, 3]\nlook = [1.0, 2.0, 3.0]\n",
        "x.toml:3:8: camera.look = [1.0, 2.0, 3.0] equals camera.eye, so there is no direction to look in",
    );
    check(
        "[sky]\nmodel = \"cubemap\"\n",
        "x.toml:2:9: sky.model = \"cubemap\" needs sky.file, the image to show",
    );
    let missing = refused("[sky]\nmodel = \"cubemap\"\nfile = \"nowhere.png\"\n");
    assert_eq!(missing, "x.toml:3:8: sky.file = \"nowhere.png\" is not there: no file nowhere.png");
}

#[test]
fn bands_that_overlap_are_refused_and_both_named() {
    let message = refused(
        "[[sea.cascade]]\npatch_size = 100\nband = [0, 1]\n[[sea.cascade]]\npatch_size = 10\nband = [0.9, inf]\n",
    );
    assert_eq!(
        message,
        "x.toml:6:8: sea.cascade.band = [0.9, inf] of the patch of 10 m overlaps [0, 1] of the patch of 100 m"
    );
    let message =
        refused("[[sea.cascade]]\npatch_size = 100\nband = [0, 1]\n[[sea.cascade]]\npatch_size = 10\n");
    assert!(message.starts_with("x.toml:4:1: sea.cascade"), "{message}");
    assert!(message.contains("all of them one or none"), "{message}");
    check(
        "[[sea.cascade]]\nband = [2, 1]\n",
        "x.toml:2:8: sea.cascade.band = [2, 1] is out of range: 0 <= low < high, high may be inf rad/m",
    );
    check(
        "[[sea.cascade]]\nband = [inf, inf]\n",
        "x.toml:2:9: sea.cascade.band = inf is not a finite number: 0 <= low < high, high may be inf rad/m",
    );
}

#[test]
fn at_most_four_cascades() {
    let cascades = |sizes: &[u32]| -> String {
        sizes.iter().map(|size| format!("[[sea.cascade]]\npatch_size = {size}\n")).collect()
    };
    assert_eq!(Scene::parse(&cascades(&[400, 100, 25, 6]), "x.toml").unwrap().sea.cascades.len(), 4);
    let message = refused(&cascades(&[400, 100, 25, 6, 2]));
    assert!(message.starts_with("x.toml:9:1: sea.cascade"), "{message}");
    assert!(message.contains("at most 4"), "{message}");
}

#[test]
fn at_most_sixty_four_buoys() {
    let buoys = |count| "[[buoy]]\n".repeat(count);
    assert_eq!(Scene::parse(&buoys(64), "x.toml").unwrap().buoys.len(), 64);
    check(&buoys(65), "x.toml:65:1: buoy = [[buoy]] is one buoy too many: at most 64");
}

#[test]
fn equal_patches_need_bands() {
    let twins = "[[sea.cascade]]\npatch_size = 50\n[[sea.cascade]]\npatch_size = 50\n[[sea.cascade]]\npatch_size = 50\n";
    let message = refused(twins);
    assert!(message.starts_with("x.toml:3:1: sea.cascade"), "{message}");
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        Scene::load(&path).unwrap_err().to_string().replace(&*folder.path().to_string_lossy(), "F")
    };
    assert_eq!(
        refused("latin.toml", b"[sea]\n# h\xf6he\n"),
        "F/latin.toml:2:4: byte 0xf6 is not UTF-8 text; save the scene file as UTF-8"
    );
    let huge = vec![b'#'; MAX_BYTES as usize + 1];
    assert!(refused("huge.toml", &huge).contains("larger than 1048576 bytes"));
    assert!(
        Scene::load(folder.path().join("none.toml"))
            .unwrap_err()
            .to_string()
            .contains("none.toml: cannot read")
    );
    assert!(Scene::load(folder.path()).unwrap_err().to_string().contains("cannot read"));
    std::fs::write(folder.path().join("whole.toml"), &huge[1..]).unwrap();
    Scene::load(folder.path().join("whole.toml")).unwrap();
}
