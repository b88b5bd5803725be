//! Materials, textures and images in `alberti info --json`.
//!
//! Colors are linear, and factors are as in the file: textures are listed, not multiplied in.

use super::json::{shortest_number, shortest_numbers};
use model::{
    AlphaMode, ImageHeader, Material, MaterialExtensions, MipmapMode, Model, TextureFilter,
    TextureInfo, TextureSlot, WrapMode,
};
use serde_json::{Value, json};

/// Returns all materials in the file.
pub(super) fn materials_json(model: &Model) -> Vec<Value> {
    model.materials.iter().map(material_json).collect()
}

/// Returns a material: the factors and textures of core glTF, and its extensions.
///
/// `alpha_cutoff` is `null` unless the mode is `MASK`. `base_color` has four components, of which
/// the last is alpha; `emissive` has three and does not include the strength from the extension.
fn material_json(material: &Material) -> Value {
    let (mode, cutoff) = match material.alpha_mode {
        AlphaMode::Opaque => ("OPAQUE", None),
        AlphaMode::Mask { cutoff } => ("MASK", Some(shortest_number(cutoff))),
        AlphaMode::Blend => ("BLEND", None),
    };
    let textures = material.all_textures().map(|(slot, used)| texture_use_json(slot, used));
    json!({
        "name": material.name,
        "base_color": shortest_numbers(&material.base_color),
        "metallic": shortest_number(material.metallic),
        "roughness": shortest_number(material.roughness),
        "emissive": shortest_numbers(&material.emissive),
        "alpha_mode": mode,
        "alpha_cutoff": cutoff,
        "double_sided": material.double_sided,
        "unlit": material.unlit,
        "textures": textures.collect::<Vec<_>>(),
        "extensions": material_extensions_json(material),
    })
}

/// Returns a texture slot of a material.
///
/// `slot` is the path of the texture in the material's JSON. `transformed` is true if
/// KHR_texture_transform changes the texture coordinates.
fn texture_use_json(slot: TextureSlot, used: TextureInfo) -> Value {
    json!({
        "slot": slot.json_path(),
        "texture": used.texture,
        "uv_set": used.uv_set,
        "transformed": used.uv_matrix != TextureInfo::IDENTITY_UV,
    })
}

/// Returns the material extensions that differ from their defaults, by name without
/// `KHR_materials_`.
///
/// An extension with default values has no effect and is omitted: an index of refraction of 1.5, a
/// dispersion of 0, a strength of 1. Extension textures are listed with the material's textures.
fn material_extensions_json(material: &Material) -> Value {
    let (more, strength) = (&material.extensions, material.emission.strength);
    let ior = (more.ior != 1.5).then(|| json!({"ior": shortest_number(more.ior)}));
    let dispersion =
        (more.dispersion != 0.0).then(|| json!({"dispersion": shortest_number(more.dispersion)}));
    let emissive = (strength != 1.0).then(|| json!({"strength": shortest_number(strength)}));
    let volume = more.volume.as_ref().map(|of| {
        json!({
            "thickness": shortest_number(of.thickness),
            "attenuation_distance": shortest_number(of.attenuation_distance),
            "attenuation_color": shortest_numbers(&of.attenuation_color),
        })
    });
    let all = [
        ("ior", ior),
        ("dispersion", dispersion),
        ("emissive_strength", emissive),
        ("volume", volume),
    ];
    let all = all.into_iter().chain(material_layers_json(&material.extensions));
    all.filter_map(|(name, value)| Some((name.to_owned(), value?))).collect()
}

/// Returns the extensions that add or replace a layer of the BRDF; missing ones are `None`.
///
/// The thickness of iridescence is a pair in nanometers: minimum and maximum.
fn material_layers_json(more: &MaterialExtensions) -> [(&'static str, Option<Value>); 7] {
    // Colors and reflectances have three components; every other parameter has one.
    let (one, three) = (shortest_number, |color: &[f32]| shortest_numbers(color));
    let specular = more
        .specular
        .as_ref()
        .map(|of| json!({"factor": one(of.factor), "color": three(&of.color)}));
    let glossiness = more
        .specular_glossiness
        .as_ref()
        .map(|of| json!({"specular": three(&of.specular), "glossiness": one(of.glossiness)}));
    let clearcoat = more
        .clearcoat
        .as_ref()
        .map(|of| json!({"factor": one(of.factor), "roughness": one(of.roughness)}));
    let sheen = more
        .sheen
        .as_ref()
        .map(|of| json!({"color": three(&of.color), "roughness": one(of.roughness)}));
    let transmission = more.transmission.as_ref().map(|of| json!({"factor": one(of.factor)}));
    let iridescence = more.iridescence.as_ref().map(|of| {
        let thickness = three(&[of.thickness_minimum, of.thickness_maximum]);
        json!({"factor": one(of.factor), "ior": one(of.ior), "thickness_nanometres": thickness})
    });
    let anisotropy = more
        .anisotropy
        .as_ref()
        .map(|of| json!({"strength": one(of.strength), "rotation": one(of.rotation)}));
    [
        ("specular", specular),
        ("pbrSpecularGlossiness", glossiness),
        ("clearcoat", clearcoat),
        ("sheen", sheen),
        ("transmission", transmission),
        ("iridescence", iridescence),
        ("anisotropy", anisotropy),
    ]
}

/// Returns all textures in the file, with their samplers.
///
/// `wrap` contains the modes along u and v. glTF samplers combine minification and mipmaps in one
/// constant, such as `LINEAR_MIPMAP_NEAREST`; here they are two members.
pub(super) fn textures_json(model: &Model) -> Vec<Value> {
    let describe = |texture: &model::Texture| {
        let sampler = texture.sampler;
        json!({
            "image": texture.image,
            "wrap": [wrap_name(sampler.wrap_u), wrap_name(sampler.wrap_v)],
            "magnify": filter_name(sampler.mag_filter),
            "minify": filter_name(sampler.min_filter),
            "mipmap": match sampler.mipmap_mode {
                MipmapMode::None => "none",
                MipmapMode::Nearest => "nearest",
                MipmapMode::Linear => "linear",
            },
        })
    };
    model.textures.iter().map(describe).collect()
}

/// Returns the name of a wrap mode.
fn wrap_name(wrap: WrapMode) -> &'static str {
    match wrap {
        WrapMode::Repeat => "repeat",
        WrapMode::MirroredRepeat => "mirror",
        WrapMode::ClampToEdge => "clamp",
    }
}

/// Returns the name of a filter.
fn filter_name(filter: TextureFilter) -> &'static str {
    match filter {
        TextureFilter::Nearest => "nearest",
        TextureFilter::Linear => "linear",
    }
}

/// Returns all images in the file; `file` contains the header of each readable image.
///
/// `uri` is `null` for an image in a buffer. `bytes` is the size of the encoded file.
pub(super) fn images_json(model: &Model) -> Vec<Value> {
    let describe = |file: &model::ImageInfo| {
        let header = file.header.map(|header: ImageHeader| {
            json!({
                "format": header.format,
                "width": header.width,
                "height": header.height,
                "bytes": header.bytes,
            })
        });
        json!({"name": file.name, "uri": file.uri, "file": header})
    };
    model.image_infos.iter().map(describe).collect()
}
