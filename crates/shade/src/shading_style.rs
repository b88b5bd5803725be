//! Styles: what surfaces look like when their material is not the point.
//!
//! They go through the stages of shaded pictures and take the same normals, weights and lights; only the last step, from these to
//! a colour, is another. Colours that stand for numbers (normals, depth, parts, texture coordinates) are written so that the
//! code in the picture is the number, before samples are put together.

use super::fragment_lanes::{FragmentLanes, cross, dot, lane_vector};
use super::material_inputs::MaterialInputs;
use super::surface_geometry::SurfaceGeometry;
use super::{Draw, DrawKind, Shading};
use crate::color::srgb_to_linear;
use model::TextureInfo;
use raster::{Fragment, Surface};
use std::f32::consts::PI;

/// What surfaces look like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ShadingStyle {
    /// Light at the corners of each triangle, blended over it, times the colour of the material (Gouraud, 1971).
    Gouraud,
    /// Matt clay in the light of the scene.
    Clay,
    /// The colour of a ball of glazed clay that faces the viewer as the surface does.
    Matcap,
    /// The normal in the world: red, green and blue are (n + 1) / 2.
    Normals,
    /// The nearer, the brighter: from 1 at `near` to 0.1 at `far`, both along the view axis.
    Depth {
        /// Where it is white.
        near: f32,
        /// Where it is darkest.
        far: f32,
    },
    /// A checkerboard of 8 × 8 squares for each unit of texture coordinates; red grows with u, green with v.
    UvChecker,
    /// A colour for each part.
    Ids,
    /// The colour of the material in three steps of light.
    Toon,
    /// As if of glass: the denser the more a surface lies along the line of sight.
    XRay,
}

/// Surfaces of a style.
#[derive(Debug)]
pub struct StyledShading<'a> {
    /// What shaded surfaces would be drawn with.
    pub shading: &'a Shading<'a>,
    /// What they look like.
    pub style: ShadingStyle,
    /// The rows of the turn from the world to view space: right, up, backwards.
    pub world_to_view: [[f32; 3]; 3],
    /// The place of the eye.
    pub eye_position: [f32; 3],
}

/// The albedo of clay.
const CLAY_ALBEDO: [f32; 3] = [0.58, 0.52, 0.46];
/// The squares of a checkerboard in a unit of texture coordinates.
const CHECKER_SQUARES: f32 = 8.0;
/// The light of toon surfaces, up to which share of white.
const TOON_TONES: [(f32, f32); 3] = [(0.18, 0.3), (0.55, 0.62), (f32::INFINITY, 1.0)];
/// The colour that is left of surfaces of glass.
const XRAY_COLOR: [f32; 3] = [0.03, 0.22, 0.5];

/// One corner of a triangle, seen as if it filled a pixel.
struct VertexLanes([[f32; 1]; 3]);

impl VertexLanes {
    fn at_vertex(number: usize) -> Self {
        let mut weights = [[0.0]; 3];
        weights[number] = [1.0];
        Self(weights)
    }
}

impl FragmentLanes<1> for VertexLanes {
    fn weights(&self) -> [[f32; 1]; 3] {
        self.0
    }
    fn weights_dx(&self) -> [[f32; 1]; 3] {
        [[0.0]; 3]
    }
    fn weights_dy(&self) -> [[f32; 1]; 3] {
        [[0.0]; 3]
    }
}

impl Surface for StyledShading<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.shading.passes_alpha_test(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.shading.draws.find_draw(fragment.id);
        let is_surface = draw.primitive.topology == model::Topology::Triangles;
        let is_of_numbers = matches!(self.style, ShadingStyle::Depth { .. } | ShadingStyle::Ids);
        if draw.kind != DrawKind::Surface || !(is_surface || is_of_numbers) {
            return self.shading.shade(fragment);
        }
        let facing = self.shading.surface_geometry(
            draw,
            &draw.primitive_indices(&[fragment.id], true),
            fragment,
        );
        match self.style {
            ShadingStyle::Gouraud => self.shade_gouraud(draw, fragment),
            ShadingStyle::Clay => {
                let light = self.diffuse_light(&facing);
                self.tone_mapped([0, 1, 2].map(|k: usize| CLAY_ALBEDO[k] * light[k]))
            }
            ShadingStyle::Matcap => opaque_color(self.matcap_color(&facing)),
            ShadingStyle::Normals => {
                decode_codes(lane_vector(&facing.normals, 0).map(|c| 0.5 * c + 0.5))
            }
            ShadingStyle::Depth { near, far } => {
                let depth = self.view_depth(&facing);
                let share = if far > near { (far - depth) / (far - near) } else { 1.0 };
                decode_codes([0.1 + 0.9 * share.clamp(0.0, 1.0); 3])
            }
            ShadingStyle::UvChecker => checker_color(draw, fragment, facing.n_dot_v[0]),
            ShadingStyle::Ids => decode_codes(part_color(draw.part_id)),
            ShadingStyle::Toon => self.shade_toon(draw, fragment, &facing),
            ShadingStyle::XRay => self.shade_xray(fragment, &facing),
        }
    }
}

