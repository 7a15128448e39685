//! Not a test: a program that only steps a sea, for `scripts/mca-neon` to count what that executes.
#![allow(clippy::expect_used, reason = "a test may panic")]
use swell::jobs::Workers;
use swell::sea::{CascadeSettings, FoamSettings, Sea, SeaSettings};

fn number(variable: &str, default: usize) -> usize {
    std::env::var(variable).map_or(default, |text| text.parse().expect("a number"))
}

/// `SWELL_STEPS` steps of one cascade, N = `SWELL_SIZE`, without the foam's memory, which would make steps of different
/// lengths; on one thread.
#[test]
#[ignore = "scripts/mca-neon runs it"]
fn steps() {
    let cascade = CascadeSettings { resolution: number("SWELL_SIZE", 256), ..CascadeSettings::default() };
    let foam = FoamSettings { fade_time: 0.0, ..FoamSettings::default() };
    let settings = SeaSettings { cascades: vec![cascade], foam, ..SeaSettings::default() };
    Workers::new(1).expect("a thread").run(|| {
        let mut sea = Sea::new(&settings).expect("valid");
        let mut maps = sea.new_maps();
        for step in 0..number("SWELL_STEPS", 1) {
            sea.step(step as f64 / 90.0, &mut maps).expect("a step");
        }
    });
}
