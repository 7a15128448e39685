//! What one frame shows: where it is seen from, the sea, and what floats on it.

use super::camera::Eye;
use super::solids::Solid;
use crate::sea::SeaMaps;

/// One moment, as a host describes it to [`super::Renderer::record`]. Everything is borrowed: hosts reuse their vectors.
#[derive(Clone, Copy)]
pub struct Moment<'a> {
    /// One for each of the target's views.
    pub eyes: &'a [Eye],
    /// The sea at this moment.
    pub maps: &'a SeaMaps,
    /// What floats on it, at most [`super::MOST_SOLIDS`]; drawn with [`super::Look::Water`] alone.
    pub solids: &'a [Solid],
    /// How far the comfort vignette is closed, 0 (not at all, and not drawn) to 1.
    pub vignette: f32,
}
