//! Texture slots: the material properties that can have a texture.

use crate::{Material, TextureInfo};

/// A material property that can have a texture.
///
/// The channels are documented with the fields of [`Material`] and its extensions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum TextureSlot {
    /// Base color.
    BaseColor,
    /// Metalness and roughness.
    MetallicRoughness,
    /// Normal map.
    Normal,
    /// Ambient occlusion.
    Occlusion,
    /// Emitted light.
    Emissive,
    /// Strength of the specular reflection.
    Specular,
    /// Color of the specular reflection.
    SpecularColor,
    /// Diffuse color of the specular-glossiness workflow, stored as the base color.
    Diffuse,
    /// Specular color and glossiness of the specular-glossiness workflow.
    SpecularGlossiness,
    /// Strength of the clearcoat.
    Clearcoat,
    /// Roughness of the clearcoat.
    ClearcoatRoughness,
    /// Normal map of the clearcoat.
    ClearcoatNormal,
    /// Color of the sheen.
    SheenColor,
    /// Roughness of the sheen.
    SheenRoughness,
    /// Fraction of transmitted light.
    Transmission,
    /// Thickness of the volume.
    Thickness,
    /// Strength of the thin film.
    Iridescence,
    /// Thickness of the thin film.
    IridescenceThickness,
    /// Direction and strength of the anisotropy.
    Anisotropy,
}

impl TextureSlot {
    /// Every slot with its location in a glTF material: a JSON pointer without the leading slash.
    ///
    /// To add a KHR_materials extension, see "How to add" in ARCHITECTURE.md.
    /// KHR_animation_pointer also uses these pointers for texture transforms.
    pub const PATHS: [(Self, &'static str); 19] = [
        (Self::BaseColor, "pbrMetallicRoughness/baseColorTexture"),
        (Self::MetallicRoughness, "pbrMetallicRoughness/metallicRoughnessTexture"),
        (Self::Normal, "normalTexture"),
        (Self::Occlusion, "occlusionTexture"),
        (Self::Emissive, "emissiveTexture"),
        (Self::Specular, "extensions/KHR_materials_specular/specularTexture"),
        (Self::SpecularColor, "extensions/KHR_materials_specular/specularColorTexture"),
        (Self::Diffuse, "extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture"),
        (
            Self::SpecularGlossiness,
            "extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
        ),
        (Self::Clearcoat, "extensions/KHR_materials_clearcoat/clearcoatTexture"),
        (Self::ClearcoatRoughness, "extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture"),
        (Self::ClearcoatNormal, "extensions/KHR_materials_clearcoat/clearcoatNormalTexture"),
        (Self::SheenColor, "extensions/KHR_materials_sheen/sheenColorTexture"),
        (Self::SheenRoughness, "extensions/KHR_materials_sheen/sheenRoughnessTexture"),
        (Self::Transmission, "extensions/KHR_materials_transmission/transmissionTexture"),
        (Self::Thickness, "extensions/KHR_materials_volume/thicknessTexture"),
        (Self::Iridescence, "extensions/KHR_materials_iridescence/iridescenceTexture"),
        (
            Self::IridescenceThickness,
            "extensions/KHR_materials_iridescence/iridescenceThicknessTexture",
        ),
        (Self::Anisotropy, "extensions/KHR_materials_anisotropy/anisotropyTexture"),
    ];

    /// Returns whether red, green and blue of the texture are sRGB encoded. Alpha never is.
    #[must_use]
    pub const fn is_srgb(self) -> bool {
        matches!(
            self,
            Self::BaseColor
                | Self::Emissive
                | Self::SpecularColor
                | Self::Diffuse
                | Self::SpecularGlossiness
                | Self::SheenColor
        )
    }

    /// Returns the slot's location in a glTF material: a JSON pointer without the leading slash.
    #[must_use]
    pub fn json_path(self) -> &'static str {
        Self::PATHS.iter().find(|(slot, _)| *slot == self).map_or("", |(_, path)| path)
    }
}

