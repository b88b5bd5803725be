//! Converts Phong materials from MTL libraries to metallic-roughness materials.

use gltf_import::linear_from_srgb;
use model::{AlphaMode, Material, Specular};

/// The sRGB-encoded diffuse color of materials that do not specify one.
const PLAIN_COLOR: [f32; 3] = [0.8; 3];
/// The maximum diffuse color of a metal, and its minimum specular color.
const METAL_THRESHOLD: f32 = 0.04;

/// The Phong shading keys of an MTL library, with `None` for missing keys.
///
/// Colors are sRGB encoded, from 0 to 1. The OBJ importer reads them from a library; other programs
/// may set them directly.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PhongMaterial {
    /// `Kd`, the diffuse color.
    pub diffuse: Option<[f32; 3]>,
    /// `Ks`, the specular color.
    pub specular: Option<[f32; 3]>,
    /// `Ns`, the exponent of the specular highlight.
    pub exponent: Option<f32>,
    /// `illum`, the illumination model.
    pub illumination: Option<f32>,
    /// `d`, the opacity.
    pub dissolve: Option<f32>,
    /// `Tr`, the transparency.
    pub transparency: Option<f32>,
    /// Whether a texture (`map_Kd`) multiplies the diffuse color.
    pub has_texture: bool,
}

impl PhongMaterial {
    /// Returns a double-sided metallic-roughness material that looks similar, without textures.
    #[must_use]
    pub fn to_material(&self) -> Material {
        let mut material = Material { base_color: self.base_color(), ..double_sided_matte() };
        self.set_reflection(&mut material);
        if self.alpha() < 1.0 {
            material.alpha_mode = AlphaMode::Blend;
        }
        material
    }

    /// Returns the diffuse color in linear light, with alpha.
    pub(super) fn base_color(&self) -> [f32; 4] {
        let color = color_beside_texture(self.diffuse, self.has_texture, PLAIN_COLOR);
        let [r, g, b] = linear_color(color);
        [r, g, b, self.alpha()]
    }

    /// Returns alpha from `d` or else `Tr`.
    ///
    /// By itself, `Tr 1` would make everything invisible; programs that write it mean the opposite.
    pub(super) fn alpha(&self) -> f32 {
        let transparency = self.transparency.map(|transparency| transparency.clamp(0.0, 1.0));
        match (self.dissolve, transparency) {
            (Some(dissolve), _) => dissolve.clamp(0.0, 1.0),
            (None, Some(transparency)) if transparency < 1.0 => 1.0 - transparency,
            _ => 1.0,
        }
    }

    /// Returns whether `Tr 1` is the only opacity value, which would make everything invisible.
    pub(super) fn is_invisible_by_transparency(&self) -> bool {
        self.dissolve.is_none() && self.transparency.is_some_and(|transparency| transparency >= 1.0)
    }

    /// Sets the roughness and reflectance, and the color of a metal.
    pub(super) fn set_reflection(&self, material: &mut Material) {
        material.unlit = self.illumination == Some(0.0);
        let is_matte = self.illumination == Some(1.0);
        let exponent = self.exponent.unwrap_or(0.0).max(0.0);
        material.roughness = if is_matte { 1.0 } else { (2.0 / (exponent + 2.0)).sqrt().sqrt() };
        let specular = self.specular.filter(|_| !is_matte).unwrap_or_default();
        let specular = specular.map(|channel| channel.clamp(0.0, 1.0));
        let largest = |color: [f32; 3]| color.into_iter().fold(0.0, f32::max);
        let is_black = self.diffuse.is_some_and(|color| largest(color) < METAL_THRESHOLD);
        if is_black && largest(specular) >= METAL_THRESHOLD && !self.has_texture {
            let [r, g, b] = linear_color(specular);
            material.base_color = [r, g, b, material.base_color[3]];
            material.metallic = 1.0;
            return;
        }
        // 0.04 · strength · color = 0.08 · Ks; the largest channel of the color is at least 1.
        let strength = (2.0 * largest(specular)).min(1.0);
        let color =
            specular.map(|channel| if strength > 0.0 { 2.0 * channel / strength } else { 1.0 });
        if strength != 1.0 || color != [1.0; 3] {
            let layer = Specular { factor: strength, color, ..Specular::default() };
            material.extensions.specular = Some(Box::new(layer));
        }
    }
}

/// Returns a purely diffuse material that is visible from both sides.
pub(super) fn double_sided_matte() -> Material {
    Material { double_sided: true, metallic: 0.0, roughness: 1.0, ..Material::plain() }
}

/// Adjusts a color that a texture multiplies. A black color, which would hide the texture, becomes
/// white, as does a missing color.
pub(super) fn color_beside_texture(
    color: Option<[f32; 3]>,
    has_texture: bool,
    default: [f32; 3],
) -> [f32; 3] {
    match color {
        Some(color) if color != [0.0; 3] => color,
        _ if has_texture => [1.0; 3],
        color => color.unwrap_or(default),
    }
}

/// Converts an sRGB color to linear light. Numbers outside [0, 1] are clamped.
pub(super) fn linear_color(color: [f32; 3]) -> [f32; 3] {
    color.map(|channel| linear_from_srgb(channel.clamp(0.0, 1.0)))
}
