//! Materials of MTL libraries in terms of metallic-roughness shading.
//!
//! | MTL | material |
//! | --- | --- |
//! | `Kd`, `Ke` | base color and emission, sRGB decoded; above 1 an emission has a strength |
//! | `Ns` | α² = 2 / (Ns + 2) |
//! | `Ks` | reflectance at normal incidence 0.08 Ks; nothing for 0 |
//! | `Kd` below 0.04, `Ks` not | a metal of the color `Ks` |
//! | `illum` 0, 1 | unlit; matte and without reflections |
//! | `d`, else 1 − `Tr` | alpha |
//! | `Ni` | index of refraction, for the reflectance of metallic-roughness materials |
//! | `Pr`, `Pm`, `Ps`, `Pc`, `Pcr`, `aniso`, `anisor` | as they are; `Ns`, `Ks` do not count then |
//!
//! Beside a texture, which they multiply, black `Kd` and `Ke` are taken as white.
//!
//! Files do not say how colors are encoded. They are picked on screens and shown unconverted by the
//! programs of their time, so that they are sRGB.
//!
//! `Ns` is the exponent of Blinn's distribution of half vectors, which Beckmann's and GGX's of
//! α² = 2 / (Ns + 2) come close to (B. Walter et al., *Microfacet Models for Refraction through
//! Rough Surfaces*, 2007, §5.2); the roughness is √α. The reflectance follows Blender, whose
//! exporter writes `Ks` 0.5 for the 4 % of most dielectrics.

use super::mtl::MtlMaterial;
use super::scene::to_name;
use super::textures::TextureTable;
use crate::import::srgb::linear_from_srgb;
use crate::import::warnings::ImportWarnings;
use crate::material::{Anisotropy, Clearcoat, Emission, Sheen, Specular};
use crate::{AlphaMode, Material, NormalTexture};

/// Diffuse color, sRGB encoded, where a library gives none.
const PLAIN_COLOR: [f32; 3] = [0.8; 3];
/// The largest diffuse color of a metal, and the least specular one.
const METAL_THRESHOLD: f32 = 0.04;

/// A material of a library. Textures that it needs are entered in the table.
pub(super) fn to_material<'a>(
    mtl: &MtlMaterial<'a>,
    textures: &mut TextureTable<'a>,
    warnings: &mut ImportWarnings,
) -> Material {
    let mut material = Material {
        name: to_name(mtl.name),
        double_sided: true,
        metallic: 0.0,
        roughness: 1.0,
        ..Material::plain()
    };
    let color = mtl.color_beside_texture(mtl.diffuse, "map_Kd", PLAIN_COLOR);
    let [r, g, b] = linear_color(color);
    material.base_color = [r, g, b, 1.0];
    set_emission(&mut material, mtl);
    let has_pbr_keys = ["Pr", "Pm"].into_iter().any(|key| mtl.numbers.contains_key(key));
    if has_pbr_keys || mtl.has_texture("map_Pr") || mtl.has_texture("map_Pm") {
        set_metallic_roughness(&mut material, mtl);
    } else {
        set_phong(&mut material, mtl);
    }
    set_layers(&mut material, mtl);
    set_alpha(&mut material, mtl, warnings);
    set_textures(&mut material, mtl, textures);
    material
}

/// Emission; a color above 1 is one of at most 1 with a strength.
fn set_emission(material: &mut Material, mtl: &MtlMaterial<'_>) {
    let color = mtl.color_beside_texture(mtl.emission, "map_Ke", [0.0; 3]);
    let strength = color.into_iter().fold(1.0, f32::max);
    let color = linear_color(color.map(|channel| channel / strength));
    material.emission = Emission { color, strength };
    material.emissive = material.emission.scaled_color();
}

/// The keys of metallic-roughness materials. A texture multiplies a factor of 1 where none is
/// given.
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

