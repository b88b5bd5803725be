//! Shading styles: clay, matcap, toon and x-ray surfaces, and false colors for normals, depth,
//! texture coordinates and part ids.
//!
//! Styles use the same normals, weights and lights as shaded pictures; only the last step, which
//! turns these into a color, differs. False colors are decoded so that the sRGB code in the picture
//! is the number itself, wherever a pixel has the color of a single sample.

mod false_colors;

use super::attributes::PrimitiveIndices;
use super::fragment_lanes::{FragmentLanes, FragmentPacket};
use super::lanes::{Lanes, Rgb, Vec3Lanes};
use super::material_inputs::MaterialInputs;
use super::surface_geometry::SurfaceGeometry;
use super::transmission::luminance;
use super::vector::dot;
use super::{Draw, DrawKind, Shading};
use crate::kernel_part::kernel_part;
use false_colors::{checker_color, decode_codes, map_colors, matcap_ball_color, part_color};
use model::{AlphaMode, Colormap};
use raster::{F32x8, Fragment, Fragments, Kernel, LANES, Surface, shade_each};
use std::f32::consts::FRAC_1_PI;

/// The look of surfaces that are not shaded with their material.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ShadingStyle {
    /// The base color of the material (the albedo), without light, exposure or tone mapping.
    Unlit,
    /// Gouraud shading: diffuse light computed at the vertices of each triangle and interpolated,
    /// times the base color (Gouraud 1971).
    Gouraud,
    /// Matte clay under the scene's lights.
    Clay,
    /// Matcap: the color of a glazed clay ball at the point with the same orientation to the
    /// viewer.
    Matcap,
    /// The normal in the world: red, green and blue are (n + 1) / 2.
    Normals,
    /// Depth along the view axis: grays from 1 at `near`, falling linearly to 0.1 at `far`, or
    /// colors from the last of a colormap at `near` to the first at `far`.
    Depth {
        /// The depth shown as white or the last color.
        near: f32,
        /// The depth shown as the darkest gray or the first color.
        far: f32,
        /// The colors, or `None` for grays.
        colormap: Option<Colormap>,
    },
    /// A checkerboard with 8 × 8 squares per unit of texture coordinates; red increases with u, and
    /// green with v.
    UvChecker,
    /// A color for each part.
    Ids,
    /// Toon (cel) shading: the base color in three steps of light.
    Toon,
    /// X-ray: translucent, and denser where a surface is closer to parallel with the line of sight.
    XRay,
}

/// Shades surfaces in a style, for the rasterizer.
#[derive(Debug)]
pub struct StyledShading<'a> {
    /// The shading whose draws, lights and environment are used.
    pub shading: &'a Shading<'a>,
    /// The look of the surfaces.
    pub style: ShadingStyle,
    /// The rows of the rotation from world to view space: right, up and backward.
    pub world_to_view: [[f32; 3]; 3],
    /// The position of the eye in the world.
    pub eye_position: [f32; 3],
}

/// The diffuse albedo of clay.
const CLAY_ALBEDO: [f32; 3] = [0.58, 0.52, 0.46];
/// The steps of toon light, each with its maximum luminance and its brightness.
const TOON_TONES: [(f32, f32); 3] = [(0.18, 0.3), (0.55, 0.62), (f32::INFINITY, 1.0)];
/// The color of x-ray surfaces at their densest.
const XRAY_COLOR: [f32; 3] = [0.03, 0.22, 0.5];

/// A fragment at one vertex of a triangle, for shading per vertex.
struct VertexFragment([Lanes<1>; 3]);

impl VertexFragment {
    /// Returns the fragment at one of the three vertices.
    fn at_vertex(vertex: usize) -> Self {
        let mut weights = [Lanes::ZERO; 3];
        weights[vertex] = Lanes::ONE;
        Self(weights)
    }
}

impl FragmentLanes<1> for VertexFragment {
    fn weights(&self) -> [Lanes<1>; 3] {
        self.0
    }
    fn weights_dx(&self) -> [Lanes<1>; 3] {
        [Lanes::ZERO; 3]
    }
    fn weights_dy(&self) -> [Lanes<1>; 3] {
        [Lanes::ZERO; 3]
    }
}

