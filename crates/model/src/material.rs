//! Materials: metallic-roughness PBR with the KHR_materials extensions, as declared in the file.

mod extensions;
mod texture_slot;
mod uv_transform;

pub use extensions::{
    Anisotropy, Clearcoat, Iridescence, MaterialExtensions, Sheen, Specular, SpecularGlossiness,
    Transmission, Volume,
};
pub use texture_slot::TextureSlot;
pub use uv_transform::{UvTransform, UvTransformPart};

/// A surface material: the glTF metallic-roughness model (glTF 2.0 §3.9) and its extensions.
///
/// All factors are linear, not sRGB, and in the ranges stated here. A texture multiplies the factor
/// of the same name. The comments state which channels are used and whether the texture is sRGB
/// encoded.
#[derive(Clone, PartialEq, Debug)]
pub struct Material {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Base color factor: red, green, blue and alpha in [0, 1]. Multiplies the texture and vertex
    /// color.
    pub base_color: [f32; 4],
    /// Base color texture (sRGB with linear alpha).
    pub base_color_texture: Option<TextureInfo>,
    /// Metalness: 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// Perceptual roughness: 0 for mirrors, 1 for chalk. Its square is the α of the GGX
    /// distribution.
    pub roughness: f32,
    /// Texture of metalness (blue) and roughness (green), linear.
    pub metallic_roughness_texture: Option<TextureInfo>,
    /// Normal map.
    pub normal_texture: Option<NormalTexture>,
    /// Ambient occlusion map.
    pub occlusion_texture: Option<OcclusionTexture>,
    /// Emitted radiance: the color of `emission` times its strength.
    pub emissive: [f32; 3],
    /// Texture of the emitted light (sRGB).
    pub emissive_texture: Option<TextureInfo>,
    /// The factors of `emissive`, which animations change one at a time.
    pub emission: Emission,
    /// How alpha is used: opaque, alpha test or blending.
    pub alpha_mode: AlphaMode,
    /// Whether back faces are also drawn.
    pub double_sided: bool,
    /// Whether the base color is shown without lighting (KHR_materials_unlit).
    pub unlit: bool,
    /// Parameters of the KHR_materials extensions.
    pub extensions: MaterialExtensions,
}

impl Material {
    /// Returns whether light passes through the surface (KHR_materials_transmission).
    ///
    /// Masked and unlit materials are always drawn opaque.
    #[must_use]
    pub fn is_transmissive(&self) -> bool {
        let transmission = self.extensions.transmission.as_ref();
        let masked = matches!(self.alpha_mode, AlphaMode::Mask { .. });
        transmission.is_some_and(|layer| layer.factor > 0.0) && !masked && !self.unlit
    }

    /// Returns whether transmitted light changes direction: refracted by the thickness of the
    /// surface (KHR_materials_volume, KHR_materials_dispersion) or scattered by its roughness.
    ///
    /// Smooth thin sheets and media with the same index of refraction as air do not deflect light.
    #[must_use]
    pub fn bends_transmitted_light(&self) -> bool {
        let MaterialExtensions { ior, specular_glossiness, volume, .. } = &self.extensions;
        let has_gloss_texture = specular_glossiness.as_ref().is_some_and(|g| g.texture.is_some());
        let is_rough = self.roughness > 0.0 || has_gloss_texture;
        let is_thick = volume.as_ref().is_some_and(|volume| volume.thickness > 0.0);
        self.is_transmissive() && *ior > 1.0 && (is_rough || is_thick)
    }

    /// Returns whether shading needs a tangent frame, for a normal map or anisotropic highlights.
    #[must_use]
    pub fn needs_tangents(&self) -> bool {
        let clearcoat = self.extensions.clearcoat.as_ref();
        self.normal_texture.is_some()
            || self.extensions.anisotropy.is_some()
            || clearcoat.is_some_and(|clearcoat| clearcoat.normal_texture.is_some())
    }
}

impl Default for Material {
    /// Returns the default material (glTF 2.0 §3.9): white, opaque, metallic, rough and
    /// single-sided.
    fn default() -> Self {
        Self {
            name: None,
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            occlusion_texture: None,
            emissive: [0.0; 3],
            emissive_texture: None,
            emission: Emission::default(),
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
            extensions: MaterialExtensions::default(),
        }
    }
}

/// The color and strength of emission.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Emission {
    /// Red, green and blue, each in [0, 1].
    pub color: [f32; 3],
    /// Multiplier of the color, at least 0 (KHR_materials_emissive_strength). The product is a
    /// luminance in candela per square meter.
    pub strength: f32,
}

impl Emission {
    /// Returns the color times the strength.
    #[must_use]
    pub fn scaled_color(self) -> [f32; 3] {
        self.color.map(|channel| channel * self.strength)
    }
}

impl Default for Emission {
    fn default() -> Self {
        Self { color: [0.0; 3], strength: 1.0 }
    }
}

/// A normal map: linear red, green and blue store a vector in tangent space, decoded as 2x − 1,
/// with red along the tangent, green along the bitangent and blue along the normal.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NormalTexture {
    /// The texture.
    pub texture: TextureInfo,
    /// Scale of the first two components of the vector before it is normalized; any number.
    pub scale: f32,
}

/// An ambient occlusion map: linear red is the fraction of ambient light that arrives.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OcclusionTexture {
    /// The texture.
    pub texture: TextureInfo,
    /// Strength in [0, 1]; the light is multiplied by 1 + strength · (red − 1).
    pub strength: f32,
}

/// A reference to a texture, with the texture coordinates to use (`textureInfo` in glTF).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TextureInfo {
    /// Index of the texture in the model.
    pub texture: usize,
    /// The texture coordinate set, n in `TEXCOORD_n`.
    pub uv_set: usize,
    /// Texture transform: the first two rows of the matrix from the mesh's (u, v, 1) to the
    /// texture's (u, v). This is the identity unless the file uses KHR_texture_transform.
    pub uv_matrix: [[f32; 3]; 2],
}

impl TextureInfo {
    /// The transform that leaves texture coordinates unchanged.
    pub const IDENTITY_UV: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

/// How alpha is used: opaque, alpha test or blending (glTF 2.0 §3.9.4).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Alpha test: the surface is opaque where alpha is at least the cutoff, and invisible
    /// elsewhere.
    Mask {
        /// The smallest alpha that is opaque.
        cutoff: f32,
    },
    /// Alpha is the coverage for blending the surface over the background.
    Blend,
}

impl Material {
    /// Returns the material for formats without materials: light gray, matte and double-sided.
    ///
    /// Unlike the glTF default, it is not a metal, which would mirror its surroundings. Both sides
    /// are drawn because many files in these formats have triangles with inconsistent winding.
    #[must_use]
    pub fn plain() -> Self {
        Self {
            base_color: [0.6, 0.6, 0.6, 1.0],
            metallic: 0.0,
            roughness: 0.6,
            double_sided: true,
            ..Self::default()
        }
    }

    /// Returns the material for surfaces colored by scalars: white, matte and double-sided.
    #[must_use]
    pub fn white() -> Self {
        Self { base_color: [1.0; 4], ..Self::plain() }
    }
}
