//! Materials: factors and textures, including the KHR_materials extensions.
//!
//! Numeric extension properties are found through the table of [animatable
//! properties](model::object_model), which contains their JSON pointers and bounds, and textures
//! through the table of [`TextureSlot`]s.
//!
//! ```text
//!  core members ──────────────────────────► Material
//!  extensions ──┬─ textures by slot ──────► MaterialExtensions
//!               └─ numbers by pointer ────► clamped to their bounds
//! ```
//!
//! A material is never rejected, because it affects only the appearance, and values out of range
//! have an obvious replacement.

use crate::warnings::ImportWarnings;
use gltf::json::Root;
use gltf::json::material::AlphaMode as JsonAlphaMode;
use gltf::json::validation::Checked;
use model::object_model::{MATERIAL_PROPERTIES, PropertyRow};
use model::{
    AlphaMode, Diagnostic, Material, Model, NormalTexture, OcclusionTexture, TextureInfo,
    TextureSlot, UvTransform,
};
use serde_json::{Map, Value};

/// Reads all materials of a file. Errors in materials are only warnings.
pub(super) fn import_materials(root: &Root, warnings: &mut ImportWarnings) -> Vec<Material> {
    (0..root.materials.len())
        .map(|at| MaterialReader { root, at, warnings: &mut *warnings }.read_material())
        .collect()
}

/// Returns the texture transform (KHR_texture_transform) of a slot, if the file specifies one.
///
/// The default is the identity: offset 0, rotation 0, scale 1. The rotation is in radians,
/// counter-clockwise around the origin of the texture coordinates.
pub(super) fn texture_transform(
    root: &Root,
    material: usize,
    slot: TextureSlot,
) -> Option<UvTransform> {
    let json = JsonTextureInfo::from_slot(root, material, slot)?.transform?;
    let rotation = json.get("rotation").and_then(Value::as_f64).unwrap_or(0.0);
    Some(UvTransform {
        material,
        slot,
        offset: json.get("offset").and_then(float_array).unwrap_or([0.0; 2]),
        rotation: rotation as f32,
        scale: json.get("scale").and_then(float_array).unwrap_or([1.0; 2]),
    })
}

/// Reads one material.
///
/// JSON pointers for warnings are composed on demand, because valid materials do not need them.
struct MaterialReader<'a, 'w> {
    root: &'a Root,
    /// Index of the material.
    at: usize,
    warnings: &'w mut ImportWarnings,
}

