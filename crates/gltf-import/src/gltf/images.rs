//! Reads the visible images, checks them against the limits, and decodes them.
//!
//! Only images that a visible surface uses are read. A broken image causes a warning and never
//! discards the model. The texel limit is applied in file order to the sizes in the headers, before
//! any decoder runs.

use super::accessor::AccessorReader;
use super::selection;
use crate::image_decoder::EncodedImage;
use crate::limits::Limits;
use crate::parallel_decoding::{DecodeResult, decode_images};
use crate::warnings::ImportWarnings;
use crate::{ImageLoading, image_decoder};
use gltf::json::Root;
use gltf::json::image::Image as JsonImage;
use model::{Diagnostic, ImageHeader, ImageInfo, Material, Model};
use std::borrow::Cow;

/// Images of a file that have been read but not decoded.
///
/// If an image is in a buffer view, its bytes are borrowed from the buffer.
#[derive(Default)]
pub(super) struct EncodedImages<'a> {
    /// Whether each image of the file should be read.
    needed: Vec<bool>,
    /// The images that could be read.
    pub(super) encoded: Vec<EncodedImage<'a>>,
    /// Warnings about the images that could not be read.
    warnings: ImportWarnings,
}

impl<'a> EncodedImages<'a> {
    /// Reads the images that are needed.
    pub(super) fn read_needed(source: &'a AccessorReader<'_>, needed: Vec<bool>) -> Self {
        let mut warnings = ImportWarnings::default();
        let encoded = read_encoded(&needed, source, &mut warnings);
        Self { needed, encoded, warnings }
    }
}

/// Returns the images that the surfaces of the active scene will use, according to the JSON.
///
/// This runs before meshes are read, so that images can be decoded at the same time. Materials of
/// the active variant replace the default materials. The result may differ from [`needed_images`],
/// which takes the imported primitives into account: a primitive without items needs no images.
pub(super) fn announced_images(root: &Root, model: &Model, variant: Option<usize>) -> Vec<bool> {
    let mut needed = vec![false; root.images.len()];
    for (mesh, _) in
        root.meshes.iter().zip(visible_meshes(model, root.meshes.len())).filter(|at| at.1)
    {
        for primitive in &mesh.primitives {
            let base = primitive.material.map(|material| material.value());
            let dressed =
                variant.and_then(|variant| selection::variant_material(root, primitive, variant));
            mark_material_images(dressed.or(base), model, &mut needed);
        }
    }
    needed
}

/// Returns the images that visible surfaces use.
///
/// `images` is the number of images in the file; the result has a flag for each image.
fn needed_images(model: &Model, images: usize) -> Vec<bool> {
    let mut needed = vec![false; images];
    let is_visible = visible_meshes(model, model.meshes.len());
    let meshes = model.meshes.iter().zip(is_visible).filter(|(_, is_visible)| *is_visible);
    for primitive in meshes.flat_map(|(mesh, _)| &mesh.primitives).filter(|p| p.item_count() > 0) {
        mark_material_images(primitive.material, model, &mut needed);
    }
    needed
}

/// Returns for each mesh whether the active scene draws it.
///
/// A mesh without an instance in the active scene is imported, but its images are not decoded.
fn visible_meshes(model: &Model, meshes: usize) -> Vec<bool> {
    let mut is_visible = vec![false; meshes];
    for instance in model.node_instances() {
        if let Some(flag) =
            model.nodes[instance.node].mesh.and_then(|mesh| is_visible.get_mut(mesh))
        {
            *flag = true;
        }
    }
    is_visible
}

/// Marks the images of a material.
///
/// Only textures that affect the picture count; an unlit material uses only its base color texture.
fn mark_material_images(material: Option<usize>, model: &Model, needed: &mut [bool]) {
    let material = material.and_then(|at| model.materials.get(at));
    for (_, info) in material.into_iter().flat_map(Material::visible_textures) {
        let image = model.textures.get(info.texture).and_then(|texture| texture.image);
        if let Some(flag) = image.and_then(|image| needed.get_mut(image)) {
            *flag = true;
        }
    }
}

/// Adds the images to an otherwise complete model.
///
/// The images that were read early and have been `decoded` are used, unless the meshes turn out to
/// need other images.
pub(super) fn import_images(
    source: &AccessorReader<'_>,
    model: &mut Model,
    announced: EncodedImages<'_>,
    decoded: Vec<DecodeResult>,
    loading: ImageLoading,
    warnings: &mut ImportWarnings,
) {
    let needed = needed_images(model, source.root.images.len());
    model.image_infos = source.root.images.iter().map(image_info).collect();
    match loading {
        ImageLoading::Decode if announced.needed == needed => {
            store_decoded(model, announced, decoded, warnings);
        }
        ImageLoading::Decode => {
            let encoded_images = EncodedImages::read_needed(source, needed);
            let decoded = decode_images(&encoded_images.encoded);
            store_decoded(model, encoded_images, decoded, warnings);
        }
        ImageLoading::Headers => {
            // The other images are not visible and do not need warnings.
            let others = needed.iter().map(|needed| !needed).collect();
            store_headers(
                &EncodedImages::read_needed(source, others).encoded,
                &mut model.image_infos,
            );
            store_decoded(model, EncodedImages::read_needed(source, needed), Vec::new(), warnings);
        }
    }
}

