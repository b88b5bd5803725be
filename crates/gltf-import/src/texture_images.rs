//! Texture images for mesh formats, stored next to the mesh or in its archive, and decoded like
//! glTF images.
//!
//! A broken image causes a warning and never discards the model.

use crate::gltf::check_image_size;
use crate::image_decoder::{self, EncodedImage};
use crate::parallel_decoding::decode_images;
use crate::{ImageLoading, ImportOptions, ImportWarnings};
use model::{Diagnostic, Image, ImageHeader, ImageInfo, Model};
use std::borrow::Cow;

/// The consequence that all image warnings state.
const SHOWN_WITHOUT_IMAGE: &str = "the surface is shown without it";

/// An image that a material refers to.
#[derive(Debug)]
pub struct TextureImage<'a> {
    /// The name of the image in the referring file.
    pub name: String,
    /// The location of the reference in the referring file, for messages.
    pub location: String,
    /// The encoded bytes, or the reason why they are missing. `None` if nothing visible uses the
    /// image.
    pub bytes: Option<Result<Cow<'a, [u8]>, Diagnostic>>,
}

/// Decodes images and stores each in the model at its index in `files`.
pub fn store_images<'a>(
    model: &mut Model,
    files: Vec<TextureImage<'a>>,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) {
    let mut texels_left = options.limits.image_texels;
    let mut encoded = Vec::new();
    let mut locations = Vec::new();
    for (index, file) in files.into_iter().enumerate() {
        let TextureImage { name, location, bytes } = file;
        let mut info = ImageInfo { name: None, uri: Some(name), header: None };
        let check = |bytes: Cow<'a, [u8]>| {
            let size = image_decoder::image_size(&bytes)
                .map_err(|problem| Diagnostic::invalid(&location, problem))?;
            let limits = &options.limits;
            check_image_size(size.0, size.1, &mut texels_left, limits, &location)?;
            Ok((bytes, size))
        };
        match bytes.map(|bytes| bytes.and_then(check)) {
            // Nothing shows this image, so it has not been read.
            None => {}
            Some(Ok((bytes, size))) => {
                let format = image_decoder::format_name(&bytes);
                let (width, height) = size;
                info.header = Some(ImageHeader { format, width, height, bytes: bytes.len() });
                encoded.push(EncodedImage { index, bytes, size });
            }
            Some(Err(diagnostic)) => warnings.downgrade(&diagnostic, SHOWN_WITHOUT_IMAGE),
        }
        locations.push(location);
        model.image_infos.push(info);
    }
    if options.images == ImageLoading::Headers {
        encoded.clear();
    }
    let decoded = options.timings.measure("images", || decode_images(&encoded));
    let mut images: Vec<Option<Image>> = vec![None; model.image_infos.len()];
    for (image, decoded) in encoded.iter().zip(decoded) {
        match decoded {
            Ok(decoded) => images[image.index] = Some(decoded),
            Err(message) => {
                let diagnostic = Diagnostic::invalid(&locations[image.index], message);
                warnings.downgrade(&diagnostic, SHOWN_WITHOUT_IMAGE);
            }
        }
    }
    model.images = images.into();
}
