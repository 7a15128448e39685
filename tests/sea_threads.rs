//! The same bytes with any number of threads, one frame ahead or not; errors instead of hangs.
#![allow(clippy::expect_used, reason = "a test may panic")]
mod sea_common;
use sea_common::{cascades, maps};
use swell::jobs::Workers;
use swell::sea::{Sea, SeaAhead, SeaError, SeaMaps};

fn run(threads: usize) -> Vec<SeaMaps> {
    Workers::new(threads).expect("threads").run(|| {
        let mut sea = Sea::new(&cascades()).expect("valid");
        [0.0, 0.1, 0.25, 40.0]
            .map(|time| {
                let mut maps = sea.new_maps_with_planes();
                sea.step(time, &mut maps).expect("a step");
                maps
            })
            .to_vec()
    })
}

#[test]
fn threads_do_not_matter() {
    let one = run(1);
    assert!(one == run(2));
    assert!(one == run(3));
}

/// What a frame is given: no planes.
fn frame_at(time: f64) -> SeaMaps {
    let mut maps = maps(&cascades(), time);
    maps.cascades.iter_mut().for_each(|cascade| cascade.planes = None);
    maps
}

#[test]
fn one_frame_ahead_gives_the_same_maps() {
    for threads in [1, 2] {
        let mut ahead =
            SeaAhead::new(Sea::new(&cascades()).expect("valid"), Workers::new(threads).expect("threads"));
        assert_eq!(ahead.next(None).err(), Some(SeaError::NotBegun));
        let times = [0.0, 0.02, 0.04, 0.5, 0.06];
        ahead.begin(times[0]).expect("begun");
        for (frame, time) in times.iter().enumerate() {
            let following = times.get(frame + 1).copied();
            let found = ahead.next(following).expect("maps");
            assert!(*found == frame_at(*time), "frame {frame}");
        }
        assert_eq!(ahead.next(None).err(), Some(SeaError::NotBegun));
        assert!(matches!(
            ahead.begin(f64::NAN).and_then(|()| ahead.next(None).map(drop)),
            Err(SeaError::Time { .. })
        ));
        ahead.begin(0.3).expect("begun after an error");
        assert!(*ahead.next(None).expect("maps") == frame_at(0.3));
    }
}

#[test]
fn wrong_settings_are_named() {
    type Break = fn(&mut swell::sea::SeaSettings);
    let cases: [(&str, Break); 9] = [
        ("resolution", |sea| sea.cascades[1].resolution = 48),
        ("patch_size", |sea| sea.cascades[0].patch_size = 0.0),
        ("band", |sea| sea.cascades[0].band = [2.0, 1.0]),
        ("wind_speed", |sea| sea.cascades[0].wind_speed = f64::NAN),
        ("alignment", |sea| sea.cascades[0].alignment = 1.1),
        ("depth", |sea| sea.cascades[2].depth = f64::INFINITY),
        ("gravity", |sea| sea.gravity = -1.0),
        ("repeat_period", |sea| sea.repeat_period = 0.0),
        ("number of cascades", |sea| sea.cascades.clear()),
    ];
    for (key, break_it) in cases {
        let mut sea = cascades();
        break_it(&mut sea);
        let error = Sea::new(&sea).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains(key), "{key}: {error}");
    }
    let mut sea = Sea::new(&cascades()).expect("valid");
    let mut maps = sea.new_maps();
    assert!(matches!(sea.step(f64::INFINITY, &mut maps), Err(SeaError::Time { .. })));
    maps.cascades.pop();
    assert_eq!(sea.step(0.0, &mut maps), Err(SeaError::Maps));
}
