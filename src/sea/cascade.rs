//! One cascade: its spectrum, its working space, and its chain of stages.
use super::{
    clock::Phase,
    displacement,
    error::SeaError,
    evolve,
    fft::{Fft, LANES, Lane, two},
    foam::{self, Fading, FrameFoam, Memory},
    gradient::{self, Field, GradientParams},
    maps::CascadeMaps,
    mips::{halve, mip_levels, mip_offset},
    settings::{CascadeSettings, NormalKind},
    spectrum::PackedSpectrum,
    stages::{Times, stage},
};
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

/// Rows of the grid in one job.
const ROWS: usize = 8;
/// Texels of a mip level worth a job of their own.
const MIP_BATCH: usize = 1024;

/// A cascade ready to be stepped.
#[derive(Clone, Debug)]
pub(super) struct Cascade {
    settings: CascadeSettings,
    params: GradientParams,
    spectrum: PackedSpectrum,
    fft: Fft,
    rotations: Vec<[f32; 2]>,
    /// Output of [`two::along_u`], all tiles.
    half: Vec<Lane>,
    /// Output of [`two::along_v`], all tiles.
    tiles: Vec<Lane>,
    /// `[n_u, n_y, n_v, J]`, unnormalised, the whole chain.
    normals: Vec<[f32; 4]>,
    /// `[Du, h, Dv, compression]`, the whole chain.
    texels: Vec<[f32; 4]>,
    memory: Memory,
}

impl Cascade {
    pub fn new(
        settings: &CascadeSettings,
        gravity: f64,
        period: f64,
        normals: NormalKind,
        index: u32,
    ) -> Result<Self, SeaError> {
        let n = settings.resolution;
        let fft = Fft::new(n)?;
        let spectrum = PackedSpectrum::new(settings, gravity, period, index)?;
        let chain = mip_offset(n, mip_levels(n));
        Ok(Self {
            params: GradientParams {
                per_difference: (n as f64 / (2.0 * settings.patch_size)) as f32,
                normal_length: gradient::normal_length(settings.roughness as f32),
                normals,
            },
            settings: settings.clone(),
            rotations: vec![[0.0; 2]; spectrum.harmonics.len()],
            half: vec![[0.0; LANES]; n / (2 * LANES) * two::half_tile_len(n)],
            tiles: vec![[0.0; LANES]; n / two::COLUMNS * two::column_tile_len(n)],
            normals: vec![[0.0; 4]; chain],
            texels: vec![[0.0; 4]; chain],
            memory: Memory::new(n),
            spectrum,
            fft,
        })
    }

    /// Fills `maps` for `phase`.
    pub fn step(&mut self, phase: Phase, fading: Option<&Fading>, maps: &mut CascadeMaps, times: &Times) {
        let foam = fading.map(|fading| self.remember(phase, fading, maps, times));
        self.displace(phase, maps, times);
        times.measure(stage::GRADIENT, || self.shade(foam, maps));
        times.measure(stage::MIPS, || self.filter(maps));
    }

    /// Brings the foam's memory to the last tick at or before `phase`; where that tick is the frame itself, to the one
    /// before. Uses the maps' planes as working space.
    fn remember(
        &mut self,
        phase: Phase,
        fading: &Fading,
        maps: &mut CascadeMaps,
        times: &Times,
    ) -> FrameFoam {
        let last = phase.tick(fading.ticks);
        let missing = self.memory.begin(last, fading);
        let on_tick = missing > 0 && Phase::of_tick(last, fading.ticks) == phase;
        // Until it is whole the memory is good for nothing, should a job panic.
        self.memory.tick = None;
        for back in (u64::from(on_tick)..missing).rev() {
            let laps = (back / fading.ticks + 1) * fading.ticks;
            let tick = Phase::of_tick((last + laps - back) % fading.ticks, fading.ticks);
            self.displace(tick, maps, times);
            times.measure(stage::FOAM, || self.take_in(fading.decay, maps));
        }
        self.memory.tick = Some(last);
        if on_tick {
            FrameFoam { lost: fading.decay, keep: true }
        } else {
            FrameFoam::after_tick(fading, last, phase)
        }
    }

    /// One tick of the foam's memory, from the displacement planes.
    fn take_in(&mut self, decay: f32, maps: &CascadeMaps) {
        let n = self.settings.resolution;
        let field = Field { du: &maps.du, height: &maps.height, dv: &maps.dv };
        let per_difference = self.params.per_difference;
        let breaking = self.settings.breaking as f32;
        self.memory.texels.par_chunks_mut(ROWS * n).enumerate().for_each(|(batch, memory)| {
            for (row, memory) in memory.chunks_exact_mut(n).enumerate() {
                gradient::jacobian_row(field, n, batch * ROWS + row, per_difference, |column, jacobian| {
                    for (memory, jacobian) in memory[column..].iter_mut().zip(jacobian) {
                        *memory = foam::fade(*memory, decay, foam::compression(jacobian, breaking));
                    }
                });
            }
        });
    }

