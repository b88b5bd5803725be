//! Materials: factors and textures, those of the KHR_materials extensions among them.
//!
//! The numbers of extensions are found by the table of [`Field`](crate::Field)s, which says where they stand and
//! within which bounds they must be; textures by the table of [`TextureSlot`]s.

use super::error::Fault;
use super::warnings::Warnings;
use crate::{
    AlphaMode, Material, Model, NormalTexture, OcclusionTexture, TextureSlot, TextureUse,
    UvTransform,
};
use crate::{MATERIAL, Row};
use gltf::json::Root;
use gltf::json::material::AlphaMode as JsonAlphaMode;
use gltf::json::validation::Checked;
use serde_json::{Map, Value};

/// Reads all materials of a file. What is wrong with one is a warning.
pub(super) fn materials(root: &Root, warnings: &mut Warnings) -> Vec<Material> {
    (0..root.materials.len())
        .map(|at| Reader { root, at, warnings: &mut *warnings }.material())
        .collect()
}

/// The transform of a texture as the file gives it (KHR_texture_transform); `None` if it gives none.
pub(super) fn uv_transform(root: &Root, material: usize, slot: TextureSlot) -> Option<UvTransform> {
    let json = Info::of(root, material, slot)?.transform?;
    let rotation = json.get("rotation").and_then(Value::as_f64).unwrap_or(0.0);
    Some(UvTransform {
        material,
        slot,
        offset: json.get("offset").and_then(floats).unwrap_or([0.0; 2]),
        rotation: rotation as f32,
        scale: json.get("scale").and_then(floats).unwrap_or([1.0; 2]),
    })
}

struct Reader<'a, 'w> {
    root: &'a Root,
    at: usize,
    warnings: &'w mut Warnings,
}

