//! Level of detail: which patches of sea are drawn, and how densely ("VR Ocean" section 5).
//!
//! ```text
//! eye -> snap -> Ranges (57) -> subdivide -> balance -> leaves -> cull, any frustum (59)-(61)
//!                                                          |             |
//!                          stitch pattern (63)(64), weights of the slide -> Instance, sorted by pattern
//! ```
//! Every patch is the same grid of (V + 1)^2 vertices with one of 16 index patterns; `vertex_position` says where a
//! vertex of an instance stands. `docs/lod.md` gives the reasons. [`tessellation`] draws patches with as many vertices as
//! the waves need instead.
mod balance;
pub mod error;
pub mod frustum;
pub mod grid;
pub mod morph;
pub mod node;
pub mod palette;
pub mod quadtree;
pub mod select;
pub mod settings;
pub mod skirt;
pub mod snap;
pub mod spacing;
pub mod stitch;
pub mod subdivision;
pub mod tessellation;
pub mod weight;

pub use error::LodError;
pub use frustum::Frustum;
pub use morph::vertex_position;
pub use node::Node;
pub use palette::level_color;
pub use quadtree::Quadtree;
pub use select::{Batch, Instance, Leaf, MAX_BATCH, Selection};
pub use settings::{LodSettings, Preset, Quality};
pub use skirt::{SkirtVertex, border_fade, skirt};
pub use snap::{snap_origin, snap_step};
pub use spacing::{vertex_spacing, vertex_spacing_bound};
pub use stitch::{Edge, Pattern};
pub use subdivision::SubdivisionMap;
pub use tessellation::{SignalSettings, Tessellation};
pub use weight::{Ranges, WEIGHT_STEPS, morph_start};
