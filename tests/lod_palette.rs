//! The colours of levels in the shader are those of its twin in Rust.
use swell::lod::level_color;

#[test]
fn the_shader_has_the_same_colours_in_the_same_order() {
    let shader = include_str!("../shaders/debug.wgsl");
    let mut rest = shader;
    for level in 0..9 {
        let [r, g, b] = level_color(level);
        let row = format!("vec3f({r:.2}, {g:.2}, {b:.2}),");
        let (_, after) =
            rest.split_once(&row).unwrap_or_else(|| panic!("level {level}: no {row} in its place"));
        rest = after;
    }
    assert_eq!(level_color(9), level_color(0));
}
