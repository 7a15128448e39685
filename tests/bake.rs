//! Baked files: the same bytes every time, whole or not there, and parts that fit together.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use swell::commands::bake::{BakeOptions, BakeReport, Format, bake};
use swell::commands::{Clock, Frames};
use swell::scene::Scene;
use swell::sea::{Sea, mip_levels, mip_offset};

const SCENE: &str = "
[sea]
resolution = 32
wind_speed = 9
[[sea.cascade]]
patch_size = 90
[[sea.cascade]]
patch_size = 13
resolution = 16
rotation_deg = 30
";

fn scene() -> Scene {
    Scene::parse(SCENE, "bake.toml").unwrap()
}

fn options(out: &Path, frames: &str) -> BakeOptions {
    BakeOptions {
        out: out.to_owned(),
        frames: frames.parse().unwrap(),
        clock: Clock::new(3.0, 25.0).unwrap(),
        format: Format::Npy,
        threads: 1,
    }
}

/// Every file of a folder by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    entries.map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap())).collect()
}

#[test]
fn twice_gives_identical_bytes_whatever_the_threads() {
    let [a, b] = [1, 2].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        let options = BakeOptions { threads, ..options(folder.path(), "3") };
        assert_eq!(bake(&scene(), &options).unwrap(), BakeReport { written: 12, kept: 0 });
        files(folder.path())
    });
    assert_eq!(a.len(), 13);
    assert!(a == b);
}

#[test]
fn parts_equal_the_whole() {
    let whole = tempfile::tempdir().unwrap();
    bake(&scene(), &options(whole.path(), "5")).unwrap();
    let parts = tempfile::tempdir().unwrap();
    bake(&scene(), &options(parts.path(), "3..5")).unwrap();
    bake(&scene(), &options(parts.path(), "0..3")).unwrap();
    assert!(files(whole.path()) == files(parts.path()));
}

#[test]
fn parts_baked_at_the_same_time_equal_the_whole() {
    let whole = tempfile::tempdir().unwrap();
    bake(&scene(), &options(whole.path(), "12")).unwrap();
    let parts = tempfile::tempdir().unwrap();
    std::thread::scope(|scope| {
        for range in ["0..4", "4..8", "8..12"] {
            scope.spawn(|| bake(&scene(), &options(parts.path(), range)).unwrap());
        }
    });
    assert!(files(whole.path()) == files(parts.path()));
}

#[test]
fn arrays_hold_the_maps_of_their_time() {
    let folder = tempfile::tempdir().unwrap();
    bake(&scene(), &options(folder.path(), "7..8")).unwrap();
    let scene = scene();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps_with_planes();
    sea.step(3.0 + 7.0 / 25.0, &mut maps).unwrap();
    for (index, cascade) in maps.cascades.iter().enumerate() {
        let n = cascade.resolution;
        let bytes = fs::read(folder.path().join(format!("displacement_{index}_0007.npy"))).unwrap();
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!(npy.shape(), [n as u64, n as u64, 3]);
        assert_eq!(npy.order(), npyz::Order::C);
        let values = npy.into_vec::<f32>().unwrap();
        // One point in the middle, off the diagonal: [z][x][Dx, h, Dz].
        let (x, z) = (n / 4, n / 2 + 1);
        let at = z * n + x;
        let planes = cascade.planes.as_ref().unwrap();
        assert_eq!(values[3 * at..3 * at + 3], [planes.du[at], planes.height[at], planes.dv[at]]);
        assert!(values.iter().any(|&value| value != 0.0));

        let bytes = fs::read(folder.path().join(format!("gradient_{index}_0007.npy"))).unwrap();
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!(npy.shape(), [mip_offset(n, mip_levels(n)) as u64, 4]);
        assert_eq!(npy.into_vec::<u8>().unwrap(), cascade.gradient.as_flattened());
    }
}

