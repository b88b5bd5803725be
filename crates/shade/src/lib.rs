//! Shading: the colour of a fragment, from its material and the lights.
//!
//! Materials are those of glTF: metallic-roughness with its extensions (`substance`, `inputs`). Lights are in photometric
//! units: a white matt surface that faces a sun of π lux shows 1. All sums are in linear light.

#![allow(clippy::needless_range_loop, reason = "lanes of several arrays are walked side by side")]

mod ambient_occlusion;
mod attributes;
mod backdrop;
mod base_brdf;
pub mod color;
mod directional_albedo;
mod draw;
mod environment;
mod fragment_lanes;
mod layered_brdf;
mod layers;
mod light;
mod material_inputs;
mod material_textures;
mod microfacet;
mod output;
mod picture;
mod procedural_sky;
mod shading_style;
mod shadow_catcher;
mod shadow_map;
mod shadow_receiver;
mod sheen;
mod surface_geometry;
mod texture;
mod tone_mapping;
mod transmission;

pub use ambient_occlusion::AmbientOcclusion;
pub use attributes::Vertex;
pub use attributes::{NORMAL, POSITION, UV};
pub use backdrop::{Backdrop, BackdropImage, Gradient, ImageFit};
pub use draw::{Draw, DrawKind, DrawList, Tangents};
pub use environment::Environment;
pub use light::Light;
pub use material_textures::{MaterialTexture, MaterialTextures};
pub use output::{AtomicFile, OutputError, PngRows, encode_png, write_file};
pub use picture::{Channel, Picture};
pub use procedural_sky::{PreethamSky, studio_radiance};
pub use shading_style::{ShadingStyle, StyledShading};
pub use shadow_map::{Shadow, ShadowMap};
pub use texture::{MipChain, TexelEncoding};
pub use tone_mapping::{ToneMapper, ToneMapping};

use attributes::{PrimitiveIndices, interpolate};
use fragment_lanes::{FragmentLanes, FragmentPacket, scale_channels};
use homog::{HPoint, World};
use layered_brdf::LayeredBrdf;
use material_inputs::MaterialInputs;
use model::{AlphaMode, Topology};
use raster::{F32x8, Fragment, Fragments, Kernel, LANES, SimdLevel, Surface};
use shadow_receiver::ShadowReceiver;
use surface_geometry::{SurfaceGeometry, find_back_faces, flip_vectors, view_directions};
use transmission::TransmitEight;

/// What the fragments of a frame are shaded with.
#[derive(Debug)]
pub struct Shading<'a> {
    /// What is painted behind everything, if something is.
    pub backdrop: Option<&'a Backdrop>,
    /// What was drawn.
    pub draws: &'a DrawList<'a>,
    /// The lights, in the world.
    pub lights: &'a [Light],
    /// What the lights see, one after the other, as far as they cast shadows; nothing where none does.
    pub shadows: &'a [Option<ShadowMap>],
    /// What is in the way of light from all around; nothing unless it is asked for.
    pub occlusion: Option<&'a AmbientOcclusion>,
    /// Light from all around.
    pub environment: Option<&'a Environment>,
    /// How light becomes colours.
    pub tone_mapper: ToneMapper,
    /// Where the viewer is: the eye, or in parallel projection the direction towards it, at infinity.
    pub viewer: HPoint<World>,
    /// The instructions that eight fragments at once are shaded with.
    pub simd_level: SimdLevel,
}

impl Surface for Shading<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.draws.passes_alpha_test(fragment)
    }

    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        self.draws.passes_alpha_test_eight(fragments, self.simd_level)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.draws.find_draw(fragment.id);
        let colors =
            self.shade_lanes(draw, &draw.primitive_indices(&[fragment.id], true), fragment);
        colors.map(|[color]| color)
    }

    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        self.simd_level.run_kernel(ShadeEight { shading: self, fragments })
    }

    fn transmittance_eight(&self, fragments: &Fragments<'_>, alphas: &F32x8) -> [F32x8; 3] {
        self.simd_level.run_kernel(TransmitEight { shading: self, fragments, alphas })
    }
}

/// The question whether eight fragments of one masked primitive are there.
struct AlphaTestEight<'a> {
    draws: &'a DrawList<'a>,
    fragments: &'a Fragments<'a>,
}

