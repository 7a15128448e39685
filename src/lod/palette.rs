//! Colours for looking at the levels.

/// Linear Rec. 709 colours, neighbours told apart by hue and by lightness, also by people who see few hues
/// (after Okabe and Ito 2008).
const COLORS: [[f32; 3]; 9] = [
    [0.30, 0.30, 0.30],
    [0.00, 0.17, 0.45],
    [0.09, 0.46, 0.81],
    [0.00, 0.34, 0.17],
    [0.87, 0.77, 0.05],
    [0.79, 0.35, 0.00],
    [0.66, 0.11, 0.00],
    [0.60, 0.19, 0.39],
    [0.90, 0.90, 0.90],
];

/// Colour of a level in the `lod` debug view, linear Rec. 709; levels beyond the eighth start again.
pub const fn level_color(level: u8) -> [f32; 3] {
    COLORS[level as usize % COLORS.len()]
}
