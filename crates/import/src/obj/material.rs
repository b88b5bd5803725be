//! Converts materials from MTL libraries to metallic-roughness materials.
//!
//! | MTL | material |
//! | --- | --- |
//! | `Kd`, `Ke` | base color, emission; sRGB decoded; emission above 1 becomes color and strength |
//! | `Ns` | α² = 2 / (Ns + 2) |
//! | `Ks` | reflectance 0.08 Ks at normal incidence; none for 0 |
//! | `Kd` below 0.04, `Ks` above | a metal with the color `Ks` |
//! | `illum` 0, 1 | 0: unlit; 1: matte without reflections |
//! | `d`, else 1 − `Tr` | alpha |
//! | `Ni` | index of refraction, for the reflectance of metallic-roughness materials |
//! | `Pr`, `Pm`, `Ps`, `Pc`, `Pcr`, `aniso`, `anisor` | used unchanged, instead of `Ns` and `Ks` |
//!
//! Black `Kd` and `Ke` become white if a texture multiplies them.
//!
//! Files do not specify how colors are encoded. Users picked them on screens, and the programs of
//! the time displayed them without conversion, so they are treated as sRGB.
//!
//! `Ns` is the exponent of Blinn's distribution of half vectors. The Beckmann and GGX distributions
//! with α² = 2 / (Ns + 2) approximate it (B. Walter et al., *Microfacet Models for Refraction
//! through Rough Surfaces*, 2007, §5.2); the roughness is √α. The reflectance follows Blender,
//! whose exporter writes `Ks` 0.5 for the 4% reflectance of most dielectrics.

use super::mtl::MtlMaterial;
use super::phong::{PhongMaterial, color_beside_texture, double_sided_matte, linear_color};
use super::scene::to_name;
use super::textures::TextureTable;
use gltf_import::ImportWarnings;
use model::{AlphaMode, Anisotropy, Clearcoat, Emission, Material, NormalTexture, Sheen};

/// Converts a material from a library. The textures it needs are added to the table.
pub(super) fn to_material<'a>(
    mtl: &MtlMaterial<'a>,
    textures: &mut TextureTable<'a>,
    warnings: &mut ImportWarnings,
) -> Material {
    let phong = mtl.phong();
    let mut material = Material {
        name: to_name(mtl.name),
        base_color: phong.base_color(),
        ..double_sided_matte()
    };
    set_emission(&mut material, mtl);
    let has_pbr_keys = ["Pr", "Pm"].into_iter().any(|key| mtl.numbers.contains_key(key));
    if has_pbr_keys || mtl.has_texture("map_Pr") || mtl.has_texture("map_Pm") {
        set_metallic_roughness(&mut material, mtl);
    } else {
        phong.set_reflection(&mut material);
    }
    set_layers(&mut material, mtl);
    set_alpha_mode(&mut material, mtl, warnings);
    set_textures(&mut material, mtl, textures);
    material
}

/// Sets the emission. A color above 1 is split into a color of at most 1 and a strength.
fn set_emission(material: &mut Material, mtl: &MtlMaterial<'_>) {
    let color = color_beside_texture(mtl.emission, mtl.has_texture("map_Ke"), [0.0; 3]);
    let strength = color.into_iter().fold(1.0, f32::max);
    let color = linear_color(color.map(|channel| channel / strength));
    material.emission = Emission { color, strength };
    material.emissive = material.emission.scaled_color();
}

/// Applies the keys of metallic-roughness materials. With a texture, a missing factor is 1.
fn set_metallic_roughness(material: &mut Material, mtl: &MtlMaterial<'_>) {
    let factor = |key: &str, map: &str, default: f32| {
        mtl.unit_number(key).unwrap_or(if mtl.has_texture(map) { 1.0 } else { default })
    };
    material.roughness = factor("Pr", "map_Pr", 0.5);
    material.metallic = factor("Pm", "map_Pm", 0.0);
    if let Some(ior) = mtl.number("Ni").filter(|ior| *ior >= 1.0) {
        material.extensions.ior = ior;
    }
}

/// Applies sheen, clearcoat and anisotropy.
fn set_layers(material: &mut Material, mtl: &MtlMaterial<'_>) {
    if let Some(sheen) = mtl.unit_number("Ps").filter(|sheen| *sheen > 0.0) {
        let layer = Sheen { color: [sheen; 3], roughness: 0.5, ..Sheen::default() };
        material.extensions.sheen = Some(Box::new(layer));
    }
    if let Some(factor) = mtl.unit_number("Pc").filter(|factor| *factor > 0.0) {
        let roughness = mtl.unit_number("Pcr").unwrap_or(0.0);
        let layer = Clearcoat { factor, roughness, ..Clearcoat::default() };
        material.extensions.clearcoat = Some(Box::new(layer));
    }
    if let Some(strength) = mtl.unit_number("aniso").filter(|strength| *strength > 0.0) {
        let turns = mtl.number("anisor").unwrap_or(0.0);
        let rotation = turns * std::f32::consts::TAU;
        let layer = Anisotropy { strength, rotation, texture: None };
        material.extensions.anisotropy = Some(Box::new(layer));
    }
}

/// Enables blending for translucent materials, and warns about invisible materials.
fn set_alpha_mode(material: &mut Material, mtl: &MtlMaterial<'_>, warnings: &mut ImportWarnings) {
    let name = String::from_utf8_lossy(mtl.name);
    if material.base_color[3] == 0.0 {
        warnings.push_warning("", format!("the material {name:?} is invisible: `d` is 0"));
    } else if mtl.phong().is_invisible_by_transparency() {
        let message = format!("the material {name:?} has `Tr` 1 and no `d`: it is shown opaque");
        warnings.push_warning("", message);
    }
    if material.base_color[3] < 1.0 || mtl.has_texture("map_d") {
        material.alpha_mode = AlphaMode::Blend;
    }
}

/// Adds the textures of the material.
fn set_textures<'a>(
    material: &mut Material,
    mtl: &MtlMaterial<'a>,
    textures: &mut TextureTable<'a>,
) {
    let of = |key: &str| mtl.textures.get(key);
    material.base_color_texture = textures.base_color(of("map_Kd"), of("map_d"));
    material.metallic_roughness_texture = textures.metallic_roughness(of("map_Pr"), of("map_Pm"));
    material.emissive_texture = of("map_Ke").map(|texture| textures.use_file(texture));
    let normal = of("norm").map(|texture| (texture, textures.use_file(texture)));
    let normal = normal.or_else(|| {
        let texture = of("bump")?;
        Some((texture, textures.use_bump_map(texture)))
    });
    material.normal_texture =
        normal.map(|(mtl, texture)| NormalTexture { texture, scale: mtl.bump });
}

impl MtlMaterial<'_> {
    /// Returns the number for a keyword.
    fn number(&self, key: &str) -> Option<f32> {
        self.numbers.get(key).copied()
    }

    /// Returns the number for a keyword, clamped to [0, 1].
    fn unit_number(&self, key: &str) -> Option<f32> {
        self.number(key).map(|number| number.clamp(0.0, 1.0))
    }

    /// Returns the keys of Phong shading.
    fn phong(&self) -> PhongMaterial {
        PhongMaterial {
            diffuse: self.diffuse,
            specular: self.specular,
            exponent: self.number("Ns"),
            illumination: self.number("illum"),
            dissolve: self.number("d"),
            transparency: self.number("Tr"),
            has_texture: self.has_texture("map_Kd"),
        }
    }

    /// Returns whether the material has a texture for this keyword.
    fn has_texture(&self, key: &str) -> bool {
        self.textures.contains_key(key)
    }
}