impl Kernel for AlphaTestEight<'_> {
    type Output = [bool; LANES];

    #[inline(always)]
    fn run(self) -> [bool; LANES] {
        let id = self.fragments.id(0);
        let (draw, _) = self.draws.find_draw(id);
        draw.passes_alpha_test(
            &draw.primitive_indices(&[id; LANES], true),
            &FragmentPacket::new(self.fragments),
        )
    }
}

impl DrawList<'_> {
    /// Whether a masked primitive is there in a fragment.
    pub fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        let (draw, _) = self.find_draw(fragment.id);
        let [keeps] =
            draw.passes_alpha_test(&draw.primitive_indices(&[fragment.id], true), fragment);
        keeps
    }

    /// The same for eight fragments of one primitive.
    pub fn passes_alpha_test_eight(
        &self,
        fragments: &Fragments<'_>,
        instructions: SimdLevel,
    ) -> [bool; LANES] {
        instructions.run_kernel(AlphaTestEight { draws: self, fragments })
    }

    /// The draw of one of eight fragments, the names of those that are of it, and which these are. The others, which have the first one's
    /// name, are shaded as if they were of its primitive, and not looked at.
    #[inline(always)]
    fn select_draw_lanes(
        &self,
        fragments: &Fragments<'_>,
        first: usize,
    ) -> (&Draw<'_>, [u32; LANES], [bool; LANES]) {
        let name = fragments.id(first);
        let (draw, end) = self.find_draw(name);
        let (mut ids, mut own) = ([name; LANES], [true; LANES]);
        if !fragments.is_single_primitive() {
            for lane in 0..LANES {
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

impl Kernel for ShadeEight<'_> {
    type Output = [F32x8; 4];

    #[inline(always)]
    fn run(self) -> [F32x8; 4] {
        let Self { shading, fragments } = self;
        let wide = FragmentPacket::new(fragments);
        let is_one = fragments.is_single_primitive();
        let mut colors = [[0.0; LANES]; 4];
        let mut done = [false; LANES];
        // One draw after the other: most often there is only one.
        while let Some(first) = done.iter().position(|&is_done| !is_done) {
            let (draw, ids, own) = shading.draws.select_draw_lanes(fragments, first);
            let of_draw = shading.shade_lanes(draw, &draw.primitive_indices(&ids, is_one), &wide);
            for (color, of_draw) in colors.iter_mut().zip(&of_draw) {
                for lane in 0..LANES {
                    color[lane] = if own[lane] { of_draw[lane] } else { color[lane] };
                }
            }
            for lane in 0..LANES {
                done[lane] |= own[lane];
            }
        }
        colors
    }
}

impl Shading<'_> {
    /// The colours of fragments of one draw, multiplied by alpha.
    #[inline(always)]
    fn shade_lanes<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> [[f32; N]; 4] {
        match draw.kind {
            DrawKind::Surface => {}
            DrawKind::Environment(blur) => {
                return self.shade_environment_backdrop(draw, items, seen, blur);
            }
            DrawKind::Backdrop => return self.shade_backdrop(draw, items, seen),
            DrawKind::ShadowCatcher => return self.shade_shadow_catcher(draw, items, seen),
        }
        let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
        let mut inputs = MaterialInputs::evaluate(draw, &draw.vertex_indices(items), seen);
        let mut sums = inputs.emitted;
        let mut passing = [0.0; N];
        if draw.is_lit() {
            passing = self.add_reflected_light(draw, items, seen, &mut inputs, &mut sums);
        } else {
            for (sum, color) in sums.iter_mut().zip(&inputs.base) {
                for lane in 0..N {
                    sum[lane] += color[lane];
                }
            }
        }
        self.tone_mapper.map_colors(&mut sums);
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
        if draw.material.is_transmissive() {
            for lane in 0..N {
                alpha[lane] *= 1.0 - passing[lane];
            }
        }
        colors
    }

    /// The environment behind everything.
    #[inline(always)]
    fn shade_environment_backdrop<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
        blur: f32,
    ) -> [[f32; N]; 4] {
        let places =
            interpolate(&draw.vertex_positions(&draw.vertex_indices(items)), &seen.weights());
        let mut ways = view_directions(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
        let mut colors = [[0.0; N]; 3];
        if let Some(environment) = self.environment {
            flip_vectors(&mut ways, &[true; N]);
            colors = environment.prefiltered_radiance(&ways, &[blur; N]);
        }
        self.tone_mapper.map_colors(&mut colors);
        let [r, g, b] = colors;
        [r, g, b, [1.0; N]]
    }

    /// What is painted behind everything.
    #[inline(always)]
    fn shade_backdrop<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> [[f32; N]; 4] {
        let [x, y, _] =
            interpolate(&draw.vertex_positions(&draw.vertex_indices(items)), &seen.weights());
        let mut colors = [[0.0; N]; 4];
        for lane in 0..N {
            let color = self.backdrop.map_or([0.0; 4], |all| all.color_at([x[lane], y[lane]]));
            for channel in 0..4 {
                colors[channel][lane] = color[channel];
            }
        }
        colors
    }

    /// Adds the light that surfaces reflect to the viewer, and returns the share of light that they let pass.
    #[inline(always)]
    fn add_reflected_light<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
        inputs: &mut MaterialInputs<N>,
        sums: &mut [[f32; N]; 3],
    ) -> [f32; N] {
        let facing = self.surface_geometry(draw, items, seen);
        if let Some(occlusion) = self.occlusion {
            let open = occlusion.visibility(&facing.positions, &facing.normals, &facing.views);
            scale_channels(std::slice::from_mut(&mut inputs.occlusion), &[open]);
        }
        let tangents = draw.interpolate_tangents(items, &seen.weights());
        let mut receivers = None;
        if !self.shadows.is_empty() {
            receivers = Some(ShadowReceiver::from_geometry(
                draw,
                &draw.vertex_indices(items),
                seen,
                &facing,
            ));
        }
        let mut reflection = LayeredBrdf::new(draw, inputs, facing, &tangents, *sums);
        reflection.add_lights(self.lights, self.shadows, receivers.as_ref());
        if let Some(environment) = self.environment {
            reflection.add_environment(environment);
        }
        *sums = reflection.finish();
        reflection.transmittance
    }

    /// How the surfaces lie to the viewer, without their slopes.
    #[inline(always)]
    fn surface_geometry<const N: usize>(
        &self,
        draw: &Draw<'_>,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> SurfaceGeometry<N> {
        let weights = &seen.weights();
        let corners = draw.vertex_indices(items);
        let carried = draw.vertex_positions(&corners);
        let places = interpolate(&carried, weights);
        let views = view_directions(&places, <[f64; 4]>::from(self.viewer).map(|c| c as f32));
        let has_two_sides = draw.material.double_sided;
        // Backs of surfaces with one side are never drawn, and need not be told from fronts.
        let mut faces = [[0.0; N]; 3];
        if has_two_sides || !draw.is_smooth {
            faces = draw.face_normals(&carried);
        }
        let (mut normals, turns) = draw.interpolate_normals(&corners, seen, &faces);
        let mut is_back = [false; N];
        if has_two_sides {
            is_back = find_back_faces(&faces, &views);
            flip_vectors(&mut normals, &is_back);
        }
        SurfaceGeometry::new(places, views, normals, is_back, turns)
    }
}