impl Surface for StyledShading<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.shading.passes_alpha_test(fragment)
    }

    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        self.shading.alpha_test_eight(fragments)
    }

    // Not inlined into the loops over eight fragments, one for each kind of pixel, because shading
    // a fragment in a style takes far longer than the call.
    #[inline(never)]
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.shading.draws.find_draw(fragment.id);
        if !self.is_styled(draw) {
            return self.shading.shade(fragment);
        }
        let primitive = draw.primitive_indices(&[fragment.id], true);
        if !self.style.needs_material() {
            return self.shade_lanes(draw, &primitive, fragment).map(|channel| channel[0]);
        }
        let geometry = self.shading.surface_geometry(draw, &primitive, fragment);
        match self.style {
            ShadingStyle::Gouraud => self.shade_gouraud(draw, fragment),
            ShadingStyle::Toon => self.shade_toon(draw, fragment, &geometry),
            _ => self.shade_xray(fragment, &geometry),
        }
    }

    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        // A step of toon light may occur between two triangles of one surface.
        self.style != ShadingStyle::Toon && self.shading.is_continuous(first_id, second_id)
    }

    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let draws = &self.shading.draws;
        let is_styled = |lane| self.is_styled(draws.find_draw(fragments.id(lane)).0);
        if self.style.needs_material() || !(0..LANES).all(is_styled) {
            return shade_each(fragments, |fragment| self.shade(fragment));
        }
        if self.style == ShadingStyle::Ids {
            return self.part_colors(fragments);
        }
        let colors =
            self.shading.simd_level.run_wide_kernel(StyleEight { styled: self, fragments });
        colors.unwrap_or_else(|| shade_each(fragments, |fragment| self.shade(fragment)))
    }
}

impl ShadingStyle {
    /// Returns whether the style uses the material's textures or alpha. Such styles are shaded one
    /// fragment at a time.
    const fn needs_material(self) -> bool {
        matches!(self, Self::Gouraud | Self::Toon | Self::XRay)
    }
}

/// The kernel that shades eight fragments in a style without materials.
struct StyleEight<'a> {
    styled: &'a StyledShading<'a>,
    fragments: &'a Fragments<'a>,
}

impl Kernel for StyleEight<'_> {
    type Output = [F32x8; 4];

    #[inline(always)]
    fn run(self) -> [F32x8; 4] {
        let Self { styled, fragments } = self;
        let packet = FragmentPacket::new(fragments);
        let mut colors = [Lanes::ZERO; 4];
        styled.shading.draws.for_each_draw(
            fragments,
            #[inline(always)]
            |draw, primitives, mask| {
                let shaded = styled.shade_lanes(draw, primitives, &packet);
                for (channel, draw_channel) in colors.iter_mut().zip(shaded) {
                    *channel = draw_channel.select(mask, *channel);
                }
            },
        );
        colors.map(|channel| channel.0)
    }
}

/// Returns the base color of a material, premultiplied by alpha if the material blends.
#[inline(always)]
fn unlit_color<const N: usize>(
    draw: &Draw<'_>,
    primitives: &PrimitiveIndices<N>,
    fragments: &impl FragmentLanes<N>,
) -> [Lanes<N>; 4] {
    let vertices = draw.vertex_indices(primitives);
    let inputs = MaterialInputs::evaluate(draw, &vertices, fragments);
    let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
    let alpha = if is_blended { inputs.alpha } else { Lanes::ONE };
    let Rgb { r, g, b } = inputs.base_color * alpha;
    [r, g, b, alpha]
}

