//! From a headset's views to eyes in the world.

use crate::draw::{Eye, Fov, Pose};
use crate::raft::{Head, Rider};
use crate::xr::{self, VIEWS, View};
use glam::{DVec3, Quat, Vec3};

/// A pose's position, metres in play space, and its orientation.
pub fn parts(pose: xr::Pose) -> (DVec3, Quat) {
    let orientation = Quat::from_array(pose.orientation);
    // Some runtimes give quaternions that are a little too long.
    let orientation =
        if orientation.length_squared() > 0.0 { orientation.normalize() } else { Quat::IDENTITY };
    (Vec3::from(pose.position).as_dvec3(), orientation)
}

/// The head: between the eyes, turned half way from one to the other, since canted displays turn them by opposite angles.
pub fn head(views: &[View; VIEWS]) -> Head {
    let [(left, a), (right, b)] = views.map(|view| parts(view.pose));
    Head::new((left + right) * 0.5, a.slerp(b, 0.5))
}

/// Both views as eyes in the rider's world.
pub fn eyes(rider: &Rider, views: &[View; VIEWS]) -> [Eye; VIEWS] {
    views.map(|view| {
        let (position, orientation) = parts(view.pose);
        let (position, axes) = rider.to_world(position, orientation);
        let [left, right, up, down] = view.angles.map(f32::tan);
        Eye { position, axes, fov: Fov { left, right, up, down } }
    })
}

/// A pose in the rider's world.
pub fn placed(rider: &Rider, pose: xr::Pose) -> Pose {
    let (position, orientation) = parts(pose);
    let (position, axes) = rider.to_world(position, orientation);
    Pose { position, axes }
}
