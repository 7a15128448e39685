//! No bytes make the scene reader panic, and whatever it accepts is finite.
#![allow(clippy::expect_used, reason = "a test may panic")]
use proptest::prelude::*;
use proptest::sample::Index;
use swell::scene::{Scene, SceneError};

const SCENES: [&str; 6] = [
    include_str!("../scenes/open_ocean.toml"),
    include_str!("../scenes/calm.toml"),
    include_str!("../scenes/storm.toml"),
    include_str!("../scenes/gerstner.toml"),
    include_str!("../scenes/pond.toml"),
    include_str!("../scenes/fbm_sea.toml"),
];

/// Pieces that are likely to hurt where they do not belong.
const TOKENS: [&str; 24] = [
    "nan",
    "-inf",
    "1e400",
    "99999999999999999999",
    "-0",
    "0x7f",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "\"",
    "'''",
    "=",
    ".",
    "\n",
    "\r",
    "\0",
    "#",
    "1979-05-27",
    "true",
    "sea.cascade",
    "\u{1f30a}",
];

/// Reads the bytes; an error must be one line that begins with the file, with a place inside the text if it has one.
fn check(bytes: &[u8]) {
    match Scene::parse_bytes(bytes, "mutant.toml") {
        Ok(scene) => {
            let numbers = scene.sea.cascades.iter().flat_map(|c| {
                [
                    c.patch_size,
                    c.wind_speed,
                    c.wind_direction,
                    c.alignment,
                    c.choppiness,
                    c.fetch,
                    c.depth,
                    c.band[0],
                ]
            });
            assert!(numbers.chain(scene.camera.eye).chain(scene.camera.look).all(f64::is_finite));
            assert!(scene.camera.eye != scene.camera.look);
            assert!((1..=4).contains(&scene.sea.cascades.len()));
            assert!(swell::sea::waves::validate(&scene.sea.models).is_ok());
            assert!(scene.lod.reach.is_finite() && scene.lod.max_height.is_some_and(f64::is_finite));
            assert!(scene.raft.check().is_ok() && scene.buoys.len() <= 64);
            assert!(scene.buoys.iter().all(|buoy| buoy.at.iter().all(|at| at.is_finite())));
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with("mutant.toml:"), "{message}");
            assert!(message.len() < 4096 && !message.contains('\n'), "{message}");
            if let SceneError::Syntax { place, .. } | SceneError::UnknownKey { place, .. } = &error {
                let lines = bytes.split(|&b| b == b'\n').count();
                assert!((1..=lines).contains(&place.line), "{message}");
            }
        }
    }
}

/// Examples for each test; `SWELL_SCENE_CASES` overrules the number.
fn cases() -> u32 {
    std::env::var("SWELL_SCENE_CASES")
        .map_or(300, |text| text.parse().expect("SWELL_SCENE_CASES is a number"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        check(&bytes);
    }

    #[test]
    fn random_text(text in "[\\[\\]{}=.,\"'#\\\\a-z_0-9 \\n\\t\\-]{0,200}") {
        check(text.as_bytes());
    }

    #[test]
    fn changed_bytes(scene in 0..SCENES.len(), changes in proptest::collection::vec((any::<Index>(), any::<u8>()), 1..8)) {
        let mut bytes = SCENES[scene].as_bytes().to_vec();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        check(&bytes);
    }

    #[test]
    fn cut_and_doubled(scene in 0..SCENES.len(), from in any::<Index>(), to in any::<Index>(), at in any::<Index>()) {
        let text = SCENES[scene].as_bytes();
        let (from, to) = (from.index(text.len()), to.index(text.len()));
        let piece = &text[from.min(to)..from.max(to)];
        let at = at.index(text.len());
        check(&[&text[..at], piece, &text[at..]].concat());
        check(&text[..at]);
    }

    #[test]
    fn spliced_tokens(
        scene in 0..SCENES.len(),
        splices in proptest::collection::vec((any::<Index>(), 0..TOKENS.len(), any::<bool>()), 1..6),
    ) {
        let mut words: Vec<&str> = SCENES[scene].split_inclusive([' ', '\n']).collect();
        for (at, token, replace) in splices {
            let at = at.index(words.len());
            if replace {
                words[at] = TOKENS[token];
            } else {
                words.insert(at, TOKENS[token]);
            }
        }
        check(words.concat().as_bytes());
    }
}
