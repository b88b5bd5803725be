//! Textures of MTL libraries: the image files that materials need, and images combined from several
//! files, because a material here has a single texture where MTL has two.

use super::mtl::MtlTexture;
use super::shorten;
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use gltf_import::UriResolver;
use gltf_import::{TextureImage, store_images};
use model::{Diagnostic, Image, ImageInfo, Model, Sampler, Texture, TextureInfo, WrapMode};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Maximum number of image files.
const MAX_IMAGES: usize = 4096;

/// The images and textures needed by the materials converted so far.
#[derive(Debug, Default)]
pub(super) struct TextureTable<'a> {
    /// The folder of the current library with a trailing slash, or empty for the OBJ file's folder.
    pub(super) folder: String,
    /// The images: files, and combinations of files.
    images: Vec<ImageSource<'a>>,
    files: BTreeMap<(String, &'a [u8]), usize>,
    textures: Vec<Texture>,
    texture_indices: BTreeMap<(usize, bool), usize>,
    /// Images that may be height maps.
    bump_maps: BTreeSet<usize>,
}

/// The source of an image.
#[derive(Clone, Debug)]
enum ImageSource<'a> {
    /// A file, identified by folder and name.
    File { folder: String, name: &'a [u8] },
    /// Color from one image, opacity from another.
    Opacity { color: Option<usize>, opacity: usize, channel: Option<u8> },
    /// Roughness in green and metalness in blue; a missing image counts as white.
    MetallicRoughness { roughness: Option<usize>, metallic: Option<usize> },
}

impl<'a> TextureTable<'a> {
    /// Returns the texture for a file.
    pub(super) fn use_file(&mut self, mtl: &MtlTexture<'a>) -> TextureInfo {
        let image = self.file_image(mtl);
        self.texture_of(image, mtl)
    }

    /// Returns the texture for a bump map, which is used only if it is a normal map.
    pub(super) fn use_bump_map(&mut self, mtl: &MtlTexture<'a>) -> TextureInfo {
        let image = self.file_image(mtl);
        self.bump_maps.insert(image);
        self.texture_of(image, mtl)
    }

    /// Returns the texture for color and opacity. The options of the color texture take precedence.
    ///
    /// A file that is used for both is not changed, and supplies its own alpha.
    pub(super) fn base_color(
        &mut self,
        color: Option<&MtlTexture<'a>>,
        opacity: Option<&MtlTexture<'a>>,
    ) -> Option<TextureInfo> {
        let options = color.or(opacity)?;
        let color = color.map(|texture| self.file_image(texture));
        let image = match (color, opacity) {
            (Some(color), None) => color,
            (color, Some(texture)) => {
                let opacity = self.file_image(texture);
                let channel = texture.channel;
                if color == Some(opacity) && matches!(channel, None | Some(b'm' | b'M')) {
                    opacity
                } else {
                    self.push_image(ImageSource::Opacity { color, opacity, channel })
                }
            }
            (None, None) => return None,
        };
        Some(self.texture_of(image, options))
    }

    /// Returns the texture for roughness and metalness. The options of the roughness texture take
    /// precedence.
    pub(super) fn metallic_roughness(
        &mut self,
        roughness: Option<&MtlTexture<'a>>,
        metallic: Option<&MtlTexture<'a>>,
    ) -> Option<TextureInfo> {
        let options = roughness.or(metallic)?;
        let roughness = roughness.map(|texture| self.file_image(texture));
        let metallic = metallic.map(|texture| self.file_image(texture));
        let image = self.push_image(ImageSource::MetallicRoughness { roughness, metallic });
        Some(self.texture_of(image, options))
    }

    /// Returns the index of a file's image.
    fn file_image(&mut self, mtl: &MtlTexture<'a>) -> usize {
        let key = (self.folder.clone(), mtl.file.bytes);
        if let Some(image) = self.files.get(&key) {
            return *image;
        }
        let image = self.push_image(ImageSource::File { folder: key.0.clone(), name: key.1 });
        self.files.insert(key, image);
        image
    }

    /// Appends an image.
    fn push_image(&mut self, image: ImageSource<'a>) -> usize {
        self.images.push(image);
        self.images.len() - 1
    }