impl StyledShading<'_> {
    /// Returns whether the style applies to a draw. It does not apply to the background or, except
    /// for false colors, to lines and points.
    fn is_styled(&self, draw: &Draw<'_>) -> bool {
        let is_surface = draw.primitive.topology == model::Topology::Triangles;
        let is_false_color = matches!(self.style, ShadingStyle::Depth { .. } | ShadingStyle::Ids);
        draw.kind == DrawKind::Surface && (is_surface || is_false_color)
    }

    /// Returns the colors of the parts that eight fragments belong to, without interpolation.
    fn part_colors(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let mut colors = [[1.0; LANES]; 4];
        let (mut last, mut color) = (None, [0.0; 3]);
        for lane in 0..LANES {
            let part = self.shading.draws.find_draw(fragments.id(lane)).0.part_id;
            if last != Some(part) {
                (last, color) =
                    (Some(part), decode_codes(Rgb::<1>::splat(part_color(part))).lane(0));
            }
            for (channel, value) in colors.iter_mut().zip(color) {
                channel[lane] = value;
            }
        }
        colors
    }

    /// Computes the colors of fragments of one draw, in a style without materials.
    #[inline(always)]
    fn shade_lanes<const N: usize>(
        &self,
        draw: &Draw<'_>,
        primitives: &PrimitiveIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> [Lanes<N>; 4] {
        if self.style == ShadingStyle::Unlit {
            return unlit_color(draw, primitives, fragments);
        }
        let geometry = self.shading.surface_geometry(draw, primitives, fragments);
        opaque_color(match self.style {
            ShadingStyle::Clay => {
                let light = kernel_part!(N, self.diffuse_light(&geometry));
                self.shading.tone_mapper.map_colors(Rgb::splat(CLAY_ALBEDO) * light)
            }
            ShadingStyle::Matcap => kernel_part!(N, self.matcap_color(&geometry)),
            ShadingStyle::Normals => {
                let Vec3Lanes { x, y, z } = geometry.normals;
                decode_codes(Rgb { r: x, g: y, b: z }.map(|c| 0.5 * c + 0.5))
            }
            ShadingStyle::Depth { near, far, colormap } => {
                let depth = self.view_depth(&geometry);
                let mut nearness = Lanes::ONE;
                if far > near {
                    nearness = ((far - depth) / (far - near)).clamp(0.0, 1.0);
                }
                let gray = 0.1 + 0.9 * nearness;
                let gray = Rgb { r: gray, g: gray, b: gray };
                decode_codes(colormap.map_or(gray, |colormap| map_colors(colormap, nearness)))
            }
            ShadingStyle::Ids => decode_codes(Rgb::splat(part_color(draw.part_id))),
            _ => {
                let vertices = draw.vertex_indices(primitives);
                kernel_part!(N, checker_color(draw, &vertices, fragments, geometry.n_dot_v))
            }
        })
    }

    /// Computes the radiance of white Lambert surfaces under the lights and the environment,
    /// without shadows.
    ///
    /// This is Σ E n·l / π over the lights, plus the environment's irradiance over π.
    #[inline(always)]
    fn diffuse_light<const N: usize>(&self, geometry: &SurfaceGeometry<N>) -> Rgb<N> {
        let mut sum = Rgb::ZERO;
        for light in self.shading.lights {
            let incident = light.incident_at(geometry.positions);
            let n_dot_l = geometry.normals.dot(incident.to_light).max(0.0);
            let ambient = Rgb::splat(light.ambient_lux().unwrap_or_default());
            sum += (incident.lux * n_dot_l + ambient) * FRAC_1_PI;
        }
        if let Some(environment) = self.shading.environment {
            sum += environment.irradiance_over_pi(geometry.normals);
        }
        sum
    }

    /// Computes the exposed and tone mapped color of a material in diffuse light, premultiplied by
    /// alpha if the material blends. Unlit colors are already display colors: they are only
    /// exposed, and the light is ignored.
    fn material_color(
        &self,
        draw: &Draw<'_>,
        fragment: &Fragment<'_>,
        diffuse_light: [f32; 3],
    ) -> [f32; 4] {
        let vertices = draw.vertex_indices(&draw.primitive_indices(&[fragment.id], true));
        let inputs = MaterialInputs::<1>::sample(draw, &vertices, fragment);
        let tone_mapper = &self.shading.tone_mapper;
        let color = if draw.is_lit() {
            let diffuse = inputs.base_color * Rgb::splat(diffuse_light);
            tone_mapper.map_colors(diffuse + inputs.emitted)
        } else {
            inputs.base_color * tone_mapper.exposure
        };
        let is_blended = draw.material.alpha_mode == AlphaMode::Blend;
        let alpha = if is_blended { inputs.alpha[0] } else { 1.0 };
        let [r, g, b] = color.lane(0).map(|channel| channel * alpha);
        [r, g, b, alpha]
    }

    /// Computes Gouraud shading: light per vertex, interpolated, times the base color per fragment.
    fn shade_gouraud(&self, draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 4] {
        let primitive = draw.primitive_indices(&[fragment.id], true);
        let mut light = [0.0; 3];
        let lit_vertices = if draw.is_lit() { 0..3 } else { 0..0 };
        for vertex in lit_vertices {
            let at_vertex = VertexFragment::at_vertex(vertex);
            let geometry = self.shading.find_geometry(draw, &primitive, &at_vertex);
            let vertex_light = self.diffuse_light(&geometry).lane(0);
            for (sum, light) in light.iter_mut().zip(vertex_light) {
                *sum += light * fragment.weights[vertex];
            }
        }
        self.material_color(draw, fragment, light)
    }

    /// Computes toon shading: the base color in steps of light.
    ///
    /// The luminance of the diffuse light is quantized to three tones, and the hue of the base
    /// color is preserved.
    fn shade_toon(
        &self,
        draw: &Draw<'_>,
        fragment: &Fragment<'_>,
        geometry: &SurfaceGeometry<1>,
    ) -> [f32; 4] {
        // The darkest tone with a limit above the luminance.
        let light = luminance(self.diffuse_light(geometry))[0];
        let tone = TOON_TONES.iter().find(|(up_to, _)| light < *up_to);
        let brightness = tone.map_or(1.0, |(_, brightness)| *brightness);
        self.material_color(draw, fragment, [brightness; 3])
    }

    /// Returns the matcap color at the normal, in a frame whose z points to the viewer of this
    /// pixel, so that in perspective a sphere looks the same everywhere in the picture.
    #[inline(always)]
    fn matcap_color<const N: usize>(&self, geometry: &SurfaceGeometry<N>) -> Rgb<N> {
        let SurfaceGeometry { normals, views, .. } = *geometry;
        let right = Vec3Lanes::splat(self.world_to_view[1]).cross(views);
        // This is zero if the view is vertical.
        let inv_length =
            right.dot(right).map(|square| if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 });
        let right = right * inv_length;
        let up = views.cross(right);
        matcap_ball_color(Vec3Lanes {
            x: normals.dot(right),
            y: normals.dot(up),
            z: normals.dot(views),
        })
    }

    /// Computes the distances from the eye along the view axis.
    #[inline(always)]
    fn view_depth<const N: usize>(&self, geometry: &SurfaceGeometry<N>) -> Lanes<N> {
        let backwards = Vec3Lanes::splat(self.world_to_view[2]);
        -backwards.dot(geometry.positions - Vec3Lanes::splat(self.eye_position))
    }

    /// Computes the color of a translucent surface whose alpha grows with the cube of 1 − |n·v|.
    fn shade_xray(&self, fragment: &Fragment<'_>, geometry: &SurfaceGeometry<1>) -> [f32; 4] {
        if !self.passes_alpha_test(fragment) {
            return [0.0; 4];
        }
        // Back faces of single-sided surfaces are also drawn here, and their normals point away.
        let n_dot_v = dot(geometry.normals.lane(0), geometry.views.lane(0)).abs();
        let along = 1.0 - n_dot_v.min(1.0);
        let alpha = 0.07 + 0.73 * along * along * along;
        let [r, g, b] = XRAY_COLOR.map(|channel| channel * alpha);
        [r, g, b, alpha]
    }
}

/// Returns colors with alpha 1.
#[inline(always)]
fn opaque_color<const N: usize>(Rgb { r, g, b }: Rgb<N>) -> [Lanes<N>; 4] {
    [r, g, b, Lanes::ONE]
}
