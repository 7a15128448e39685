//! Where the panel stands in play space, and where a hand points on it.

use crate::host::headset::eyes;
use crate::raft::Head;
use crate::xr;
use glam::{DVec3, Quat, Vec2, Vec3};

/// Width and height, metres.
pub const SIZE: [f32; 2] = [0.66, 0.88];
/// From the head to the middle, metres along the ground: an arm and a ray away.
const AWAY: f64 = 1.0;
/// The middle is so far below the eyes, metres, and leans back by so many radians to face them.
const BELOW: f64 = 0.25;

/// A rectangle that stands still in play space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    middle: DVec3,
    /// Its own x is to the right, y up, z towards whoever reads it.
    turn: Quat,
}

/// Where a ray meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// From the top left, as a share of width and height; beyond 0..=1 it passes by.
    pub at: Vec2,
    /// From where the hand points, metres.
    pub distance: f32,
}

impl Hit {
    /// Whether it is on the rectangle.
    pub fn is_on(&self) -> bool {
        self.at.cmpge(Vec2::ZERO).all() && self.at.cmple(Vec2::ONE).all()
    }
}

impl Board {
    /// In front of `head`, facing it.
    pub fn before(head: Head) -> Self {
        let ahead = DVec3::new(-head.yaw.sin(), 0.0, -head.yaw.cos());
        #[expect(clippy::cast_possible_truncation, reason = "angles")]
        let (yaw, lean) = (head.yaw as f32, f64::atan2(BELOW, AWAY) as f32);
        let turn = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(-lean);
        Self { middle: head.position + ahead * AWAY - DVec3::Y * BELOW, turn }
    }

    /// Its middle; +Z faces the reader.
    pub fn pose(&self) -> xr::Pose {
        xr::Pose { position: self.middle.as_vec3().into(), orientation: self.turn.into() }
    }

    /// Where the ray from `aim` meets its plane; nothing from behind it, or where the ray goes along or away.
    pub fn hit(&self, aim: xr::Pose) -> Option<Hit> {
        let (from, orientation) = eyes::parts(aim);
        let back = self.turn.inverse();
        let from = back * (from - self.middle).as_vec3();
        let along = back * (orientation * Vec3::NEG_Z);
        if from.z <= 0.0 || along.z >= -1e-3 {
            return None;
        }
        let distance = -from.z / along.z;
        let place = from + along * distance;
        let at = Vec2::new(0.5 + place.x / SIZE[0], 0.5 - place.y / SIZE[1]);
        Some(Hit { at, distance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standing() -> Board {
        Board::before(Head::new(DVec3::new(0.0, 1.6, 0.0), Quat::IDENTITY))
    }

    fn aimed(from: Vec3, at: Vec3) -> xr::Pose {
        let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (at - from).normalize());
        xr::Pose { position: from.into(), orientation: turn.into() }
    }

    #[test]
    fn it_stands_before_the_head_and_faces_it() {
        for yaw in [0.0f32, 0.7, -2.5] {
            let head = Head::new(DVec3::new(0.3, 1.5, -0.2), Quat::from_rotation_y(yaw));
            let board = Board::before(head);
            let to_head = (head.position - board.middle).as_vec3();
            let faces = board.turn * Vec3::Z;
            assert!(faces.dot(to_head.normalize()) > 0.999_99, "{yaw}: {faces} and {to_head}");
            let ahead = Quat::from_rotation_y(yaw) * Vec3::NEG_Z;
            assert!((-to_head).with_y(0.0).normalize().dot(ahead) > 0.999_99, "{yaw}");
            assert!((board.turn * Vec3::X).y.abs() < 1e-6, "its edge is level");
        }
    }

    #[test]
    fn a_ray_meets_what_it_points_at() {
        let board = standing();
        let hand = Vec3::new(0.2, 1.1, -0.3);
        let corner = |x: f32, y: f32| {
            board.middle.as_vec3() + board.turn * Vec3::new((x - 0.5) * SIZE[0], (0.5 - y) * SIZE[1], 0.0)
        };
        for (x, y) in [(0.01, 0.01), (0.99, 0.01), (0.5, 0.5), (0.25, 0.9), (1.2, -0.3)] {
            let place = corner(x, y);
            let hit = board.hit(aimed(hand, place)).unwrap();
            assert!((hit.at - Vec2::new(x, y)).length() < 1e-4, "{:?} for {x}, {y}", hit.at);
            assert!((hit.distance - (place - hand).length()).abs() < 1e-4);
            assert_eq!(hit.is_on(), x <= 1.0 && y >= 0.0);
        }
    }

    #[test]
    fn nothing_is_met_from_behind_or_away() {
        let board = standing();
        let middle = board.middle.as_vec3();
        let behind = middle - board.turn * Vec3::Z;
        assert_eq!(board.hit(aimed(behind, middle)), None);
        let hand = Vec3::new(0.2, 1.1, -0.3);
        assert_eq!(board.hit(aimed(hand, hand + (hand - middle))), None);
        assert_eq!(board.hit(aimed(hand, hand + board.turn * Vec3::X)), None);
    }
}