impl StyledShading<'_> {
    /// What a white matt surface sends to the viewer.
    fn diffuse_light(&self, facing: &SurfaceGeometry<1>) -> [f32; 3] {
        let normal = lane_vector(&facing.normals, 0);
        let mut sum = [0.0; 3];
        for light in self.shading.lights {
            let arriving = light.incident_at(&facing.positions);
            let cosine = dot(normal, lane_vector(&arriving.to_light, 0)).max(0.0);
            let lux = lane_vector(&arriving.lux, 0);
            let ambient = light.ambient_lux().unwrap_or_default();
            sum = [0, 1, 2].map(|k: usize| sum[k] + (lux[k] * cosine + ambient[k]) / PI);
        }
        if let Some(environment) = self.shading.environment {
            let scattered = lane_vector(&environment.irradiance_over_pi(&facing.normals), 0);
            sum = [0, 1, 2].map(|k: usize| sum[k] + scattered[k]);
        }
        sum
    }

    fn tone_mapped(&self, color: [f32; 3]) -> [f32; 4] {
        let mut lanes = color.map(|channel| [channel]);
        self.shading.tone_mapper.map_colors(&mut lanes);
        opaque_color(lane_vector(&lanes, 0))
    }

    fn shade_gouraud(&self, draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 4] {
        let items = draw.primitive_indices(&[fragment.id], true);
        let mut light = [0.0; 3];
        for corner in 0..3 {
            let facing =
                self.shading.surface_geometry(draw, &items, &VertexLanes::at_vertex(corner));
            let at_corner = self.diffuse_light(&facing);
            for (sum, light) in light.iter_mut().zip(at_corner) {
                *sum += light * fragment.weights[corner];
            }
        }
        let (base, emitted) = base_and_emitted(draw, fragment);
        self.tone_mapped([0, 1, 2].map(|k: usize| base[k] * light[k] + emitted[k]))
    }

    fn shade_toon(
        &self,
        draw: &Draw<'_>,
        fragment: &Fragment<'_>,
        facing: &SurfaceGeometry<1>,
    ) -> [f32; 4] {
        let [r, g, b] = self.diffuse_light(facing);
        // Luminance of linear sRGB.
        let light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let tone =
            TOON_TONES.iter().find(|(up_to, _)| light < *up_to).map_or(1.0, |(_, tone)| *tone);
        let (base, emitted) = base_and_emitted(draw, fragment);
        self.tone_mapped([0, 1, 2].map(|k: usize| base[k] * tone + emitted[k]))
    }

    /// A light from the upper left, a highlight and a rim, by the normal in a frame whose z points to the viewer of this pixel.
    fn matcap_color(&self, facing: &SurfaceGeometry<1>) -> [f32; 3] {
        let (normal, view) = (lane_vector(&facing.normals, 0), lane_vector(&facing.views, 0));
        let right = unit_or_zero(cross(self.world_to_view[1], view));
        let up = cross(view, right);
        matcap_ball_color([dot(normal, right), dot(normal, up), dot(normal, view)])
    }

    fn view_depth(&self, facing: &SurfaceGeometry<1>) -> f32 {
        let place = lane_vector(&facing.positions, 0);
        -dot(self.world_to_view[2], [0, 1, 2].map(|k: usize| place[k] - self.eye_position[k]))
    }

    fn shade_xray(&self, fragment: &Fragment<'_>, facing: &SurfaceGeometry<1>) -> [f32; 4] {
        if !self.passes_alpha_test(fragment) {
            return [0.0; 4];
        }
        // Backs of surfaces with one side are seen here too, and their normals point away.
        let cosine = dot(lane_vector(&facing.normals, 0), lane_vector(&facing.views, 0)).abs();
        let along = 1.0 - cosine.min(1.0);
        let alpha = 0.07 + 0.73 * along * along * along;
        let [r, g, b] = XRAY_COLOR.map(|channel| channel * alpha);
        [r, g, b, alpha]
    }
}

