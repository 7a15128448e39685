//! The surface straight ahead of whoever looks, for the panel's plot.

use crate::draw::Eye;
use crate::panel::{Panel, SECTION_POINTS, SECTION_STEP};
use crate::sea::{SeaMaps, query::Query};

/// Heights straight ahead of `eye`, where somebody looks at the plot.
pub fn cut(panel: &mut Panel, maps: &SeaMaps, eye: &Eye) {
    if !panel.plots().wants_section() {
        return;
    }
    let back = eye.axes.z_axis;
    let length = f64::from(back.x).hypot(f64::from(back.z)).max(1e-6);
    let ahead = [-f64::from(back.x) / length, -f64::from(back.z) / length];
    let query = Query::new(maps);
    let heights = (0..SECTION_POINTS).map(|point| {
        let distance = point as f64 * SECTION_STEP;
        query.above(eye.position.x + ahead[0] * distance, eye.position.z + ahead[1] * distance).height()
    });
    panel.plots().set_section(heights);
}