impl Material {
    /// Returns all textures of the material, each with its slot.
    pub fn all_textures(&self) -> impl Iterator<Item = (TextureSlot, TextureInfo)> {
        let mut copy = self.clone();
        let slots = TextureSlot::PATHS.iter().map(|(slot, _)| *slot);
        slots.filter_map(move |slot| Some((slot, *copy.texture_mut(slot)?)))
    }

    /// Returns the textures that affect the picture, each with its slot; only their images are
    /// decoded. An unlit material shows only its base color.
    pub fn visible_textures(&self) -> impl Iterator<Item = (TextureSlot, TextureInfo)> {
        let unlit = self.unlit;
        self.all_textures().filter(move |(slot, _)| match slot {
            TextureSlot::BaseColor | TextureSlot::Diffuse => true,
            _ => !unlit,
        })
    }

    /// Returns mutable access to the texture in a slot.
    ///
    /// Returns `None` if the slot is empty or its extension is absent.
    pub fn texture_mut(&mut self, slot: TextureSlot) -> Option<&mut TextureInfo> {
        let extensions = &mut self.extensions;
        // The specular-glossiness workflow stores its diffuse texture as the base color texture.
        let is_spec_gloss = extensions.specular_glossiness.is_some();
        match slot {
            TextureSlot::BaseColor => self.base_color_texture.as_mut().filter(|_| !is_spec_gloss),
            TextureSlot::Diffuse => self.base_color_texture.as_mut().filter(|_| is_spec_gloss),
            TextureSlot::MetallicRoughness => self.metallic_roughness_texture.as_mut(),
            TextureSlot::Normal => self.normal_texture.as_mut().map(|normal| &mut normal.texture),
            TextureSlot::Occlusion => self.occlusion_texture.as_mut().map(|used| &mut used.texture),
            TextureSlot::Emissive => self.emissive_texture.as_mut(),
            TextureSlot::Specular => extensions.specular.as_mut()?.texture.as_mut(),
            TextureSlot::SpecularColor => extensions.specular.as_mut()?.color_texture.as_mut(),
            TextureSlot::SpecularGlossiness => {
                extensions.specular_glossiness.as_mut()?.texture.as_mut()
            }
            TextureSlot::Clearcoat => extensions.clearcoat.as_mut()?.texture.as_mut(),
            TextureSlot::ClearcoatRoughness => {
                extensions.clearcoat.as_mut()?.roughness_texture.as_mut()
            }
            TextureSlot::ClearcoatNormal => {
                let normal = extensions.clearcoat.as_mut()?.normal_texture.as_mut();
                normal.map(|normal| &mut normal.texture)
            }
            TextureSlot::SheenColor => extensions.sheen.as_mut()?.color_texture.as_mut(),
            TextureSlot::SheenRoughness => extensions.sheen.as_mut()?.roughness_texture.as_mut(),
            TextureSlot::Transmission => extensions.transmission.as_mut()?.texture.as_mut(),
            TextureSlot::Thickness => extensions.volume.as_mut()?.thickness_texture.as_mut(),
            TextureSlot::Iridescence => extensions.iridescence.as_mut()?.texture.as_mut(),
            TextureSlot::IridescenceThickness => {
                extensions.iridescence.as_mut()?.thickness_texture.as_mut()
            }
            TextureSlot::Anisotropy => extensions.anisotropy.as_mut()?.texture.as_mut(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_are_in_table_order() {
        assert!(TextureSlot::PATHS.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(TextureSlot::Normal.json_path(), "normalTexture");
    }

    #[test]
    fn a_material_lists_its_textures() {
        let used =
            |texture| TextureInfo { texture, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
        let mut material = Material { base_color_texture: Some(used(3)), ..Material::default() };
        assert_eq!(
            material.all_textures().collect::<Vec<_>>(),
            [(TextureSlot::BaseColor, used(3))]
        );
        material.extensions.specular_glossiness = Some(Box::default());
        assert_eq!(material.all_textures().collect::<Vec<_>>(), [(TextureSlot::Diffuse, used(3))]);
    }
}
