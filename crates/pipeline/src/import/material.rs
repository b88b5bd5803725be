//! Materials: the factors and the base-colour texture, with the extensions that change them.

use super::error::Fault;
use super::warnings::Warnings;
use crate::model::{AlphaMode, Material, Model, TextureUse};
use gltf::json::material::AlphaMode as JsonAlphaMode;
use gltf::json::validation::Checked;
use gltf::json::{Root, texture};
use serde_json::{Map, Value};

/// Reads all materials of a file. What is wrong with one is a warning.
pub(super) fn materials(root: &Root, warnings: &mut Warnings) -> Vec<Material> {
    (0..root.materials.len())
        .map(|at| Reader { root, at, warnings: &mut *warnings }.material())
        .collect()
}

struct Reader<'a, 'w> {
    root: &'a Root,
    at: usize,
    warnings: &'w mut Warnings,
}

impl Reader<'_, '_> {
    fn material(mut self) -> Material {
        let json = &self.root.materials[self.at];
        let pbr = &json.pbr_metallic_roughness;
        let strength = self.emissive_strength();
        let mut material = Material {
            name: json.name.clone(),
            base_color: self.unit("pbrMetallicRoughness/baseColorFactor", pbr.base_color_factor.0),
            base_color_texture: pbr
                .base_color_texture
                .as_ref()
                .and_then(|info| self.texture_use("pbrMetallicRoughness/baseColorTexture", info)),
            metallic: self.unit("pbrMetallicRoughness/metallicFactor", [pbr.metallic_factor.0])[0],
            roughness: self.unit("pbrMetallicRoughness/roughnessFactor", [pbr.roughness_factor.0])
                [0],
            emissive: self.unit("emissiveFactor", json.emissive_factor.0).map(|x| x * strength),
            emissive_texture: json
                .emissive_texture
                .as_ref()
                .and_then(|info| self.texture_use("emissiveTexture", info)),
            alpha_mode: self.alpha_mode(),
            double_sided: json.double_sided,
            unlit: self.extension("KHR_materials_unlit").is_some(),
        };
        if let Some(glossy) = self.extension("KHR_materials_pbrSpecularGlossiness").cloned() {
            self.specular_glossiness(&glossy, &mut material);
        }
        material
    }

    fn extension(&self, name: &str) -> Option<&Map<String, Value>> {
        let extensions = self.root.materials[self.at].extensions.as_ref()?;
        extensions.others.get(name)?.as_object()
    }

    fn pointer(&self, member: &str) -> String {
        format!("/materials/{}/{member}", self.at)
    }

