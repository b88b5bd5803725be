//! Reads the image and sampler of each texture.
//!
//! glTF identifies filters and wrap modes by OpenGL constants, and combines the magnification,
//! minification and mipmap filters in two members; here each is an enum. Without a sampler,
//! textures repeat and are filtered trilinearly, which is also the default without `minFilter`.

use crate::warnings::ImportWarnings;
use gltf::json::Root;
use gltf::json::texture::{MagFilter, MinFilter, WrappingMode};
use gltf::json::validation::Checked;
use model::{Diagnostic, MipmapMode, Sampler, Texture, TextureFilter, WrapMode};

/// The value of `Texture::source` in the JSON type if the file has no source.
///
/// The `gltf` crate stores indices in 32 bits, and uses the largest value as a marker.
const NO_SOURCE: usize = u32::MAX as usize;

/// Reads all textures of a file. Errors in textures are only warnings.
///
/// A missing sampler is replaced by the default sampler, with a warning.
pub(super) fn import_textures(root: &Root, warnings: &mut ImportWarnings) -> Vec<Texture> {
    let mut textures = Vec::with_capacity(root.textures.len());
    for (at, json) in root.textures.iter().enumerate() {
        let pointer = format!("/textures/{at}");
        let sampler = json.sampler.as_ref().map_or_else(Sampler::default, |index| {
            root.samplers.get(index.value()).map_or_else(
                || {
                    let pointer = format!("{pointer}/sampler");
                    let count = root.samplers.len();
                    let diagnostic =
                        Diagnostic::unresolved_index(&pointer, "sampler", index.value(), count);
                    warnings.downgrade(&diagnostic, "the default sampler is used");
                    Sampler::default()
                },
                convert_sampler,
            )
        });
        textures.push(Texture { image: texture_image(root, at, warnings), sampler });
    }
    textures
}

/// Returns the image of a texture. An image from a supported extension (KHR_texture_basisu,
/// EXT_texture_webp) takes precedence over the fallback for other readers.
///
/// If the index is out of range, the texture has no image and the surface is drawn untextured.
fn texture_image(root: &Root, at: usize, warnings: &mut ImportWarnings) -> Option<usize> {
    let json = &root.textures[at];
    let extensions = json.extensions.as_ref().map(|extensions| &extensions.others);
    let of = |name: &str| extensions.and_then(|all| all.get(name)?.get("source")?.as_u64());
    let basis = of("KHR_texture_basisu").filter(|_| cfg!(feature = "basisu"));
    let webp = || of("EXT_texture_webp").filter(|_| cfg!(feature = "webp"));
    let other = basis.or_else(webp);
    let image = other.map_or(json.source.value(), |source| source as usize);
    if image < root.images.len() {
        return Some(image);
    }
    if image != NO_SOURCE {
        let pointer = format!("/textures/{at}/source");
        let diagnostic = Diagnostic::unresolved_index(&pointer, "image", image, root.images.len());
        warnings.downgrade(&diagnostic, "the texture is not shown");
    }
    None
}

/// Converts the sampler. Missing or unknown members get their defaults.
///
/// ```text
///  minFilter                 min_filter   mipmap_mode
///  NEAREST                   Nearest      None
///  LINEAR                    Linear       None
///  NEAREST_MIPMAP_NEAREST    Nearest      Nearest
///  LINEAR_MIPMAP_NEAREST     Linear       Nearest
///  NEAREST_MIPMAP_LINEAR     Nearest      Linear
///  LINEAR_MIPMAP_LINEAR      Linear       Linear        the default
/// ```
fn convert_sampler(json: &gltf::json::texture::Sampler) -> Sampler {
    let wrap = |mode: Checked<WrappingMode>| match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => WrapMode::ClampToEdge,
        Checked::Valid(WrappingMode::MirroredRepeat) => WrapMode::MirroredRepeat,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => WrapMode::Repeat,
    };
    let magnify = match json.mag_filter {
        Some(Checked::Valid(MagFilter::Nearest)) => TextureFilter::Nearest,
        _ => TextureFilter::Linear,
    };
    let (minify, mipmap) = match json.min_filter {
        Some(Checked::Valid(MinFilter::Nearest)) => (TextureFilter::Nearest, MipmapMode::None),
        Some(Checked::Valid(MinFilter::Linear)) => (TextureFilter::Linear, MipmapMode::None),
        Some(Checked::Valid(MinFilter::NearestMipmapNearest)) => {
            (TextureFilter::Nearest, MipmapMode::Nearest)
        }
        Some(Checked::Valid(MinFilter::LinearMipmapNearest)) => {
            (TextureFilter::Linear, MipmapMode::Nearest)
        }
        Some(Checked::Valid(MinFilter::NearestMipmapLinear)) => {
            (TextureFilter::Nearest, MipmapMode::Linear)
        }
        _ => (TextureFilter::Linear, MipmapMode::Linear),
    };
    Sampler {
        wrap_u: wrap(json.wrap_s),
        wrap_v: wrap(json.wrap_t),
        mag_filter: magnify,
        min_filter: minify,
        mipmap_mode: mipmap,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn opengl_constants_are_converted() {
        let read = |json| convert_sampler(&serde_json::from_value(json).unwrap());
        assert_eq!(read(json!({})), Sampler::default());
        let wrong = json!({"magFilter": 1, "minFilter": 2, "wrapS": 3, "wrapT": 4});
        assert_eq!(read(wrong), Sampler::default());
        for (number, minify, mipmap) in [
            (9728, TextureFilter::Nearest, MipmapMode::None),
            (9729, TextureFilter::Linear, MipmapMode::None),
            (9984, TextureFilter::Nearest, MipmapMode::Nearest),
            (9985, TextureFilter::Linear, MipmapMode::Nearest),
            (9986, TextureFilter::Nearest, MipmapMode::Linear),
            (9987, TextureFilter::Linear, MipmapMode::Linear),
        ] {
            let sampler = read(json!({"magFilter": 9728, "minFilter": number, "wrapT": 33071}));
            let (magnify, wrap_u, wrap_v) =
                (TextureFilter::Nearest, WrapMode::Repeat, WrapMode::ClampToEdge);
            assert_eq!(
                sampler,
                Sampler {
                    wrap_u,
                    wrap_v,
                    mag_filter: magnify,
                    min_filter: minify,
                    mipmap_mode: mipmap
                }
            );
        }
        assert_eq!(read(json!({"wrapS": 33648})).wrap_u, WrapMode::MirroredRepeat);
    }
}
