//! Shading: the colour of a fragment, from its material and the lights.
//!
//! Surfaces are matt (Lambert): the light that leaves one towards the eye is its colour times the light that
//! arrives, over π. All sums are in linear light.

mod corners;
mod draw;
mod light;
mod normal;
mod seen;
mod texture;

pub use corners::Vertex;
pub(crate) use corners::{NORMAL, PLACE, UV};
pub use draw::{Draw, DrawList};
pub use light::Light;
pub use texture::MipChain;

use crate::model::{AlphaMode, Material, Topology};
use corners::{Corners, blend};
use homog::{HPoint, World};
use normal::turn_to_viewer;
use raster::{Eight, Fragment, Fragments, Surface, WIDE};
use seen::{Seen, Wide, in_all, scale};

/// What the fragments of a frame are shaded with.
#[derive(Debug)]
pub struct Shading<'a> {
    /// What was drawn.
    pub draws: &'a DrawList<'a>,
    /// The lights, in the world.
    pub lights: &'a [Light],
    /// Where the viewer is: the eye, or in parallel projection the direction towards it, at infinity.
    pub viewer: HPoint<World>,
}

impl Surface for Shading<'_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        let (draw, _) = self.draws.of(fragment.id);
        let AlphaMode::Mask { cutoff } = draw.material.alpha_mode else { return true };
        let corners = draw.corners(&[fragment.id], true);
        let [_, _, _, [alpha]] = draw.own_colors(&corners, fragment, true, false).0;
        alpha >= cutoff
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.draws.of(fragment.id);
        let colors = self.colors(draw, &draw.corners(&[fragment.id], true), fragment);
        colors.map(|[color]| color)
    }

    #[inline(always)]
    fn shade_eight(&self, fragments: &Fragments<'_>) -> [Eight; 4] {
        let wide = Wide::new(fragments);
        let is_one = fragments.are_of_one();
        let mut colors = [[0.0; WIDE]; 4];
        let mut done = [false; WIDE];
        // One draw after the other: most often there is only one.
        while let Some(first) = done.iter().position(|&is_done| !is_done) {
            let name = fragments.id(first);
            let (draw, end) = self.draws.of(name);
            // Fragments of other draws are shaded as if they were of this primitive, and not looked at.
            let (mut ids, mut own) = ([name; WIDE], [true; WIDE]);
            if !is_one {
                for lane in 0..WIDE {
                    let id = fragments.id(lane);
                    own[lane] = (draw.first_id..end).contains(&id);
                    ids[lane] = if own[lane] { id } else { name };
                }
            }
            let of_draw = self.colors(draw, &draw.corners(&ids, is_one), &wide);
            for (color, of_draw) in colors.iter_mut().zip(&of_draw) {
                for lane in 0..WIDE {
                    color[lane] = if own[lane] { of_draw[lane] } else { color[lane] };
                }
            }
            for lane in 0..WIDE {
                done[lane] |= own[lane];
            }
        }
        colors
    }
}

impl Shading<'_> {
    /// The colours of fragments of one draw, multiplied by alpha.
    #[inline(always)]
    fn colors<const N: usize>(
        &self,
        draw: &Draw<'_>,
        corners: &Corners<N>,
        seen: &impl Seen<N>,
    ) -> [[f32; N]; 4] {
        let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
        let (mut colors, emitted) = draw.own_colors(corners, seen, is_blended, true);
        if draw.is_lit() {
            scale(&mut colors, &self.arriving(draw, corners, &seen.weights()));
        }
        for (color, emitted) in colors.iter_mut().zip(&emitted) {
            for lane in 0..N {
                color[lane] += emitted[lane];
            }
        }
        let [r, g, b, alpha] = &mut colors;
        if is_blended {
            for color in [r, g, b] {
                for lane in 0..N {
                    color[lane] *= alpha[lane];
                }
            }
        } else {
            *alpha = [1.0; N];
        }
        colors
    }

    /// The light that white surfaces send to the eye: the sum over all lights, over π.
    #[inline(always)]
    fn arriving<const N: usize>(
        &self,
        draw: &Draw<'_>,
        corners: &Corners<N>,
        weights: &[[f32; N]; 3],
    ) -> [[f32; N]; 3] {
        let has_two_sides = draw.material.double_sided;
        let (mut places, mut faces) = ([[0.0; N]; 3], [[0.0; N]; 3]);
        // Backs of surfaces with one side are never drawn, and need not be told from fronts.
        if has_two_sides || !draw.smooth || self.lights.iter().any(Light::is_near) {
            let carried = draw.places(corners);
            places = blend(&carried, weights);
            faces = draw.face_normals(&carried);
        }
        let mut normals = draw.front_normals(corners, weights, &faces);
        if has_two_sides {
            let viewer = <[f64; 4]>::from(self.viewer).map(|c| c as f32);
            turn_to_viewer(&mut normals, &faces, &places, viewer);
        }
        let mut sums = [[0.0; N]; 3];
        for light in self.lights {
            light.illuminate(&places, &normals, &mut sums);
        }
        for sum in &mut sums {
            for illuminance in sum {
                *illuminance *= std::f32::consts::FRAC_1_PI;
            }
        }
        sums
    }
}

impl Draw<'_> {
    /// Whether light falls on it: unlit materials, lines and points show their colour as it is.
    pub(crate) fn is_lit(&self) -> bool {
        !self.material.unlit && self.primitive.topology == Topology::Triangles
    }

    /// The base colour with alpha, if that counts: factor × texture × vertex colour, linear (glTF 2.0 §3.9.2). And the light
    /// that the surface gives off by itself, if that counts (§3.9.3): none where the base colour is all there is to see.
    #[inline(always)]
    fn own_colors<const N: usize>(
        &self,
        corners: &Corners<N>,
        seen: &impl Seen<N>,
        alpha_counts: bool,
        emission_counts: bool,
    ) -> ([[f32; N]; 4], [[f32; N]; 3]) {
        let Material { base_color, emissive, unlit, .. } = self.material;
        let emits = emission_counts && !*unlit && *emissive != [0.0; 3];
        let mut base = in_all(*base_color);
        let mut emitted = in_all(if emits { *emissive } else { [0.0; 3] });
        if let Some(colors) = &self.colors {
            scale(&mut base, &blend::<N, 4>(&corners.carried(colors, 0), &seen.weights()));
        }
        let textures = [
            (self.base_color_texture, &self.material.base_color_texture),
            (self.emissive_texture.filter(|_| emits), &self.material.emissive_texture),
        ];
        for (slot, (chain, used)) in textures.into_iter().enumerate() {
            let (Some(chain), Some(used)) = (chain, used) else { continue };
            let uvs = self.uvs(corners, seen, used, chain.wants_derivatives());
            let texels = chain.sample(&uvs, alpha_counts && slot == 0);
            scale(if slot == 0 { &mut base[..] } else { &mut emitted[..] }, &texels);
        }
        (base, emitted)
    }
}
