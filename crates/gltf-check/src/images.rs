//! Validation of images: sources, actual and declared formats, and use in textures.
//!
//! ```text
//!  uri ──────────┐             ┌─► mimeType, data URI: must match the bytes
//!                ├─► bytes ────┼─► header: must be complete
//!  bufferView ───┘             └─► textures: PNG and JPEG, others with an extension
//! ```
//!
//! No pixels are decoded: the header contains the format and the size, and a full decode would take
//! most of the validation time.

use super::codes;
use super::document::{CheckedDocument, extension_object, index_member, string_member};
use super::store::BufferStore;
use super::uris;
use super::usage::{UsageMap, ViewUse};
use gltf_import::UriResolver;
use serde_json::Value;
use std::borrow::Cow;

/// Validates all images, then the textures that use them.
///
/// The media type of an image, detected from its bytes or declared, determines which textures may
/// refer to it.
///
/// `is_binary` is set for a GLB, where data URIs are discouraged.
pub(super) fn check_images(
    document: &CheckedDocument<'_>,
    store: &BufferStore<'_>,
    usage: &UsageMap<'_>,
    resolver: &UriResolver<'_>,
    is_binary: bool,
) {
    let mut kinds = Vec::new();
    for (at, image) in document.root_array("images").iter().enumerate() {
        let checker = ImageChecker {
            document,
            store,
            usage,
            resolver,
            is_binary,
            pointer: format!("/images/{at}"),
        };
        kinds.push(checker.check_image(image));
    }
    for (at, texture) in document.root_array("textures").iter().enumerate() {
        check_texture(document, at, texture, &kinds);
    }
}

/// The image formats by media type, each with the extension that allows it.
///
/// Core glTF supports only PNG and JPEG (§3.8.3). An extension allows its format in its own
/// `source` member, so a texture can also have a fallback image.
const IMAGE_FORMATS: [(&str, Option<&str>); 4] = [
    ("image/png", None),
    ("image/jpeg", None),
    ("image/webp", Some("EXT_texture_webp")),
    ("image/ktx2", Some("KHR_texture_basisu")),
];

/// Detects the media type of an image from its first bytes (glTF 2.0 §3.8.3).
///
/// As in all viewers, the bytes take precedence over the declared type.
///
/// WebP is a RIFF container; bytes 4 to 7 are the file length and are skipped.
fn sniff_media_type(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xFF, 0xD8, 0xFF, ..] => Some("image/jpeg"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("image/webp"),
        [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', ..] => Some("image/ktx2"),
        _ => None,
    }
}

/// The context for validating one image.
struct ImageChecker<'a> {
    document: &'a CheckedDocument<'a>,
    store: &'a BufferStore<'a>,
    usage: &'a UsageMap<'a>,
    resolver: &'a UriResolver<'a>,
    /// Whether the file is a GLB, where data URIs are discouraged.
    is_binary: bool,
    /// The JSON pointer of the image.
    pointer: String,
}

