//! Deferred shading of a visibility buffer: from primitive ids and barycentric weights to colors.
//!
//! ```text
//!  fragments ─► draw call ─► attributes ─► surface geometry ─┐
//!  (ids and      by id       of vertices   (normals, views)  ├─► layered BRDF ─► tone mapping
//!   weights)                 textures ───► material inputs ──┤   lights, shadows
//!                                                            └   environment, occlusion
//! ```
//!
//! The rasterizer requests the colors of eight fragments at once from [`Shading`]. If these belong
//! to several draws, all eight are shaded for one draw after another, and each lane takes the color
//! of its draw. Shading runs after visibility, so its cost does not grow with the number of hidden
//! triangles.

use super::ambient_occlusion::AmbientOcclusion;
use super::attributes::{PrimitiveIndices, interpolate};
use super::brdf::LayeredBrdf;
use super::fragment_lanes::{FragmentLanes, FragmentPacket};
use super::lanes::{Lanes, Mask, Rgb, Vec3Lanes};
use super::material_inputs::MaterialInputs;
use super::shadow_receiver::ShadowReceiver;
use super::surface_geometry::{SurfaceGeometry, find_back_faces, flip_vectors, view_directions};
use super::transmission::{TransmissionFramebuffer, TransmittedShare};
use super::{
    Backdrop, Draw, DrawKind, DrawList, Environment, GroundOcclusion, Light, LightShadow,
    ToneMapper,
};
use crate::kernel_part::kernel_part;
use homog::{HPoint, World};
use model::{AlphaMode, Topology};
use raster::{
    F32x8, Fragment, Fragments, Kernel, LANES, SimdLevel, Surface, TranslucentColors, shade_each,
};

/// The draws, lights and settings for shading the fragments of a frame.
#[derive(Debug)]
pub struct Shading<'a> {
    /// The backdrop behind everything, if any.
    pub backdrop: Option<&'a Backdrop>,
    /// The draw calls of the frame.
    pub draws: &'a DrawList<'a>,
    /// The lights in the world.
    pub lights: &'a [Light],
    /// The shadow maps of the first lights in order, with `None` for lights without shadows.
    pub shadows: &'a [Option<LightShadow>],
    /// The occlusion of the ground by the models, if there is a ground that shows shadows.
    pub ground_occlusion: Option<&'a GroundOcclusion>,
    /// Screen-space ambient occlusion, if it is enabled.
    pub occlusion: Option<&'a AmbientOcclusion>,
    /// The picture of the surfaces behind refracting and rough glass. Without it, such glass is
    /// drawn like a smooth thin sheet.
    pub transmission_framebuffer: Option<&'a TransmissionFramebuffer>,
    /// The environment for image-based lighting, if any.
    pub environment: Option<&'a Environment>,
    /// The exposure and tone curve.
    pub tone_mapper: ToneMapper,
    /// The viewer: the eye or, in parallel projection, the direction toward it as a point at
    /// infinity.
    pub viewer: HPoint<World>,
    /// Whether the picture has 8 bits per channel, so that a smooth sky must be dithered to hide
    /// steps.
    pub has_eight_bits: bool,
    /// The vector instructions for shading eight fragments at once.
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
        self.shade_one(fragment).color.map(|channel| channel[0])
    }

    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let kernel = ShadeEight { shading: self, fragments, transmittance: None };
        let colors = self.simd_level.run_wide_kernel(kernel);
        colors.unwrap_or_else(|| shade_each(fragments, |fragment| self.shade(fragment)))
    }

    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        self.draws.is_continuous(first_id, second_id)
    }

    fn shade_translucent_eight(&self, fragments: &Fragments<'_>) -> TranslucentColors {
        let mut transmittance = Default::default();
        let kernel =
            ShadeEight { shading: self, fragments, transmittance: Some(&mut transmittance) };
        let color = self.simd_level.run_wide_kernel(kernel);
        let color = color.unwrap_or_else(|| {
            let (weights, mut color) = (fragments.weights(), [[0.0; LANES]; 4]);
            for lane in 0..LANES {
                let shaded = self.shade_one(&fragments.fragment(lane, &weights));
                let channels = color.iter_mut().chain(&mut transmittance);
                for (channel, one) in channels.zip(shaded.color.iter().chain(&shaded.transmittance))
                {
                    channel[lane] = one[0];
                }
            }
            color
        });
        TranslucentColors { color, transmittance }
    }
}

