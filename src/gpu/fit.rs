//! Pictures of one shape in windows of another: as large as fits, in the middle, black around.

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    /// Left and top edge.
    pub from: [u32; 2],
    /// Right and bottom edge, outside.
    pub to: [u32; 2],
}

/// Where picture number `index` of `count`, side by side, goes in a window of `window` pixels; all are `picture` pixels
/// large. Empty only where the window is.
pub(super) fn fit(picture: [u32; 2], window: [u32; 2], index: u32, count: u32) -> Area {
    let wide = |value: u32| u64::from(value);
    let edge = |index: u32| wide(window[0]) * wide(index) / wide(count.max(1));
    let (left, right) = (edge(index), edge(index + 1));
    let cell = [right - left, wide(window[1])];
    let [width, height] = picture.map(|side| wide(side.max(1)));
    // The side that is short decides; the other follows, rounded.
    let size = if cell[0] * height <= cell[1] * width {
        [cell[0], (cell[0] * height + width / 2) / width]
    } else {
        [(cell[1] * width + height / 2) / height, cell[1]]
    };
    let size = [0, 1].map(|axis| size[axis].clamp(cell[axis].min(1), cell[axis]));
    let from = [left + (cell[0] - size[0]) / 2, (cell[1] - size[1]) / 2];
    let narrow = |value: u64| u32::try_from(value).unwrap_or(u32::MAX);
    Area { from: from.map(narrow), to: [0, 1].map(|axis| narrow(from[axis] + size[axis])) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_the_windows_size_fills_it() {
        assert_eq!(fit([641, 359], [641, 359], 0, 1), Area { from: [0, 0], to: [641, 359] });
    }

    #[test]
    fn bars_are_equal_and_the_shape_is_kept() {
        assert_eq!(fit([100, 100], [300, 200], 0, 1), Area { from: [50, 0], to: [250, 200] });
        assert_eq!(fit([200, 100], [100, 100], 0, 1), Area { from: [0, 25], to: [100, 75] });
    }

    #[test]
    fn two_pictures_stand_beside_each_other() {
        assert_eq!(fit([100, 100], [400, 200], 0, 2), Area { from: [0, 0], to: [200, 200] });
        assert_eq!(fit([100, 100], [400, 200], 1, 2), Area { from: [200, 0], to: [400, 200] });
    }

    #[test]
    fn nothing_leaves_the_window_and_nothing_vanishes() {
        for picture in [[1, 4000], [4000, 1], [1280, 720], [3, 2]] {
            for window in [[1, 1], [2, 999], [999, 2], [640, 480]] {
                for (index, count) in [(0, 1), (0, 2), (1, 2)] {
                    let Area { from, to } = fit(picture, window, index, count);
                    assert!(to[0] <= window[0] && to[1] <= window[1], "{picture:?} {window:?}");
                    let cells = window[0] >= count;
                    assert!(!cells || (from[0] < to[0] && from[1] < to[1]), "{picture:?} {window:?}");
                }
            }
        }
    }
}
