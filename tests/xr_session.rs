//! Sessions on Monado: from IDLE to EXITING, each eye's picture what a mono camera there sees, everybody silent.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::headset::Watcher;
use support::monado::{Service, Settings};
use support::picture::Picture;
use support::program::run;
use support::stage::{Stage, shipped};
use swell::draw::Look;

#[test]
fn a_session_of_forty_frames() {
    let service = Service::start(Settings::default());
    let said = run(&mut service.reexec("forty_frames"));
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
    // Said once, not once a frame.
    for line in ["headset: ", "extensions found: ", "extensions missing: ", "in use: "] {
        assert_eq!(said.err.lines().filter(|said| said.starts_with(line)).count(), 1, "{line} {}", said.err);
    }
    let line = |start| said.err.lines().find(|line| line.starts_with(start)).unwrap();
    for there in ["XR_KHR_vulkan_enable2", "XR_KHR_composition_layer_depth", "XR_FB_display_refresh_rate"] {
        assert!(line("extensions found: ").contains(there), "{there}: {}", said.err);
    }
    // What Monado lacks is missed by nobody.
    for absent in [
        "XR_FB_foveation",
        "XR_FB_foveation_configuration",
        "XR_FB_foveation_vulkan",
        "XR_FB_swapchain_update_state",
        "XR_EXT_performance_settings",
        "XR_FB_space_warp",
        "XR_META_vulkan_swapchain_create_info",
    ] {
        assert!(line("extensions missing: ").contains(absent), "{absent}: {}", said.err);
    }
    assert!(line("in use: ").contains("Hz") && line("in use: ").contains("depth submitted"), "{}", said.err);
    assert!(!line("in use: ").contains("foveation"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn forty_frames() {
    let scene = shipped("open_ocean");
    let mut watcher = Watcher::new(13);
    let report = watcher.watch(&scene, 40);
    assert_eq!((report.shown, report.recovered), (40, 0));
    assert_eq!(watcher.seen.len(), 40);
    let states = [
        "IDLE",
        "READY",
        "SYNCHRONIZED",
        "VISIBLE",
        "FOCUSED",
        "VISIBLE",
        "SYNCHRONIZED",
        "STOPPING",
        "IDLE",
        "EXITING",
    ];
    assert_eq!(watcher.states, states);
    assert!(
        watcher.seen.windows(2).all(|pair| pair[0].time < pair[1].time),
        "time stands still or runs back"
    );
    let mut alone: Option<Stage> = None;
    for (index, seen) in watcher.seen.iter().enumerate() {
        let Some(views) = &seen.pictures else { continue };
        let apart = views[0].difference(&views[1]).mean;
        assert!(apart > 0.02, "frame {index}: the eyes see the same: {apart}");
        let mono = alone.get_or_insert_with(|| Stage::new(&scene, views[0].size, 1, Look::Water, seen.time));
        mono.host.set_scenery(&seen.solids, seen.vignette);
        for (view, eye) in views.iter().zip(seen.eyes) {
            // Some drivers leave layer 1 with its clear colour.
            assert!(view.colours() > 1000, "frame {index}: {} colours", view.colours());
            let [view, lone] = lenses_over(view, &mono.picture(seen.time, &[eye]));
            let difference = view.difference(&lone);
            println!("frame {index}: mean {}, 99th percentile {}", difference.mean, difference.high);
            // The foam remembers what came before, and the lone camera chooses detail for one eye, not for the head.
            assert!(
                difference.mean < 0.004 && difference.high < 0.05,
                "{} {}",
                difference.mean,
                difference.high
            );
        }
    }
}

/// Both with black wherever `seen` is black, and a pixel around: what the lenses hide, and its softened edge.
fn lenses_over(seen: &Picture, lone: &Picture) -> [Picture; 2] {
    let [width, height] = seen.size;
    let black = |x: u32, y: u32| seen.pixel(x, y) == [0, 0, 0];
    let around = |at: u32, most: u32| at.saturating_sub(1)..=(at + 1).min(most - 1);
    let mut both = [seen.clone(), lone.clone()];
    let mut hidden = 0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if around(x, width).any(|x| around(y, height).any(|y| black(x, y))) {
            let at = 3 * (y * width + x) as usize;
            both.iter_mut().for_each(|picture| picture.rgb[at..at + 3].fill(0));
            hidden += 1;
        }
    }
    // The corners, and not the picture.
    let pixels = width * height;
    assert!(hidden > pixels / 100 && hidden < pixels / 8, "{hidden} of {pixels} pixels are black");
    both
}
