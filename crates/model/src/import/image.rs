//! Images: which ones are needed, and their bytes.
//!
//! Only images that a visible surface uses are read. A broken image costs a warning, never the model. The budget of texels
//! is spent in the order of the file, from the sizes in the headers, before any decoder runs.

use super::Images;
use super::accessor::Source;
use super::choice;
use super::decode;
use super::decoding::{Decoded, decode_all};
use super::error::Fault;
use super::limits::Limits;
use super::warnings::Warnings;
use crate::{ImageFile, ImageHeader, Material, Model};
use gltf::json::Root;
use gltf::json::image::Image as JsonImage;
use std::borrow::Cow;

/// An encoded image.
pub(super) struct Encoded<'a> {
    number: usize,
    pub(super) bytes: Cow<'a, [u8]>,
    /// Width and height in texels.
    size: (u32, u32),
}

/// Images of a file that have been read but not decoded.
#[derive(Default)]
pub(super) struct Found<'a> {
    /// For each image of the file, whether it was looked for.
    needed: Vec<bool>,
    pub(super) encoded: Vec<Encoded<'a>>,
    warnings: Warnings,
}

impl<'a> Found<'a> {
    pub(super) fn read(source: &'a Source<'_>, needed: Vec<bool>) -> Self {
        let mut warnings = Warnings::default();
        let encoded = read(&needed, source, &mut warnings);
        Self { needed, encoded, warnings }
    }
}

/// The images that the surfaces of a model will show whose meshes are not read yet, by what the file says of them.
pub(super) fn announced(root: &Root, model: &Model, variant: Option<usize>) -> Vec<bool> {
    let mut needed = vec![false; root.images.len()];
    for (mesh, _) in root.meshes.iter().zip(shown(model, root.meshes.len())).filter(|at| at.1) {
        for primitive in &mesh.primitives {
            let usual = primitive.material.map(|material| material.value());
            let dressed = variant.and_then(|variant| choice::dressed(root, primitive, variant));
            note(dressed.or(usual), model, &mut needed);
        }
    }
    needed
}

/// The images that visible surfaces show.
fn needed(model: &Model, images: usize) -> Vec<bool> {
    let mut needed = vec![false; images];
    let shown = shown(model, model.meshes.len());
    let meshes = model.meshes.iter().zip(shown).filter(|(_, shown)| *shown);
    for primitive in meshes.flat_map(|(mesh, _)| &mesh.primitives).filter(|p| p.count() > 0) {
        note(primitive.material, model, &mut needed);
    }
    needed
}

/// For each mesh, whether the shown scene shows it.
fn shown(model: &Model, meshes: usize) -> Vec<bool> {
    let mut shown = vec![false; meshes];
    for instance in model.instances() {
        if let Some(flag) = model.nodes[instance.node].mesh.and_then(|mesh| shown.get_mut(mesh)) {
            *flag = true;
        }
    }
    shown
}

/// Notes the images of a material.
fn note(material: Option<usize>, model: &Model, needed: &mut [bool]) {
    let material = material.and_then(|at| model.materials.get(at));
    for (_, used) in material.into_iter().flat_map(Material::textures) {
        let image = model.textures.get(used.texture).and_then(|texture| texture.image);
        if let Some(flag) = image.and_then(|image| needed.get_mut(image)) {
            *flag = true;
        }
    }
}

