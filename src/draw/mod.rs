//! Draw.
#[allow(missing_docs)]
pub mod shaders {
    use crate::gpu::BindingKind;
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