impl<'a> MaterialReader<'a, '_> {
    /// Reads the core properties, then the extensions.
    ///
    /// Factors out of range are clamped with a warning. Specular-glossiness textures replace the
    /// metallic-roughness textures, which files also contain for readers without the extension.
    ///
    /// At the end, `update_derived` computes fields that depend on several others. Animations also
    /// call it.
    fn read_material(mut self) -> Material {
        let json = &self.root.materials[self.at];
        let pbr = &json.pbr_metallic_roughness;
        let mut material = Material {
            name: json.name.clone(),
            base_color: self
                .clamp_unit("pbrMetallicRoughness/baseColorFactor", pbr.base_color_factor.0),
            base_color_texture: self.read_texture(TextureSlot::BaseColor),
            metallic: self
                .clamp_unit("pbrMetallicRoughness/metallicFactor", [pbr.metallic_factor.0])[0],
            roughness: self
                .clamp_unit("pbrMetallicRoughness/roughnessFactor", [pbr.roughness_factor.0])[0],
            metallic_roughness_texture: self.read_texture(TextureSlot::MetallicRoughness),
            normal_texture: self.read_normal_texture(TextureSlot::Normal),
            emissive_texture: self.read_texture(TextureSlot::Emissive),
            alpha_mode: self.read_alpha_mode(),
            double_sided: json.double_sided,
            unlit: self.extension_object("KHR_materials_unlit").is_some(),
            ..Material::default()
        };
        material.emission.color = self.clamp_unit("emissiveFactor", json.emissive_factor.0);
        if let (Some(texture), Some(json)) =
            (self.read_texture(TextureSlot::Occlusion), &json.occlusion_texture)
        {
            let strength = self.clamp_unit("occlusionTexture/strength", [json.strength.0])[0];
            material.occlusion_texture = Some(OcclusionTexture { texture, strength });
        }
        self.read_extensions(&mut material);
        material.update_derived();
        material
    }

    /// Returns the object of an extension if the material has it.
    fn extension_object(&self, name: &str) -> Option<&'a Map<String, Value>> {
        let extensions = self.root.materials[self.at].extensions.as_ref()?;
        extensions.others.get(name)?.as_object()
    }

    /// Returns the JSON pointer to a member of the material.
    fn member_pointer(&self, member: &str) -> String {
        format!("/materials/{}/{member}", self.at)
    }

    /// Clamps factors to [0, 1], with a warning.
    fn clamp_unit<const N: usize>(&mut self, member: &str, factors: [f32; N]) -> [f32; N] {
        let mut inside = factors;
        self.clamp_numbers(member, &mut inside, [0.0, 1.0]);
        inside
    }

    /// Clamps numbers to bounds, with a warning. NaN becomes the minimum.
    ///
    /// The comparison is written so that it fails for NaN. The warning lists the numbers before and
    /// after the correction. A maximum of `f32::MAX` means no maximum.
    fn clamp_numbers(&mut self, member: &str, numbers: &mut [f32], [min, max]: [f32; 2]) {
        let given = numbers.to_vec();
        for number in &mut *numbers {
            *number = if *number > min { number.min(max) } else { min };
        }
        if given != numbers {
            let range = match max {
                f32::MAX => format!("{min} or more"),
                _ => format!("{min} to {max}"),
            };
            let text = |numbers: &[f32]| match numbers {
                [number] => number.to_string(),
                numbers => format!("{numbers:?}"),
            };
            let [given, used] = [text(&given), text(numbers)];
            let message = format!("{given} is out of range ({range}); {used} is used");
            self.warnings.push_warning(&self.member_pointer(member), message);
        }
    }

    /// Reads the alpha mode with its cutoff (0.5 by default). An unknown mode becomes opaque, with
    /// a warning.
    ///
    /// The cutoff is not clamped; with a cutoff above 1 nothing is visible, which is valid (glTF
    /// 2.0 §3.9.4).
    fn read_alpha_mode(&mut self) -> AlphaMode {
        let json = &self.root.materials[self.at];
        match json.alpha_mode {
            Checked::Valid(JsonAlphaMode::Opaque) => AlphaMode::Opaque,
            Checked::Valid(JsonAlphaMode::Blend) => AlphaMode::Blend,
            Checked::Valid(JsonAlphaMode::Mask) => {
                AlphaMode::Mask { cutoff: json.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0) }
            }
            Checked::Invalid => {
                let message = "the alpha mode must be OPAQUE, MASK or BLEND; OPAQUE is used";
                self.warnings.push_warning(&self.member_pointer("alphaMode"), message);
                AlphaMode::Opaque
            }
        }
    }

    /// Reads the extensions: first the records with their textures, then the numbers.
    ///
    /// The table of animatable properties lists each number of each extension with its bounds, so
    /// no number is handled by name here. If a value has the wrong type or length, the default
    /// stays in effect, with a warning.
    fn read_extensions(&mut self, material: &mut Material) {
        self.create_extensions(material);
        for PropertyRow { path, bounds, numbers_mut: numbers, .. } in &MATERIAL_PROPERTIES {
            let Some((name, member)) =
                path.strip_prefix("extensions/").and_then(|path| path.split_once('/'))
            else {
                continue;
            };
            // The scale of the clearcoat normal map is read with its texture.
            let json = self.extension_object(name).and_then(|extension| extension.get(member));
            let (Some(json), Some(numbers)) = (json, numbers(material)) else { continue };
            let given: Option<Vec<f32>> = match json {
                Value::Number(number) => number.as_f64().map(|x| vec![x as f32]),
                Value::Array(all) => all.iter().map(|x| x.as_f64().map(|x| x as f32)).collect(),
                _ => None,
            };
            match given.filter(|given| given.len() == numbers.len()) {
                Some(given) => {
                    numbers.copy_from_slice(&given);
                    self.clamp_numbers(path, numbers, *bounds);
                }
                None => {
                    let expected = match numbers.len() {
                        1 => "expected a number".to_owned(),
                        several => format!("expected {several} numbers"),
                    };
                    self.warnings.push_warning(
                        &self.member_pointer(path),
                        format!("{expected}; the default is used"),
                    );
                }
            }
        }
    }

    /// Creates the record of each extension that is present, with its textures and default numbers.
    ///
    /// A record exists if the extension's object exists, even if that is empty: for example,
    /// KHR_materials_clearcoat without members is a coating with factor 0. With specular-glossiness
    /// the base color factor is reset first, because the core factor belongs to the fallback.
    fn create_extensions(&mut self, material: &mut Material) {
        use TextureSlot as Slot;
        let extensions = &mut material.extensions;
        extensions.specular =
            self.extension_object("KHR_materials_specular").map(|_| Box::default());
        extensions.transmission =
            self.extension_object("KHR_materials_transmission").map(|_| Box::default());
        extensions.specular_glossiness =
            self.extension_object("KHR_materials_pbrSpecularGlossiness").map(|_| Box::default());
        extensions.clearcoat =
            self.extension_object("KHR_materials_clearcoat").map(|_| Box::default());
        extensions.sheen = self.extension_object("KHR_materials_sheen").map(|_| Box::default());
        extensions.volume = self.extension_object("KHR_materials_volume").map(|_| Box::default());
        extensions.iridescence =
            self.extension_object("KHR_materials_iridescence").map(|_| Box::default());
        extensions.anisotropy =
            self.extension_object("KHR_materials_anisotropy").map(|_| Box::default());
        if let Some(specular) = &mut extensions.specular {
            specular.texture = self.read_texture(Slot::Specular);
            specular.color_texture = self.read_texture(Slot::SpecularColor);
        }
        if let Some(spec_gloss) = &mut extensions.specular_glossiness {
            spec_gloss.texture = self.read_texture(Slot::SpecularGlossiness);
            (material.base_color, material.base_color_texture) =
                ([1.0; 4], self.read_texture(Slot::Diffuse));
        }
        if let Some(clearcoat) = &mut extensions.clearcoat {
            clearcoat.texture = self.read_texture(Slot::Clearcoat);
            clearcoat.roughness_texture = self.read_texture(Slot::ClearcoatRoughness);
            clearcoat.normal_texture = self.read_normal_texture(Slot::ClearcoatNormal);
        }
        if let Some(sheen) = &mut extensions.sheen {
            sheen.color_texture = self.read_texture(Slot::SheenColor);
            sheen.roughness_texture = self.read_texture(Slot::SheenRoughness);
        }
        if let Some(transmission) = &mut extensions.transmission {
            transmission.texture = self.read_texture(Slot::Transmission);
        }
        if let Some(volume) = &mut extensions.volume {
            volume.thickness_texture = self.read_texture(Slot::Thickness);
        }
        if let Some(iridescence) = &mut extensions.iridescence {
            iridescence.texture = self.read_texture(Slot::Iridescence);
            iridescence.thickness_texture = self.read_texture(Slot::IridescenceThickness);
        }
        if let Some(anisotropy) = &mut extensions.anisotropy {
            anisotropy.texture = self.read_texture(Slot::Anisotropy);
        }
    }

    /// Reads the normal map in a slot, with the scale of its x and y components.
    ///
    /// The scale may be negative, which inverts the relief. If it is not finite, it becomes 1.
    fn read_normal_texture(&mut self, slot: TextureSlot) -> Option<NormalTexture> {
        let texture = self.read_texture(slot)?;
        let scale = JsonTextureInfo::from_slot(self.root, self.at, slot)?.scale;
        let scale = if scale.is_finite() { scale } else { 1.0 };
        Some(NormalTexture { texture, scale })
    }

    /// Reads the texture in a slot. A reference to a missing texture causes a warning.
    ///
    /// The `texCoord` of KHR_texture_transform, if present, overrides the `texCoord` of the texture
    /// reference.
    fn read_texture(&mut self, slot: TextureSlot) -> Option<TextureInfo> {
        let JsonTextureInfo { texture, uv_set, transform, .. } =
            JsonTextureInfo::from_slot(self.root, self.at, slot)?;
        if texture >= self.root.textures.len() {
            let pointer = self.member_pointer(&format!("{}/index", slot.json_path()));
            let diagnostic = Diagnostic::unresolved_index(
                &pointer,
                "texture",
                texture,
                self.root.textures.len(),
            );
            self.warnings.downgrade(&diagnostic, "the surface is shown without it");
            return None;
        }
        let other_set = transform.and_then(|t| t.get("texCoord")).and_then(Value::as_u64);
        let transform = texture_transform(self.root, self.at, slot);
        Some(TextureInfo {
            texture,
            uv_set: other_set.map_or(uv_set, |set| set as usize),
            uv_matrix: transform
                .map_or(TextureInfo::IDENTITY_UV, |transform| transform.to_matrix()),
        })
    }
}