/// The keys of Phong shading.
fn set_phong(material: &mut Material, mtl: &MtlMaterial<'_>) {
    let illumination = mtl.number("illum");
    material.unlit = illumination == Some(0.0);
    let is_matte = illumination == Some(1.0);
    let exponent = mtl.number("Ns").unwrap_or(0.0).max(0.0);
    material.roughness = if is_matte { 1.0 } else { (2.0 / (exponent + 2.0)).sqrt().sqrt() };
    let specular = mtl.specular.unwrap_or([0.0; 3]).map(|channel| channel.clamp(0.0, 1.0));
    let specular = if is_matte { [0.0; 3] } else { specular };
    let largest = |color: [f32; 3]| color.into_iter().fold(0.0, f32::max);
    let is_black = mtl.diffuse.is_some_and(|color| largest(color) < METAL_THRESHOLD);
    if is_black && largest(specular) >= METAL_THRESHOLD && !mtl.has_texture("map_Kd") {
        let [r, g, b] = linear_color(specular);
        material.base_color = [r, g, b, 1.0];
        material.metallic = 1.0;
        return;
    }
    // 0.04 · strength · color = 0.08 · Ks, with a color of at least 1 in its largest channel.
    let strength = (2.0 * largest(specular)).min(1.0);
    let color = specular.map(|channel| if strength > 0.0 { 2.0 * channel / strength } else { 1.0 });
    if strength != 1.0 || color != [1.0; 3] {
        let layer = Specular { factor: strength, color, ..Specular::default() };
        material.extensions.specular = Some(Box::new(layer));
    }
}

/// Sheen, clearcoat and anisotropy.
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

/// Alpha, by `d` or else `Tr`.
///
/// `Tr 1` alone would make everything invisible: programs that write it mean the opposite.
fn set_alpha(material: &mut Material, mtl: &MtlMaterial<'_>, warnings: &mut ImportWarnings) {
    let mut alpha = match (mtl.unit_number("d"), mtl.unit_number("Tr")) {
        (Some(dissolve), _) => dissolve,
        (None, Some(transparency)) => 1.0 - transparency,
        (None, None) => 1.0,
    };
    if alpha == 0.0 {
        let name = String::from_utf8_lossy(mtl.name);
        if mtl.numbers.contains_key("d") {
            warnings.push_warning("", format!("the material {name:?} is invisible: `d` is 0"));
        } else {
            let message =
                format!("the material {name:?} has `Tr` 1 and no `d`: it is shown opaque");
            warnings.push_warning("", message);
            alpha = 1.0;
        }
    }
    material.base_color[3] = alpha;
    if alpha < 1.0 || mtl.has_texture("map_d") {
        material.alpha_mode = AlphaMode::Blend;
    }
}

/// Textures of the material.
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

/// Linear light of an sRGB color; numbers beyond 0 to 1 are clamped.
fn linear_color(color: [f32; 3]) -> [f32; 3] {
    color.map(|channel| linear_from_srgb(channel.clamp(0.0, 1.0)))
}

impl MtlMaterial<'_> {
    /// The number of a keyword.
    fn number(&self, key: &str) -> Option<f32> {
        self.numbers.get(key).copied()
    }

    /// The number of a keyword, clamped to 0 to 1.
    fn unit_number(&self, key: &str) -> Option<f32> {
        self.number(key).map(|number| number.clamp(0.0, 1.0))
    }

    /// The color of a keyword beside a texture that it multiplies; white where it is black or not
    /// given, as the texture would not be seen.
    fn color_beside_texture(
        &self,
        color: Option<[f32; 3]>,
        map: &str,
        default: [f32; 3],
    ) -> [f32; 3] {
        match color {
            Some(color) if color != [0.0; 3] => color,
            _ if self.has_texture(map) => [1.0; 3],
            color => color.unwrap_or(default),
        }
    }

    /// Whether the material has a texture of this keyword.
    fn has_texture(&self, key: &str) -> bool {
        self.textures.contains_key(key)
    }
}
