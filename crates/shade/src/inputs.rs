//! Inputs: what a material says of a surface at some fragments, its factors times its textures.

use super::Draw;
use super::corners::{Corners, blend};
use super::seen::{Seen, in_all, scale};
use model::{MaterialExtensions, TextureSlot};

/// What a material says of a surface at some fragments. All numbers are linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs<const N: usize> {
    /// Red, green, blue and alpha of the surface.
    pub(super) base: [[f32; N]; 4],
    /// 0 for dielectrics, 1 for metals.
    pub(super) metallic: [f32; N],
    /// Perceptual roughness.
    pub(super) roughness: [f32; N],
    /// The normal in the tangent space of the surface, of any length.
    pub(super) slope: [[f32; N]; 3],
    /// How much of the ambient light arrives.
    pub(super) occlusion: [f32; N],
    /// Light that the surface gives off.
    pub(super) emitted: [[f32; N]; 3],
    /// What extensions say.
    pub(super) layers: Layers<N>,
}

/// What the extensions of a material say; without them nothing here is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layers<const N: usize> {
    /// The strength of highlights of dielectrics.
    pub(super) specular: [f32; N],
    /// The reflected share of dielectrics from straight ahead: the colour of highlights. In the older model, of all surfaces.
    pub(super) specular_color: [[f32; N]; 3],
    /// The share of the clear layer.
    pub(super) coat: [f32; N],
    /// The clear layer's perceptual roughness.
    pub(super) coat_roughness: [f32; N],
    /// The clear layer's normal in tangent space.
    pub(super) coat_slope: [[f32; N]; 3],
    /// The colour of fibres.
    pub(super) sheen: [[f32; N]; 3],
    /// The perceptual roughness of fibres.
    pub(super) sheen_roughness: [f32; N],
    /// The share of light that passes.
    pub(super) transmission: [f32; N],
    /// The way through the body, in the mesh's units.
    pub(super) thickness: [f32; N],
    /// The share of the thin film.
    pub(super) film: [f32; N],
    /// Its thickness in nanometres.
    pub(super) film_thickness: [f32; N],
    /// The direction of long highlights in tangent space, and how long they are.
    pub(super) anisotropy: [[f32; N]; 3],
}

impl<const N: usize> Inputs<N> {
    /// The inputs at fragments of a draw. Texels have an alpha only where materials blend; of an unlit draw only the base colour
    /// is there.
    #[inline(always)]
    pub(super) fn of(draw: &Draw<'_>, corners: &Corners<N>, seen: &impl Seen<N>) -> Self {
        let mut inputs = Self::factors(draw);
        let weights = seen.weights();
        if let Some(colors) = &draw.colors {
            scale(&mut inputs.base, &blend::<N, 4>(&corners.carried(colors, 0), &weights));
        }
        for maps in draw.maps.together() {
            let uvs = draw.uvs(corners, seen, &maps[0].used);
            for (map, texels) in maps.iter().zip(&draw.maps.read(maps, &uvs)) {
                inputs.apply(draw, map.slot, texels);
            }
        }
        inputs
    }

    /// What the material says without textures.
    #[inline(always)]
    fn factors(draw: &Draw<'_>) -> Self {
        let material = draw.material;
        Self {
            base: in_all(material.base_color),
            metallic: [material.metallic; N],
            roughness: [material.roughness; N],
            slope: in_all([0.0, 0.0, 1.0]),
            occlusion: [1.0; N],
            emitted: in_all(if material.unlit { [0.0; 3] } else { material.emissive }),
            layers: Layers::factors(&material.extensions),
        }
    }

    /// Multiplies what a texture belongs to by its texels.
    #[inline(always)]
    fn apply(&mut self, draw: &Draw<'_>, slot: TextureSlot, texels: &[[f32; N]; 4]) {
        let material = draw.material;
        let [red, green, blue, alpha] = texels;
        match slot {
            TextureSlot::BaseColor | TextureSlot::Diffuse => scale(&mut self.base, texels),
            TextureSlot::MetallicRoughness => {
                multiply(&mut self.roughness, green);
                multiply(&mut self.metallic, blue);
            }
            TextureSlot::Normal => {
                let size = material.normal_texture.map_or(1.0, |normal| normal.scale);
                self.slope = slope(texels, size);
            }
            TextureSlot::Occlusion => {
                let strength = material.occlusion_texture.map_or(1.0, |used| used.strength);
                for lane in 0..N {
                    self.occlusion[lane] = 1.0 + strength * (red[lane] - 1.0);
                }
            }
            TextureSlot::Emissive => scale(&mut self.emitted, texels),
            TextureSlot::SpecularGlossiness => {
                let older = material.extensions.specular_glossiness.as_deref();
                let glossiness = older.map_or(1.0, |older| older.glossiness);
                for lane in 0..N {
                    self.roughness[lane] = 1.0 - glossiness * alpha[lane];
                }
                scale(&mut self.layers.specular_color, texels);
            }
            slot => self.layers.apply(&material.extensions, slot, texels),
        }
    }
}

