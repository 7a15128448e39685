//! What a window shows of a headset's views.

use crate::gpu::Layers;
use std::str::FromStr;

/// `--mirror`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mirror {
    /// The left eye's view.
    #[default]
    Left,
    /// The right eye's view.
    Right,
    /// Both, side by side.
    Both,
    /// There is no window.
    None,
}

impl FromStr for Mirror {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        Ok(match word {
            "left" => Self::Left,
            "right" => Self::Right,
            "both" => Self::Both,
            "none" => Self::None,
            _ => return Err("one of left, right, both, none".to_owned()),
        })
    }
}

impl Mirror {
    /// The layers of the headset's pictures that are shown; none without a window.
    pub const fn layers(self) -> Option<Layers> {
        match self {
            Self::Left => Some(Layers::One(0)),
            Self::Right => Some(Layers::One(1)),
            Self::Both => Some(Layers::Both),
            Self::None => None,
        }
    }
}
