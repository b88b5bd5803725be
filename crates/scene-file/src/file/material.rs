//! Material overrides in a scene file.

use crate::color::Color;
use crate::number::{Fraction, NonNegative};
use crate::schema::{scene_enum, scene_struct};

scene_struct! {
    /// A material override. Each field that is given replaces that of the model's material, with
    /// its texture; the others are unchanged. Of several overrides of one material, later ones win.
    pub struct MaterialFile as "Material" {
        /// Which materials. Default: `All`.
        pub of: MaterialsFile = MaterialsFile::All,
        /// The base color; vertex colors still multiply it. Default: as in the model.
        pub base_color: Option<Color> = None,
        /// The base color's alpha, from 0 to 1; it counts with `Blend` and `Mask`. Default: as in
        /// the model.
        pub alpha: Option<Fraction> = None,
        /// 0 for dielectrics, 1 for metals. Where it or `roughness` is given, the texture of both
        /// is left out. Default: as in the model.
        pub metallic: Option<Fraction> = None,
        /// 0 for mirrors, 1 for chalk. Default: as in the model.
        pub roughness: Option<Fraction> = None,
        /// The color of the emitted light. Default: as in the model.
        pub emissive: Option<Color> = None,
        /// A factor for the emitted light. Default: as in the model; 1 with `emissive`.
        pub emissive_strength: Option<NonNegative> = None,
        /// The meaning of alpha. Default: as in the model.
        pub alpha_mode: Option<AlphaModeFile> = None,
        /// Whether back faces are shown too. Default: as in the model.
        pub double_sided: Option<bool> = None,
        /// Whether the base color is shown without lighting. Default: as in the model.
        pub unlit: Option<bool> = None,
        /// Whether textures are kept, and multiplied by the given values. Default: false.
        pub keep_textures: bool = false,
    }
}

scene_enum! {
    /// A choice of materials of a model.
    #[derive(Eq)]
    pub enum MaterialsFile as "Materials" {
        /// All of them, and that of surfaces without one.
        All,
        /// Those of this name.
        Name(String),
        /// By the index in the file, from 0.
        Index(usize),
    }
}

scene_enum! {
    /// The meaning of alpha.
    #[derive(Copy)]
    pub enum AlphaModeFile as "AlphaMode" {
        /// Alpha is ignored.
        Opaque,
        /// The surface is opaque where alpha is at least the cutoff, and absent elsewhere.
        Mask {
            /// The smallest alpha that is opaque, from 0 to 1. Default: 0.5.
            cutoff: Fraction = Fraction::HALF,
        },
        /// Alpha is the opacity over what is behind the surface.
        Blend,
    }
}
