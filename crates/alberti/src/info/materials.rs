//! What `alberti info --json` tells of materials, textures and images.

use super::json::{short, shorts};
use model::{
    AlphaMode, ImageHeader, Material, MipmapMode, Model, TextureFilter, TextureInfo, TextureSlot,
    WrapMode,
};
use serde_json::{Value, json};

pub(super) fn materials(model: &Model) -> Vec<Value> {
    model.materials.iter().map(material).collect()
}

fn material(material: &Material) -> Value {
    let (mode, cutoff) = match material.alpha_mode {
        AlphaMode::Opaque => ("OPAQUE", None),
        AlphaMode::Mask { cutoff } => ("MASK", Some(short(cutoff))),
        AlphaMode::Blend => ("BLEND", None),
    };
    json!({
        "name": material.name,
        "base_color": shorts(&material.base_color),
        "metallic": short(material.metallic),
        "roughness": short(material.roughness),
        "emissive": shorts(&material.emissive),
        "alpha_mode": mode,
        "alpha_cutoff": cutoff,
        "double_sided": material.double_sided,
        "unlit": material.unlit,
        "textures": material.all_textures().map(texture_use).collect::<Vec<_>>(),
        "extensions": extensions(material),
    })
}

fn texture_use((slot, used): (TextureSlot, TextureInfo)) -> Value {
    json!({
        "slot": slot.json_path(),
        "texture": used.texture,
        "uv_set": used.uv_set,
        "transformed": used.uv_matrix != TextureInfo::IDENTITY_UV,
    })
}

/// What extensions say of the material, by their names without `KHR_materials_`.
fn extensions(material: &Material) -> Value {
    let more = &material.extensions;
    let mut all = serde_json::Map::new();
    let mut put = |name: &str, value: Value| all.insert(name.to_owned(), value);
    if more.ior != 1.5 {
        put("ior", json!({"ior": short(more.ior)}));
    }
    if more.dispersion != 0.0 {
        put("dispersion", json!({"dispersion": short(more.dispersion)}));
    }
    if material.emission.strength != 1.0 {
        put("emissive_strength", json!({"strength": short(material.emission.strength)}));
    }
    if let Some(of) = &more.specular {
        put("specular", json!({"factor": short(of.factor), "color": shorts(&of.color)}));
    }
    if let Some(of) = &more.specular_glossiness {
        let (specular, glossiness) = (shorts(&of.specular), short(of.glossiness));
        put("pbrSpecularGlossiness", json!({"specular": specular, "glossiness": glossiness}));
    }
    if let Some(of) = &more.clearcoat {
        put("clearcoat", json!({"factor": short(of.factor), "roughness": short(of.roughness)}));
    }
    if let Some(of) = &more.sheen {
        put("sheen", json!({"color": shorts(&of.color), "roughness": short(of.roughness)}));
    }
    if let Some(of) = &more.transmission {
        put("transmission", json!({"factor": short(of.factor)}));
    }
    if let Some(of) = &more.volume {
        let (distance, color) = (short(of.attenuation_distance), shorts(&of.attenuation_color));
        let thickness = short(of.thickness);
        put(
            "volume",
            json!({"thickness": thickness, "attenuation_distance": distance, "attenuation_color": color}),
        );
    }
    if let Some(of) = &more.iridescence {
        let thickness = shorts(&[of.thickness_minimum, of.thickness_maximum]);
        let (factor, ior) = (short(of.factor), short(of.ior));
        put(
            "iridescence",
            json!({"factor": factor, "ior": ior, "thickness_nanometres": thickness}),
        );
    }
    if let Some(of) = &more.anisotropy {
        put("anisotropy", json!({"strength": short(of.strength), "rotation": short(of.rotation)}));
    }
    Value::Object(all)
}

pub(super) fn textures(model: &Model) -> Vec<Value> {
    let describe = |texture: &model::Texture| {
        let sampler = texture.sampler;
        json!({
            "image": texture.image,
            "wrap": [wrap(sampler.wrap_u), wrap(sampler.wrap_v)],
            "magnify": filter(sampler.mag_filter),
            "minify": filter(sampler.min_filter),
            "mipmap": match sampler.mipmap_mode {
                MipmapMode::None => "none",
                MipmapMode::Nearest => "nearest",
                MipmapMode::Linear => "linear",
            },
        })
    };
    model.textures.iter().map(describe).collect()
}

fn wrap(wrap: WrapMode) -> &'static str {
    match wrap {
        WrapMode::Repeat => "repeat",
        WrapMode::MirroredRepeat => "mirror",
        WrapMode::ClampToEdge => "clamp",
    }
}

fn filter(filter: TextureFilter) -> &'static str {
    match filter {
        TextureFilter::Nearest => "nearest",
        TextureFilter::Linear => "linear",
    }
}

pub(super) fn images(model: &Model) -> Vec<Value> {
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