    /// Returns a reference to an image with the options of a statement.
    ///
    /// In MTL, where v points up, coordinates are scaled and then translated; here v points down.
    fn texture_of(&mut self, image: usize, mtl: &MtlTexture<'a>) -> TextureInfo {
        let textures = &mut self.textures;
        let texture = *self.texture_indices.entry((image, mtl.is_clamped)).or_insert_with(|| {
            let wrap = if mtl.is_clamped { WrapMode::ClampToEdge } else { WrapMode::Repeat };
            let sampler = Sampler { wrap_u: wrap, wrap_v: wrap, ..Sampler::default() };
            textures.push(Texture { image: Some(image), sampler });
            textures.len() - 1
        });
        let ([u, v], [width, height]) = (mtl.offset, mtl.scale);
        let uv_matrix = [[width, 0.0, u], [0.0, height, 1.0 - height - v]];
        let is_finite = uv_matrix.as_flattened().iter().all(|x: &f32| x.is_finite());
        let uv_matrix = if is_finite { uv_matrix } else { TextureInfo::IDENTITY_UV };
        TextureInfo { texture, uv_set: 0, uv_matrix }
    }

    /// Reads and decodes the files, combines images, and adds all images to the model.
    pub(super) fn load_images(
        self,
        model: &mut Model,
        resolver: &UriResolver<'_>,
        options: &ImportOptions,
        warnings: &mut ImportWarnings,
    ) {
        let Self { images, textures, bump_maps, .. } = self;
        // Files are loaded first and have separate indices.
        let mut file_indices = vec![None; images.len()];
        let mut files = Vec::new();
        for (image, source) in images.iter().enumerate() {
            if let ImageSource::File { folder, name } = source {
                file_indices[image] = Some(files.len());
                files.push(if files.len() < MAX_IMAGES {
                    read_image(folder, name, resolver, warnings)
                } else {
                    unread_image(name)
                });
            }
        }
        store_images(model, files, options, warnings);
        model.textures = textures;
        if file_indices.iter().any(Option::is_none) {
            combine_all(model, &images, &file_indices, options.limits.image_texels);
        }
        remove_height_maps(model, &bump_maps, warnings);
    }
}

/// Combines images, and arranges all images in the order of the table.
fn combine_all(
    model: &mut Model,
    images: &[ImageSource<'_>],
    file_indices: &[Option<usize>],
    texels: u64,
) {
    let (decoded, infos) = (model.images.clone(), std::mem::take(&mut model.image_infos));
    let file = |image: usize| decoded[file_indices[image]?].as_ref();
    let mut limit = TexelLimit { left: texels };
    let combine = |(at, source): (usize, &ImageSource<'_>)| match source {
        ImageSource::File { .. } => file(at).cloned(),
        ImageSource::Opacity { color, opacity: other, channel } => {
            let color = color.and_then(file);
            // If the opacity cannot be read, the color is used unchanged.
            let Some(other) = file(*other) else { return color.cloned() };
            let has_alpha = other.rgba.iter().any(|texel| texel[3] < 255);
            let alpha = |texel| opacity(texel, *channel, has_alpha);
            // Combined images also count against the limit, because a small file can request many.
            limit.allows(color.unwrap_or(other)).then(|| match color {
                Some(color) => combine_images(color, Some(other), |[r, g, b, _], beside| {
                    [r, g, b, beside.map_or(255, alpha)]
                }),
                None => combine_images(other, None, |own, _| [255, 255, 255, alpha(own)]),
            })
        }
        ImageSource::MetallicRoughness { roughness, metallic } => {
            let (roughness, metallic) = (roughness.and_then(file), metallic.and_then(file));
            let like = roughness.or(metallic)?;
            limit.allows(like).then(|| {
                // In glTF roughness is green and metalness blue.
                combine_images(like, metallic, |own, beside| {
                    let green = if roughness.is_some() { own[1] } else { 255 };
                    [255, green, beside.map_or(255, |texel| texel[0]), 255]
                })
            })
        }
    };
    let all: Vec<Option<Image>> = images.iter().enumerate().map(combine).collect();
    let info = |at: &Option<usize>| at.map_or_else(ImageInfo::default, |at| infos[at].clone());
    model.image_infos = file_indices.iter().map(info).collect();
    model.images = Arc::from(all);
}

/// Reads an image file below the library's folder, else below the OBJ file's folder. If neither has
/// it, its file name is tried next to the OBJ file, because many libraries contain paths from
/// another computer.
fn read_image<'a>(
    folder: &str,
    name: &[u8],
    resolver: &UriResolver<'_>,
    warnings: &mut ImportWarnings,
) -> TextureImage<'a> {
    let name = String::from_utf8_lossy(name).into_owned();
    let location = format!("texture {}", shorten(&name));
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let first = resolver.read_uri(&format!("{folder}{name}"), &location);
    let bytes = first.or_else(|error| {
        let again = |uri: &str| resolver.read_uri(uri, &location);
        let found = if folder.is_empty() { None } else { again(&name).ok() };
        let found = found.or_else(|| {
            let bytes = if last == name { None } else { again(last).ok() }?;
            let message = format!("not found at the path in the library; {last:?} is read instead");
            warnings.push_warning(&location, message);
            Some(bytes)
        });
        found.ok_or(error)
    });
    let name = if name.starts_with("data:") { "data:".to_owned() } else { name };
    TextureImage { name, location, bytes: Some(bytes.map(Cow::Owned)) }
}

