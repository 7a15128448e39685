//! The sea: a patch of ocean from wind, as maps of displacement, normals and foam; and waves as formulas.
//!
//! # Stages
//! [`spectrum`] (once) -> every step [`evolve`] -> [`fft`] -> [`gradient`] -> [`mips`], with [`foam`] remembering. All that
//! follows the transform along columns is one pass over bands of rows. [`stages::STAGES`] is the graph of jobs; kernels
//! are written over [`simd`]; the scalar truth of every stage is in [`mod@reference`]. See `docs/sea.md`.
//!
//! # Formulas
//! [`waves`] holds other ways to make water move, which are no maps: a sea may have some in place of its spectrum, or on
//! top of it.
//!
//! # Guarantees
//! [`Sea::step`] is a pure function of the settings and the time: the same bytes on every run, with any number of
//! threads, from whatever time the sea was stepped before; and on AVX2, AVX-512 and NEON alike.
pub mod ahead;
mod band;
mod cascade;
pub mod clock;
mod columns;
pub mod dispersion;
pub mod error;
pub mod evolve;
pub mod fft;
pub mod foam;
pub mod gradient;
pub mod maps;
pub mod mips;
pub mod octaves;
mod pack;
pub mod philox;
pub mod query;
pub mod reference;
mod scratch;
pub mod settings;
mod shade;
pub mod simd;
pub mod spectrum;
mod split;
pub mod stages;
pub mod waves;

pub use ahead::SeaAhead;
pub use error::SeaError;
pub use maps::{CascadeMaps, Planes, SeaMaps};
pub use mips::{mip_levels, mip_offset};
pub use query::{Query, Surface};
pub use settings::{CascadeSettings, FoamSettings, NormalKind, SeaSettings, Spectrum, split_bands};
pub use spectrum::expected_variance;

use cascade::Cascade;
use clock::Phase;
use foam::Fading;
use rayon::prelude::*;
use simd::Isa;
use stages::Times;
use std::sync::Arc;
use waves::Model;

/// A sea ready to be stepped: spectra, working space, and the foam's memory.
#[derive(Debug)]
pub struct Sea {
    settings: SeaSettings,
    cascades: Vec<Cascade>,
    fading: Option<Fading>,
    models: Arc<[Model]>,
    times: Times,
}

impl Sea {
    /// Checks the settings and makes the spectra, on the threads of the pool it is called in.
    ///
    /// # Errors
    /// [`SeaError::Sea`] and [`SeaError::Cascade`] name the parameter that is out of range.
    pub fn new(settings: &SeaSettings) -> Result<Self, SeaError> {
        Self::with_isa(settings, Isa::best())
    }

    /// [`Sea::new`], stepped with the instructions of `isa`. AVX2, AVX-512 and NEON give the same bits.
    ///
    /// # Errors
    /// Those of [`Sea::new`].
    pub fn with_isa(settings: &SeaSettings, isa: Isa) -> Result<Self, SeaError> {
        settings.validate()?;
        let cascades = settings.cascades.iter().zip(0..).map(|(cascade, index)| {
            Cascade::new(cascade, settings.gravity, settings.repeat_period, settings.normals, index, isa)
        });
        let cascades = cascades.collect::<Result<_, _>>()?;
        for cascade in &settings.cascades {
            scratch::reserve(cascade.resolution, isa);
        }
        Ok(Self {
            cascades,
            fading: Fading::new(&settings.foam, settings.repeat_period),
            models: settings.models.as_slice().into(),
            settings: settings.clone(),
            times: Times::default(),
        })
    }

    /// What the sea was made from.
    pub fn settings(&self) -> &SeaSettings {
        &self.settings
    }

    /// Flat maps of the right sizes, to be filled by [`Sea::step`]: what a frame needs.
    pub fn new_maps(&self) -> SeaMaps {
        self.flat_maps(false)
    }

    /// [`Sea::new_maps`] with planes of displacement at full precision, which cost a step their writing.
    pub fn new_maps_with_planes(&self) -> SeaMaps {
        self.flat_maps(true)
    }

    fn flat_maps(&self, planes: bool) -> SeaMaps {
        let cascades = self.settings.cascades.iter().map(|cascade| CascadeMaps::new(cascade, planes));
        SeaMaps {
            time: 0.0,
            foam: self.settings.foam,
            cascades: cascades.collect(),
            models: Arc::clone(&self.models),
        }
    }

    /// Fills `maps` with the sea at `time` (seconds, any sign), on the threads of the pool it is called in.
    ///
    /// Stepping forward in small steps is cheapest; a first step, a step back, or one beyond the foam's memory rebuilds
    /// that memory, which costs about 20 steps for every second of the foam's fade time.
    ///
    /// # Errors
    /// [`SeaError::Time`] unless `time` is finite; [`SeaError::Maps`] for maps of another sea.
    pub fn step(&mut self, time: f64, maps: &mut SeaMaps) -> Result<(), SeaError> {
        self.step_some(time, u32::MAX, maps)
    }

    /// [`Sea::step`] of those cascades whose bit is set; the maps of the others stay as they are.
    fn step_some(&mut self, time: f64, cascades: u32, maps: &mut SeaMaps) -> Result<(), SeaError> {
        if !time.is_finite() {
            return Err(SeaError::Time { time });
        }
        let fits = maps.cascades.len() == self.cascades.len()
            && self.cascades.iter().zip(&maps.cascades).all(|(cascade, maps)| cascade.fits(maps));
        if !fits {
            return Err(SeaError::Maps);
        }
        let phase = Phase::at(time, self.settings.repeat_period);
        let (fading, times) = (self.fading.as_ref(), &self.times);
        self.cascades.par_iter_mut().zip(maps.cascades.par_iter_mut()).enumerate().for_each(
            |(index, (cascade, maps))| {
                if cascades & (1 << index) != 0 {
                    cascade.step(phase, fading, maps, times);
                }
            },
        );
        maps.time = time;
        maps.models = Arc::clone(&self.models);
        Ok(())
    }

    /// Time spent in each of [`stages::STAGES`], summed over cascades, since the last call.
    pub fn take_times(&self) -> [std::time::Duration; stages::STAGES.len()] {
        self.times.take()
    }

    /// Forgets what a panicking job may have left half written.
    pub(crate) fn forget(&mut self) {
        for cascade in &mut self.cascades {
            cascade.forget();
        }
    }
}
