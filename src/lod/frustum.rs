//! Boxes against the planes of a view, eqs (59)(60).
use glam::{Mat4, Vec3, Vec4};

/// The six planes of one view: a point p is inside where `n . p + d >= 0` for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// (n, d), not normalised: left, right, bottom, top, near, far.
    planes: [Vec4; 6],
}

/// A plane that keeps everything.
const EVERYWHERE: Vec4 = Vec4::W;

impl Frustum {
    /// The planes of a clip matrix with Vulkan's depth 0..=1, reversed: near where z = w, far where z = 0.
    ///
    /// `view_projection` takes positions relative to the eye that is given to `select`, along the world's axes, to
    /// clip space; a headset's view carries its own eye's offset from the head. Either sign of y is right, and so are
    /// asymmetric fields of view. With an infinite far plane z does not depend on the position: that plane keeps
    /// everything.
    pub fn from_view_projection(view_projection: Mat4) -> Self {
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| view_projection.row(row));
        Self { planes: [w + x, w - x, w + y, w - y, w - z, z].map(plane_or_everywhere) }
    }

    /// A frustum that keeps every box.
    pub const fn everywhere() -> Self {
        Self { planes: [EVERYWHERE; 6] }
    }

    /// False only when the box is wholly outside one plane.
    ///
    /// `centre` and `half_extents` in metres, relative to the eye. Boxes near a corner of the frustum may be kept
    /// though they are outside; none that reaches inside is dropped.
    pub fn keeps(&self, centre: Vec3, half_extents: Vec3) -> bool {
        // The sums round by a few parts in 2^24 of their largest terms.
        let half_extents = half_extents + (centre.abs() + half_extents) * 1e-6;
        !self.planes.iter().any(|plane| {
            let normal = plane.truncate();
            let farthest = centre.dot(normal) + half_extents.dot(normal.abs());
            farthest + plane.w < 0.0
        })
    }
}

/// `plane`, or one that keeps everything where its normal is zero next to its offset.
fn plane_or_everywhere(plane: Vec4) -> Vec4 {
    if plane.truncate().length() <= 1e-12 * plane.w.abs() || plane.is_nan() { EVERYWHERE } else { plane }
}