/// Returns the placeholder for an image beyond the maximum number.
fn unread_image<'a>(name: &[u8]) -> TextureImage<'a> {
    let name = String::from_utf8_lossy(name).into_owned();
    let location = format!("texture {}", shorten(&name));
    let message = format!("only the first {MAX_IMAGES} image files are read");
    let bytes = Err(Diagnostic::missing_data(&location, &message));
    TextureImage { name, location, bytes: Some(bytes) }
}

/// The limit on the number of texels in combined images.
struct TexelLimit {
    left: u64,
}

impl TexelLimit {
    /// Returns whether an image of this size may be created.
    fn allows(&mut self, image: &Image) -> bool {
        let left = self.left.checked_sub(u64::from(image.width) * u64::from(image.height));
        self.left = left.unwrap_or(0);
        left.is_some()
    }
}

/// Combines two images into an image with the size of `like`. Each texel is computed from the two
/// texels at the same position.
fn combine_images(
    like: &Image,
    other: Option<&Image>,
    combine: impl Fn([u8; 4], Option<[u8; 4]>) -> [u8; 4],
) -> Image {
    let (width, height) = (like.width, like.height);
    let mut rgba = Vec::with_capacity(like.rgba.len());
    for (at, &own) in (0u64..).zip(&like.rgba) {
        let (x, y) = (at % u64::from(width), at / u64::from(width));
        let beside = other.and_then(|other| {
            let (of_x, of_y) = (u64::from(other.width), u64::from(other.height));
            let (x, y) = (x * of_x / u64::from(width), y * of_y / u64::from(height));
            other.rgba.get((y * of_x + x) as usize).copied()
        });
        rgba.push(combine(own, beside));
    }
    Image { width, height, rgba }
}

/// Returns the opacity of a texel: the channel named by `-imfchan`, or alpha if the image has
/// transparent texels, or else luminance.
fn opacity([r, g, b, a]: [u8; 4], channel: Option<u8>, has_alpha: bool) -> u8 {
    // Rec. 709 weights in 256ths.
    let luminance = (54 * u32::from(r) + 183 * u32::from(g) + 19 * u32::from(b)) / 256;
    match channel.map(|channel| channel.to_ascii_lowercase()) {
        Some(b'r') => r,
        Some(b'g') => g,
        Some(b'b') => b,
        Some(b'm') => a,
        None if has_alpha => a,
        _ => luminance as u8,
    }
}

/// Removes gray bump maps, which contain heights, because libraries do not specify their scale.
///
/// A colored bump map is a normal map, which many programs store under this name.
fn remove_height_maps(
    model: &mut Model,
    bump_maps: &BTreeSet<usize>,
    warnings: &mut ImportWarnings,
) {
    let is_gray = |image: &Image| image.rgba.iter().all(|[r, g, b, _]| r == g && g == b);
    let is_height_map =
        |image: &usize| model.images.get(*image).is_some_and(|at| at.as_ref().is_some_and(is_gray));
    let height_maps: BTreeSet<usize> = bump_maps.iter().copied().filter(is_height_map).collect();
    for &image in &height_maps {
        let name = model.image_infos[image].uri.as_deref().unwrap_or_default();
        let location = format!("texture {}", shorten(name));
        warnings.push_warning(
            &location,
            "this bump map is a height map; only normal maps are supported",
        );
    }
    for material in &mut model.materials {
        let textures = &model.textures;
        material.normal_texture = material.normal_texture.filter(|normal| {
            let image = textures[normal.texture.texture].image;
            !image.is_some_and(|image| height_maps.contains(&image))
        });
    }
}
