//! Images, and how textures read them.

/// A decoded image: 8 bits for each of red, green, blue and alpha, rows from the top, alpha not multiplied in.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// `width` × `height` texels.
    pub rgba: Vec<[u8; 4]>,
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({} x {})", self.width, self.height)
    }
}

/// What a file says of an image.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ImageInfo {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The URI, if it is in a file of its own; `data:` stands for one that is in the URI itself.
    pub uri: Option<String>,
    /// What its first bytes say; `None` if it was not read, or could not be.
    pub header: Option<ImageHeader>,
}

/// What the first bytes of an image say.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ImageHeader {
    /// The name of the format: `png`, `jpeg`, `webp` or `ktx2`.
    pub format: &'static str,
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// How many bytes the encoded image has.
    pub bytes: usize,
}

/// An image with a way to read it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Texture {
    /// The image; `None` if the file names none we can read.
    pub image: Option<usize>,
    /// How it is read.
    pub sampler: Sampler,
}

/// How a texture is read outside of [0, 1] and between texels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sampler {
    /// What happens left and right of the image.
    pub wrap_u: WrapMode,
    /// What happens above and below the image.
    pub wrap_v: WrapMode,
    /// Between texels, where the picture shows the texture enlarged.
    pub mag_filter: TextureFilter,
    /// Between texels of one level, where the picture shows the texture reduced.
    pub min_filter: TextureFilter,
    /// Between the levels of the mip chain, where the picture shows the texture reduced.
    pub mipmap_mode: MipmapMode,
}

/// What a texture shows outside of [0, 1].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum WrapMode {
    /// The image over and over.
    #[default]
    Repeat,
    /// The image over and over, every second one mirrored.
    MirroredRepeat,
    /// The texels of the border.
    ClampToEdge,
}

/// What a texture shows between the centres of texels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum TextureFilter {
    /// The nearest texel.
    Nearest,
    /// The four texels around, weighted.
    #[default]
    Linear,
}

/// Which levels of the mip chain a reduced texture shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum MipmapMode {
    /// The full image only.
    None,
    /// The nearest level.
    Nearest,
    /// The two levels around, weighted.
    #[default]
    Linear,
}
