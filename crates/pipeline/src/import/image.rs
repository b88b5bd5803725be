//! Images: which ones are needed, their bytes, and decoding them in parallel.
//!
//! Only images that a visible surface uses are read. A broken image costs a warning, never the model. Which thread
//! decodes which image makes no difference: results are kept by number, and the budget of texels is spent in the order
//! of the file, from the sizes in the headers, before any decoder runs.

use super::Images;
use super::accessor::Source;
use super::decode;
use super::error::Fault;
use super::limits::Limits;
use super::warnings::Warnings;
use crate::model::{Image, ImageFile, ImageHeader, Material, Mesh, Model, Texture};
use gltf::json::image::Image as JsonImage;
use std::borrow::Cow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// An encoded image.
struct Encoded<'a> {
    number: usize,
    bytes: Cow<'a, [u8]>,
    /// Width and height in texels.
    size: (u32, u32),
}

/// Reads the images of a file into its model, whose meshes marked in `shown` are visible.
pub(super) fn images(
    source: &Source<'_>,
    model: &mut Model,
    shown: &[bool],
    what: Images,
    warnings: &mut Warnings,
) {
    let count = source.root.images.len();
    let mut needed = needed(&model.meshes, shown, &model.materials, &model.textures, count);
    model.image_files = source.root.images.iter().map(file).collect();
    let encoded = read(&needed, source, warnings);
    note_headers(&encoded, &mut model.image_files);
    match what {
        Images::Decode => model.images = decode_all(&encoded, count, warnings),
        Images::Headers => {
            model.images = vec![None; count];
            // Nobody sees the others, so that nobody needs to be warned of them.
            needed.iter_mut().for_each(|needed| *needed = !*needed);
            note_headers(&read(&needed, source, &mut Warnings::default()), &mut model.image_files);
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

/// Which images the primitives of the given meshes need, by number.
fn needed(
    meshes: &[Mesh],
    shown: &[bool],
    materials: &[Material],
    textures: &[Texture],
    images: usize,
) -> Vec<bool> {
    let mut needed = vec![false; images];
    let visible = meshes.iter().zip(shown).filter(|(_, shown)| **shown).map(|(mesh, _)| mesh);
    for primitive in visible.flat_map(|mesh| &mesh.primitives).filter(|p| p.count() > 0) {
        let material = primitive.material.and_then(|at| materials.get(at));
        for (_, used) in material.into_iter().flat_map(Material::textures) {
            let image = textures.get(used.texture).and_then(|texture| texture.image);
            if let Some(flag) = image.and_then(|image| needed.get_mut(image)) {
                *flag = true;
            }
        }
    }
    needed
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

/// Decodes the images on all processors; the result has an entry for each of the file's `count` images.
fn decode_all(
    encoded: &[Encoded<'_>],
    count: usize,
    warnings: &mut Warnings,
) -> Vec<Option<Image>> {
    let results: Vec<Mutex<Option<Result<Image, String>>>> =
        encoded.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(image) = encoded.get(at) else { break };
            let result = decode::decode(&image.bytes);
            if let Ok(mut slot) = results[at].lock() {
                *slot = Some(result);
            }
        }
    };
    let processors = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 1..processors.min(encoded.len()) {
            scope.spawn(work);
        }
        work();
    });
    let mut images = vec![None; count];
    for (image, result) in encoded.iter().zip(results) {
        match result.into_inner().ok().flatten() {
            Some(Ok(decoded)) => images[image.number] = Some(decoded),
            Some(Err(problem)) => {
                let fault = Fault::invalid(&format!("/images/{}", image.number), problem);
                warnings.soft(&fault, LEFT_OUT);
            }
            None => {}
        }
    }
    images
}
