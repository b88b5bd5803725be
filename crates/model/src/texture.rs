//! Textures: decoded images, and samplers that define how they are wrapped and filtered.
//!
//! Names and meanings of the sampler states follow glTF 2.0 §3.8.4, which takes them from OpenGL.

/// A decoded image: 8-bit red, green, blue and straight alpha, top row first.
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

/// The metadata of an image in the file, decoded or not.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ImageInfo {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The URI if the image is in a separate file; `data:` if it is embedded in the URI.
    pub uri: Option<String>,
    /// Format and size from the first bytes of the image, or `None` if they were not read or are
    /// invalid.
    pub header: Option<ImageHeader>,
}

/// The format and size of an encoded image, from its header.
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

/// A texture: an image and a sampler.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Texture {
    /// Index of the image, or `None` if it is missing or cannot be read.
    pub image: Option<usize>,
    /// Wrapping and filtering.
    pub sampler: Sampler,
}

/// The sampler state: wrapping outside [0, 1], and filtering between texels and mip levels.
///
/// The default repeats and filters trilinearly, as in glTF. The single `minFilter` in glTF
/// corresponds to two states here and in Vulkan: `LINEAR_MIPMAP_NEAREST` is a linear `min_filter`
/// with the nearest mip level.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sampler {
    /// Wrap mode to the left and right of the image.
    pub wrap_u: WrapMode,
    /// Wrap mode above and below the image.
    pub wrap_v: WrapMode,
    /// Filter for magnification, where a texel covers more than one pixel.
    pub mag_filter: TextureFilter,
    /// Filter within a mip level for minification.
    pub min_filter: TextureFilter,
    /// Filter between mip levels for minification.
    pub mipmap_mode: MipmapMode,
}

/// The wrap mode for texture coordinates outside [0, 1].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum WrapMode {
    /// The image repeats.
    #[default]
    Repeat,
    /// The image repeats, with every second copy mirrored.
    MirroredRepeat,
    /// The border texels are repeated.
    ClampToEdge,
}

/// The filter between texel centers.
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
/// Shading selects the levels (`select_levels` in `shade/src/texture/addressing.rs`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum MipmapMode {
    /// No mipmapping: only the full image.
    None,
    /// The nearest mip level.
    Nearest,
    /// The weighted mean of the two nearest mip levels; with a bilinear filter this is trilinear
    /// filtering.
    #[default]
    Linear,
}