/// A texture reference as stored in the file.
struct JsonTextureInfo<'a> {
    /// Index of the texture, or `usize::MAX` if it is absent or negative.
    texture: usize,
    /// Texture coordinate set: `n` in `TEXCOORD_n`.
    uv_set: usize,
    /// Scale of a normal map's x and y components; 1 for other textures.
    scale: f32,
    /// The object of KHR_texture_transform.
    transform: Option<&'a Value>,
}

impl<'a> JsonTextureInfo<'a> {
    /// Returns the texture reference in a slot of a material. The texture may not exist.
    ///
    /// The `gltf` crate has different types for normal, occlusion and other textures, so each has a
    /// branch. Extensions are read from raw JSON at the slot's path.
    fn from_slot(root: &'a Root, material: usize, slot: TextureSlot) -> Option<Self> {
        let json = root.materials.get(material)?;
        let pbr = &json.pbr_metallic_roughness;
        let info = match slot {
            TextureSlot::BaseColor => pbr.base_color_texture.as_ref(),
            TextureSlot::MetallicRoughness => pbr.metallic_roughness_texture.as_ref(),
            TextureSlot::Emissive => json.emissive_texture.as_ref(),
            TextureSlot::Normal => {
                let json = json.normal_texture.as_ref()?;
                let (texture, uv_set) = (json.index.value(), json.tex_coord as usize);
                let extensions_json = json.extensions.as_ref().map(|extensions| &extensions.others);
                let transform = extensions_json
                    .and_then(|extensions_json| extensions_json.get(TEXTURE_TRANSFORM));
                return Some(Self { texture, uv_set, scale: json.scale, transform });
            }
            TextureSlot::Occlusion => {
                let json = json.occlusion_texture.as_ref()?;
                let (texture, uv_set) = (json.index.value(), json.tex_coord as usize);
                let extensions_json = json.extensions.as_ref().map(|extensions| &extensions.others);
                let transform = extensions_json
                    .and_then(|extensions_json| extensions_json.get(TEXTURE_TRANSFORM));
                return Some(Self { texture, uv_set, scale: 1.0, transform });
            }
            _ => return Self::from_extension(root, material, slot),
        };
        let info = info?;
        let extensions_json = info.extensions.as_ref().map(|extensions| &extensions.others);
        Some(Self {
            texture: info.index.value(),
            uv_set: info.tex_coord as usize,
            scale: 1.0,
            transform: extensions_json
                .and_then(|extensions_json| extensions_json.get(TEXTURE_TRANSFORM)),
        })
    }

