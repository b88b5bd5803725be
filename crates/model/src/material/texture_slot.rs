//! All places of a material that can have a texture, by name.

use crate::{Material, TextureInfo};

/// A place of a material that can have a texture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum TextureSlot {
    /// The base colour.
    BaseColor,
    /// Metalness and roughness.
    MetallicRoughness,
    /// Slopes of the surface.
    Normal,
    /// Ambient light that arrives.
    Occlusion,
    /// Light that is given off.
    Emissive,
    /// The strength of highlights.
    Specular,
    /// The colour of highlights.
    SpecularColor,
    /// The diffuse colour of the older model, which is the base colour.
    Diffuse,
    /// Reflection and gloss of the older model.
    SpecularGlossiness,
    /// The share of the clear layer.
    Clearcoat,
    /// The roughness of the clear layer.
    ClearcoatRoughness,
    /// The slopes of the clear layer.
    ClearcoatNormal,
    /// The colour of fibres.
    SheenColor,
    /// The roughness of fibres.
    SheenRoughness,
    /// The share of light that passes.
    Transmission,
    /// The thickness of the body.
    Thickness,
    /// The share of the thin film.
    Iridescence,
    /// The thickness of the thin film.
    IridescenceThickness,
    /// The direction and strength of long highlights.
    Anisotropy,
}

impl TextureSlot {
    /// Every slot, each with its place in a glTF material: a JSON pointer without the first slash.
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

    /// Whether the texture's red, green and blue are sRGB codes; alpha never is, nor are numbers that are no colours.
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

    /// Its place in a glTF material: a JSON pointer without the first slash.
    #[must_use]
    pub fn json_path(self) -> &'static str {
        Self::PATHS.iter().find(|(slot, _)| *slot == self).map_or("", |(_, path)| path)
    }
}

impl Material {
    /// All textures of the material, each with its slot.
    pub fn all_textures(&self) -> impl Iterator<Item = (TextureSlot, TextureInfo)> {
        let mut copy = self.clone();
        let slots = TextureSlot::PATHS.iter().map(|(slot, _)| *slot);
        slots.filter_map(move |slot| Some((slot, *copy.texture_mut(slot)?)))
    }

    /// The textures that the surface shows, each with its slot: their images are decoded. Without light there is only the base
    /// colour to see, and where a body has no depth, its depth is not.
    pub fn visible_textures(&self) -> impl Iterator<Item = (TextureSlot, TextureInfo)> {
        let unlit = self.unlit;
        self.all_textures().filter(move |(slot, _)| match slot {
            TextureSlot::BaseColor | TextureSlot::Diffuse => true,
            _ => !unlit,
        })
    }

    /// The texture in a slot.
    pub fn texture_mut(&mut self, slot: TextureSlot) -> Option<&mut TextureInfo> {
        let more = &mut self.extensions;
        // The diffuse texture of the older model stands in the place of the base colour's.
        let older = more.specular_glossiness.is_some();
        match slot {
            TextureSlot::BaseColor => self.base_color_texture.as_mut().filter(|_| !older),
            TextureSlot::Diffuse => self.base_color_texture.as_mut().filter(|_| older),
            TextureSlot::MetallicRoughness => self.metallic_roughness_texture.as_mut(),
            TextureSlot::Normal => self.normal_texture.as_mut().map(|normal| &mut normal.texture),
            TextureSlot::Occlusion => self.occlusion_texture.as_mut().map(|used| &mut used.texture),
            TextureSlot::Emissive => self.emissive_texture.as_mut(),
            TextureSlot::Specular => more.specular.as_mut()?.texture.as_mut(),
            TextureSlot::SpecularColor => more.specular.as_mut()?.color_texture.as_mut(),
            TextureSlot::SpecularGlossiness => more.specular_glossiness.as_mut()?.texture.as_mut(),
            TextureSlot::Clearcoat => more.clearcoat.as_mut()?.texture.as_mut(),
            TextureSlot::ClearcoatRoughness => more.clearcoat.as_mut()?.roughness_texture.as_mut(),
            TextureSlot::ClearcoatNormal => {
                let normal = more.clearcoat.as_mut()?.normal_texture.as_mut();
                normal.map(|normal| &mut normal.texture)
            }
            TextureSlot::SheenColor => more.sheen.as_mut()?.color_texture.as_mut(),
            TextureSlot::SheenRoughness => more.sheen.as_mut()?.roughness_texture.as_mut(),
            TextureSlot::Transmission => more.transmission.as_mut()?.texture.as_mut(),
            TextureSlot::Thickness => more.volume.as_mut()?.thickness_texture.as_mut(),
            TextureSlot::Iridescence => more.iridescence.as_mut()?.texture.as_mut(),
            TextureSlot::IridescenceThickness => {
                more.iridescence.as_mut()?.thickness_texture.as_mut()
            }
            TextureSlot::Anisotropy => more.anisotropy.as_mut()?.texture.as_mut(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_stand_in_the_order_of_their_table() {
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
