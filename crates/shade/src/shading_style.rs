//! Shading styles: clay, matcap, toon and x-ray surfaces, and false colors for normals, depth,
//! texture coordinates and part ids.
//!
//! Styles take the same normals, weights and lights as shaded pictures; only the last step, from
//! these to a color, is another one. False colors are decoded so that the sRGB code in the picture
//! is the number, as long as a pixel has one sample's color.

use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Rgb};
use super::material_inputs::MaterialInputs;
use super::surface_geometry::SurfaceGeometry;
use super::transmission::luminance;
use super::vector::{cross, dot, normalize_or_zero, subtract};
use super::{Draw, DrawKind, Shading};
use crate::color::srgb_to_linear;
use model::TextureInfo;
use raster::{Fragment, Surface};
use std::f32::consts::PI;

/// The look of surfaces that are not shaded by their material.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ShadingStyle {
    /// Gouraud shading: diffuse light at the vertices of each triangle, interpolated, times the
    /// base color (Gouraud 1971).
    Gouraud,
    /// Matte clay in the light of the scene.
    Clay,
    /// Matcap: the color of a ball of glazed clay that faces the viewer as the surface does.
    Matcap,
    /// The normal in the world: red, green and blue are (n + 1) / 2.
    Normals,
    /// Depth along the view axis: 1 at `near`, falling linearly to 0.1 at `far`.
    Depth {
        /// The depth of white.
        near: f32,
        /// The depth of the darkest gray.
        far: f32,
    },
    /// A checkerboard of 8 × 8 squares for each unit of texture coordinates; red grows with u,
    /// green with v.
    UvChecker,
    /// A color for each part.
    Ids,
    /// Toon (cel) shading: the base color in three steps of light.
    Toon,
    /// Translucent, the denser the more a surface lies along the line of sight.
    XRay,
}

/// Surfaces in a style, for the rasterizer.
#[derive(Debug)]
pub struct StyledShading<'a> {
    /// The shading whose draws, lights and environment are used.
    pub shading: &'a Shading<'a>,
    /// The look of the surfaces.
    pub style: ShadingStyle,
    /// The rows of the rotation from the world to view space: right, up, backwards.
    pub world_to_view: [[f32; 3]; 3],
    /// The position of the eye in the world.
    pub eye_position: [f32; 3],
}

/// The diffuse albedo of clay.
const CLAY_ALBEDO: [f32; 3] = [0.58, 0.52, 0.46];
/// The squares of a checkerboard in a unit of texture coordinates.
const CHECKER_SQUARES: f32 = 8.0;
/// The steps of toon light: the luminance up to which each reaches, and its brightness.
const TOON_TONES: [(f32, f32); 3] = [(0.18, 0.3), (0.55, 0.62), (f32::INFINITY, 1.0)];
/// The color of x-ray surfaces where they are densest.
const XRAY_COLOR: [f32; 3] = [0.03, 0.22, 0.5];

/// A fragment at one vertex of a triangle, for shading per vertex.
struct VertexFragment([Lanes<1>; 3]);

impl VertexFragment {
    /// The fragment at one of the three vertices.
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

    // Not a part of the loops over eight fragments, of which there is one for each kind of pixel:
    // a fragment in a style takes far longer than the call.
    #[inline(never)]
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.shading.draws.find_draw(fragment.id);
        let is_surface = draw.primitive.topology == model::Topology::Triangles;
        let is_false_color = matches!(self.style, ShadingStyle::Depth { .. } | ShadingStyle::Ids);
        if draw.kind != DrawKind::Surface || !(is_surface || is_false_color) {
            return self.shading.shade(fragment);
        }
        let primitive = draw.primitive_indices(&[fragment.id], true);
        let geometry = self.shading.surface_geometry(draw, &primitive, fragment);
        match self.style {
            ShadingStyle::Gouraud => self.shade_gouraud(draw, fragment),
            ShadingStyle::Clay => self.shade_clay(&geometry),
            ShadingStyle::Matcap => opaque_color(self.matcap_color(&geometry)),
            ShadingStyle::Normals => decode_codes(geometry.normals.lane(0).map(|c| 0.5 * c + 0.5)),
            ShadingStyle::Depth { near, far } => {
                let depth = self.view_depth(&geometry);
                let nearness = if far > near { (far - depth) / (far - near) } else { 1.0 };
                decode_codes([0.1 + 0.9 * nearness.clamp(0.0, 1.0); 3])
            }
            ShadingStyle::UvChecker => checker_color(draw, fragment, geometry.n_dot_v[0]),
            ShadingStyle::Ids => decode_codes(part_color(draw.part_id)),
            ShadingStyle::Toon => self.shade_toon(draw, fragment, &geometry),
            ShadingStyle::XRay => self.shade_xray(fragment, &geometry),
        }
    }
}