    /// Evolution, transforms, displacement planes.
    fn displace(&mut self, phase: Phase, maps: &mut CascadeMaps, times: &Times) {
        let n = self.settings.resolution;
        let fft = &self.fft;
        times.measure(stage::ROTATIONS, || evolve::rotations(&self.spectrum, phase, &mut self.rotations));
        let rotations = &self.rotations;
        times.measure(stage::ALONG_U, || {
            let out = self.half.par_chunks_mut(two::half_tile_len(n));
            out.zip(self.spectrum.modes.par_chunks(n))
                .for_each(|(out, modes)| two::along_u(fft, modes, rotations, out));
        });
        let half = &self.half;
        times.measure(stage::ALONG_V, || {
            let out = self.tiles.par_chunks_mut(two::column_tile_len(n)).enumerate();
            out.for_each(|(tile, out)| two::along_v(fft, half, tile, out));
        });
        let (tiles, choppiness) = (&self.tiles, self.settings.choppiness as f32);
        times.measure(stage::DISPLACEMENT, || {
            let rows = maps.du.par_chunks_mut(ROWS * n);
            rows.zip(maps.height.par_chunks_mut(ROWS * n))
                .zip(maps.dv.par_chunks_mut(ROWS * n))
                .enumerate()
                .for_each(|(batch, ((du, height), dv))| {
                    let rows = displacement::Rows { du, height, dv };
                    displacement::assemble(tiles, n, choppiness, batch * ROWS, rows);
                });
        });
    }

    /// Level 0 of both maps, and what their chains are filtered from.
    fn shade(&mut self, foam: Option<FrameFoam>, maps: &mut CascadeMaps) {
        let n = self.settings.resolution;
        let params = &self.params;
        let field = Field { du: &maps.du, height: &maps.height, dv: &maps.dv };
        let (normals, texels) = (&mut self.normals[..n * n], &mut self.texels[..n * n]);
        let breaking = self.settings.breaking as f32;
        normals
            .par_chunks_mut(ROWS * n)
            .zip(texels.par_chunks_mut(ROWS * n))
            .zip(self.memory.texels.par_chunks_mut(ROWS * n))
            .zip(maps.gradient[..n * n].par_chunks_mut(ROWS * n))
            .zip(maps.displacement[..n * n].par_chunks_mut(ROWS * n))
            .enumerate()
            .for_each(|(batch, ((((normals, texels), memory), gradient), displacement))| {
                for (row, normals) in normals.chunks_exact_mut(n).enumerate() {
                    gradient::gradient_row(field, n, batch * ROWS + row, params, normals);
                }
                for (i, (texel, normal)) in texels.iter_mut().zip(&*normals).enumerate() {
                    let mut compression = foam::compression(normal[3], breaking);
                    if let Some(foam) = foam {
                        compression = foam::fade(memory[i], foam.lost, compression);
                        if foam.keep {
                            memory[i] = compression;
                        }
                    }
                    let at = batch * ROWS * n + i;
                    *texel = [field.du[at], field.height[at], field.dv[at], compression];
                }
                gradient::pack(normals, gradient);
                displacement.as_flattened_mut().convert_from_f32_slice(texels.as_flattened());
            });
    }

    /// The levels above 0 of both maps.
    fn filter(&mut self, maps: &mut CascadeMaps) {
        let n = self.settings.resolution;
        for level in 1..mip_levels(n) {
            let (from, here) = (mip_offset(n, level - 1), mip_offset(n, level));
            let next = mip_offset(n, level + 1);
            let side = n >> level;
            let batch = (MIP_BATCH / side).clamp(1, side) * side;
            let (upper_normals, normals) = self.normals[from..next].split_at_mut(here - from);
            let (upper_texels, texels) = self.texels[from..next].split_at_mut(here - from);
            normals
                .par_chunks_mut(batch)
                .zip(upper_normals.par_chunks(4 * batch))
                .zip(maps.gradient[here..next].par_chunks_mut(batch))
                .zip(texels.par_chunks_mut(batch))
                .zip(upper_texels.par_chunks(4 * batch))
                .zip(maps.displacement[here..next].par_chunks_mut(batch))
                .for_each(
                    |(((((normals, upper_normals), gradient), texels), upper_texels), displacement)| {
                        halve(upper_normals, 2 * side, normals);
                        gradient::pack(normals, gradient);
                        halve(upper_texels, 2 * side, texels);
                        displacement.as_flattened_mut().convert_from_f32_slice(texels.as_flattened());
                    },
                );
        }
    }

    /// Whether `maps` fit.
    pub fn fits(&self, maps: &CascadeMaps) -> bool {
        let n = self.settings.resolution;
        let chain = mip_offset(n, mip_levels(n));
        maps.resolution == n
            && maps.displacement.len() == chain
            && maps.gradient.len() == chain
            && [&maps.du, &maps.height, &maps.dv].iter().all(|plane| plane.len() == n * n)
    }

    /// Forgets the foam's memory, which a panic may have left half written.
    pub fn forget(&mut self) {
        self.memory.tick = None;
    }
}