impl<'a> Reader<'a, '_> {
    fn material(mut self) -> Material {
        let json = &self.root.materials[self.at];
        let pbr = &json.pbr_metallic_roughness;
        let mut material = Material {
            name: json.name.clone(),
            base_color: self.unit("pbrMetallicRoughness/baseColorFactor", pbr.base_color_factor.0),
            base_color_texture: self.texture(TextureSlot::BaseColor),
            metallic: self.unit("pbrMetallicRoughness/metallicFactor", [pbr.metallic_factor.0])[0],
            roughness: self.unit("pbrMetallicRoughness/roughnessFactor", [pbr.roughness_factor.0])
                [0],
            metallic_roughness_texture: self.texture(TextureSlot::MetallicRoughness),
            normal_texture: self.normal_texture(TextureSlot::Normal),
            emissive_texture: self.texture(TextureSlot::Emissive),
            alpha_mode: self.alpha_mode(),
            double_sided: json.double_sided,
            unlit: self.extension("KHR_materials_unlit").is_some(),
            ..Material::default()
        };
        material.emission.color = self.unit("emissiveFactor", json.emissive_factor.0);
        if let (Some(texture), Some(json)) =
            (self.texture(TextureSlot::Occlusion), &json.occlusion_texture)
        {
            let strength = self.unit("occlusionTexture/strength", [json.strength.0])[0];
            material.occlusion_texture = Some(OcclusionTexture { texture, strength });
        }
        self.extensions(&mut material);
        material.settle();
        material
    }

    fn extension(&self, name: &str) -> Option<&'a Map<String, Value>> {
        let extensions = self.root.materials[self.at].extensions.as_ref()?;
        extensions.others.get(name)?.as_object()
    }

    fn pointer(&self, member: &str) -> String {
        format!("/materials/{}/{member}", self.at)
    }

    /// Factors brought into [0, 1], where the specification wants them.
    fn unit<const N: usize>(&mut self, member: &str, factors: [f32; N]) -> [f32; N] {
        let mut inside = factors;
        self.bound(member, &mut inside, [0.0, 1.0]);
        inside
    }

    /// Brings numbers within bounds, with a warning; what is no number becomes the least.
    fn bound(&mut self, member: &str, numbers: &mut [f32], [least, greatest]: [f32; 2]) {
        let said = numbers.to_vec();
        for number in &mut *numbers {
            *number = if *number > least { number.min(greatest) } else { least };
        }
        if said != numbers {
            let range = match greatest {
                f32::MAX => format!("not at least {least}"),
                _ => format!("not in [{least}, {greatest}]"),
            };
            let message = format!("{said:?} is {range}; it is {numbers:?}");
            self.warnings.add(&self.pointer(member), message);
        }
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

    /// What the extensions add: first the records with their textures, then the numbers.
    fn extensions(&mut self, material: &mut Material) {
        self.records(material);
        for Row { path, bounds, numbers, .. } in &MATERIAL {
            let Some((name, member)) =
                path.strip_prefix("extensions/").and_then(|path| path.split_once('/'))
            else {
                continue;
            };
            // The scale of the coat's normals is read with their texture.
            let json = self.extension(name).and_then(|extension| extension.get(member));
            let (Some(json), Some(numbers)) = (json, numbers(material)) else { continue };
            let said: Option<Vec<f32>> = match json {
                Value::Number(number) => number.as_f64().map(|x| vec![x as f32]),
                Value::Array(all) => all.iter().map(|x| x.as_f64().map(|x| x as f32)).collect(),
                _ => None,
            };
            match said.filter(|said| said.len() == numbers.len()) {
                Some(said) => {
                    numbers.copy_from_slice(&said);
                    self.bound(path, numbers, *bounds);
                }
                None => {
                    let due = match numbers.len() {
                        1 => "a number is due".to_owned(),
                        several => format!("{several} numbers are due"),
                    };
                    self.warnings.add(&self.pointer(path), format!("{due}; the usual is used"));
                }
            }
        }
    }

    fn records(&mut self, material: &mut Material) {
        use TextureSlot as Slot;
        let more = &mut material.extensions;
        more.specular = self.extension("KHR_materials_specular").map(|_| Box::default());
        more.transmission = self.extension("KHR_materials_transmission").map(|_| Box::default());
        more.specular_glossiness =
            self.extension("KHR_materials_pbrSpecularGlossiness").map(|_| Box::default());
        more.clearcoat = self.extension("KHR_materials_clearcoat").map(|_| Box::default());
        more.sheen = self.extension("KHR_materials_sheen").map(|_| Box::default());
        more.volume = self.extension("KHR_materials_volume").map(|_| Box::default());
        more.iridescence = self.extension("KHR_materials_iridescence").map(|_| Box::default());
        more.anisotropy = self.extension("KHR_materials_anisotropy").map(|_| Box::default());
        if let Some(specular) = &mut more.specular {
            specular.texture = self.texture(Slot::Specular);
            specular.color_texture = self.texture(Slot::SpecularColor);
        }
        if let Some(older) = &mut more.specular_glossiness {
            older.texture = self.texture(Slot::SpecularGlossiness);
            (material.base_color, material.base_color_texture) =
                ([1.0; 4], self.texture(Slot::Diffuse));
        }
        if let Some(coat) = &mut more.clearcoat {
            coat.texture = self.texture(Slot::Clearcoat);
            coat.roughness_texture = self.texture(Slot::ClearcoatRoughness);
            coat.normal_texture = self.normal_texture(Slot::ClearcoatNormal);
        }
        if let Some(sheen) = &mut more.sheen {
            sheen.color_texture = self.texture(Slot::SheenColor);
            sheen.roughness_texture = self.texture(Slot::SheenRoughness);
        }
        if let Some(transmission) = &mut more.transmission {
            transmission.texture = self.texture(Slot::Transmission);
        }
        if let Some(volume) = &mut more.volume {
            volume.thickness_texture = self.texture(Slot::Thickness);
        }
        if let Some(film) = &mut more.iridescence {
            film.texture = self.texture(Slot::Iridescence);
            film.thickness_texture = self.texture(Slot::IridescenceThickness);
        }
        if let Some(anisotropy) = &mut more.anisotropy {
            anisotropy.texture = self.texture(Slot::Anisotropy);
        }
    }

    fn normal_texture(&mut self, slot: TextureSlot) -> Option<NormalTexture> {
        let texture = self.texture(slot)?;
        let scale = Info::of(self.root, self.at, slot)?.scale;
        let scale = if scale.is_finite() { scale } else { 1.0 };
        Some(NormalTexture { texture, scale })
    }

    fn texture(&mut self, slot: TextureSlot) -> Option<TextureUse> {
        let Info { texture, uv_set, transform, .. } = Info::of(self.root, self.at, slot)?;
        if texture >= self.root.textures.len() {
            let pointer = self.pointer(&format!("{}/index", slot.path()));
            let fault = Fault::unresolved(&pointer, "texture", texture, self.root.textures.len());
            self.warnings.soft(&fault, "the surface is shown without it");
            return None;
        }
        let other_set = transform.and_then(|t| t.get("texCoord")).and_then(Value::as_u64);
        let transform = uv_transform(self.root, self.at, slot);
        Some(TextureUse {
            texture,
            uv_set: other_set.map_or(uv_set, |set| set as usize),
            uv_map: transform.map_or(TextureUse::KEEP_UV, |transform| transform.map()),
        })
    }
}

