//! Keys of `[camera]`.
use crate::scene::CameraSettings;
use crate::scene::key::{Key, angle, number, position};

/// Keys of `[camera]`.
pub(in crate::scene) static CAMERA: &[Key<CameraSettings>] = &[
    position("eye", [0.0, 4.0, 0.0], |c, v| c.eye = v, "Position of the camera."),
    position("look", [0.0, 0.0, -60.0], |c, v| c.look = v, "Point looked at; must differ from `eye`."),
    angle("fov_deg", [10.0, 120.0], 50.0, |c, v| c.fov_y = v, "Vertical field of view."),
    number(
        "eye_separation",
        "m",
        [0.0, 1.0],
        0.063,
        |c, v| c.eye_separation = v,
        "Distance between the eyes of stereo pictures.",
    ),
];
