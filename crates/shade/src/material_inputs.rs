//! Inputs: what a material says of a surface at some fragments, its factors times its textures.

use super::Draw;
use super::attributes::{VertexIndices, interpolate};
use super::fragment_lanes::{FragmentLanes, scale_channels, splat};
use model::{MaterialExtensions, TextureSlot};

/// What a material says of a surface at some fragments. All numbers are linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct MaterialInputs<const N: usize> {
    /// Red, green, blue and alpha of the surface.
    pub(super) base: [[f32; N]; 4],
    /// 0 for dielectrics, 1 for metals.
    pub(super) metallic: [f32; N],
    /// Perceptual roughness.
    pub(super) roughness: [f32; N],
    /// The normal in the tangent space of the surface, of any length.
    pub(super) tangent_normal: [[f32; N]; 3],
    /// How much of the ambient light arrives.
    pub(super) occlusion: [f32; N],
    /// Light that the surface gives off.
    pub(super) emitted: [[f32; N]; 3],
    /// What extensions say.
    pub(super) layers: LayerInputs<N>,
}

/// What the extensions of a material say; without them nothing here is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct LayerInputs<const N: usize> {
    /// The strength of highlights of dielectrics.
    pub(super) specular: [f32; N],
    /// The reflected share of dielectrics from straight ahead: the colour of highlights. In the older model, of all surfaces.
    pub(super) specular_color: [[f32; N]; 3],
    /// The share of the clear layer.
    pub(super) clearcoat: [f32; N],
    /// The clear layer's perceptual roughness.
    pub(super) clearcoat_roughness: [f32; N],
    /// The clear layer's normal in tangent space.
    pub(super) clearcoat_normal: [[f32; N]; 3],
    /// The colour of fibres.
    pub(super) sheen_color: [[f32; N]; 3],
    /// The perceptual roughness of fibres.
    pub(super) sheen_roughness: [f32; N],
    /// The share of light that passes.
    pub(super) transmission: [f32; N],
    /// The way through the body, in the mesh's units.
    pub(super) thickness: [f32; N],
    /// The share of the thin film.
    pub(super) iridescence: [f32; N],
    /// Its thickness in nanometres.
    pub(super) iridescence_thickness: [f32; N],
    /// The direction of long highlights in tangent space, and how long they are.
    pub(super) anisotropy: [[f32; N]; 3],
}

impl<const N: usize> MaterialInputs<N> {
    /// The inputs at fragments of a draw. Texels have an alpha only where materials blend; of an unlit draw only the base colour
    /// is there.
    #[inline(always)]
    pub(super) fn evaluate(
        draw: &Draw<'_>,
        corners: &VertexIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> Self {
        let mut inputs = Self::from_factors(draw);
        let weights = seen.weights();
        if let Some(colors) = &draw.colors {
            scale_channels(
                &mut inputs.base,
                &interpolate::<N, 4>(&corners.fetch_attributes(colors, 0), &weights),
            );
        }
        for maps in draw.textures.groups() {
            let uvs = draw.texture_coordinates(corners, seen, &maps[0].usage);
            for (map, texels) in maps.iter().zip(&draw.textures.sample_group(maps, &uvs)) {
                inputs.apply_texture(draw, map.slot, texels);
            }
        }
        inputs
    }

    /// What the material says without textures.
    #[inline(always)]
    fn from_factors(draw: &Draw<'_>) -> Self {
        let material = draw.material;
        Self {
            base: splat(material.base_color),
            metallic: [material.metallic; N],
            roughness: [material.roughness; N],
            tangent_normal: splat([0.0, 0.0, 1.0]),
            occlusion: [1.0; N],
            emitted: splat(if material.unlit { [0.0; 3] } else { material.emissive }),
            layers: LayerInputs::from_factors(&material.extensions),
        }
    }

    /// Multiplies what a texture belongs to by its texels.
    #[inline(always)]
    fn apply_texture(&mut self, draw: &Draw<'_>, slot: TextureSlot, texels: &[[f32; N]; 4]) {
        let material = draw.material;
        let [red, green, blue, alpha] = texels;
        match slot {
            TextureSlot::BaseColor | TextureSlot::Diffuse => scale_channels(&mut self.base, texels),
            TextureSlot::MetallicRoughness => {
                multiply_lanes(&mut self.roughness, green);
                multiply_lanes(&mut self.metallic, blue);
            }
            TextureSlot::Normal => {
                let size = material.normal_texture.map_or(1.0, |normal| normal.scale);
                self.tangent_normal = decode_tangent_normal(texels, size);
            }
            TextureSlot::Occlusion => {
                let strength = material.occlusion_texture.map_or(1.0, |used| used.strength);
                for lane in 0..N {
                    self.occlusion[lane] = 1.0 + strength * (red[lane] - 1.0);
                }
            }
            TextureSlot::Emissive => scale_channels(&mut self.emitted, texels),
            TextureSlot::SpecularGlossiness => {
                let older = material.extensions.specular_glossiness.as_deref();
                let glossiness = older.map_or(1.0, |older| older.glossiness);
                for lane in 0..N {
                    self.roughness[lane] = 1.0 - glossiness * alpha[lane];
                }
                scale_channels(&mut self.layers.specular_color, texels);
            }
            slot => self.layers.apply_texture(&material.extensions, slot, texels),
        }
    }
}

impl<const N: usize> LayerInputs<N> {
    /// What the extensions say without textures.
    #[inline(always)]
    fn from_factors(more: &MaterialExtensions) -> Self {
        let coat = more.clearcoat.as_deref().copied().unwrap_or_default();
        let sheen = more.sheen.as_deref().copied().unwrap_or_default();
        let film = more.iridescence.as_deref().copied().unwrap_or_default();
        let specular = more.specular.as_deref().copied().unwrap_or_default();
        let older = more.specular_glossiness.as_deref();
        Self {
            specular: [specular.factor; N],
            specular_color: splat(older.map_or(specular.color, |older| older.specular)),
            clearcoat: [coat.factor; N],
            clearcoat_roughness: [coat.roughness; N],
            clearcoat_normal: splat([0.0, 0.0, 1.0]),
            sheen_color: splat(sheen.color),
            sheen_roughness: [sheen.roughness; N],
            transmission: [more.transmission.as_deref().map_or(0.0, |t| t.factor); N],
            thickness: [more.volume.as_deref().map_or(0.0, |volume| volume.thickness); N],
            iridescence: [film.factor; N],
            iridescence_thickness: [film.thickness_maximum; N],
            anisotropy: splat([1.0, 0.0, more.anisotropy.as_deref().map_or(0.0, |a| a.strength)]),
        }
    }

