//! What `--debug` can show instead of water.

use super::ocean::Layer;
use super::sea_stages::SeaStages;
use super::shaders;
use std::str::FromStr;

/// What is drawn on the sea's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// Water.
    #[default]
    Water,
    /// The triangles, coloured by level.
    Wireframe,
    /// Patches coloured by level.
    Lod,
    /// Normals: x red, z green, up blue.
    Normal,
    /// Compression 1 - J: white where foam begins, red beyond.
    Jacobian,
    /// Height as a colour: blue troughs, red crests.
    Height,
    /// Height in metres, for targets of one float channel.
    Metres,
    /// Water without a sky, over magenta: magenta below the horizon is a hole in the sea.
    Holes,
}

impl FromStr for Look {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        Ok(match word {
            "wireframe" => Self::Wireframe,
            "lod" => Self::Lod,
            "normal" => Self::Normal,
            "jacobian" => Self::Jacobian,
            "height" => Self::Height,
            "holes" => Self::Holes,
            _ => return Err("one of wireframe, lod, normal, jacobian, height, holes".to_owned()),
        })
    }
}

impl Look {
    /// What is drawn on the surface, one over the other.
    pub(super) fn layers(self, stages: SeaStages) -> Vec<Layer> {
        let layer = |fragment, entry| Layer { fragment, entry, lines: false };
        match self {
            Self::Water | Self::Holes => {
                vec![layer(stages.water(), c"fragment_main")]
            }
            Self::Wireframe => vec![
                layer(shaders::DEBUG_BASE_MAIN, c"base_main"),
                Layer { fragment: shaders::DEBUG_LINE_MAIN, entry: c"line_main", lines: true },
            ],
            Self::Lod => vec![layer(stages.lod(), c"lod_main")],
            Self::Normal => vec![layer(stages.normal(), c"normal_main")],
            Self::Jacobian => vec![layer(stages.jacobian(), c"jacobian_main")],
            Self::Height => vec![layer(shaders::DEBUG_HEIGHT_MAIN, c"height_main")],
            Self::Metres => vec![layer(shaders::DEBUG_METRES_MAIN, c"metres_main")],
        }
    }

    /// Whether the sky is drawn behind it.
    pub(super) const fn has_sky(self) -> bool {
        !matches!(self, Self::Holes | Self::Metres | Self::Wireframe)
    }

    /// Whether things float on it.
    pub(super) const fn has_solids(self) -> bool {
        matches!(self, Self::Water)
    }

    /// Whether it is a picture for eyes, which a vignette may darken.
    pub(super) const fn has_vignette(self) -> bool {
        !matches!(self, Self::Metres)
    }

    /// What shows where nothing is drawn.
    pub(super) const fn clear(self) -> [f32; 4] {
        match self {
            Self::Holes => [1.0, 0.0, 1.0, 1.0],
            Self::Metres => [f32::NAN; 4],
            _ => [0.0, 0.0, 0.0, 1.0],
        }
    }
}