impl Draw<'_> {
    /// Whether light falls on it: unlit materials, lines and points show their colour as it is.
    pub fn is_lit(&self) -> bool {
        !self.material.unlit && self.primitive.topology == Topology::Triangles
    }

    /// Whether fragments of a masked primitive are there.
    #[inline(always)]
    fn passes_alpha_test<const N: usize>(
        &self,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> [bool; N] {
        let mut keeps = [true; N];
        if let AlphaMode::Mask { cutoff } = self.material.alpha_mode {
            let alpha = self.sample_alpha(items, seen);
            for lane in 0..N {
                keeps[lane] = alpha[lane] >= cutoff;
            }
        }
        keeps
    }

    /// The alpha of fragments: factor × texture × vertex colour (glTF 2.0 §3.9.4).
    #[inline(always)]
    fn sample_alpha<const N: usize>(
        &self,
        items: &PrimitiveIndices<N>,
        seen: &impl FragmentLanes<N>,
    ) -> [f32; N] {
        let corners = self.vertex_indices(items);
        let mut alpha = [[self.material.base_color[3]; N]];
        if let Some(colors) = &self.colors {
            scale_channels(
                &mut alpha,
                &interpolate::<N, 1>(&corners.fetch_attributes(colors, 3), &seen.weights()),
            );
        }
        if let Some(map) = self.textures.base_color() {
            let uvs = self.texture_coordinates(&corners, seen, &map.usage);
            let [_, _, _, texel] = map.mip_chain.sample(&uvs, true, self.textures.anisotropy);
            scale_channels(&mut alpha, &[texel]);
        }
        let [alpha] = alpha;
        alpha
    }
}