    /// Factors brought into [0, 1], where the specification wants them.
    fn unit<const N: usize>(&mut self, member: &str, factors: [f32; N]) -> [f32; N] {
        let inside = factors.map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 });
        if inside != factors {
            let message = format!("{factors:?} is not in [0, 1]; it is {inside:?}");
            self.warnings.add(&self.pointer(member), message);
        }
        inside
    }

    fn alpha_mode(&mut self) -> AlphaMode {
        let json = &self.root.materials[self.at];
        match json.alpha_mode {
            Checked::Valid(JsonAlphaMode::Opaque) => AlphaMode::Opaque,
            Checked::Valid(JsonAlphaMode::Blend) => AlphaMode::Blend,
            Checked::Valid(JsonAlphaMode::Mask) => {
                AlphaMode::Mask { cutoff: json.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0) }
            }
            Checked::Invalid => {
                let message = "the alpha mode is not one of OPAQUE, MASK and BLEND; it is OPAQUE";
                self.warnings.add(&self.pointer("alphaMode"), message);
                AlphaMode::Opaque
            }
        }
    }

    fn emissive_strength(&self) -> f32 {
        let extension = self.extension("KHR_materials_emissive_strength");
        let strength = extension.and_then(|e| e.get("emissiveStrength")).and_then(Value::as_f64);
        strength.map_or(1.0, |s| s.clamp(0.0, 1e6) as f32)
    }

    /// The older model of materials, as far as one colour and one texture can show it.
    fn specular_glossiness(&mut self, extension: &Map<String, Value>, material: &mut Material) {
        const NAME: &str = "extensions/KHR_materials_pbrSpecularGlossiness";
        let diffuse = extension.get("diffuseFactor").and_then(floats).unwrap_or([1.0; 4]);
        material.base_color = self.unit(&format!("{NAME}/diffuseFactor"), diffuse);
        material.metallic = 0.0;
        let gloss = extension.get("glossinessFactor").and_then(Value::as_f64).unwrap_or(1.0) as f32;
        material.roughness = 1.0 - self.unit(&format!("{NAME}/glossinessFactor"), [gloss])[0];
        let info = extension.get("diffuseTexture").cloned();
        let info = info.and_then(|info| serde_json::from_value::<texture::Info>(info).ok());
        material.base_color_texture =
            info.and_then(|info| self.texture_use(&format!("{NAME}/diffuseTexture"), &info));
    }

    fn texture_use(&mut self, member: &str, info: &texture::Info) -> Option<TextureUse> {
        let texture = info.index.value();
        if texture >= self.root.textures.len() {
            let pointer = self.pointer(&format!("{member}/index"));
            let fault = Fault::unresolved(&pointer, "texture", texture, self.root.textures.len());
            self.warnings.soft(&fault, "the surface is shown without it");
            return None;
        }
        let transform =
            info.extensions.as_ref().and_then(|e| e.others.get("KHR_texture_transform"));
        let uv_set = transform.and_then(|t| t.get("texCoord")).and_then(Value::as_u64);
        Some(TextureUse {
            texture,
            uv_set: uv_set.map_or(info.tex_coord as usize, |set| set as usize),
            uv_map: transform.map_or(TextureUse::KEEP_UV, uv_map),
        })
    }
}

/// Warns of primitives that lack the texture coordinates their material asks for.
pub(super) fn warn_of_missing_texcoords(model: &Model, warnings: &mut Warnings) {
    for (at, mesh) in model.meshes.iter().enumerate() {
        for (part, primitive) in mesh.primitives.iter().enumerate() {
            let material = primitive.material.map(|material| &model.materials[material]);
            let mut used = material.into_iter().flat_map(Material::textures);
            let missing = used.find(|used| used.uv_set >= primitive.uvs.len());
            if let Some(TextureUse { uv_set, .. }) = missing.filter(|_| primitive.count() > 0) {
                let message = format!("its texture needs TEXCOORD_{uv_set}; it is shown without");
                warnings.add(&format!("/meshes/{at}/primitives/{part}"), message);
            }
        }
    }
}

/// The map of KHR_texture_transform: scale, then rotate (counter-clockwise in an image whose v points down), then move.
fn uv_map(transform: &Value) -> [[f32; 3]; 2] {
    let [u, v] = transform.get("offset").and_then(floats).unwrap_or([0.0; 2]);
    let [width, height] = transform.get("scale").and_then(floats).unwrap_or([1.0; 2]);
    let angle = transform.get("rotation").and_then(Value::as_f64).unwrap_or(0.0);
    let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
    let map = [[cos * width, sin * height, u], [-sin * width, cos * height, v]];
    if map.as_flattened().iter().all(|x| x.is_finite()) { map } else { TextureUse::KEEP_UV }
}

fn floats<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let numbers: Option<Vec<f32>> =
        value.as_array()?.iter().map(|item| item.as_f64().map(|x| x as f32)).collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn texture_transform_turns_about_the_origin_and_then_moves() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let transform = json!({"offset": [0.5, 0.25], "rotation": quarter, "scale": [2.0, 3.0]});
        let map = uv_map(&transform);
        let image = |u: f32, v: f32| map.map(|row| row[0] * u + row[1] * v + row[2]);
        let near =
            |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6;
        assert!(near(image(0.0, 0.0), [0.5, 0.25]));
        assert!(near(image(1.0, 0.0), [0.5, 0.25 - 2.0]));
        assert!(near(image(0.0, 1.0), [0.5 + 3.0, 0.25]));
    }
}
