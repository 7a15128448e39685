//! One cascade: its spectrum, its working space, and its chain of stages.
use super::{
    band::{self, Frame, Shading, Tick},
    clock::Phase,
    columns::StepColumns,
    error::SeaError,
    evolve::Rotations,
    fft::{
        layout::{FIELDS, Layout},
        rows::HalfSpectra,
        run_sized,
        twiddles::Twiddles,
    },
    foam::{Fading, FrameFoam, Memory},
    gradient::GradientParams,
    maps::CascadeMaps,
    mips::{Pyramid, Top},
    scratch::with_scratch,
    settings::{CascadeSettings, NormalKind},
    simd::{Aligned, Isa},
    spectrum::PackedSpectrum,
    split::{self, MAX_BANDS},
    stages::{Times, stage},
};
use rayon::prelude::*;
use std::ops::Range;

/// A cascade ready to be stepped.
#[derive(Clone, Debug)]
pub(super) struct Cascade {
    isa: Isa,
    layout: Layout,
    params: GradientParams,
    breaking: f32,
    spectrum: PackedSpectrum,
    twiddles: Twiddles,
    rotations: Vec<[f32; 2]>,
    /// For each tile of ku the spectra of the three fields, columns transformed.
    half: Aligned<f32>,
    /// Those of the step before, where several threads step: see [`Self::transform_columns`].
    last_half: Aligned<f32>,
    /// The highest level that each band makes by itself.
    tops: Aligned<f32>,
    memory: Memory,
}

impl Cascade {
    pub fn new(
        settings: &CascadeSettings,
        gravity: f64,
        period: f64,
        normals: NormalKind,
        index: u32,
        isa: Isa,
    ) -> Result<Self, SeaError> {
        let n = settings.resolution;
        let layout = Layout::new(n).ok_or(SeaError::TransformSize { size: n })?;
        let spectrum = PackedSpectrum::new(settings, gravity, period, index, layout)?;
        let half = layout.tiles() * FIELDS * layout.tile_len();
        Ok(Self {
            params: GradientParams::new(settings, normals),
            breaking: settings.breaking as f32,
            rotations: vec![[0.0; 2]; spectrum.harmonics.len()],
            half: Aligned::zeros(half),
            last_half: Aligned::zeros(half),
            tops: Aligned::zeros(MAX_BANDS * Top::len(n)),
            memory: Memory::new(n),
            twiddles: Twiddles::new(&layout),
            spectrum,
            layout,
            isa,
        })
    }

    /// Fills `maps` for `phase`.
    pub fn step(&mut self, phase: Phase, fading: Option<&Fading>, maps: &mut CascadeMaps, times: &Times) {
        let foam = fading.map(|fading| self.remember(phase, fading, times));
        // A frame on a tick takes that tick in: until it has, the memory is good for nothing.
        let tick =
            if foam.is_some_and(|foam| foam.keep) { self.memory.tick.take() } else { self.memory.tick };
        self.transform_columns(phase, times);
        let band = self.band_rows();
        times.measure(stage::BANDS, || self.fill_bands(band, foam, maps));
        self.memory.tick = tick;
        times.measure(stage::TOP, || self.fill_top(band, maps));
    }

    /// Brings the foam's memory to the last tick at or before `phase`; where that tick is the frame itself, to the one
    /// before.
    fn remember(&mut self, phase: Phase, fading: &Fading, times: &Times) -> FrameFoam {
        let last = phase.tick(fading.ticks);
        let missing = self.memory.begin(last, fading);
        let on_tick = missing > 0 && Phase::of_tick(last, fading.ticks) == phase;
        // Until it is whole the memory is good for nothing, should a job panic.
        self.memory.tick = None;
        for back in (u64::from(on_tick)..missing).rev() {
            let laps = (back / fading.ticks + 1) * fading.ticks;
            let tick = Phase::of_tick((last + laps - back) % fading.ticks, fading.ticks);
            self.transform_columns(tick, times);
            times.measure(stage::FOAM, || self.take_in(fading.decay));
        }
        self.memory.tick = Some(last);
        if on_tick {
            FrameFoam { lost: fading.decay, keep: true }
        } else {
            FrameFoam::after_tick(fading, last, phase)
        }
    }

