//! KHR_materials extensions: clearcoat, sheen, transmission, volume, iridescence, anisotropy and
//! more.
//!
//! Each extension with several parameters has a record, which is absent if the material does not
//! use the extension. Names, units and texture channels follow the extensions' specifications.
//! Factors are linear, and a texture multiplies the factor of the same name. Records are boxed
//! because most materials have none.

use crate::{NormalTexture, TextureInfo};

/// The parameters of a material's KHR_materials extensions.
#[derive(Clone, PartialEq, Debug)]
pub struct MaterialExtensions {
    /// Index of refraction: 0 (reflects everything) or at least 1. Default: 1.5
    /// (KHR_materials_ior).
    pub ior: f32,
    /// Dispersion: 20 over the Abbe number, at least 0. Default: 0 (KHR_materials_dispersion).
    pub dispersion: f32,
    /// Strength and color of the specular reflection of dielectrics.
    pub specular: Option<Box<Specular>>,
    /// Specular-glossiness workflow, instead of metalness and roughness.
    pub specular_glossiness: Option<Box<SpecularGlossiness>>,
    /// Clear layer on top of the surface.
    pub clearcoat: Option<Box<Clearcoat>>,
    /// Retroreflective cloth fibers.
    pub sheen: Option<Box<Sheen>>,
    /// Light that passes through the surface.
    pub transmission: Option<Box<Transmission>>,
    /// Absorbing medium behind the surface.
    pub volume: Option<Box<Volume>>,
    /// Thin film on the surface.
    pub iridescence: Option<Box<Iridescence>>,
    /// Anisotropic roughness: highlights stretched along one direction.
    pub anisotropy: Option<Box<Anisotropy>>,
}

impl Default for MaterialExtensions {
    /// Returns the parameters without extensions: an index of refraction of 1.5, and no dispersion.
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

/// The strength and color of the specular reflection of dielectrics (KHR_materials_specular).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Specular {
    /// Strength in [0, 1]. Default: 1.
    pub factor: f32,
    /// Texture of the strength (alpha).
    pub texture: Option<TextureInfo>,
    /// Color of the reflection at normal incidence (F0), at least 0 and possibly above 1. Default:
    /// 1.
    pub color: [f32; 3],
    /// Texture of the color (sRGB).
    pub color_texture: Option<TextureInfo>,
}

/// The specular-glossiness workflow (KHR_materials_pbrSpecularGlossiness).
///
/// The diffuse factor and texture are stored as the material's base color, with metalness 0 and
/// roughness 1 − glossiness. Shading that ignores this record is a reasonable approximation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SpecularGlossiness {
    /// Reflectance at normal incidence (F0), with each channel in [0, 1]. Default: 1.
    pub specular: [f32; 3],
    /// 1 − roughness: 1 for mirrors, 0 for chalk. Default: 1.
    pub glossiness: f32,
    /// Texture of both: F0 in red, green and blue (sRGB), and glossiness in alpha (linear).
    pub texture: Option<TextureInfo>,
}

/// A clear coating with an index of refraction of 1.5 (KHR_materials_clearcoat).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Clearcoat {
    /// Strength of the layer, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Texture of the strength (red).
    pub texture: Option<TextureInfo>,
    /// Roughness of the layer, in [0, 1]. Default: 0.
    pub roughness: f32,
    /// Texture of the roughness (green).
    pub roughness_texture: Option<TextureInfo>,
    /// Normal map of the layer; without it the layer is smooth.
    pub normal_texture: Option<NormalTexture>,
}

/// Retroreflective cloth fibers, visible at grazing angles (KHR_materials_sheen).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Sheen {
    /// Color, with each channel in [0, 1]. Default: 0, which disables the layer.
    pub color: [f32; 3],
    /// Texture of the color (sRGB).
    pub color_texture: Option<TextureInfo>,
    /// Roughness of the layer, in [0, 1]. Default: 0.
    pub roughness: f32,
    /// Texture of the roughness (alpha).
    pub roughness_texture: Option<TextureInfo>,
}

/// Light that passes through the surface, tinted by the base color (KHR_materials_transmission).
///
/// Roughness scatters this light, and the thickness of a [`Volume`] refracts it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Transmission {
    /// Fraction of the unreflected light that is transmitted, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Texture of the fraction (red).
    pub texture: Option<TextureInfo>,
}

/// An absorbing medium behind the surface (KHR_materials_volume).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Volume {
    /// Thickness below the surface in mesh units, at least 0; 0 for a thin sheet. Default: 0.
    pub thickness: f32,
    /// Texture of the thickness (green).
    pub thickness_texture: Option<TextureInfo>,
    /// Distance in world units after which white light has become `attenuation_color`; above 0.
    /// Default: infinite.
    pub attenuation_distance: f32,
    /// Color of white light after that distance, with each channel in [0, 1]. Default: 1.
    pub attenuation_color: [f32; 3],
}

/// Thin-film interference (KHR_materials_iridescence).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Iridescence {
    /// Strength of the film, in [0, 1]. Default: 0.
    pub factor: f32,
    /// Texture of the strength (red).
    pub texture: Option<TextureInfo>,
    /// Index of refraction of the film, at least 1. Default: 1.3.
    pub ior: f32,
    /// Thickness in nanometers where the texture's green is 0, at least 0. Default: 100.
    pub thickness_minimum: f32,
    /// Thickness in nanometers where the texture's green is 1, or without a texture, at least 0.
    /// Default: 400.
    pub thickness_maximum: f32,
    /// Texture of the thickness (green).
    pub thickness_texture: Option<TextureInfo>,
}

/// Anisotropic roughness (KHR_materials_anisotropy).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Anisotropy {
    /// Strength in [0, 1]; 0 for round highlights. Default: 0.
    pub strength: f32,
    /// Direction of the stretched highlights in radians, counter-clockwise from the tangent.
    /// Default: 0.
    pub rotation: f32,
    /// Texture: red and green store a direction, decoded as 2x − 1 and rotated by `rotation`; blue
    /// multiplies the strength.
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
