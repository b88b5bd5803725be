//! Phong shading of MTL libraries as metallic-roughness materials.

use gltf_import::linear_from_srgb;
use model::{AlphaMode, Material, Specular};

/// Diffuse color, sRGB encoded, where a library gives none.
const PLAIN_COLOR: [f32; 3] = [0.8; 3];
/// The largest diffuse color of a metal, and the least specular one.
const METAL_THRESHOLD: f32 = 0.04;

/// The keys of Phong shading of an MTL library; `None` for those that it lacks.
///
/// Colors are sRGB encoded, from 0 to 1. The importer of OBJ files reads them from a library, and
/// other programs may have them as numbers.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PhongMaterial {
    /// `Kd`, the diffuse color.
    pub diffuse: Option<[f32; 3]>,
    /// `Ks`, the specular color.
    pub specular: Option<[f32; 3]>,
    /// `Ns`, the exponent of the specular highlight.
    pub exponent: Option<f32>,
    /// `illum`, the model of illumination.
    pub illumination: Option<f32>,
    /// `d`, the opacity.
    pub dissolve: Option<f32>,
    /// `Tr`, the transparency.
    pub transparency: Option<f32>,
    /// Whether a texture (`map_Kd`) multiplies the diffuse color.
    pub has_texture: bool,
}

impl PhongMaterial {
    /// The double-sided metallic-roughness material that looks alike, without its textures.
    #[must_use]
    pub fn to_material(&self) -> Material {
        let mut material = Material { base_color: self.base_color(), ..double_sided_matte() };
        self.set_reflection(&mut material);
        if self.alpha() < 1.0 {
            material.alpha_mode = AlphaMode::Blend;
        }
        material
    }

    /// The diffuse color in linear light, with alpha.
    pub(super) fn base_color(&self) -> [f32; 4] {
        let color = color_beside_texture(self.diffuse, self.has_texture, PLAIN_COLOR);
        let [r, g, b] = linear_color(color);
        [r, g, b, self.alpha()]
    }

    /// Alpha, by `d` or else `Tr`.
    ///
    /// `Tr 1` alone would make everything invisible: programs that write it mean the opposite.
    pub(super) fn alpha(&self) -> f32 {
        let transparency = self.transparency.map(|transparency| transparency.clamp(0.0, 1.0));
        match (self.dissolve, transparency) {
            (Some(dissolve), _) => dissolve.clamp(0.0, 1.0),
            (None, Some(transparency)) if transparency < 1.0 => 1.0 - transparency,
            _ => 1.0,
        }
    }

    /// Whether nothing says how opaque it is but `Tr 1`.
    pub(super) fn is_invisible_by_transparency(&self) -> bool {
        self.dissolve.is_none() && self.transparency.is_some_and(|transparency| transparency >= 1.0)
    }

    /// Sets roughness and reflectance, and what makes a metal of it.
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
        // 0.04 · strength · color = 0.08 · Ks, with a color of at least 1 in its largest channel.
        let strength = (2.0 * largest(specular)).min(1.0);
        let color =
            specular.map(|channel| if strength > 0.0 { 2.0 * channel / strength } else { 1.0 });
        if strength != 1.0 || color != [1.0; 3] {
            let layer = Specular { factor: strength, color, ..Specular::default() };
            material.extensions.specular = Some(Box::new(layer));
        }
    }
}

/// A material that reflects nothing but diffusely, seen from both sides.
pub(super) fn double_sided_matte() -> Material {
    Material { double_sided: true, metallic: 0.0, roughness: 1.0, ..Material::plain() }
}

/// A color beside a texture that it multiplies: white where it is black or not given, as the
/// texture would not be seen.
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

/// Linear light of an sRGB color; numbers beyond 0 to 1 are clamped.
pub(super) fn linear_color(color: [f32; 3]) -> [f32; 3] {
    color.map(|channel| linear_from_srgb(channel.clamp(0.0, 1.0)))
}
