//! Material inputs: the parameters of a material at `N` fragments, from its factors, textures and
//! vertex colors (glTF 2.0 §3.9).
//!
//! ```text
//!  base color = factor × vertex color × texture.rgb     roughness = factor × texture.g
//!  alpha      = factor × vertex color × texture.a       metalness = factor × texture.b
//!  emitted    = factor × texture.rgb                    occlusion = lerp(1, texture.r, strength)
//!  normal     = (2 texture.rgb − 1) × (scale, scale, 1), in tangent space
//! ```
//!
//! The BRDF uses only these parameters, not factors, slots or channels.

use super::Draw;
use super::attributes::{VertexIndices, interpolate};
use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Rgb, Vec3Lanes};
use super::texture::TexelLanes;
use crate::kernel_part::kernel_part;
use model::{MaterialExtensions, TextureSlot};

/// The core parameters of a material. All numbers are linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct MaterialInputs<const N: usize> {
    /// The base color; in specular-glossiness, the diffuse color.
    pub(super) base_color: Rgb<N>,
    /// The alpha of the base color.
    pub(super) alpha: Lanes<N>,
    /// The metalness: 0 for dielectrics, 1 for metals.
    pub(super) metallic: Lanes<N>,
    /// The perceptual roughness.
    pub(super) roughness: Lanes<N>,
    /// The normal from the normal map in tangent space, of any length.
    pub(super) tangent_normal: Vec3Lanes<N>,
    /// The ambient occlusion: the fraction of light from all directions that arrives.
    pub(super) occlusion: Lanes<N>,
    /// The ambient visibility computed from the picture, in addition to the material's texture, or
    /// `None` without screen-space ambient occlusion.
    pub(super) screen_visibility: Option<Lanes<N>>,
    /// The emitted radiance.
    pub(super) emitted: Rgb<N>,
    /// The parameters of the extensions.
    pub(super) layers: LayerInputs<N>,
}

/// The parameters of a material's extensions. The parameters of absent extensions are never read.
#[derive(Clone, Copy, Debug)]
pub(super) struct LayerInputs<const N: usize> {
    /// The strength of the specular reflection of dielectrics.
    pub(super) specular: Lanes<N>,
    /// The color of F0 for dielectrics; in specular-glossiness, the F0 of all surfaces.
    pub(super) specular_color: Rgb<N>,
    /// The strength of the clearcoat.
    pub(super) clearcoat: Lanes<N>,
    /// The perceptual roughness of the clearcoat.
    pub(super) clearcoat_roughness: Lanes<N>,
    /// The normal of the clearcoat in tangent space, of any length.
    pub(super) clearcoat_normal: Vec3Lanes<N>,
    /// The color of sheen.
    pub(super) sheen_color: Rgb<N>,
    /// The perceptual roughness of sheen.
    pub(super) sheen_roughness: Lanes<N>,
    /// The fraction of light that is not reflected diffusely but transmitted.
    pub(super) transmission: Lanes<N>,
    /// The thickness of the volume in mesh units.
    pub(super) thickness: Lanes<N>,
    /// The strength of the thin film.
    pub(super) iridescence: Lanes<N>,
    /// The thickness of the thin film in nanometers.
    pub(super) iridescence_thickness: Lanes<N>,
    /// The direction of anisotropy in tangent space in x and y, and its strength in z.
    pub(super) anisotropy: Vec3Lanes<N>,
}

impl<const N: usize> MaterialInputs<N> {
    /// Evaluates the inputs at fragments of a draw by interpolating vertex colors and filtering
    /// textures.
    ///
    /// Alpha is read from textures only if the material blends. For an unlit draw, only the base
    /// color is evaluated.
    #[inline(always)]
    pub(super) fn evaluate(
        draw: &Draw<'_>,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> Self {
        kernel_part!(N, Self::sample(draw, vertices, fragments))
    }

    /// Evaluates the inputs like [`evaluate`](Self::evaluate), but inlined.
    #[inline(always)]
    pub(super) fn sample(
        draw: &Draw<'_>,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> Self {
        let mut inputs = Self::from_factors(draw);
        if let Some(colors) = &draw.colors {
            let [r, g, b, alpha] =
                interpolate(&vertices.fetch_attributes(colors, 0), &fragments.weights());
            inputs.base_color = inputs.base_color * Rgb { r, g, b };
            inputs.alpha *= alpha;
        }
        // Textures with the same footprint are sampled together.
        for group in draw.textures.groups() {
            let uvs = draw.texture_coordinates(vertices, fragments, &group[0].info);
            let texels = draw.textures.sample_group(group, &uvs);
            // Each texture multiplies the parameter of its slot.
            for (texture, texel) in group.iter().zip(texels) {
                inputs.apply_texture(draw, texture.slot, texel);
            }
        }
        inputs
    }

    /// Returns the factors of the material, without textures.
    #[inline(always)]
    fn from_factors(draw: &Draw<'_>) -> Self {
        let material = draw.material;
        let [r, g, b, alpha] = material.base_color;
        Self {
            base_color: Rgb::splat([r, g, b]),
            alpha: Lanes::splat(alpha),
            metallic: Lanes::splat(material.metallic),
            roughness: Lanes::splat(material.roughness),
            tangent_normal: Vec3Lanes::splat([0.0, 0.0, 1.0]),
            occlusion: Lanes::ONE,
            screen_visibility: None,
            emitted: Rgb::splat(if material.unlit { [0.0; 3] } else { material.emissive }),
            layers: LayerInputs::from_factors(&material.extensions),
        }
    }

