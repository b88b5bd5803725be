//! Textures: decoded images, and the samplers that define how they are wrapped and filtered.
//!
//! Names and meanings of the sampler states follow glTF 2.0 §3.8.4, which takes them from OpenGL.

/// A decoded image: 8 bits for each of red, green, blue and alpha, top row first, straight alpha.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// `width` × `height` texels, row by row.
    pub rgba: Vec<[u8; 4]>,
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} x {})", self.width, self.height)
    }
}

/// Metadata of an image of the file, whether it was decoded or not.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ImageInfo {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The URI if the image is in a separate file; `data:` if it is embedded in the URI.
    pub uri: Option<String>,
    /// Format and size from the first bytes of the image; `None` if they were not read or are
    /// invalid.
    pub header: Option<ImageHeader>,
}

/// Format and size of an encoded image, from its header.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ImageHeader {
    /// Name of the format: `png`, `jpeg`, `webp` or `ktx2`.
    pub format: &'static str,
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// Length of the encoded image in bytes.
    pub bytes: usize,
}

/// A texture: an image and the sampler that reads it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Texture {
    /// Index of the image; `None` if the file refers to none, or to one that cannot be read.
    pub image: Option<usize>,
    /// Wrapping and filtering.
    pub sampler: Sampler,
}

/// Sampler state: wrapping outside [0, 1], and filtering between texels and mip levels.
///
/// The default repeats and filters trilinearly, as in glTF. Its single `minFilter` covers two
/// states here and in Vulkan: `LINEAR_MIPMAP_NEAREST` is a linear `min_filter` with the nearest mip
/// level.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sampler {
    /// Wrapping to the left and right of the image.
    pub wrap_u: WrapMode,
    /// Wrapping above and below the image.
    pub wrap_v: WrapMode,
    /// Filter where the texture is magnified: a texel covers more than one pixel.
    pub mag_filter: TextureFilter,
    /// Filter within one mip level where the texture is minified.
    pub min_filter: TextureFilter,
    /// Filter between mip levels where the texture is minified.
    pub mipmap_mode: MipmapMode,
}

/// Wrapping of texture coordinates outside [0, 1].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum WrapMode {
    /// The image repeats.
    #[default]
    Repeat,
    /// The image repeats, every second time mirrored.
    MirroredRepeat,
    /// The border texels continue.
    ClampToEdge,
}

/// Filter between texel centers.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum TextureFilter {
    /// The nearest texel.
    Nearest,
    /// Bilinear: the four nearest texels, weighted by distance.
    #[default]
    Linear,
}

/// The mipmap mode of a sampler: how mip levels are filtered.
///
/// Shading chooses the levels (`select_levels` in `shade/src/texture/addressing.rs`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum MipmapMode {
    /// No mipmapping: the full image only.
    None,
    /// The nearest mip level.
    Nearest,
    /// The two nearest mip levels, weighted; with a bilinear filter this is trilinear filtering.
    #[default]
    Linear,
}
