//! What some runtimes add: each piece asks whether its extension is there and does nothing where it is not.

mod foveation;
mod hand_joints;
mod performance;
mod refresh_rate;
mod space_warp;
mod threads;

pub use foveation::{Foveation, FoveationLevel};
pub use hand_joints::{HandJoints, JOINTS, Joints};
pub use performance::sustain;
pub use refresh_rate::choose_refresh_rate;
pub use space_warp::motion_size;
pub use threads::{ThreadRole, hint};
