//! Materials: what a surface looks like, as the file has it.

mod extensions;
mod texture_slot;
mod uv_transform;

pub use extensions::{
    Anisotropy, Clearcoat, Iridescence, MaterialExtensions, Sheen, Specular, SpecularGlossiness,
    Transmission, Volume,
};
pub use texture_slot::TextureSlot;
pub use uv_transform::{UvTransform, UvTransformPart};

/// What a surface looks like: glTF's metallic-roughness model, and what extensions add to it.
///
/// All factors are linear, not sRGB, and in the ranges that the comments name. A texture multiplies the factor it stands
/// beside; the comments say which of its channels count, and whether its colours are sRGB.
#[derive(Clone, PartialEq, Debug)]
pub struct Material {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Red, green, blue and alpha of the surface, each in [0, 1]; multiplies texture and vertex colour.
    pub base_color: [f32; 4],
    /// The texture of the base colour (sRGB, alpha linear).
    pub base_color_texture: Option<TextureInfo>,
    /// 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// 0 for mirrors, 1 for chalk; its square is the α of the microfacet formulas.
    pub roughness: f32,
    /// The texture of metalness (blue) and roughness (green), linear.
    pub metallic_roughness_texture: Option<TextureInfo>,
    /// Small slopes of the surface.
    pub normal_texture: Option<NormalTexture>,
    /// How much of the ambient light arrives.
    pub occlusion_texture: Option<OcclusionTexture>,
    /// Light the surface gives off by itself: `emission`'s colour times its strength.
    pub emissive: [f32; 3],
    /// The texture of that light (sRGB); multiplies it.
    pub emissive_texture: Option<TextureInfo>,
    /// What `emissive` is made of; animations change one or the other.
    pub emission: Emission,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Whether the back of the surface is shown too.
    pub double_sided: bool,
    /// Whether the base colour is shown as it is, without light (KHR_materials_unlit).
    pub unlit: bool,
    /// What the extensions of glTF add.
    pub extensions: MaterialExtensions,
}

impl Material {
    /// Whether light passes through the surface.
    #[must_use]
    pub fn is_transmissive(&self) -> bool {
        let transmission = self.extensions.transmission.as_ref();
        let masked = matches!(self.alpha_mode, AlphaMode::Mask { .. });
        transmission.is_some_and(|share| share.factor > 0.0) && !masked && !self.unlit
    }

    /// Whether a texture bends the surface's normals, so that its tangents count.
    #[must_use]
    pub fn needs_tangents(&self) -> bool {
        let coat = self.extensions.clearcoat.as_ref();
        self.normal_texture.is_some()
            || self.extensions.anisotropy.is_some()
            || coat.is_some_and(|coat| coat.normal_texture.is_some())
    }
}

impl Default for Material {
    /// The material of primitives that name none (glTF 2.0 §3.9): white, opaque, one-sided.
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

/// Light a surface gives off by itself.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Emission {
    /// Red, green and blue, each in [0, 1].
    pub color: [f32; 3],
    /// What the colour is multiplied by, at least 0; the product is in candela per square metre
    /// (KHR_materials_emissive_strength).
    pub strength: f32,
}

impl Emission {
    /// Colour times strength.
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

/// A texture of slopes: red, green and blue (linear) are 2x − 1 of a vector in the tangent space of the surface, red along the
/// tangent, green along the bitangent, blue along the normal.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NormalTexture {
    /// The texture.
    pub texture: TextureInfo,
    /// Multiplies the first two components of the vector before it is brought to length 1; any number.
    pub scale: f32,
}

/// A texture of the ambient light that arrives: red (linear), 1 for all of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OcclusionTexture {
    /// The texture.
    pub texture: TextureInfo,
    /// In [0, 1]: light arrives as 1 + strength · (red − 1).
    pub strength: f32,
}

/// A texture in use: which one, and by which coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TextureInfo {
    /// The texture's number in the model.
    pub texture: usize,
    /// The set of texture coordinates (`TEXCOORD_n`).
    pub uv_set: usize,
    /// The first two rows of the map from the mesh's (u, v, 1) to the texture's (u, v); the identity unless the file
    /// uses KHR_texture_transform.
    pub uv_matrix: [[f32; 3]; 2],
}

impl TextureInfo {
    /// The map that keeps texture coordinates as they are.
    pub const IDENTITY_UV: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

/// What the alpha of a surface means.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum AlphaMode {
    /// Nothing: the surface is solid.
    #[default]
    Opaque,
    /// The surface is solid where alpha is at least the cutoff, and absent elsewhere.
    Mask {
        /// The smallest alpha that is solid.
        cutoff: f32,
    },
    /// The share of the surface's colour over what is behind it.
    Blend,
}