    /// Evolution, and the pass along columns.
    ///
    /// Of what a thread writes here the others have read their share in the step before, and still have it in their caches:
    /// each line would have to be taken back from there. So there are two of it, in turns.
    fn transform_columns(&mut self, phase: Phase, times: &Times) {
        if rayon::current_num_threads() > 1 {
            std::mem::swap(&mut self.half, &mut self.last_half);
        }
        times.measure(stage::ROTATIONS, || {
            let harmonics = &self.spectrum.harmonics;
            self.isa.run(Rotations { harmonics, phase, table: &mut self.rotations });
        });
        times.measure(stage::COLUMNS, || {
            let (isa, layout, rotations) = (self.isa, self.layout, &self.rotations);
            let (spectrum, twiddles) = (&self.spectrum, &self.twiddles.columns);
            let tiles = self.half.par_chunks_exact_mut(FIELDS * layout.tile_len()).with_max_len(1);
            tiles.enumerate().for_each(|(tile, out)| {
                with_scratch(|scratch| {
                    let spectrum = spectrum.tile(tile);
                    let height = scratch.tile(layout);
                    run_sized!(isa, layout.n, StepColumns { spectrum, rotations, twiddles, height, out });
                });
            });
        });
    }

    /// Rows in a band: rows at its edges are transformed by its neighbours too, so bands are few. The grid as a whole for one
    /// thread, one for each where that is a power of two, else so many that they can be shared out, at most
    /// [`MAX_BANDS`].
    fn band_rows(&self) -> usize {
        let threads = rayon::current_num_threads();
        let bands = if threads.is_power_of_two() { threads } else { (2 * threads).next_power_of_two() };
        let bands = bands.min(MAX_BANDS);
        (self.layout.n / bands).max(band::least_rows(self.layout.n))
    }

    /// What every band needs.
    fn shading(&self) -> Shading<'_> {
        Shading {
            half: HalfSpectra { tiles: &self.half, twiddles: &self.twiddles.rows },
            gradient: self.params,
            breaking: self.breaking,
        }
    }

    /// The pass along rows, and of both maps all that a band can make by itself.
    fn fill_bands(&mut self, band: usize, foam: Option<FrameFoam>, maps: &mut CascadeMaps) {
        let n = self.layout.n;
        let mut tops = std::mem::take(&mut self.tops);
        let mut memory = std::mem::take(&mut self.memory.texels);
        let (isa, shading) = (self.isa, self.shading());
        let mut bands = split::bands(n, band, maps, &mut memory, &mut tops);
        bands.par_iter_mut().with_max_len(1).flatten().for_each(|part| {
            with_scratch(|scratch| {
                let range: Range<usize> = part.range.clone();
                let working = scratch.band(n, isa);
                let planes = part.planes.as_mut().map(|planes| planes.each_mut().map(|plane| &mut **plane));
                let (maps, memory, top) = (&mut part.maps, &mut *part.memory, &mut *part.top);
                run_sized!(isa, n, Frame { shading, range, maps, planes, memory, foam, top, working });
            });
        });
        (self.tops, self.memory.texels) = (tops, memory);
    }

    /// The levels above those that bands make by themselves.
    fn fill_top(&self, band: usize, maps: &mut CascadeMaps) {
        let n = self.layout.n;
        if band == n {
            return;
        }
        let mut maps = split::whole(n, maps);
        with_scratch(|scratch| {
            let kept = scratch.pyramid(n);
            let pyramid = &Pyramid::of(n, &self.params);
            self.isa.run(Top { pyramid, band, tops: &self.tops, kept, maps: &mut maps });
        });
    }

    /// One tick of the foam's memory.
    fn take_in(&mut self, decay: f32) {
        let (n, band) = (self.layout.n, self.band_rows());
        let mut memory = std::mem::take(&mut self.memory.texels);
        let (isa, shading) = (self.isa, self.shading());
        memory.par_chunks_exact_mut(band * n).with_max_len(1).enumerate().for_each(|(index, memory)| {
            with_scratch(|scratch| {
                let range = index * band..(index + 1) * band;
                let working = scratch.band(n, isa);
                run_sized!(isa, n, Tick { shading, range, memory, decay, working });
            });
        });
        self.memory.texels = memory;
    }

    /// Whether `maps` fit.
    pub fn fits(&self, maps: &CascadeMaps) -> bool {
        maps.fits(self.layout.n)
    }

    /// Forgets the foam's memory, which a panic may have left half written, or lost.
    pub fn forget(&mut self) {
        let n = self.layout.n;
        self.memory = Memory::new(n);
        self.tops = Aligned::zeros(MAX_BANDS * Top::len(n));
    }
}
