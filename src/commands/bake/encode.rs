//! A map in the bytes of its file.
use super::Format;
use super::files::{Map, MapFile};
use crate::output::{atomic::Sink, exr, npy};
use crate::sea::{CascadeMaps, Planes};
use std::io;

/// Writes the map that `file` is for.
///
/// Displacement: `[z][x][Dx, h, Dz]` in metres along the cascade's own axes, `f32`; as an image R = Dx, G = h, B = Dz.
/// Gradient: the bytes of eqs (50)(51), `[pixel][n_x, n_z, J, smoothness]`, levels in the order of eq (55); as an image
/// with mip maps R = n_x, G = n_z and B = J from -1 to 1, A = smoothness from 0 to 1.
pub(super) fn write(file: &MapFile, maps: &CascadeMaps, mut sink: &mut dyn Sink) -> io::Result<()> {
    let n = maps.resolution;
    match (file.map, file.format) {
        (Map::Displacement, Format::Npy) => {
            npy::write(&mut sink, &[n as u64, n as u64, 3], displacement(maps)?.flatten())
        }
        (Map::Displacement, Format::Exr) => {
            exr::write_rgb(&mut sink, [n, n], &displacement(maps)?.collect::<Vec<_>>())
        }
        (Map::Gradient, Format::Npy) => {
            let shape = [maps.gradient.len() as u64, 4];
            npy::write(&mut sink, &shape, maps.gradient.as_flattened().iter().copied())
        }
        (Map::Gradient, Format::Exr) => {
            let pixels: Vec<_> = maps.gradient.iter().map(|&texel| unpack(texel)).collect();
            exr::write_rgba_mips(&mut sink, n, &pixels)
        }
    }
}

fn displacement(maps: &CascadeMaps) -> io::Result<impl Iterator<Item = [f32; 3]>> {
    let without = || io::Error::other("the maps were made without planes of full precision");
    let Planes { du, height, dv } = maps.planes.as_ref().ok_or_else(without)?;
    Ok(du.iter().zip(height).zip(dv).map(|((&du, &height), &dv)| [du, height, dv]))
}

/// The inverse of eq (50).
fn unpack([nu, nv, jacobian, smoothness]: [u8; 4]) -> [f32; 4] {
    let unsigned = |byte: u8| f32::from(byte) / 255.0;
    let signed = |byte: u8| unsigned(byte) * 2.0 - 1.0;
    [signed(nu), signed(nv), signed(jacobian), unsigned(smoothness)]
}
