//! Material overrides in a scene file.

use crate::color::Color;
use crate::number::{Fraction, NonNegative};
use crate::schema::{scene_enum, scene_struct};

scene_struct! {
    /// A material override. Each field that is set replaces the field of the model's material and
    /// its texture; the others are unchanged. If a material has several overrides, later ones win.
    pub struct MaterialFile as "Material" {
        /// The materials to override. Default: `All`.
        pub of: MaterialsFile = MaterialsFile::All,
        /// The base color; vertex colors still multiply it. Default: as in the model.
        pub base_color: Option<Color> = None,
        /// The base color's alpha, from 0 to 1; it takes effect with `Blend` and `Mask`. Default:
        /// as in the model.
        pub alpha: Option<Fraction> = None,
        /// The metalness: 0 for dielectrics, 1 for metals. If `metallic` or `roughness` is set,
        /// their shared texture is dropped. Default: as in the model.
        pub metallic: Option<Fraction> = None,
        /// The roughness: 0 for mirrors, 1 for chalk. Default: as in the model.
        pub roughness: Option<Fraction> = None,
        /// The color of the emitted light. Default: as in the model.
        pub emissive: Option<Color> = None,
        /// A factor for the emitted light. Default: as in the model; 1 with `emissive`.
        pub emissive_strength: Option<NonNegative> = None,
        /// The interpretation of alpha. Default: as in the model.
        pub alpha_mode: Option<AlphaModeFile> = None,
        /// Whether back faces are also shown. Default: as in the model.
        pub double_sided: Option<bool> = None,
        /// Whether the base color is shown without lighting. Default: as in the model.
        pub unlit: Option<bool> = None,
        /// Whether textures are kept and multiplied by the values of this override. Default: false.
        pub keep_textures: bool = false,
    }
}

scene_enum! {
    /// A selection of a model's materials.
    #[derive(Eq)]
    pub enum MaterialsFile as "Materials" {
        /// All materials, including the one for surfaces without a material.
        All,
        /// The materials with this name.
        Name(String),
        /// By index in the file, from 0.
        Index(usize),
    }
}

scene_enum! {
    /// The interpretation of alpha.
    #[derive(Copy)]
    pub enum AlphaModeFile as "AlphaMode" {
        /// Alpha is ignored.
        Opaque,
        /// The surface is opaque where alpha reaches the cutoff, and absent elsewhere.
        Mask {
            /// The smallest alpha that is opaque, from 0 to 1. Default: 0.5.
            cutoff: Fraction = Fraction::HALF,
        },
        /// Alpha is the surface's opacity over everything behind it.
        Blend,
    }
}