    /// Returns the texture reference in a slot of an extension.
    ///
    /// A member that is not an object of the expected form becomes a reference to a missing
    /// texture, for which the caller adds a warning.
    fn from_extension(root: &'a Root, material: usize, slot: TextureSlot) -> Option<Self> {
        let (name, member) = slot.json_path().strip_prefix("extensions/")?.split_once('/')?;
        let json = root.materials[material].extensions.as_ref()?.others.get(name)?.get(member)?;
        let index = |name: &str| json.get(name).and_then(Value::as_u64).map(|at| at as usize);
        Some(Self {
            texture: index("index").unwrap_or(usize::MAX),
            uv_set: index("texCoord").unwrap_or(0),
            scale: json.get("scale").and_then(Value::as_f64).map_or(1.0, |scale| scale as f32),
            transform: json.get("extensions").and_then(|all| all.get(TEXTURE_TRANSFORM)),
        })
    }
}

/// The extension for affine transforms of texture coordinates, which may occur in any texture
/// reference.
const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";

/// Warns about primitives that lack the texture coordinates their material uses.
///
/// This runs once both materials and meshes are complete. Only the first missing set of a primitive
/// is reported. Primitives without items are skipped, because they are not drawn.
pub(super) fn warn_of_missing_texcoords(model: &Model, warnings: &mut ImportWarnings) {
    for (at, mesh) in model.meshes.iter().enumerate() {
        for (primitive_index, primitive) in mesh.primitives.iter().enumerate() {
            let material = primitive.material.map(|material| &model.materials[material]);
            let mut textures_used = material.into_iter().flat_map(Material::visible_textures);
            let missing = textures_used
                .find(|(_, textures_used)| textures_used.uv_set >= primitive.uvs.len());
            if let Some((_, TextureInfo { uv_set, .. })) =
                missing.filter(|_| primitive.item_count() > 0)
            {
                let message = format!(
                    "the primitive lacks TEXCOORD_{uv_set}, which a texture of its material needs; \
                     it is shown without that texture"
                );
                warnings
                    .push_warning(&format!("/meshes/{at}/primitives/{primitive_index}"), message);
            }
        }
    }
}

/// Returns an array of exactly `N` numbers, rounded to single precision, or `None` for any other
/// value.
fn float_array<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let numbers: Option<Vec<f32>> =
        value.as_array()?.iter().map(|item| item.as_f64().map(|x| x as f32)).collect();
    numbers?.try_into().ok()
}
