//! What a scene file changes of the materials of a model.

use crate::scene::number::{NonNegative, Share};
use serde::Deserialize;

/// A change of materials. Each field that is there goes in place of what the model has, with its texture; the others stay as they
/// are. Of several changes of one material the later ones go before the earlier.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Material", deny_unknown_fields, default)]
pub struct MaterialFile {
    /// Which materials. Default: `All`.
    pub of: MaterialsFile,
    /// The base colour as on a web page, `#rgb` or `#rrggbb`; colours of vertices still multiply it. Default: as the model has it.
    pub base_color: Option<String>,
    /// The base colour's alpha, from 0 to 1; it counts with `Blend` and `Mask`. Default: as the model has it.
    pub alpha: Option<Share>,
    /// 0 for what is no metal, 1 for metals. Where it or `roughness` is there, the texture of both is left out. Default: as the model has it.
    pub metallic: Option<Share>,
    /// 0 for mirrors, 1 for chalk. Default: as the model has it.
    pub roughness: Option<Share>,
    /// The colour of the light that the surface gives off, `#rgb` or `#rrggbb`. Default: as the model has it.
    pub emissive: Option<String>,
    /// What that light is multiplied by. Default: as the model has it; 1 with `emissive`.
    pub emissive_strength: Option<NonNegative>,
    /// What alpha means. Default: as the model has it.
    pub alpha_mode: Option<AlphaModeFile>,
    /// Whether the backs of surfaces are shown too. Default: as the model has it.
    pub double_sided: Option<bool>,
    /// Whether the base colour is shown as it is, without light. Default: as the model has it.
    pub unlit: Option<bool>,
    /// Whether textures stay, to be multiplied by what is given. Default: false.
    pub keep_textures: bool,
}

/// Which materials of a model.
#[derive(Clone, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Materials")]
pub enum MaterialsFile {
    /// All of them, and that of surfaces without one.
    #[default]
    All,
    /// Those of this name.
    Name(String),
    /// By its place in the file, from 0.
    Index(usize),
}

/// What the alpha of a surface means.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "AlphaMode", deny_unknown_fields)]
pub enum AlphaModeFile {
    /// Nothing: the surface is solid.
    Opaque,
    /// The surface is solid where alpha is at least the cutoff, and absent elsewhere.
    Mask {
        /// The smallest alpha that is solid, from 0 to 1. Default: 0.5.
        #[serde(default = "half")]
        cutoff: Share,
    },
    /// The share of the surface's colour over what is behind it.
    Blend,
}

fn half() -> Share {
    Share::HALF
}