impl<const N: usize> Layers<N> {
    /// What the extensions say without textures.
    #[inline(always)]
    fn factors(more: &MaterialExtensions) -> Self {
        let coat = more.clearcoat.as_deref().copied().unwrap_or_default();
        let sheen = more.sheen.as_deref().copied().unwrap_or_default();
        let film = more.iridescence.as_deref().copied().unwrap_or_default();
        let specular = more.specular.as_deref().copied().unwrap_or_default();
        let older = more.specular_glossiness.as_deref();
        Self {
            specular: [specular.factor; N],
            specular_color: in_all(older.map_or(specular.color, |older| older.specular)),
            coat: [coat.factor; N],
            coat_roughness: [coat.roughness; N],
            coat_slope: in_all([0.0, 0.0, 1.0]),
            sheen: in_all(sheen.color),
            sheen_roughness: [sheen.roughness; N],
            transmission: [more.transmission.as_deref().map_or(0.0, |t| t.factor); N],
            thickness: [more.volume.as_deref().map_or(0.0, |volume| volume.thickness); N],
            film: [film.factor; N],
            film_thickness: [film.thickness_maximum; N],
            anisotropy: in_all([1.0, 0.0, more.anisotropy.as_deref().map_or(0.0, |a| a.strength)]),
        }
    }

    #[inline(always)]
    fn apply(&mut self, more: &MaterialExtensions, slot: TextureSlot, texels: &[[f32; N]; 4]) {
        let [red, green, blue, alpha] = texels;
        match slot {
            TextureSlot::Specular => multiply(&mut self.specular, alpha),
            TextureSlot::SpecularColor => scale(&mut self.specular_color, texels),
            TextureSlot::Clearcoat => multiply(&mut self.coat, red),
            TextureSlot::ClearcoatRoughness => multiply(&mut self.coat_roughness, green),
            TextureSlot::ClearcoatNormal => {
                let normal = more.clearcoat.as_deref().and_then(|coat| coat.normal_texture);
                self.coat_slope = slope(texels, normal.map_or(1.0, |normal| normal.scale));
            }
            TextureSlot::SheenColor => scale(&mut self.sheen, texels),
            TextureSlot::SheenRoughness => multiply(&mut self.sheen_roughness, alpha),
            TextureSlot::Transmission => multiply(&mut self.transmission, red),
            TextureSlot::Thickness => multiply(&mut self.thickness, green),
            TextureSlot::Iridescence => multiply(&mut self.film, red),
            TextureSlot::IridescenceThickness => {
                let film = more.iridescence.as_deref().copied().unwrap_or_default();
                let span = film.thickness_maximum - film.thickness_minimum;
                for lane in 0..N {
                    self.film_thickness[lane] = film.thickness_minimum + span * green[lane];
                }
            }
            TextureSlot::Anisotropy => {
                for lane in 0..N {
                    self.anisotropy[0][lane] = 2.0 * red[lane] - 1.0;
                    self.anisotropy[1][lane] = 2.0 * green[lane] - 1.0;
                }
                multiply(&mut self.anisotropy[2], blue);
            }
            _ => {}
        }
    }
}

#[inline(always)]
fn multiply<const N: usize>(numbers: &mut [f32; N], factors: &[f32; N]) {
    for lane in 0..N {
        numbers[lane] *= factors[lane];
    }
}

/// A normal of tangent space from a texture's red, green and blue.
#[inline(always)]
fn slope<const N: usize>([red, green, blue, _]: &[[f32; N]; 4], size: f32) -> [[f32; N]; 3] {
    let mut slope = [[0.0; N]; 3];
    for lane in 0..N {
        slope[0][lane] = (2.0 * red[lane] - 1.0) * size;
        slope[1][lane] = (2.0 * green[lane] - 1.0) * size;
        slope[2][lane] = 2.0 * blue[lane] - 1.0;
    }
    slope
}
