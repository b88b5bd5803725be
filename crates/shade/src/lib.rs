//! Shading: the colour of a fragment, from its material and the lights.
//!
//! Materials are those of glTF: metallic-roughness with its extensions (`substance`, `inputs`). Lights are in photometric
//! units: a white matt surface that faces a sun of π lux shows 1. All sums are in linear light.

#![allow(clippy::needless_range_loop, reason = "lanes of several arrays are walked side by side")]

mod albedo;
pub mod color;
mod corners;
mod develop;
mod draw;
mod environment;
mod fibres;
mod ground;
mod inputs;
mod layers;
mod light;
mod maps;
mod microfacet;
mod normal;
mod occlusion;
mod output;
mod painting;
mod picture;
mod receiver;
mod reflection;
mod seen;
mod shadow;
mod styled;
mod substance;
mod surroundings;
mod texture;
mod transmission;

pub use corners::Vertex;
pub use corners::{NORMAL, PLACE, UV};
pub use develop::{Develop, ToneMapping};
pub use draw::{Draw, DrawList, Role, Tangents};
pub use environment::Environment;
pub use light::Light;
pub use maps::{Map, Maps};
pub use occlusion::ScreenSpace;
pub use output::{Draft, OutputError, PngRows, encode_png, write_file};
pub use painting::{Fit, Gradient, Painting, Photo};
pub use picture::{Channel, Picture};
pub use shadow::{Shadow, ShadowMap};
pub use styled::{Look, Styled};
pub use surroundings::{Sky, studio};
pub use texture::{MipChain, Texels};

use corners::{Items, blend};
use homog::{HPoint, World};
use inputs::Inputs;
use model::{AlphaMode, Topology};
use normal::{Facing, seen_from_behind, turn, views};
use raster::{Eight, Fragment, Fragments, Instructions, Surface, WIDE, Work};
use receiver::Receivers;
use reflection::Reflection;
use seen::{Seen, Wide, scale};
use transmission::ThroughEight;

/// What the fragments of a frame are shaded with.
#[derive(Debug)]
pub struct Shading<'a> {
    /// What is painted behind everything, if something is.
    pub painting: Option<&'a Painting>,
    /// What was drawn.
    pub draws: &'a DrawList<'a>,
    /// The lights, in the world.
    pub lights: &'a [Light],
    /// What the lights see, one after the other, as far as they cast shadows; nothing where none does.
    pub shadows: &'a [Option<ShadowMap>],
    /// What is in the way of light from all around; nothing unless it is asked for.
    pub occlusion: Option<&'a ScreenSpace>,
    /// Light from all around.
    pub environment: Option<&'a Environment>,
    /// How light becomes colours.
    pub develop: Develop,
    /// Where the viewer is: the eye, or in parallel projection the direction towards it, at infinity.
    pub viewer: HPoint<World>,
    /// The instructions that eight fragments at once are shaded with.
    pub instructions: Instructions,
}

impl Surface for Shading<'_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.draws.keeps(fragment)
    }

    fn keeps_eight(&self, fragments: &Fragments<'_>) -> [bool; WIDE] {
        self.draws.keeps_eight(fragments, self.instructions)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.draws.of(fragment.id);
        let colors = self.colors(draw, &draw.items(&[fragment.id], true), fragment);
        colors.map(|[color]| color)
    }

    fn shade_eight(&self, fragments: &Fragments<'_>) -> [Eight; 4] {
        self.instructions.run(ShadeEight { shading: self, fragments })
    }

    fn through_eight(&self, fragments: &Fragments<'_>, alphas: &Eight) -> [Eight; 3] {
        self.instructions.run(ThroughEight { shading: self, fragments, alphas })
    }
}

/// The question whether eight fragments of one masked primitive are there.
struct KeepEight<'a> {
    draws: &'a DrawList<'a>,
    fragments: &'a Fragments<'a>,
}

impl Work for KeepEight<'_> {
    type Output = [bool; WIDE];

    #[inline(always)]
    fn run(self) -> [bool; WIDE] {
        let id = self.fragments.id(0);
        let (draw, _) = self.draws.of(id);
        draw.keeps(&draw.items(&[id; WIDE], true), &Wide::new(self.fragments))
    }
}