impl StyledShading<'_> {
    /// The radiance of a white Lambert surface, by lights without their shadows and environment.
    ///
    /// Σ E n·l / π over the lights, plus irradiance over π of the environment.
    fn diffuse_light(&self, geometry: &SurfaceGeometry<1>) -> [f32; 3] {
        let normal = geometry.normals.lane(0);
        let mut sum = [0.0; 3];
        for light in self.shading.lights {
            let incident = light.incident_at(geometry.positions);
            let n_dot_l = dot(normal, incident.to_light.lane(0)).max(0.0);
            let lux = incident.lux.lane(0);
            let ambient = light.ambient_lux().unwrap_or_default();
            sum = [0, 1, 2].map(|k: usize| sum[k] + (lux[k] * n_dot_l + ambient[k]) / PI);
        }
        if let Some(environment) = self.shading.environment {
            let diffuse = environment.irradiance_over_pi(geometry.normals).lane(0);
            sum = [0, 1, 2].map(|k: usize| sum[k] + diffuse[k]);
        }
        sum
    }

    /// An opaque color from light, exposed and tone mapped.
    fn tone_mapped(&self, light: [f32; 3]) -> [f32; 4] {
        let color = self.shading.tone_mapper.map_colors(Rgb::<1>::splat(light));
        opaque_color(color.lane(0))
    }

    /// Clay: Lambert with one albedo.
    fn shade_clay(&self, geometry: &SurfaceGeometry<1>) -> [f32; 4] {
        let light = self.diffuse_light(geometry);
        self.tone_mapped([0, 1, 2].map(|k: usize| CLAY_ALBEDO[k] * light[k]))
    }

    /// Light per vertex, interpolated; the base color per fragment.
    fn shade_gouraud(&self, draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 4] {
        let primitive = draw.primitive_indices(&[fragment.id], true);
        let mut light = [0.0; 3];
        for vertex in 0..3 {
            let at_vertex = VertexFragment::at_vertex(vertex);
            let geometry = self.shading.surface_geometry(draw, &primitive, &at_vertex);
            let vertex_light = self.diffuse_light(&geometry);
            for (sum, light) in light.iter_mut().zip(vertex_light) {
                *sum += light * fragment.weights[vertex];
            }
        }
        let (base, emitted) = base_and_emitted(draw, fragment);
        self.tone_mapped([0, 1, 2].map(|k: usize| base[k] * light[k] + emitted[k]))
    }

    /// The base color in steps of light by its luminance.
    ///
    /// The luminance of the diffuse light is quantized to three tones; the base color keeps its
    /// hue.
    fn shade_toon(
        &self,
        draw: &Draw<'_>,
        fragment: &Fragment<'_>,
        geometry: &SurfaceGeometry<1>,
    ) -> [f32; 4] {
        // The darkest tone whose limit is above the luminance.
        let light = luminance(Rgb::<1>::splat(self.diffuse_light(geometry)))[0];
        let tone = TOON_TONES.iter().find(|(up_to, _)| light < *up_to);
        let brightness = tone.map_or(1.0, |(_, brightness)| *brightness);
        let (base, emitted) = base_and_emitted(draw, fragment);
        self.tone_mapped([0, 1, 2].map(|k: usize| base[k] * brightness + emitted[k]))
    }

    /// The matcap at the normal in a frame whose z points to the viewer of this pixel: in
    /// perspective a sphere looks alike wherever it is in the picture.
    fn matcap_color(&self, geometry: &SurfaceGeometry<1>) -> [f32; 3] {
        let (normal, view) = (geometry.normals.lane(0), geometry.views.lane(0));
        let right = normalize_or_zero(cross(self.world_to_view[1], view));
        let up = cross(view, right);
        matcap_ball_color([dot(normal, right), dot(normal, up), dot(normal, view)])
    }

    /// The distance from the eye along the view axis.
    fn view_depth(&self, geometry: &SurfaceGeometry<1>) -> f32 {
        -dot(self.world_to_view[2], subtract(geometry.positions.lane(0), self.eye_position))
    }

    /// A translucent surface, whose alpha grows with the cube of 1 − |n·v|.
    fn shade_xray(&self, fragment: &Fragment<'_>, geometry: &SurfaceGeometry<1>) -> [f32; 4] {
        if !self.passes_alpha_test(fragment) {
            return [0.0; 4];
        }
        // Backs of single-sided surfaces are drawn here too, and their normals point away.
        let n_dot_v = dot(geometry.normals.lane(0), geometry.views.lane(0)).abs();
        let along = 1.0 - n_dot_v.min(1.0);
        let alpha = 0.07 + 0.73 * along * along * along;
        let [r, g, b] = XRAY_COLOR.map(|channel| channel * alpha);
        [r, g, b, alpha]
    }
}

