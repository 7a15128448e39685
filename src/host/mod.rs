//! Whoever decides when a frame is drawn, from where and into what.

mod afloat;
#[cfg(target_os = "android")]
pub mod android;
mod authoring;
#[cfg(not(target_os = "android"))]
mod companion;
mod cpu;
pub mod fallback;
mod frame_log;
mod headless;
mod headset;
mod mirror;
mod painter;
mod screenshots;
pub mod standalone;
pub mod view;
#[cfg(not(target_os = "android"))]
mod window;

pub use afloat::marker;
pub use authoring::{AuthoringSettings, Fit};
#[cfg(not(target_os = "android"))]
pub use companion::{Companion, CompanionSettings};
pub use cpu::cpu_time;
pub use frame_log::{FrameLog, FrameRecord};
pub use headless::{Finished, Headless, HeadlessSettings};
pub use headset::{Drawn, Guest, HeadsetFrame, HeadsetReport, HeadsetSettings, headset};
pub use mirror::Mirror;
pub use screenshots::{Screenshots, read_back};
#[cfg(not(target_os = "android"))]
pub use window::{DesktopWindow, Ending, Key, Script, ScriptError, WindowHost, WindowSettings};

use crate::draw::{DrawError, SkyError};
use crate::gpu::GpuError;
use crate::jobs::JobsError;
use crate::output::OutputError;
use crate::raft::RaftError;
use crate::scene::SceneError;
use crate::sea::SeaError;
use crate::xr::XrError;

/// A frame loop that could not begin or go on.
#[derive(Debug, thiserror::Error)]
pub enum HostError {
    /// Vulkan.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Drawing.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The text of a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The sky's file.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The simulation.
    #[error(transparent)]
    Sea(#[from] SeaError),
    /// The headset.
    #[error(transparent)]
    Xr(#[from] XrError),
    /// The raft.
    #[error(transparent)]
    Raft(#[from] RaftError),
    /// Worker threads.
    #[error(transparent)]
    Jobs(#[from] JobsError),
    /// A session that plays itself.
    #[cfg(not(target_os = "android"))]
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A file.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Nothing to open a window on.
    #[error("no display: {0}")]
    NoDisplay(String),
    /// The display went away while a window was on it.
    #[error("the display is gone")]
    DisplayGone,
    /// The thread that writes pictures has gone.
    #[error("the picture writer stopped before the last frame")]
    WriterGone,
}