/// The fragments of a packet that belong to one draw.
pub(super) struct DrawSelection<'a> {
    /// The draw of the selected lanes.
    pub(super) draw: &'a Draw<'a>,
    /// The ids of the fragments' primitives. Lanes of other draws repeat the first fragment's id,
    /// and their results are ignored.
    pub(super) ids: [u32; LANES],
    /// The lanes of this draw.
    pub(super) mask: Mask<LANES>,
}

impl<'d> DrawList<'d> {
    /// Calls `shade` for each draw that eight fragments belong to, with the indices of their
    /// primitives and the lanes of the draw. Usually there is only one draw.
    #[inline(always)]
    pub(super) fn for_each_draw(
        &self,
        fragments: &Fragments<'_>,
        mut shade: impl FnMut(&Draw<'_>, &PrimitiveIndices<LANES>, &Mask<LANES>),
    ) {
        let mut is_done = [false; LANES];
        while let Some(first) = is_done.iter().position(|&is_done| !is_done) {
            let DrawSelection { draw, ids, mask } = self.select_draw_lanes(fragments, first);
            let primitives = draw.primitive_indices(&ids, fragments.is_single_primitive());
            shade(draw, &primitives, &mask);
            for (is_done, is_own) in is_done.iter_mut().zip(mask) {
                *is_done |= is_own;
            }
        }
    }

    /// Selects the draw of one lane, and all lanes that belong to the same draw.
    ///
    /// The material, textures and flags are then uniform across the lanes, so they do not need to
    /// be selected per lane.
    #[inline(always)]
    pub(super) fn select_draw_lanes(
        &self,
        fragments: &Fragments<'_>,
        first: usize,
    ) -> DrawSelection<'_> {
        let first_id = fragments.id(first);
        let (draw, end) = self.find_draw(first_id);
        let (mut ids, mut mask) = ([first_id; LANES], [true; LANES]);
        if !fragments.is_single_primitive() {
            for (lane, (id, is_own)) in ids.iter_mut().zip(&mut mask).enumerate() {
                let lane_id = fragments.id(lane);
                *is_own = (draw.first_id..end).contains(&lane_id);
                *id = if *is_own { lane_id } else { first_id };
            }
        }
        DrawSelection { draw, ids, mask }
    }
}

/// The kernel that shades eight fragments, compiled once per SIMD level.
struct ShadeEight<'a> {
    shading: &'a Shading<'a>,
    fragments: &'a Fragments<'a>,
    /// The transmittances of red, green and blue, for fragments that may be translucent.
    transmittance: Option<&'a mut [F32x8; 3]>,
}

impl Kernel for ShadeEight<'_> {
    type Output = [F32x8; 4];

    #[inline(always)]
    fn run(mut self) -> [F32x8; 4] {
        let Self { shading, fragments, .. } = self;
        let packet = FragmentPacket::new(fragments);
        let mut colors = [Lanes::ZERO; 4];
        shading.draws.for_each_draw(
            fragments,
            #[inline(always)]
            |draw, primitives, mask| {
                let shaded = shading.shade_lanes(draw, primitives, &packet);
                for (channel, draw_channel) in colors.iter_mut().zip(shaded.color) {
                    *channel = draw_channel.select(mask, *channel);
                }
                if let Some(transmittance) = &mut self.transmittance {
                    for (channel, draw_channel) in
                        transmittance.iter_mut().zip(shaded.transmittance)
                    {
                        *channel = draw_channel.select(mask, Lanes(*channel)).0;
                    }
                }
            },
        );
        colors.map(|channel| channel.0)
    }
}

/// Shaded fragments: the color premultiplied by alpha, alpha, and the transmittance of each
/// channel.
struct ShadedLanes<const N: usize> {
    color: [Lanes<N>; 4],
    transmittance: [Lanes<N>; 3],
}

impl<const N: usize> ShadedLanes<N> {
    /// Returns a color that lets through 1 − alpha in each channel (the "over" operator).
    #[inline(always)]
    fn over(color: [Lanes<N>; 4]) -> Self {
        Self { color, transmittance: [1.0 - color[3]; 3] }
    }
}