/// Stores decoded images in the model, and adds a warning for each failure.
///
/// A surface whose image cannot be decoded is drawn without the texture.
fn store_decoded(
    model: &mut Model,
    encoded_images: EncodedImages<'_>,
    decoded: Vec<DecodeResult>,
    warnings: &mut ImportWarnings,
) {
    warnings.append_warnings(encoded_images.warnings);
    store_headers(&encoded_images.encoded, &mut model.image_infos);
    let mut images = vec![None; model.image_infos.len()];
    for (image, decoded) in encoded_images.encoded.iter().zip(decoded) {
        match decoded {
            Ok(decoded) => images[image.index] = Some(decoded),
            Err(message) => {
                let diagnostic = Diagnostic::invalid(&format!("/images/{}", image.index), message);
                warnings.downgrade(&diagnostic, SHOWN_WITHOUT_IMAGE);
            }
        }
    }
    model.images = images.into();
}

/// Returns the name and URI of an image; a data URI is reduced to its scheme.
fn image_info(json: &JsonImage) -> ImageInfo {
    let is_data = |uri: &str| uri.get(..5).is_some_and(|s| s.eq_ignore_ascii_case("data:"));
    let uri = json.uri.as_deref().map(|uri| if is_data(uri) { "data:" } else { uri }.to_owned());
    ImageInfo { name: json.name.clone(), uri, header: None }
}

/// Stores the format and size of the images that were read.
///
/// Images that could not be read have no header.
fn store_headers(encoded: &[EncodedImage<'_>], files: &mut [ImageInfo]) {
    for EncodedImage { index: number, bytes, size: (width, height) } in encoded {
        let (format, bytes) = (image_decoder::format_name(bytes), bytes.len());
        files[*number].header = Some(ImageHeader { format, width: *width, height: *height, bytes });
    }
}

/// Reads the bytes of the needed images; failures are warnings.
///
/// The texel limit is applied here to the sizes in the headers, so that no decoder starts on an
/// image that would exceed it. All image bytes are in memory before decoding starts, because
/// decoding runs on other threads.
fn read_encoded<'a>(
    needed: &[bool],
    source: &'a AccessorReader<'_>,
    warnings: &mut ImportWarnings,
) -> Vec<EncodedImage<'a>> {
    let mut texels_left = source.limits.image_texels;
    let mut encoded_images = Vec::new();
    for number in (0..needed.len()).filter(|&at| needed[at]) {
        let pointer = format!("/images/{number}");
        let bytes = image_bytes(&source.root.images[number], &pointer, source);
        let checked = bytes.and_then(|bytes| {
            let (width, height) =
                image_decoder::image_size(&bytes).map_err(|p| Diagnostic::invalid(&pointer, p))?;
            check_image_size(width, height, &mut texels_left, source.limits, &pointer)?;
            Ok((bytes, (width, height)))
        });
        match checked {
            Ok((bytes, size)) => encoded_images.push(EncodedImage { index: number, bytes, size }),
            Err(diagnostic) => warnings.downgrade(&diagnostic, SHOWN_WITHOUT_IMAGE),
        }
    }
    encoded_images
}

/// The consequence that all image warnings state.
const SHOWN_WITHOUT_IMAGE: &str = "the surface is shown without it";

/// Returns the encoded bytes from a file, a data URI or a buffer view.
///
/// # Errors
/// Fails if the file or view cannot be read, or the image has neither.
fn image_bytes<'a>(
    json: &JsonImage,
    pointer: &str,
    source: &'a AccessorReader<'_>,
) -> Result<Cow<'a, [u8]>, Diagnostic> {
    match (&json.uri, json.buffer_view) {
        (Some(uri), _) => {
            Ok(source.buffers.resolver.read_uri(uri, &format!("{pointer}/uri"))?.into())
        }
        (None, Some(view)) => {
            let user = format!("{pointer}/bufferView");
            Ok(source.buffers.buffer_view(view.value(), &user)?.bytes.into())
        }
        (None, None) => {
            Err(Diagnostic::invalid(pointer, "the image has neither a URI nor a buffer view"))
        }
    }
}

/// Checks the size and number of texels against the limits.
///
/// `texels_left` is the remainder of the limit for all images of the file, and is reduced by the
/// texels of this image.
///
/// # Errors
/// Fails if the size is 0. Returns [`LIMIT_EXCEEDED`](model::codes::LIMIT_EXCEEDED) for
/// `image_side` or `image_texels`.
pub(crate) fn check_image_size(
    width: u32,
    height: u32,
    texels_left: &mut u64,
    limits: &Limits,
    pointer: &str,
) -> Result<(), Diagnostic> {
    let what = format!("the image has {width} x {height} texels");
    if width == 0 || height == 0 {
        return Err(Diagnostic::invalid(pointer, what));
    }
    if width.max(height) > limits.image_side {
        return Err(Diagnostic::limit_exceeded(
            pointer,
            &what,
            "image_side",
            u64::from(limits.image_side),
        ));
    }
    match texels_left.checked_sub(u64::from(width) * u64::from(height)) {
        Some(remaining) => *texels_left = remaining,
        None => {
            return Err(Diagnostic::limit_exceeded(
                pointer,
                &what,
                "image_texels",
                limits.image_texels,
            ));
        }
    }
    Ok(())
}
