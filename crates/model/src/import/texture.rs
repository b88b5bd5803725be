//! Textures: which image, read how.

use super::error::Fault;
use super::warnings::Warnings;
use crate::{Filter, Mipmap, Sampler, Texture, Wrap};
use gltf::json::Root;
use gltf::json::texture::{MagFilter, MinFilter, WrappingMode};
use gltf::json::validation::Checked;

/// What `Texture::source` is in the JSON types where the file has none.
const NO_SOURCE: usize = u32::MAX as usize;

/// Reads all textures of a file. What is wrong with one is a warning.
pub(super) fn textures(root: &Root, warnings: &mut Warnings) -> Vec<Texture> {
    let mut textures = Vec::with_capacity(root.textures.len());
    for (at, json) in root.textures.iter().enumerate() {
        let pointer = format!("/textures/{at}");
        let sampler = json.sampler.as_ref().map_or_else(Sampler::default, |index| {
            root.samplers.get(index.value()).map_or_else(
                || {
                    let pointer = format!("{pointer}/sampler");
                    let count = root.samplers.len();
                    let fault = Fault::unresolved(&pointer, "sampler", index.value(), count);
                    warnings.soft(&fault, "the texture is read in the usual way");
                    Sampler::default()
                },
                sampler,
            )
        });
        textures.push(Texture { image: source(root, at, warnings), sampler });
    }
    textures
}

/// The image of a texture; an image of an extension that is read comes before the one that stands beside it for those who
/// cannot read it.
fn source(root: &Root, at: usize, warnings: &mut Warnings) -> Option<usize> {
    let json = &root.textures[at];
    let extensions = json.extensions.as_ref().map(|extensions| &extensions.others);
    let of = |name: &str| extensions.and_then(|all| all.get(name)?.get("source")?.as_u64());
    let basis = of("KHR_texture_basisu").filter(|_| cfg!(feature = "basisu"));
    let other = basis.or_else(|| of("EXT_texture_webp"));
    let image = other.map_or(json.source.value(), |source| source as usize);
    if image < root.images.len() {
        return Some(image);
    }
    if image != NO_SOURCE {
        let pointer = format!("/textures/{at}/source");
        let fault = Fault::unresolved(&pointer, "image", image, root.images.len());
        warnings.soft(&fault, "the texture is not shown");
    }
    None
}

/// The JSON sampler in our words; what is missing or unknown is read in the usual way.
fn sampler(json: &gltf::json::texture::Sampler) -> Sampler {
    let wrap = |mode: Checked<WrappingMode>| match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    };
    let magnify = match json.mag_filter {
        Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
        _ => Filter::Linear,
    };
    let (minify, mipmap) = match json.min_filter {
        Some(Checked::Valid(MinFilter::Nearest)) => (Filter::Nearest, Mipmap::None),
        Some(Checked::Valid(MinFilter::Linear)) => (Filter::Linear, Mipmap::None),
        Some(Checked::Valid(MinFilter::NearestMipmapNearest)) => (Filter::Nearest, Mipmap::Nearest),
        Some(Checked::Valid(MinFilter::LinearMipmapNearest)) => (Filter::Linear, Mipmap::Nearest),
        Some(Checked::Valid(MinFilter::NearestMipmapLinear)) => (Filter::Nearest, Mipmap::Linear),
        _ => (Filter::Linear, Mipmap::Linear),
    };
    Sampler { wrap_u: wrap(json.wrap_s), wrap_v: wrap(json.wrap_t), magnify, minify, mipmap }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn samplers_in_our_words() {
        let read = |json| sampler(&serde_json::from_value(json).unwrap());
        assert_eq!(read(json!({})), Sampler::default());
        let wrong = json!({"magFilter": 1, "minFilter": 2, "wrapS": 3, "wrapT": 4});
        assert_eq!(read(wrong), Sampler::default());
        for (number, minify, mipmap) in [
            (9728, Filter::Nearest, Mipmap::None),
            (9729, Filter::Linear, Mipmap::None),
            (9984, Filter::Nearest, Mipmap::Nearest),
            (9985, Filter::Linear, Mipmap::Nearest),
            (9986, Filter::Nearest, Mipmap::Linear),
            (9987, Filter::Linear, Mipmap::Linear),
        ] {
            let sampler = read(json!({"magFilter": 9728, "minFilter": number, "wrapT": 33071}));
            let (magnify, wrap_u, wrap_v) = (Filter::Nearest, Wrap::Repeat, Wrap::Clamp);
            assert_eq!(sampler, Sampler { wrap_u, wrap_v, magnify, minify, mipmap });
        }
        assert_eq!(read(json!({"wrapS": 33648})).wrap_u, Wrap::Mirror);
    }
}