impl DrawList<'_> {
    /// Whether a masked primitive is there in a fragment.
    pub fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        let (draw, _) = self.of(fragment.id);
        let [keeps] = draw.keeps(&draw.items(&[fragment.id], true), fragment);
        keeps
    }

    /// The same for eight fragments of one primitive.
    pub fn keeps_eight(
        &self,
        fragments: &Fragments<'_>,
        instructions: Instructions,
    ) -> [bool; WIDE] {
        instructions.run(KeepEight { draws: self, fragments })
    }

    /// The draw of one of eight fragments, the names of those that are of it, and which these are. The others, which have the first one's
    /// name, are shaded as if they were of its primitive, and not looked at.
    #[inline(always)]
    fn lanes_of(
        &self,
        fragments: &Fragments<'_>,
        first: usize,
    ) -> (&Draw<'_>, [u32; WIDE], [bool; WIDE]) {
        let name = fragments.id(first);
        let (draw, end) = self.of(name);
        let (mut ids, mut own) = ([name; WIDE], [true; WIDE]);
        if !fragments.are_of_one() {
            for lane in 0..WIDE {
                let id = fragments.id(lane);
                own[lane] = (draw.first_id..end).contains(&id);
                ids[lane] = if own[lane] { id } else { name };
            }
        }
        (draw, ids, own)
    }
}

/// The shading of eight fragments.
struct ShadeEight<'a> {
    shading: &'a Shading<'a>,
    fragments: &'a Fragments<'a>,
}

