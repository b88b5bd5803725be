//! Materials, textures and images in `alberti info --json`.

use super::json::{shortest_number, shortest_numbers};
use model::{
    AlphaMode, ImageHeader, Material, MipmapMode, Model, TextureFilter, TextureInfo, TextureSlot,
    WrapMode,
};
use serde_json::{Value, json};

/// All materials of the file.
pub(super) fn materials_json(model: &Model) -> Vec<Value> {
    model.materials.iter().map(material_json).collect()
}

/// A material: the factors and textures of core glTF, and its extensions.
fn material_json(material: &Material) -> Value {
    let (mode, cutoff) = match material.alpha_mode {
        AlphaMode::Opaque => ("OPAQUE", None),
        AlphaMode::Mask { cutoff } => ("MASK", Some(shortest_number(cutoff))),
        AlphaMode::Blend => ("BLEND", None),
    };
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
        "textures": material.all_textures().map(texture_use_json).collect::<Vec<_>>(),
        "extensions": material_extensions_json(material),
    })
}

/// A texture slot of a material.
fn texture_use_json((slot, used): (TextureSlot, TextureInfo)) -> Value {
    json!({
        "slot": slot.json_path(),
        "texture": used.texture,
        "uv_set": used.uv_set,
        "transformed": used.uv_matrix != TextureInfo::IDENTITY_UV,
    })
}

/// The material extensions that differ from their defaults, by name without `KHR_materials_`.
fn material_extensions_json(material: &Material) -> Value {
    let more = &material.extensions;
    let mut all = serde_json::Map::new();
    let mut put = |name: &str, value: Value| all.insert(name.to_owned(), value);
    if more.ior != 1.5 {
        put("ior", json!({"ior": shortest_number(more.ior)}));
    }
    if more.dispersion != 0.0 {
        put("dispersion", json!({"dispersion": shortest_number(more.dispersion)}));
    }
    if material.emission.strength != 1.0 {
        put("emissive_strength", json!({"strength": shortest_number(material.emission.strength)}));
    }
    if let Some(of) = &more.specular {
        put(
            "specular",
            json!({"factor": shortest_number(of.factor), "color": shortest_numbers(&of.color)}),
        );
    }
    if let Some(of) = &more.specular_glossiness {
        let (specular, glossiness) =
            (shortest_numbers(&of.specular), shortest_number(of.glossiness));
        put("pbrSpecularGlossiness", json!({"specular": specular, "glossiness": glossiness}));
    }
    if let Some(of) = &more.clearcoat {
        put(
            "clearcoat",
            json!({"factor": shortest_number(of.factor), "roughness": shortest_number(of.roughness)}),
        );
    }
    if let Some(of) = &more.sheen {
        put(
            "sheen",
            json!({"color": shortest_numbers(&of.color), "roughness": shortest_number(of.roughness)}),
        );
    }
    if let Some(of) = &more.transmission {
        put("transmission", json!({"factor": shortest_number(of.factor)}));
    }
    if let Some(of) = &more.volume {
        let (distance, color) =
            (shortest_number(of.attenuation_distance), shortest_numbers(&of.attenuation_color));
        let thickness = shortest_number(of.thickness);
        put(
            "volume",
            json!({"thickness": thickness, "attenuation_distance": distance, "attenuation_color": color}),
        );
    }
    if let Some(of) = &more.iridescence {
        let thickness = shortest_numbers(&[of.thickness_minimum, of.thickness_maximum]);
        let (factor, ior) = (shortest_number(of.factor), shortest_number(of.ior));
        put(
            "iridescence",
            json!({"factor": factor, "ior": ior, "thickness_nanometres": thickness}),
        );
    }
    if let Some(of) = &more.anisotropy {
        put(
            "anisotropy",
            json!({"strength": shortest_number(of.strength), "rotation": shortest_number(of.rotation)}),
        );
    }
    Value::Object(all)
}

/// All textures of the file, with their samplers.
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

/// The name of a wrap mode.
fn wrap_name(wrap: WrapMode) -> &'static str {
    match wrap {
        WrapMode::Repeat => "repeat",
        WrapMode::MirroredRepeat => "mirror",
        WrapMode::ClampToEdge => "clamp",
    }
}

/// The name of a filter.
fn filter_name(filter: TextureFilter) -> &'static str {
    match filter {
        TextureFilter::Nearest => "nearest",
        TextureFilter::Linear => "linear",
    }
}

/// All images of the file; `file` has the header of those that can be read.
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