#[test]
fn the_description_tells_every_parameter_and_time() {
    let folder = tempfile::tempdir().unwrap();
    bake(&scene(), &options(folder.path(), "2..4")).unwrap();
    let text = fs::read_to_string(folder.path().join("bake.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["format"], "npy");
    assert_eq!((json["start"].as_f64(), json["fps"].as_f64()), (Some(3.0), Some(25.0)));
    let frames = json["frames"].as_array().unwrap();
    assert_eq!(frames.iter().map(|f| f["frame"].as_u64().unwrap()).collect::<Vec<_>>(), [2, 3]);
    assert_eq!(frames[1]["time"].as_f64().unwrap(), 3.0 + 3.0 / 25.0);
    let cascade = &json["cascades"][1];
    assert_eq!(cascade["patch_size"].as_f64(), Some(13.0));
    assert_eq!(cascade["wind_speed"].as_f64(), Some(9.0));
    assert_eq!(cascade["rotation"].as_f64(), Some(30f64.to_radians()));
    assert!(cascade["band"][1].is_null());
    assert_eq!(cascade["seed"].as_u64(), Some(1));
}

#[test]
fn a_second_bake_writes_only_what_is_not_whole() {
    for format in [Format::Npy, Format::Exr] {
        let folder = tempfile::tempdir().unwrap();
        let options = BakeOptions { format, ..options(folder.path(), "2") };
        assert_eq!(bake(&scene(), &options).unwrap(), BakeReport { written: 8, kept: 0 });
        let first = files(folder.path());
        let name = format.name();
        // Cut off, emptied, of another shape, gone.
        let cut = folder.path().join(format!("displacement_0_0000.{name}"));
        fs::write(&cut, &fs::read(&cut).unwrap()[..2000]).unwrap();
        fs::write(folder.path().join(format!("gradient_1_0000.{name}")), b"").unwrap();
        let shape = folder.path().join(format!("gradient_0_0001.{name}"));
        let mut bytes = fs::read(&shape).unwrap();
        bytes[20] ^= 1;
        fs::write(&shape, bytes).unwrap();
        fs::remove_file(folder.path().join(format!("displacement_1_0001.{name}"))).unwrap();
        let kept = folder.path().join(format!("displacement_0_0001.{name}"));
        let before = fs::metadata(&kept).unwrap().modified().unwrap();
        // What a killed bake would leave.
        fs::write(folder.path().join(format!(".displacement_0_0000.{name}.1-0.part")), b"half").unwrap();

        assert_eq!(bake(&scene(), &options).unwrap(), BakeReport { written: 4, kept: 4 });
        assert_eq!(fs::metadata(&kept).unwrap().modified().unwrap(), before);
        assert!(files(folder.path()) == first, "{name}");
        assert_eq!(bake(&scene(), &options).unwrap(), BakeReport { written: 0, kept: 8 });
    }
}

#[test]
fn leftovers_of_other_frames_may_be_somebodys_work() {
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join(".displacement_0_0009.npy.1-0.part");
    fs::write(&other, b"half").unwrap();
    bake(&scene(), &options(folder.path(), "2")).unwrap();
    assert!(other.exists());
}

#[test]
fn another_bake_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    bake(&scene(), &options(folder.path(), "1")).unwrap();
    let first = files(folder.path());
    let windier = Scene::parse(&SCENE.replace("wind_speed = 9", "wind_speed = 10"), "bake.toml").unwrap();
    let message = bake(&windier, &options(folder.path(), "2")).unwrap_err().to_string();
    assert!(message.contains("bake.json was baked with other parameters"), "{message}");
    assert!(message.contains("\"wind_speed\": 9.0 there, \"wind_speed\": 10.0 now"), "{message}");
    let faster = BakeOptions { clock: Clock::new(3.0, 30.0).unwrap(), ..options(folder.path(), "2") };
    assert!(bake(&scene(), &faster).unwrap_err().to_string().contains("\"fps\": 25.0 there"));
    let image = BakeOptions { format: Format::Exr, ..options(folder.path(), "2") };
    assert!(bake(&scene(), &image).is_err());
    fs::write(folder.path().join("bake.json"), b"{}").unwrap();
    assert!(bake(&scene(), &options(folder.path(), "1")).is_err());
    fs::write(folder.path().join("bake.json"), &first["bake.json"]).unwrap();
    assert!(files(folder.path()) == first);
}

#[test]
fn folders_that_cannot_be_written_to_are_one_clear_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, b"").unwrap();
    for out in [file.clone(), file.join("below")] {
        let message = bake(&scene(), &options(&out, "1")).unwrap_err().to_string();
        assert!(message.starts_with("cannot make the folder") && message.contains("--out"), "{message}");
    }
    // A folder stands where a file belongs: the rest is whole, and nothing half is left.
    let out = folder.path().join("out");
    fs::create_dir_all(out.join("gradient_0_0000.npy")).unwrap();
    let message = bake(&scene(), &options(&out, "1")).unwrap_err().to_string();
    assert!(message.contains("cannot write") && message.contains("gradient_0_0000.npy"), "{message}");
    let names: Vec<_> =
        fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    assert!(names.iter().all(|name| !name.ends_with(".part")), "{names:?}");
    // And a folder that does not exist yet is made.
    bake(&scene(), &options(&folder.path().join("a/b"), "1")).unwrap();
}

#[test]
fn frames_beyond_four_digits_keep_their_names() {
    let folder = tempfile::tempdir().unwrap();
    bake(
        &scene(),
        &BakeOptions { frames: Frames::new(12_345..12_346).unwrap(), ..options(folder.path(), "1") },
    )
    .unwrap();
    assert!(folder.path().join("displacement_0_12345.npy").exists());
    assert!(fs::read_to_string(folder.path().join("bake.json")).unwrap().contains("\"frame\": 12345"));
}
