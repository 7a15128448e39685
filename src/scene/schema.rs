//! Every key of a scene file, a file for each section. Reading, checking, defaults and `docs/scene.md` all come from these tables.

mod camera;
mod lod;
mod raft;
mod sea;
mod sky;
mod water;
mod wave_kinds;
mod waves;

pub(super) use camera::CAMERA;
pub(super) use lod::{LOD, LOD_SIGNAL};
pub(super) use raft::{BUOY, RAFT};
pub(super) use sea::{CASCADE_ONLY, FOAM, SEA, SEA_AND_CASCADE};
pub(super) use sky::SKY;
pub(super) use water::WATER;
pub(super) use wave_kinds::{GERSTNER_FORMS, KEYS_OF_KINDS, kinds_with};
pub(super) use waves::{ANY_SEA, FBM, FBM_FOAM, LAYER, STILL_WATER, WAVE};
