//! What the KHR_materials extensions of glTF add to a surface: one small record for each, absent where the file has none.
//!
//! Names, units and channels of textures are those of the extensions' texts. Factors are linear; a texture multiplies
//! the factor it stands beside. Records are boxed: most materials have none of them.

use crate::{NormalTexture, TextureInfo};

/// All of them.
#[derive(Clone, PartialEq, Debug)]
pub struct MaterialExtensions {
    /// The index of refraction: 0 (reflects everything) or at least 1. Default: 1.5 (KHR_materials_ior).
    pub ior: f32,
    /// How far indices of refraction differ between colours: 20 over the Abbe number, at least 0. Default: 0
    /// (KHR_materials_dispersion).
    pub dispersion: f32,
    /// The strength and colour of highlights of dielectrics.
    pub specular: Option<Box<Specular>>,
    /// The older model of surfaces, in the place of metalness and roughness.
    pub specular_glossiness: Option<Box<SpecularGlossiness>>,
    /// A clear layer on the surface.
    pub clearcoat: Option<Box<Clearcoat>>,
    /// The fibres of cloth.
    pub sheen: Option<Box<Sheen>>,
    /// Light that passes through the surface.
    pub transmission: Option<Box<Transmission>>,
    /// The body behind the surface.
    pub volume: Option<Box<Volume>>,
    /// A thin film on the surface.
    pub iridescence: Option<Box<Iridescence>>,
    /// Highlights that are longer in one direction.
    pub anisotropy: Option<Box<Anisotropy>>,
}

impl Default for MaterialExtensions {
    fn default() -> Self {
        Self {
            ior: 1.5,
            dispersion: 0.0,
            specular: None,
            specular_glossiness: None,
            clearcoat: None,
            sheen: None,
            transmission: None,
            volume: None,
            iridescence: None,
            anisotropy: None,
        }
    }
}

/// The strength and colour of highlights of dielectrics (KHR_materials_specular).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Specular {
    /// In [0, 1]. Default: 1.
    pub factor: f32,
    /// Its texture (alpha).
    pub texture: Option<TextureInfo>,
    /// The colour seen from straight ahead, at least 0 and above 1 at will. Default: 1.
    pub color: [f32; 3],
    /// Its texture (sRGB).
    pub color_texture: Option<TextureInfo>,
}

/// The older model of surfaces (KHR_materials_pbrSpecularGlossiness). Its diffuse factor and texture are the material's base
/// colour, the metalness is 0 and the roughness 1 − glossiness: what shows no more than those shows a fair likeness.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SpecularGlossiness {
    /// The reflected share seen from straight ahead, each in [0, 1]. Default: 1.
    pub specular: [f32; 3],
    /// 1 for mirrors, 0 for chalk. Default: 1.
    pub glossiness: f32,
    /// The texture of both: the colour (sRGB), and in alpha (linear) the glossiness.
    pub texture: Option<TextureInfo>,
}

/// A clear layer on the surface, with an index of refraction of 1.5 (KHR_materials_clearcoat).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Clearcoat {
    /// How much of the surface has it, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Its texture (red).
    pub texture: Option<TextureInfo>,
    /// The layer's own roughness, in [0, 1]. Default: 0.
    pub roughness: f32,
    /// Its texture (green).
    pub roughness_texture: Option<TextureInfo>,
    /// The layer's own slopes; without it the layer is smooth.
    pub normal_texture: Option<NormalTexture>,
}

/// The fibres of cloth, seen at its rim (KHR_materials_sheen).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Sheen {
    /// Each in [0, 1]. Default: 0, which is no sheen.
    pub color: [f32; 3],
    /// Its texture (sRGB).
    pub color_texture: Option<TextureInfo>,
    /// In [0, 1]. Default: 0.
    pub roughness: f32,
    /// Its texture (alpha).
    pub roughness_texture: Option<TextureInfo>,
}

/// Light that passes through the surface and is tinted by the base colour (KHR_materials_transmission). It is shown straight and sharp, as
/// through a thin pane: neither `ior` bends it nor roughness blurs it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Transmission {
    /// The share of the light that is not reflected and passes through, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Its texture (red).
    pub texture: Option<TextureInfo>,
}

/// The body behind the surface (KHR_materials_volume).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Volume {
    /// The thickness below the surface in the mesh's own units, at least 0; 0 for a thin sheet. Default: 0.
    pub thickness: f32,
    /// Its texture (green).
    pub thickness_texture: Option<TextureInfo>,
    /// After so much way through the body, in units of the world, white light has `attenuation_color`; above 0. Default: infinite.
    pub attenuation_distance: f32,
    /// Each in [0, 1]. Default: 1.
    pub attenuation_color: [f32; 3],
}

/// A thin film on the surface (KHR_materials_iridescence).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Iridescence {
    /// How much of the surface has it, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Its texture (red).
    pub texture: Option<TextureInfo>,
    /// The film's index of refraction, at least 1. Default: 1.3.
    pub ior: f32,
    /// The thickness in nanometres where the texture's green is 0, at least 0. Default: 100.
    pub thickness_minimum: f32,
    /// The thickness in nanometres where the texture's green is 1, or where there is no texture, at least 0. Default: 400.
    pub thickness_maximum: f32,
    /// The texture of the thickness (green).
    pub thickness_texture: Option<TextureInfo>,
}

/// Highlights that are longer in one direction (KHR_materials_anisotropy).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Anisotropy {
    /// In [0, 1]; 0 for round highlights. Default: 0.
    pub strength: f32,
    /// The direction in radians, counter-clockwise from the tangent. Default: 0.
    pub rotation: f32,
    /// Its texture: red and green are 2x − 1 of a direction that is turned by `rotation`, blue multiplies the strength.
    pub texture: Option<TextureInfo>,
}

impl Default for Specular {
    fn default() -> Self {
        Self { factor: 1.0, texture: None, color: [1.0; 3], color_texture: None }
    }
}

impl Default for SpecularGlossiness {
    fn default() -> Self {
        Self { specular: [1.0; 3], glossiness: 1.0, texture: None }
    }
}

impl Default for Volume {
    fn default() -> Self {
        Self {
            thickness: 0.0,
            thickness_texture: None,
            attenuation_distance: f32::INFINITY,
            attenuation_color: [1.0; 3],
        }
    }
}

impl Default for Iridescence {
    fn default() -> Self {
        Self {
            factor: 0.0,
            texture: None,
            ior: 1.3,
            thickness_minimum: 100.0,
            thickness_maximum: 400.0,
            thickness_texture: None,
        }
    }
}