impl Work for ShadeEight<'_> {
    type Output = [Eight; 4];

    #[inline(always)]
    fn run(self) -> [Eight; 4] {
        let Self { shading, fragments } = self;
        let wide = Wide::new(fragments);
        let is_one = fragments.are_of_one();
        let mut colors = [[0.0; WIDE]; 4];
        let mut done = [false; WIDE];
        // One draw after the other: most often there is only one.
        while let Some(first) = done.iter().position(|&is_done| !is_done) {
            let (draw, ids, own) = shading.draws.lanes_of(fragments, first);
            let of_draw = shading.colors(draw, &draw.items(&ids, is_one), &wide);
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
        items: &Items<N>,
        seen: &impl Seen<N>,
    ) -> [[f32; N]; 4] {
        match draw.role {
            Role::Surface => {}
            Role::Backdrop(blur) => return self.backdrop(draw, items, seen, blur),
            Role::Painting => return self.painted(draw, items, seen),
            Role::Ground => return self.ground(draw, items, seen),
        }
        let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
        let mut inputs = Inputs::of(draw, &draw.corners(items), seen);
        let mut sums = inputs.emitted;
        let mut passing = [0.0; N];
        if draw.is_lit() {
            passing = self.add_reflected(draw, items, seen, &mut inputs, &mut sums);
        } else {
            for (sum, color) in sums.iter_mut().zip(&inputs.base) {
                for lane in 0..N {
                    sum[lane] += color[lane];
                }
            }
        }
        self.develop.apply(&mut sums);
        let [r, g, b] = sums;
        let mut colors = [r, g, b, inputs.base[3]];
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
        if draw.material.transmits() {
            for lane in 0..N {
                alpha[lane] *= 1.0 - passing[lane];
            }
        }
        colors
    }

    /// The environment behind everything.
    #[inline(always)]
    fn backdrop<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &Items<N>,
        seen: &impl Seen<N>,
        blur: f32,
    ) -> [[f32; N]; 4] {
        let places = blend(&draw.places(&draw.corners(items)), &seen.weights());
        let mut ways = views(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
        let mut colors = [[0.0; N]; 3];
        if let Some(environment) = self.environment {
            turn(&mut ways, &[true; N]);
            colors = environment.blurred(&ways, &[blur; N]);
        }
        self.develop.apply(&mut colors);
        let [r, g, b] = colors;
        [r, g, b, [1.0; N]]
    }

    /// What is painted behind everything.
    #[inline(always)]
    fn painted<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &Items<N>,
        seen: &impl Seen<N>,
    ) -> [[f32; N]; 4] {
        let [x, y, _] = blend(&draw.places(&draw.corners(items)), &seen.weights());
        let mut colors = [[0.0; N]; 4];
        for lane in 0..N {
            let color = self.painting.map_or([0.0; 4], |all| all.color([x[lane], y[lane]]));
            for channel in 0..4 {
                colors[channel][lane] = color[channel];
            }
        }
        colors
    }

    /// Adds the light that surfaces reflect to the viewer, and returns the share of light that they let pass.
    #[inline(always)]
    fn add_reflected<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &Items<N>,
        seen: &impl Seen<N>,
        inputs: &mut Inputs<N>,
        sums: &mut [[f32; N]; 3],
    ) -> [f32; N] {
        let facing = self.facing(draw, items, seen);
        if let Some(occlusion) = self.occlusion {
            let open = occlusion.open(&facing.places, &facing.normals, &facing.views);
            scale(std::slice::from_mut(&mut inputs.occlusion), &[open]);
        }
        let tangents = draw.tangents(items, &seen.weights());
        let mut receivers = None;
        if !self.shadows.is_empty() {
            receivers = Some(Receivers::of(draw, &draw.corners(items), seen, &facing));
        }
        let mut reflection = Reflection::of(draw, inputs, facing, &tangents, *sums);
        reflection.add_lights(self.lights, self.shadows, receivers.as_ref());
        if let Some(environment) = self.environment {
            reflection.add_environment(environment);
        }
        *sums = reflection.whole();
        reflection.passing
    }

    /// How the surfaces lie to the viewer, without their slopes.
    #[inline(always)]
    fn facing<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &Items<N>,
        seen: &impl Seen<N>,
    ) -> Facing<N> {
        let weights = &seen.weights();
        let corners = draw.corners(items);
        let carried = draw.places(&corners);
        let places = blend(&carried, weights);
        let views = views(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
        let has_two_sides = draw.material.double_sided;
        // Backs of surfaces with one side are never drawn, and need not be told from fronts.
        let mut faces = [[0.0; N]; 3];
        if has_two_sides || !draw.smooth {
            faces = draw.face_normals(&carried);
        }
        let (mut normals, turns) = draw.front_normals(&corners, seen, &faces);
        let mut is_back = [false; N];
        if has_two_sides {
            is_back = seen_from_behind(&faces, &views);
            turn(&mut normals, &is_back);
        }
        Facing::of(places, views, normals, is_back, turns)
    }
}

impl Draw<'_> {
    /// Whether light falls on it: unlit materials, lines and points show their colour as it is.
    pub fn is_lit(&self) -> bool {
        !self.material.unlit && self.primitive.topology == Topology::Triangles
    }

    /// Whether fragments of a masked primitive are there.
    #[inline(always)]
    fn keeps<const N: usize>(&self, items: &Items<N>, seen: &impl Seen<N>) -> [bool; N] {
        let mut keeps = [true; N];
        if let AlphaMode::Mask { cutoff } = self.material.alpha_mode {
            let alpha = self.alpha(items, seen);
            for lane in 0..N {
                keeps[lane] = alpha[lane] >= cutoff;
            }
        }
        keeps
    }

    /// The alpha of fragments: factor × texture × vertex colour (glTF 2.0 §3.9.4).
    #[inline(always)]
    fn alpha<const N: usize>(&self, items: &Items<N>, seen: &impl Seen<N>) -> [f32; N] {
        let corners = self.corners(items);
        let mut alpha = [[self.material.base_color[3]; N]];
        if let Some(colors) = &self.colors {
            scale(&mut alpha, &blend::<N, 1>(&corners.carried(colors, 3), &seen.weights()));
        }
        if let Some(map) = self.maps.of_base_color() {
            let uvs = self.uvs(&corners, seen, &map.used);
            let [_, _, _, texel] = map.chain.sample(&uvs, true, self.maps.anisotropy);
            scale(&mut alpha, &[texel]);
        }
        let [alpha] = alpha;
        alpha
    }
}
