//! Materials: what a surface looks like, as the file has it.

/// What a surface looks like. All factors are linear, not sRGB.
#[derive(Clone, PartialEq, Debug)]
pub struct Material {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Red, green, blue and alpha of the surface, each in [0, 1]; multiplies texture and vertex colour.
    pub base_color: [f32; 4],
    /// The texture of the base colour (sRGB, alpha linear).
    pub base_color_texture: Option<TextureUse>,
    /// 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// 0 for mirrors, 1 for chalk.
    pub roughness: f32,
    /// Light the surface gives off by itself.
    pub emissive: [f32; 3],
    /// The texture of that light (sRGB); multiplies it.
    pub emissive_texture: Option<TextureUse>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Whether the back of the surface is shown too.
    pub double_sided: bool,
    /// Whether the base colour is shown as it is, without light (KHR_materials_unlit).
    pub unlit: bool,
}

impl Material {
    /// The textures that the surface shows.
    pub fn textures(&self) -> impl Iterator<Item = TextureUse> {
        [self.base_color_texture, self.emissive_texture].into_iter().flatten()
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
            emissive: [0.0; 3],
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

/// A texture in use: which one, and by which coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TextureUse {
    /// The texture's number in the model.
    pub texture: usize,
    /// The set of texture coordinates (`TEXCOORD_n`).
    pub uv_set: usize,
    /// The first two rows of the map from the mesh's (u, v, 1) to the texture's (u, v); the identity unless the file
    /// uses KHR_texture_transform.
    pub uv_map: [[f32; 3]; 2],
}

impl TextureUse {
    /// The map that keeps texture coordinates as they are.
    pub const KEEP_UV: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
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
