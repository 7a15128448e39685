//! The lace of foam: a tiling pattern of bubble rafts, made once at the start.
//!
//! Worley's cellular noise (1996) at three scales; foam gathers along the walls between cells, where the distances to
//! the two nearest points are nearly the same. The values are then ranked, so that a fraction a of all texels is below
//! a: a cover of a makes that share of the sea white, and the rest are gaps.

/// Texels along the side.
pub const SIZE: usize = 256;
/// Mip levels.
pub const MIPS: usize = SIZE.ilog2() as usize + 1;
/// Cells along the side and weight of each scale.
const SCALES: [(usize, f32); 3] = [(7, 0.5), (17, 0.32), (41, 0.18)];

/// One byte a texel, mip after mip.
pub fn texels() -> Vec<u8> {
    let mut ranked: Vec<(f32, usize)> = (0..SIZE * SIZE).map(|i| (lace(i % SIZE, i / SIZE), i)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut level = vec![0_u8; SIZE * SIZE];
    for (rank, &(_, i)) in ranked.iter().enumerate() {
        level[i] = u8::MAX - u8::try_from(rank * 256 / (SIZE * SIZE)).unwrap_or(u8::MAX);
    }
    let (mut chain, mut size) = (Vec::new(), SIZE);
    loop {
        chain.extend_from_slice(&level);
        if size == 1 {
            return chain;
        }
        let half = size / 2;
        level = (0..half * half)
            .map(|i| {
                let at = |dx, dy| u32::from(level[(i / half * 2 + dy) * size + i % half * 2 + dx]);
                u8::try_from((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4).unwrap_or(u8::MAX)
            })
            .collect();
        size = half;
    }
}

#[expect(clippy::cast_precision_loss, reason = "texel and cell counts")]
fn lace(x: usize, y: usize) -> f32 {
    SCALES
        .iter()
        .map(|&(cells, weight)| {
            let scale = cells as f32 / SIZE as f32;
            weight * (1.0 - walls(x as f32 * scale, y as f32 * scale, cells))
        })
        .sum()
}

/// Distance to the second nearest point minus that to the nearest, on a torus of `cells` x `cells` unit cells.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "small cell numbers"
)]
fn walls(x: f32, y: f32, cells: usize) -> f32 {
    let (cx, cy) = (x.floor(), y.floor());
    let (mut first, mut second) = (f32::MAX, f32::MAX);
    for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx as f32, dy as f32))) {
        let wrap = |c: f32| (c as i32).rem_euclid(cells as i32) as u32;
        let [jx, jy] = jitter(wrap(cx + dx), wrap(cy + dy), cells as u32);
        let distance = (cx + dx + jx - x).hypot(cy + dy + jy - y);
        if distance < first {
            second = first;
            first = distance;
        } else if distance < second {
            second = distance;
        }
    }
    second - first
}

/// A cell's point, in 0..1 along both sides: a hash after Wellons' lowbias32.
#[expect(clippy::cast_precision_loss, reason = "16 bits")]
fn jitter(x: u32, y: u32, cells: u32) -> [f32; 2] {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ cells;
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    [(h & 0xffff) as f32 / 65536.0, (h >> 16) as f32 / 65536.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cover_is_the_share_of_white() {
        let texels = texels();
        for threshold in [32_u8, 128, 224] {
            let above = texels[..SIZE * SIZE].iter().filter(|&&t| t <= u8::MAX - threshold).count();
            assert_eq!(above, SIZE * SIZE * (256 - usize::from(threshold)) / 256);
        }
        assert_eq!(texels.len(), (4 * SIZE * SIZE - 1) / 3);
    }

    #[test]
    fn the_pattern_tiles() {
        let t = texels();
        let step = |a: usize, b: usize| f64::from(t[a].abs_diff(t[b]));
        let inside: f64 = (0..SIZE).map(|y| step(y * SIZE + 100, y * SIZE + 101)).sum();
        let seam: f64 = (0..SIZE).map(|y| step(y * SIZE + SIZE - 1, y * SIZE)).sum();
        assert!(seam < 2.0 * inside, "{seam} across the seam, {inside} inside");
    }
}
