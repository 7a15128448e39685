//! OpenXR: the runtime, a session, its images, its hands, and what vendors add.
//!
//! Beside `gpu`, which it lets the runtime open; nothing here knows what is drawn. The `openxr` crate loads the functions and
//! keeps the handles; where its safe functions allocate in every frame, cannot chain structures or hide an expired wait,
//! the raw ones are called here.

mod bindings;
mod error;
pub mod extensions;
mod frame;
mod input;
mod lifecycle;
mod messages;
mod notice;
mod platform;
mod runtime;
mod session;
mod swapchain;
pub mod vendor;
mod vulkan;

pub use error::XrError;
pub use frame::{DepthRange, Layer, Motion, Quad, SpaceStep};
pub use input::{HANDS, Hand, Input};
pub use lifecycle::{Demand, Lifecycle};
pub use notice::Notice;
pub use openxr::{EventDataBuffer, SessionState, Time};
pub use platform::Platform;
#[cfg(not(target_os = "android"))]
pub use runtime::{About, about};
pub use runtime::{Runtime, VIEWS, ViewSize};
pub use session::{FrameTime, Mask, Pose, Session, View};
pub use swapchain::{Swapchain, SwapchainInfo, Usage};