impl ImageChecker<'_> {
    /// Validates an image, and returns its media type, detected from its bytes or declared.
    ///
    /// The declared `mimeType` and the type of a data URI must match the bytes. Formats other than
    /// PNG and JPEG require their extension.
    ///
    /// An image in a buffer view needs a `mimeType` (glTF 2.0 §3.8.3); for a URI, it is optional.
    /// If the bytes cannot be read, the declared type is returned, so that textures are still
    /// validated.
    fn check_image(&self, image: &Value) -> Option<String> {
        let diagnostics = self.document.diagnostics;
        let declared = string_member(image, "mimeType");
        if image.get("bufferView").is_some() && declared.is_none() {
            let message = "an image in a buffer view must have a mimeType";
            let pointer = format_args!("{}/bufferView", self.pointer);
            diagnostics.add(&codes::UNSATISFIED_DEPENDENCY, pointer, message);
        }
        let in_uri = string_member(image, "uri").and_then(uris::media_type);
        let bytes = self.image_bytes(image);
        let found = bytes.as_deref().and_then(|bytes| self.check_image_header(bytes));
        if let (Some(declared_type), Some(found)) = (declared, found)
            && found != declared_type
        {
            let message = format_args!("the image is {found}, not {declared_type}");
            diagnostics.add(&codes::IMAGE_MIME_TYPE_INVALID, &self.pointer, message);
        }
        if let Some(declared_type) =
            in_uri.filter(|declared_type| bytes.is_some() && Some(declared_type.as_str()) != found)
        {
            let message = format_args!(
                "the image is {}, not {declared_type}",
                found.unwrap_or("in an unknown format")
            );
            diagnostics.add(&codes::INVALID_URI, format_args!("{}/uri", self.pointer), message);
        }
        let kind = found.or(declared)?;
        if let Some((_, Some(extension))) = IMAGE_FORMATS.iter().find(|known| known.0 == kind)
            && found.is_some()
            && !self.document.uses_extension(extension)
        {
            let message = format_args!("{kind} is allowed only with {extension}");
            // The Khronos validator recognizes only WebP; a vendor extension may allow the others.
            let is_webp = kind == "image/webp";
            let strange = &codes::IMAGE_UNRECOGNIZED_FORMAT;
            let code = if is_webp { &codes::IMAGE_NON_ENABLED_MIME_TYPE } else { strange };
            diagnostics.add(code, &self.pointer, message);
        }
        Some(kind.to_owned())
    }

    /// Returns the bytes of an image from its buffer view or URI, or `None` if they cannot be read.
    ///
    /// A `byteStride` on the buffer view of an image is reported: images are read contiguously.
    fn image_bytes(&self, image: &Value) -> Option<Cow<'_, [u8]>> {
        let diagnostics = self.document.diagnostics;
        if let Some(view) = index_member(image, "bufferView") {
            let pointer = format!("{}/bufferView", self.pointer);
            self.usage.note_view(view, ViewUse::Image, &pointer);
            if self.store.view_stride(view).is_some() {
                let message = "byteStride must not be set on the buffer view of an image";
                diagnostics.add(&codes::IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE, &pointer, message);
            }
            return self.store.view_bytes(view).map(Cow::Borrowed);
        }
        let uri = string_member(image, "uri")?;
        let pointer = format!("{}/uri", self.pointer);
        uris::check_uri(uri, &pointer, self.is_binary, diagnostics);
        uris::read_uri(self.resolver, uri, &pointer, diagnostics).map(Cow::Owned)
    }

    /// Validates the header of an image, and returns the media type detected from its first bytes.
    ///
    /// Only the header is decoded. Decoders distinguish a truncated file from a corrupt file only
    /// in the error text, so that text determines the code. Without the `basisu` feature, KTX2 is
    /// recognized but not checked. Returns `None` for an unknown format, after reporting it.
    fn check_image_header(&self, bytes: &[u8]) -> Option<&'static str> {
        let diagnostics = self.document.diagnostics;
        let Some(kind) = sniff_media_type(bytes) else {
            let is_cut = IMAGE_FORMATS.len() > bytes.len();
            let code = if is_cut {
                &codes::IMAGE_UNEXPECTED_EOS
            } else {
                &codes::IMAGE_UNRECOGNIZED_FORMAT
            };
            let message = format_args!("unrecognized image format ({} bytes)", bytes.len());
            diagnostics.add(code, &self.pointer, message);
            return None;
        };
        let problem =
            if gltf_import::is_decoded(kind) { gltf_import::image_size(bytes).err() } else { None };
        if let Some(problem) = problem {
            let is_cut = ["end of file", "EOF", "fill whole buffer", "end before", "exhausted"]
                .iter()
                .any(|words| problem.contains(words));
            let code =
                if is_cut { &codes::IMAGE_UNEXPECTED_EOS } else { &codes::IMAGE_DATA_INVALID };
            diagnostics.add(code, &self.pointer, problem);
        }
        Some(kind)
    }
}

/// Validates the images of a texture: PNG or JPEG in core glTF, other formats through extensions.
///
/// An extension such as EXT_texture_webp has its own `source`, which must be in its format. Images
/// of unknown type are skipped, because they already have a diagnostic.
fn check_texture(
    document: &CheckedDocument<'_>,
    at: usize,
    texture: &Value,
    kinds: &[Option<String>],
) {
    let say = |member: &str, found: &str| {
        let message = format_args!("an image of type {found} cannot be used here");
        let pointer = format_args!("/textures/{at}/{member}");
        document.diagnostics.add(&codes::TEXTURE_INVALID_IMAGE_MIME_TYPE, pointer, message);
    };
    let kind = |source: Option<usize>| kinds.get(source?)?.as_deref();
    let source = kind(index_member(texture, "source"));
    if let Some(found) = source.filter(|&kind| kind != "image/png" && kind != "image/jpeg") {
        say("source", found);
    }
    for (due, name) in IMAGE_FORMATS.iter().filter_map(|(due, name)| Some((due, (*name)?))) {
        let source = extension_object(texture, name)
            .and_then(|extension| kind(index_member(extension, "source")));
        if let Some(found) = source.filter(|found| found != due) {
            say(&format!("extensions/{name}/source"), found);
        }
    }
}