/// The color of a ball of glazed clay at a normal, z towards the viewer: light from the upper left,
/// a highlight and a rim.
fn matcap_ball_color([x, y, z]: [f32; 3]) -> [f32; 3] {
    let light = [-0.4, 0.64, 0.656];
    // Wrapped diffuse.
    // Half Lambert: the cosine mapped to 0 … 1, then squared.
    let wrapped = 0.5 + 0.5 * dot([x, y, z], light);
    let diffuse = 0.06 + 0.94 * wrapped * wrapped;
    // Blinn-Phong highlight.
    let half = normalize_or_zero([light[0], light[1], light[2] + 1.0]);
    let fourth = |c: f32| c * c * c * c;
    let gloss = 0.4 * fourth(fourth(dot([x, y, z], half).max(0.0)));
    // Rim light.
    let away = 1.0 - z.clamp(0.0, 1.0);
    let rim = 0.25 * away * away * away;
    let color = |base: f32, rim_color: f32| base * diffuse + gloss + rim * rim_color;
    [color(0.5, 0.5), color(0.24, 0.7), color(0.16, 1.0)]
}

/// The base color of a material and the light that it emits.
fn base_and_emitted(draw: &Draw<'_>, fragment: &Fragment<'_>) -> ([f32; 3], [f32; 3]) {
    let vertices = draw.vertex_indices(&draw.primitive_indices(&[fragment.id], true));
    let inputs = MaterialInputs::<1>::evaluate(draw, &vertices, fragment);
    (inputs.base_color.lane(0), inputs.emitted.lane(0))
}

/// A checkerboard, whose squares fade where they are smaller than pixels; gray without texture
/// coordinates.
fn checker_color(draw: &Draw<'_>, fragment: &Fragment<'_>, n_dot_v: f32) -> [f32; 4] {
    let light = 0.4 + 0.6 * n_dot_v;
    if draw.primitive.uvs.is_empty() {
        return decode_codes([0.35 * light; 3]);
    }
    let info = TextureInfo { texture: 0, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
    let vertices = draw.vertex_indices(&draw.primitive_indices(&[fragment.id], true));
    let uvs = draw.texture_coordinates(&vertices, fragment, &info);
    let [[u, v], dx, dy] = [uvs.uv, uvs.dx, uvs.dy].map(|uv| uv.map(|lanes| lanes[0]));
    let is_odd =
        ((u * CHECKER_SQUARES).floor() + (v * CHECKER_SQUARES).floor()).rem_euclid(2.0) >= 1.0;
    // Squares per pixel, by which the contrast fades.
    let step = dx[0].abs().max(dy[0].abs()).max(dx[1].abs()).max(dy[1].abs()) * CHECKER_SQUARES;
    let contrast = 0.35 * (1.5 - step).clamp(0.0, 1.0);
    let shade = light * if is_odd { 1.0 - contrast } else { 1.0 };
    let ramp = |coordinate: f32| 0.35 + 0.65 * (coordinate - coordinate.floor());
    decode_codes([ramp(u) * shade, ramp(v) * shade, 0.55 * shade])
}

/// Colors far apart for consecutive parts: hues by multiples of the golden section.
fn part_color(part: u32) -> [f32; 3] {
    // 2³² over the golden ratio: the fraction of a product is what is left of it in 32 bits.
    let hue = (part.wrapping_add(1).wrapping_mul(2_654_435_769) >> 8) as f32 / 16_777_216.0;
    let [low, high] = if part.is_multiple_of(2) { [0.35, 0.95] } else { [0.2, 0.75] };
    // HSV to RGB.
    [0.0, 2.0, 4.0].map(|shift| {
        let sextant = (hue * 6.0 + shift) % 6.0;
        low + (high - low) * ((sextant - 3.0).abs() - 1.0).clamp(0.0, 1.0)
    })
}

/// The opaque linear color with these sRGB codes, from 0 to 1.
fn decode_codes(codes: [f32; 3]) -> [f32; 4] {
    opaque_color(codes.map(|code| srgb_to_linear(f64::from(code)) as f32))
}

/// A color with alpha 1.
fn opaque_color([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn consecutive_parts_have_colors_far_apart() {
        for part in 0..200 {
            for next in 1..5 {
                let [a, b] = [part_color(part), part_color(part + next)];
                let difference = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
                assert!(difference > 0.06, "{part} and {next} on: {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_matcap_is_bright_towards_its_light_and_never_beyond_white() {
        let bright = matcap_ball_color([-0.4, 0.64, 0.656]);
        let dark = matcap_ball_color([0.4, -0.64, 0.656]);
        for k in 0..3 {
            assert!(bright[k] > 2.0 * dark[k], "{bright:?} {dark:?}");
            assert!(bright[k] < 1.0 && dark[k] > 0.0);
        }
    }
}