/// The light that a surface sends to the viewer.
struct SurfaceLight<const N: usize> {
    /// The emitted, reflected and refracted radiance.
    radiance: Rgb<N>,
    /// The share of light that passes through from behind, if the material transmits any.
    transmission: Option<TransmittedShare<N>>,
    /// The display color that refracting or rough glass adds after tone mapping, and the alpha
    /// behind it.
    behind: Option<(Rgb<N>, Lanes<N>)>,
}

impl Shading<'_> {
    /// Shades a single fragment, with the same bits as in a packet of eight.
    #[inline(never)]
    fn shade_one(&self, fragment: &Fragment<'_>) -> ShadedLanes<1> {
        let (draw, _) = self.draws.find_draw(fragment.id);
        let primitive = draw.primitive_indices(&[fragment.id], true);
        self.shade_lanes(draw, &primitive, fragment)
    }

    /// Shades fragments of one draw.
    #[inline(always)]
    fn shade_lanes<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> ShadedLanes<N> {
        ShadedLanes::over(match draw.kind {
            DrawKind::Surface => return self.shade_surface(draw, primitives, fragments),
            DrawKind::Environment(blur) => kernel_part!(
                N,
                self.shade_environment_background(draw, primitives, fragments, blur)
            ),
            DrawKind::Backdrop => {
                kernel_part!(N, self.shade_backdrop(draw, primitives, fragments))
            }
            DrawKind::ShadowCatcher => {
                kernel_part!(N, self.shade_shadow_catcher(draw, primitives, fragments))
            }
        })
    }

    /// Computes the colors of a model's surfaces: tone mapped emitted and reflected light.
    ///
    /// Unlit materials, lines and points show only emission and base color. Alpha is the coverage
    /// if the material blends, and 1 otherwise. The transmitted part is subtracted from it, so that
    /// blending lets the background through.
    #[inline(always)]
    fn shade_surface<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> ShadedLanes<N> {
        // The material: factors times textures.
        let vertices = draw.vertex_indices(primitives);
        let mut inputs = MaterialInputs::evaluate(draw, &vertices, fragments);
        // The rendering equation: emitted, reflected and transmitted radiance.
        let SurfaceLight { radiance, transmission, behind } = if draw.is_lit() {
            self.light_surface(draw, primitives, fragments, &mut inputs)
        } else {
            let radiance = inputs.emitted + inputs.base_color;
            SurfaceLight { radiance, transmission: None, behind: None }
        };
        // Display: exposure and tone curve, then premultiplied alpha. Unlit colors are already
        // display colors (KHR_materials_unlit), so they are only exposed.
        let mut color = if draw.is_lit() {
            self.tone_mapper.map_colors(radiance)
        } else {
            radiance * self.tone_mapper.exposure
        };
        if let Some((display, _)) = behind {
            color += display;
        }
        let mut coverage = Lanes::ONE;
        if draw.material.alpha_mode == AlphaMode::Blend {
            coverage = inputs.alpha;
            color = color * coverage;
        }
        let Rgb { r, g, b } = color;
        let Some(share) = transmission else {
            return ShadedLanes::over([r, g, b, coverage]);
        };
        // The background shines through, in addition to the light from the surface itself.
        let mut alpha = coverage * (1.0 - share.gray());
        let mut transmittance = share.channel_transmittances(coverage, alpha);
        if let Some((_, alpha_behind)) = behind {
            // The background is already part of the color, with its own opacity.
            alpha = coverage - (coverage - alpha) * (1.0 - alpha_behind);
            transmittance = [1.0 - coverage; 3];
        }
        ShadedLanes { color: [r, g, b, alpha], transmittance }
    }

    /// Returns the framebuffer that shows the objects behind a draw, if it is needed.
    #[inline(always)]
    fn framebuffer_behind(&self, draw: &Draw<'_>) -> Option<&TransmissionFramebuffer> {
        self.transmission_framebuffer.filter(|_| draw.material.bends_transmitted_light())
    }

    /// Computes the backdrop, without tone mapping, at fragments whose positions are fractions of
    /// the picture.
    #[inline(always)]
    fn shade_backdrop<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> [Lanes<N>; 4] {
        let vertices = draw.vertex_indices(primitives);
        let Vec3Lanes { x, y, .. } = draw.interpolate_positions(&vertices, fragments);
        let mut colors = [Lanes::ZERO; 4];
        for lane in 0..N {
            let backdrop = self.backdrop;
            let color = backdrop.map_or([0.0; 4], |backdrop| backdrop.color_at([x[lane], y[lane]]));
            for (channel, value) in colors.iter_mut().zip(color) {
                channel[lane] = value;
            }
        }
        colors
    }

    /// Computes the reflection of lights and environment with the layered BRDF of a draw, and the
    /// refraction of light from behind. Stores the ambient occlusion in `inputs`.
    ///
    /// The geometry has smooth normals; the BRDF applies normal maps to a copy, layer by layer.
    #[inline(always)]
    fn light_surface<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
        inputs: &mut MaterialInputs<N>,
    ) -> SurfaceLight<N> {
        let geometry = self.surface_geometry(draw, primitives, fragments);
        if let Some(occlusion) = self.occlusion {
            let visibility =
                kernel_part!(N, occlusion.visibility(geometry.positions, geometry.normals));
            inputs.screen_visibility = Some(visibility);
        }
        // The tangent frame for normal maps and anisotropy.
        let tangents = draw.interpolate_tangents(primitives, &fragments.weights());
        // The offset positions for shadow maps, if there are shadow maps.
        let mut receiver = None;
        if !self.shadows.is_empty() {
            let vertices = draw.vertex_indices(primitives);
            receiver = Some(ShadowReceiver::from_geometry(draw, &vertices, fragments, &geometry));
        }
        // Direct light first, then image-based lighting.
        let mut brdf = kernel_part!(N, LayeredBrdf::new(draw, inputs, geometry, &tangents));
        kernel_part!(N, brdf.add_lights(self.lights, self.shadows, receiver.as_ref()));
        if let Some(environment) = self.environment {
            kernel_part!(N, brdf.add_environment(environment));
        }
        let mut behind = None;
        if let Some(framebuffer) = self.framebuffer_behind(draw) {
            behind = kernel_part!(N, brdf.add_light_behind(draw, framebuffer));
        }
        // Do not return the BRDF, because it is large and would be copied.
        SurfaceLight { radiance: brdf.finish(), transmission: brdf.transmission, behind }
    }

    /// Computes positions, view directions and smooth normals at fragments, before normal maps are
    /// applied.
    #[inline(always)]
    pub(super) fn surface_geometry<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> SurfaceGeometry<N> {
        kernel_part!(N, self.find_geometry(draw, primitives, fragments))
    }

    /// Computes the same as [`surface_geometry`](Self::surface_geometry), but inlined.
    #[inline(always)]
    pub(super) fn find_geometry<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> SurfaceGeometry<N> {
        let vertices = draw.vertex_indices(primitives);
        let vertex_positions = draw.vertex_positions(&vertices);
        let positions: Vec3Lanes<N> = interpolate(&vertex_positions, &fragments.weights()).into();
        let views = view_directions(positions, self.viewer_position());
        let is_double_sided = draw.material.double_sided;
        // Back faces of single-sided surfaces have been culled, so only front faces remain.
        let mut face_normals = Vec3Lanes::ZERO;
        if is_double_sided || !draw.is_smooth {
            face_normals = draw.face_normals(&vertex_positions);
        }
        // Interpolated normals (Phong), flipped to the visible side.
        let (mut normals, normal_variation) =
            draw.interpolate_normals(&vertices, fragments, face_normals);
        let mut is_back_facing = [false; N];
        if is_double_sided {
            is_back_facing = find_back_faces(face_normals, views);
            normals = flip_vectors(normals, &is_back_facing);
        }
        SurfaceGeometry::new(positions, views, normals, is_back_facing, normal_variation)
    }

    /// Returns the viewer as a homogeneous `f32` point.
    #[inline(always)]
    pub(super) fn viewer_position(&self) -> [f32; 4] {
        <[f64; 4]>::from(self.viewer).map(|c| c as f32)
    }
}

impl Draw<'_> {
    /// Returns whether lights illuminate the draw. Unlit materials, lines and points show their
    /// color unchanged.
    pub fn is_lit(&self) -> bool {
        !self.material.unlit && self.primitive.topology == Topology::Triangles
    }
}