    #[inline(always)]
    fn apply_texture(
        &mut self,
        more: &MaterialExtensions,
        slot: TextureSlot,
        texels: &[[f32; N]; 4],
    ) {
        let [red, green, blue, alpha] = texels;
        match slot {
            TextureSlot::Specular => multiply_lanes(&mut self.specular, alpha),
            TextureSlot::SpecularColor => scale_channels(&mut self.specular_color, texels),
            TextureSlot::Clearcoat => multiply_lanes(&mut self.clearcoat, red),
            TextureSlot::ClearcoatRoughness => multiply_lanes(&mut self.clearcoat_roughness, green),
            TextureSlot::ClearcoatNormal => {
                let normal = more.clearcoat.as_deref().and_then(|coat| coat.normal_texture);
                self.clearcoat_normal =
                    decode_tangent_normal(texels, normal.map_or(1.0, |normal| normal.scale));
            }
            TextureSlot::SheenColor => scale_channels(&mut self.sheen_color, texels),
            TextureSlot::SheenRoughness => multiply_lanes(&mut self.sheen_roughness, alpha),
            TextureSlot::Transmission => multiply_lanes(&mut self.transmission, red),
            TextureSlot::Thickness => multiply_lanes(&mut self.thickness, green),
            TextureSlot::Iridescence => multiply_lanes(&mut self.iridescence, red),
            TextureSlot::IridescenceThickness => {
                let film = more.iridescence.as_deref().copied().unwrap_or_default();
                let span = film.thickness_maximum - film.thickness_minimum;
                for lane in 0..N {
                    self.iridescence_thickness[lane] = film.thickness_minimum + span * green[lane];
                }
            }
            TextureSlot::Anisotropy => {
                for lane in 0..N {
                    self.anisotropy[0][lane] = 2.0 * red[lane] - 1.0;
                    self.anisotropy[1][lane] = 2.0 * green[lane] - 1.0;
                }
                multiply_lanes(&mut self.anisotropy[2], blue);
            }
            _ => {}
        }
    }
}

#[inline(always)]
fn multiply_lanes<const N: usize>(numbers: &mut [f32; N], factors: &[f32; N]) {
    for lane in 0..N {
        numbers[lane] *= factors[lane];
    }
}

/// A normal of tangent space from a texture's red, green and blue.
#[inline(always)]
fn decode_tangent_normal<const N: usize>(
    [red, green, blue, _]: &[[f32; N]; 4],
    size: f32,
) -> [[f32; N]; 3] {
    let mut slope = [[0.0; N]; 3];
    for lane in 0..N {
        slope[0][lane] = (2.0 * red[lane] - 1.0) * size;
        slope[1][lane] = (2.0 * green[lane] - 1.0) * size;
        slope[2][lane] = 2.0 * blue[lane] - 1.0;
    }
    slope
}