/// The colour of a ball of glazed clay where its normal is this, z towards the viewer.
fn matcap_ball_color([x, y, z]: [f32; 3]) -> [f32; 3] {
    let light = [-0.4, 0.64, 0.656];
    let half = unit_or_zero([light[0], light[1], light[2] + 1.0]);
    let wrapped = 0.5 + 0.5 * dot([x, y, z], light);
    let fourth = |c: f32| c * c * c * c;
    let gloss = 0.4 * fourth(fourth(dot([x, y, z], half).max(0.0)));
    let away = 1.0 - z.clamp(0.0, 1.0);
    let rim = 0.25 * away * away * away;
    let diffuse = 0.06 + 0.94 * wrapped * wrapped;
    let color = |base: f32, rim_color: f32| base * diffuse + gloss + rim * rim_color;
    [color(0.5, 0.5), color(0.24, 0.7), color(0.16, 1.0)]
}

/// The colour of the material and the light that it gives off.
fn base_and_emitted(draw: &Draw<'_>, fragment: &Fragment<'_>) -> ([f32; 3], [f32; 3]) {
    let corners = draw.vertex_indices(&draw.primitive_indices(&[fragment.id], true));
    let MaterialInputs { base: [r, g, b, _], emitted, .. } =
        MaterialInputs::<1>::evaluate(draw, &corners, fragment);
    (lane_vector(&[r, g, b], 0), lane_vector(&emitted, 0))
}

/// A checkerboard, whose squares fade where they are smaller than pixels; grey without texture coordinates.
fn checker_color(draw: &Draw<'_>, fragment: &Fragment<'_>, cosine: f32) -> [f32; 4] {
    let light = 0.4 + 0.6 * cosine;
    if draw.primitive.uvs.is_empty() {
        return decode_codes([0.35 * light; 3]);
    }
    let uv_map = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let used = TextureInfo { texture: 0, uv_set: 0, uv_matrix: uv_map };
    let corners = draw.vertex_indices(&draw.primitive_indices(&[fragment.id], true));
    let [[[u], [v]], [[ux], [vx]], [[uy], [vy]]] =
        draw.texture_coordinates(&corners, fragment, &used);
    let odd =
        ((u * CHECKER_SQUARES).floor() + (v * CHECKER_SQUARES).floor()).rem_euclid(2.0) >= 1.0;
    let step = ux.abs().max(uy.abs()).max(vx.abs()).max(vy.abs()) * CHECKER_SQUARES;
    let contrast = 0.35 * (1.5 - step).clamp(0.0, 1.0);
    let shade = light * if odd { 1.0 - contrast } else { 1.0 };
    let grown = |place: f32| 0.35 + 0.65 * (place - place.floor());
    decode_codes([grown(u) * shade, grown(v) * shade, 0.55 * shade])
}

/// Colours far apart for parts that follow each other: hues by the golden section.
fn part_color(part: u32) -> [f32; 3] {
    // 2³² over the golden ratio: the fraction of a product is what is left of it in 32 bits.
    let hue = (part.wrapping_add(1).wrapping_mul(2_654_435_769) >> 8) as f32 / 16_777_216.0;
    let [low, high] = if part.is_multiple_of(2) { [0.35, 0.95] } else { [0.2, 0.75] };
    [0.0, 2.0, 4.0].map(|shift| {
        let place = (hue * 6.0 + shift) % 6.0;
        low + (high - low) * ((place - 3.0).abs() - 1.0).clamp(0.0, 1.0)
    })
}

/// The linear colour whose codes are these, of 1.
fn decode_codes(codes: [f32; 3]) -> [f32; 4] {
    opaque_color(codes.map(|code| srgb_to_linear(f64::from(code)) as f32))
}

fn opaque_color([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

fn unit_or_zero(vector: [f32; 3]) -> [f32; 3] {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 { vector.map(|c| c / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_in_a_row_have_colours_far_apart() {
        for part in 0..200 {
            for next in 1..5 {
                let [a, b] = [part_color(part), part_color(part + next)];
                let far = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
                assert!(far > 0.06, "{part} and {next} on: {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_matcap_is_bright_towards_its_light_and_never_beyond_white_by_much() {
        let bright = matcap_ball_color([-0.4, 0.64, 0.656]);
        let dark = matcap_ball_color([0.4, -0.64, 0.656]);
        for k in 0..3 {
            assert!(bright[k] > 2.0 * dark[k], "{bright:?} {dark:?}");
            assert!(bright[k] < 1.0 && dark[k] > 0.0);
        }
    }
}
