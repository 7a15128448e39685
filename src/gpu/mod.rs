//! The only place that touches Vulkan objects' lifetimes.
//!
//! Every object keeps an [`std::sync::Arc`] of its [`Device`], which keeps its [`Instance`]: whatever is dropped first,
//! Vulkan sees the right order. Nothing here knows what is drawn.

mod bindings;
mod buffer;
mod commands;
mod depth_map;
mod device;
mod error;
mod fit;
mod image;
mod instance;
mod messages;
mod opener;
mod overlay;
mod physical;
mod picture;
mod pipeline;
mod pipeline_cache;
mod presenter;
mod recorder;
mod render_pass;
mod ring;
mod surface;
mod swapchain;
mod target;

pub use bindings::{BindingKind, Bindings, Resource};
pub use buffer::Buffer;
pub use commands::{Commands, FRAMES_IN_FLIGHT, Transition, upload_buffer, upload_image};
pub use depth_map::DepthMap;
pub use device::{Device, DeviceNeeds, Replacements};
pub use error::{Doing, GpuError};
pub use gpu_allocator::MemoryLocation;
pub use image::{Image, ImageInfo, Sampler};
pub use instance::{API_VERSION, Instance, Validation};
pub use messages::Messages;
pub use opener::{Directly, Opener};
pub use overlay::Overlay;
pub use physical::{PhysicalDevice, version};
pub use picture::{Layers, Picture};
pub use pipeline::{Blend, DepthInfo, DepthUse, Pipeline, PipelineInfo, VertexInput};
pub use presenter::{Outcome, Presenter};
pub use recorder::Recorder;
pub use render_pass::Pass;
pub use ring::UploadRing;
pub use surface::{Shown, Surface};
pub use swapchain::Pace;
pub use target::{DEPTH_FORMAT, Lent, Target, TargetInfo, Turn};
