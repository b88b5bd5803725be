//! Shading: the colour of a fragment, from its material and the lights.
//!
//! Surfaces are matt (Lambert): the light that leaves one towards the eye is its colour times the light that
//! arrives, over π. All sums are in linear light.

mod draw;
mod light;
mod texture;

pub use draw::{Draw, DrawList};
pub use light::Light;
pub use texture::MipChain;

use crate::color::linear_table;
use crate::model::{AlphaMode, Material};
use homog::{HPoint, World};
use raster::{Fragment, Surface};

/// What the fragments of a frame are shaded with.
#[derive(Debug)]
pub struct Shading<'a> {
    /// What was drawn.
    pub draws: &'a DrawList<'a>,
    /// The lights, in the world.
    pub lights: &'a [Light],
    /// Where the viewer is: the eye, or in parallel projection the direction towards it, at infinity.
    pub viewer: HPoint<World>,
    /// Whether each triangle has one normal, whatever normals the file has.
    pub flat: bool,
}

impl Surface for Shading<'_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        let draw = self.draws.of(fragment.id);
        match draw.material.alpha_mode {
            AlphaMode::Mask { cutoff } => base_color(draw, fragment)[3] >= cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => true,
        }
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let draw = self.draws.of(fragment.id);
        let base = base_color(draw, fragment);
        let alpha = if draw.material.alpha_mode == AlphaMode::Blend { base[3] } else { 1.0 };
        let light = if draw.is_lit() { self.arriving(draw, fragment) } else { [1.0; 3] };
        let emitted = emitted(draw, fragment);
        let [r, g, b] = [0, 1, 2].map(|k| (base[k] * light[k] + emitted[k]) * alpha);
        [r, g, b, alpha]
    }
}

impl Shading<'_> {
    /// The light a white surface sends to the eye: the sum over all lights, over π.
    fn arriving(&self, draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 3] {
        let place = draw.place(fragment);
        let normal = draw.normal(fragment, self.flat, to_viewer(self.viewer, place));
        let mut sum = [0.0; 3];
        for light in self.lights {
            let arriving = light.illuminance(place, normal);
            sum = [0, 1, 2].map(|k| sum[k] + arriving[k]);
        }
        sum.map(|illuminance| illuminance * std::f32::consts::FRAC_1_PI)
    }
}

/// The direction from a place to the viewer; its length has no meaning.
fn to_viewer(viewer: HPoint<World>, place: [f32; 3]) -> [f32; 3] {
    let [x, y, z, w] = <[f64; 4]>::from(viewer).map(|c| c as f32);
    [x - place[0] * w, y - place[1] * w, z - place[2] * w]
}

/// Factor × texture × vertex colour, linear, with alpha (glTF 2.0 §3.9.2).
fn base_color(draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 4] {
    let Material { base_color, base_color_texture, .. } = draw.material;
    let mut color = *base_color;
    if let Some(vertex) = draw.color(fragment) {
        color = times(color, vertex);
    }
    if let (Some(chain), Some(used)) = (draw.base_color_texture, base_color_texture) {
        let uvs = draw.uvs(fragment, used);
        color = times(color, chain.sample(uvs, linear_table()));
    }
    color
}

/// The light that the surface gives off by itself (glTF 2.0 §3.9.3); none where the base colour is all there is to see.
fn emitted(draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 3] {
    let Material { emissive, emissive_texture, unlit, .. } = draw.material;
    if *unlit || *emissive == [0.0; 3] {
        return [0.0; 3];
    }
    let (Some(chain), Some(used)) = (draw.emissive_texture, emissive_texture) else {
        return *emissive;
    };
    let texel = chain.sample(draw.uvs(fragment, used), linear_table());
    [0, 1, 2].map(|k| emissive[k] * texel[k])
}

fn times(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| a[k] * b[k])
}