/// Gives a model that is otherwise complete its images. What was found before and `decoded` meanwhile is used, unless the
/// meshes turned out to need other images than the file announced.
pub(super) fn images(
    source: &Source<'_>,
    model: &mut Model,
    (early, decoded): (Found<'_>, Vec<Decoded>),
    what: Images,
    warnings: &mut Warnings,
) {
    let needed = needed(model, source.root.images.len());
    model.image_files = source.root.images.iter().map(file).collect();
    model.images = vec![None; needed.len()];
    match what {
        Images::Decode if early.needed == needed => place(model, early, decoded, warnings),
        Images::Decode => {
            let found = Found::read(source, needed);
            let decoded = decode_all(&found.encoded);
            place(model, found, decoded, warnings);
        }
        Images::Headers => {
            // Nobody sees the others, so that nobody needs to be warned of them.
            let others = needed.iter().map(|needed| !needed).collect();
            note_headers(&Found::read(source, others).encoded, &mut model.image_files);
            place(model, Found::read(source, needed), Vec::new(), warnings);
        }
    }
}

/// Puts decoded images into a model, and the faults into its warnings.
fn place(model: &mut Model, found: Found<'_>, decoded: Vec<Decoded>, warnings: &mut Warnings) {
    warnings.append(found.warnings);
    note_headers(&found.encoded, &mut model.image_files);
    for (image, decoded) in found.encoded.iter().zip(decoded) {
        match decoded {
            Ok(decoded) => model.images[image.number] = Some(decoded),
            Err(problem) => {
                let fault = Fault::invalid(&format!("/images/{}", image.number), problem);
                warnings.soft(&fault, LEFT_OUT);
            }
        }
    }
}

fn file(json: &JsonImage) -> ImageFile {
    let is_data = |uri: &str| uri.get(..5).is_some_and(|s| s.eq_ignore_ascii_case("data:"));
    let uri = json.uri.as_deref().map(|uri| if is_data(uri) { "data:" } else { uri }.to_owned());
    ImageFile { name: json.name.clone(), uri, header: None }
}

fn note_headers(encoded: &[Encoded<'_>], files: &mut [ImageFile]) {
    for Encoded { number, bytes, size: (width, height) } in encoded {
        let (format, bytes) = (decode::format(bytes), bytes.len());
        files[*number].header = Some(ImageHeader { format, width: *width, height: *height, bytes });
    }
}

/// The bytes of the needed images; those that cannot be had are a warning.
fn read<'a>(needed: &[bool], source: &'a Source<'_>, warnings: &mut Warnings) -> Vec<Encoded<'a>> {
    let mut texels_left = source.limits.image_texels;
    let mut found = Vec::new();
    for number in (0..needed.len()).filter(|&at| needed[at]) {
        let pointer = format!("/images/{number}");
        let bytes = bytes(&source.root.images[number], &pointer, source);
        let checked = bytes.and_then(|bytes| {
            let (width, height) = decode::size(&bytes).map_err(|p| Fault::invalid(&pointer, p))?;
            check_size(width, height, &mut texels_left, source.limits, &pointer)?;
            Ok((bytes, (width, height)))
        });
        match checked {
            Ok((bytes, size)) => found.push(Encoded { number, bytes, size }),
            Err(fault) => warnings.soft(&fault, LEFT_OUT),
        }
    }
    found
}

const LEFT_OUT: &str = "the surface is shown without it";

fn bytes<'a>(
    json: &JsonImage,
    pointer: &str,
    source: &'a Source<'_>,
) -> Result<Cow<'a, [u8]>, Fault> {
    match (&json.uri, json.buffer_view) {
        (Some(uri), _) => Ok(source.buffers.resolver.read(uri, &format!("{pointer}/uri"))?.into()),
        (None, Some(view)) => {
            let user = format!("{pointer}/bufferView");
            Ok(source.buffers.view(view.value(), &user)?.bytes.into())
        }
        (None, None) => Err(Fault::invalid(pointer, "the image has neither URI nor buffer view")),
    }
}

fn check_size(
    width: u32,
    height: u32,
    texels_left: &mut u64,
    limits: &Limits,
    pointer: &str,
) -> Result<(), Fault> {
    let what = format!("the image has {width} x {height} texels");
    if width == 0 || height == 0 {
        return Err(Fault::invalid(pointer, what));
    }
    if width.max(height) > limits.image_side {
        return Err(Fault::limit(pointer, &what, "image_side", u64::from(limits.image_side)));
    }
    match texels_left.checked_sub(u64::from(width) * u64::from(height)) {
        Some(left) => *texels_left = left,
        None => return Err(Fault::limit(pointer, &what, "image_texels", limits.image_texels)),
    }
    Ok(())
}