    /// Multiplies the parameter for a texture by its texels.
    #[inline(always)]
    fn apply_texture(&mut self, draw: &Draw<'_>, slot: TextureSlot, texel: TexelLanes<N>) {
        let material = draw.material;
        match slot {
            TextureSlot::BaseColor | TextureSlot::Diffuse => {
                self.base_color = self.base_color * texel.color;
                self.alpha *= texel.alpha;
            }
            // glTF packs occlusion, roughness and metalness into red, green and blue, so that one
            // image can store all three.
            TextureSlot::MetallicRoughness => {
                self.roughness *= texel.color.g;
                self.metallic *= texel.color.b;
            }
            TextureSlot::Normal => {
                let scale = material.normal_texture.map_or(1.0, |normal| normal.scale);
                self.tangent_normal = decode_tangent_normal(texel.color, scale);
            }
            TextureSlot::Occlusion => {
                // lerp(1, red, strength), in the order used by the specification.
                let strength = material.occlusion_texture.map_or(1.0, |used| used.strength);
                self.occlusion = 1.0 + strength * (texel.color.r - 1.0);
            }
            TextureSlot::Emissive => self.emitted = self.emitted * texel.color,
            TextureSlot::SpecularGlossiness => {
                // Glossiness is in alpha, and is 1 − roughness.
                let workflow = material.extensions.specular_glossiness.as_deref();
                let glossiness = workflow.map_or(1.0, |workflow| workflow.glossiness);
                self.roughness = 1.0 - glossiness * texel.alpha;
                self.layers.specular_color = self.layers.specular_color * texel.color;
            }
            slot => self.layers.apply_texture(&material.extensions, slot, texel),
        }
    }
}

impl<const N: usize> LayerInputs<N> {
    /// Returns the factors of the extensions, without textures. The factors of absent extensions
    /// are arbitrary.
    #[inline(always)]
    fn from_factors(extensions: &MaterialExtensions) -> Self {
        let clearcoat = extensions.clearcoat.as_deref().copied().unwrap_or_default();
        let sheen = extensions.sheen.as_deref().copied().unwrap_or_default();
        let film = extensions.iridescence.as_deref().copied().unwrap_or_default();
        let specular = extensions.specular.as_deref().copied().unwrap_or_default();
        let glossiness = extensions.specular_glossiness.as_deref();
        let transmission = extensions.transmission.as_deref().map_or(0.0, |t| t.factor);
        let thickness = extensions.volume.as_deref().map_or(0.0, |volume| volume.thickness);
        let anisotropy = extensions.anisotropy.as_deref().map_or(0.0, |a| a.strength);
        Self {
            specular: Lanes::splat(specular.factor),
            specular_color: Rgb::splat(glossiness.map_or(specular.color, |g| g.specular)),
            clearcoat: Lanes::splat(clearcoat.factor),
            clearcoat_roughness: Lanes::splat(clearcoat.roughness),
            clearcoat_normal: Vec3Lanes::splat([0.0, 0.0, 1.0]),
            sheen_color: Rgb::splat(sheen.color),
            sheen_roughness: Lanes::splat(sheen.roughness),
            transmission: Lanes::splat(transmission),
            thickness: Lanes::splat(thickness),
            iridescence: Lanes::splat(film.factor),
            iridescence_thickness: Lanes::splat(film.thickness_maximum),
            anisotropy: Vec3Lanes::splat([1.0, 0.0, anisotropy]),
        }
    }

    /// Multiplies the parameter for an extension's texture by its texels.
    #[inline(always)]
    fn apply_texture(
        &mut self,
        extensions: &MaterialExtensions,
        slot: TextureSlot,
        texel: TexelLanes<N>,
    ) {
        let Rgb { r, g, b } = texel.color;
        match slot {
            TextureSlot::Specular => self.specular *= texel.alpha,
            TextureSlot::SpecularColor => self.specular_color = self.specular_color * texel.color,
            TextureSlot::Clearcoat => self.clearcoat *= r,
            TextureSlot::ClearcoatRoughness => self.clearcoat_roughness *= g,
            TextureSlot::ClearcoatNormal => {
                let clearcoat = extensions.clearcoat.as_deref();
                let normal = clearcoat.and_then(|clearcoat| clearcoat.normal_texture);
                let scale = normal.map_or(1.0, |normal| normal.scale);
                self.clearcoat_normal = decode_tangent_normal(texel.color, scale);
            }
            TextureSlot::SheenColor => self.sheen_color = self.sheen_color * texel.color,
            TextureSlot::SheenRoughness => self.sheen_roughness *= texel.alpha,
            TextureSlot::Transmission => self.transmission *= r,
            TextureSlot::Thickness => self.thickness *= g,
            TextureSlot::Iridescence => self.iridescence *= r,
            TextureSlot::IridescenceThickness => {
                // Green interpolates between the minimum and maximum thickness.
                let film = extensions.iridescence.as_deref().copied().unwrap_or_default();
                let range = film.thickness_maximum - film.thickness_minimum;
                self.iridescence_thickness = film.thickness_minimum + range * g;
            }
            TextureSlot::Anisotropy => {
                // A direction in red and green, from −1 to 1, and a strength in blue.
                self.anisotropy.x = 2.0 * r - 1.0;
                self.anisotropy.y = 2.0 * g - 1.0;
                self.anisotropy.z *= b;
            }
            _ => {}
        }
    }
}

/// Decodes the tangent-space normal in a normal map, with x and y scaled (glTF 2.0 §3.9.3).
#[inline(always)]
fn decode_tangent_normal<const N: usize>(texel: Rgb<N>, scale: f32) -> Vec3Lanes<N> {
    Vec3Lanes {
        x: (2.0 * texel.r - 1.0) * scale,
        y: (2.0 * texel.g - 1.0) * scale,
        z: 2.0 * texel.b - 1.0,
    }
}