/// A texture as the file names it.
struct Info<'a> {
    texture: usize,
    uv_set: usize,
    /// The scale of normals.
    scale: f32,
    transform: Option<&'a Value>,
}

impl<'a> Info<'a> {
    /// The texture in a slot of a material; its number may be that of no texture.
    fn of(root: &'a Root, material: usize, slot: TextureSlot) -> Option<Self> {
        let json = root.materials.get(material)?;
        let pbr = &json.pbr_metallic_roughness;
        let info = match slot {
            TextureSlot::BaseColor => pbr.base_color_texture.as_ref(),
            TextureSlot::MetallicRoughness => pbr.metallic_roughness_texture.as_ref(),
            TextureSlot::Emissive => json.emissive_texture.as_ref(),
            TextureSlot::Normal => {
                let json = json.normal_texture.as_ref()?;
                let (texture, uv_set) = (json.index.value(), json.tex_coord as usize);
                let others = json.extensions.as_ref().map(|extensions| &extensions.others);
                let transform = others.and_then(|others| others.get(TRANSFORM));
                return Some(Self { texture, uv_set, scale: json.scale, transform });
            }
            TextureSlot::Occlusion => {
                let json = json.occlusion_texture.as_ref()?;
                let (texture, uv_set) = (json.index.value(), json.tex_coord as usize);
                let others = json.extensions.as_ref().map(|extensions| &extensions.others);
                let transform = others.and_then(|others| others.get(TRANSFORM));
                return Some(Self { texture, uv_set, scale: 1.0, transform });
            }
            _ => return Self::of_extension(root, material, slot),
        };
        let info = info?;
        let others = info.extensions.as_ref().map(|extensions| &extensions.others);
        Some(Self {
            texture: info.index.value(),
            uv_set: info.tex_coord as usize,
            scale: 1.0,
            transform: others.and_then(|others| others.get(TRANSFORM)),
        })
    }

    fn of_extension(root: &'a Root, material: usize, slot: TextureSlot) -> Option<Self> {
        let (name, member) = slot.path().strip_prefix("extensions/")?.split_once('/')?;
        let json = root.materials[material].extensions.as_ref()?.others.get(name)?.get(member)?;
        let index = |name: &str| json.get(name).and_then(Value::as_u64).map(|at| at as usize);
        Some(Self {
            texture: index("index").unwrap_or(usize::MAX),
            uv_set: index("texCoord").unwrap_or(0),
            scale: json.get("scale").and_then(Value::as_f64).map_or(1.0, |scale| scale as f32),
            transform: json.get("extensions").and_then(|all| all.get(TRANSFORM)),
        })
    }
}

const TRANSFORM: &str = "KHR_texture_transform";

/// Warns of primitives that lack the texture coordinates their material asks for.
pub(super) fn warn_of_missing_texcoords(model: &Model, warnings: &mut Warnings) {
    for (at, mesh) in model.meshes.iter().enumerate() {
        for (part, primitive) in mesh.primitives.iter().enumerate() {
            let material = primitive.material.map(|material| &model.materials[material]);
            let mut used = material.into_iter().flat_map(Material::textures);
            let missing = used.find(|(_, used)| used.uv_set >= primitive.uvs.len());
            if let Some((_, TextureUse { uv_set, .. })) = missing.filter(|_| primitive.count() > 0)
            {
                let message = format!("its texture needs TEXCOORD_{uv_set}; it is shown without");
                warnings.add(&format!("/meshes/{at}/primitives/{part}"), message);
            }
        }
    }
}

fn floats<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let numbers: Option<Vec<f32>> =
        value.as_array()?.iter().map(|item| item.as_f64().map(|x| x as f32)).collect();
    numbers?.try_into().ok()
}
