//! Golden pictures: what was looked at once and found right.
use super::picture::Picture;
use std::path::{Path, PathBuf};

/// The most that a picture may differ from its golden one, in FLIP's measure.
///
/// The same lavapipe gives the same bytes. Limits leave room for another release of Mesa or LLVM, whose arithmetic
/// differs in the last bits, and for nothing that an observer would see.
pub const MEAN: f32 = 0.004;
/// The same for 99 % of the pixels: a small thing that is wrong hides in the mean.
pub const HIGH: f32 = 0.05;

/// Largest golden file, bytes.
pub const LARGEST: u64 = 120 << 10;

pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens")
}

/// Compares `actual` with the golden picture `name`; where they differ, or there is none, leaves pictures to look at.
pub fn check(name: &str, actual: &Picture) {
    let file = folder().join(format!("{name}.png"));
    if std::env::var_os("SWELL_WRITE_GOLDENS").is_some_and(|value| value == "1") {
        actual.save(&file);
        let bytes = std::fs::metadata(&file).unwrap().len();
        assert!(bytes <= LARGEST, "{}: {bytes} bytes, at most {LARGEST}", file.display());
        panic!("written, look at it: {}", file.display());
    }
    let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join("goldens");
    let place = |kind: &str| left.join(format!("{name}.{kind}.png"));
    if !file.exists() {
        actual.save(&place("actual"));
        panic!(
            "no golden picture {}; the actual one is {}; SWELL_WRITE_GOLDENS=1 writes it",
            file.display(),
            place("actual").display()
        );
    }
    let golden = Picture::load(&file);
    if golden.size != actual.size {
        actual.save(&place("actual"));
        panic!("{name}: {:?} pixels, the golden picture has {:?}", actual.size, golden.size);
    }
    let difference = golden.difference(actual);
    if difference.mean > MEAN || difference.high > HIGH {
        actual.save(&place("actual"));
        golden.save(&place("golden"));
        difference.picture().save(&place("difference"));
        panic!(
            "{name} is not its golden picture: mean {:.4} (at most {MEAN}), 99th percentile {:.3} (at most {HIGH}); \
             see {}, .golden.png and .difference.png",
            difference.mean,
            difference.high,
            place("actual").display()
        );
    }
}
