//! Styles: what surfaces look like when their material is not the point.
//!
//! They go through the stages of shaded pictures and take the same normals, weights and lights; only the last step, from these to
//! a colour, is another. Colours that stand for numbers (normals, depth, parts, texture coordinates) are written so that the
//! code in the picture is the number, before samples are put together.

use super::inputs::Inputs;
use super::normal::Facing;
use super::seen::{Seen, cross, dot, lane_of};
use super::{Draw, Role, Shading};
use crate::color::linear_of;
use model::TextureUse;
use raster::{Fragment, Surface};
use std::f32::consts::PI;

/// What surfaces look like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Look {
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
pub struct Styled<'a> {
    /// What shaded surfaces would be drawn with.
    pub shading: &'a Shading<'a>,
    /// What they look like.
    pub look: Look,
    /// The rows of the turn from the world to view space: right, up, backwards.
    pub view: [[f32; 3]; 3],
    /// The place of the eye.
    pub eye: [f32; 3],
}

/// The albedo of clay.
const CLAY: [f32; 3] = [0.58, 0.52, 0.46];
/// The squares of a checkerboard in a unit of texture coordinates.
const SQUARES: f32 = 8.0;
/// The light of toon surfaces, up to which share of white.
const TONES: [(f32, f32); 3] = [(0.18, 0.3), (0.55, 0.62), (f32::INFINITY, 1.0)];
/// The colour that is left of surfaces of glass.
const GLASS: [f32; 3] = [0.03, 0.22, 0.5];

/// One corner of a triangle, seen as if it filled a pixel.
struct Corner([[f32; 1]; 3]);

impl Corner {
    fn of(number: usize) -> Self {
        let mut weights = [[0.0]; 3];
        weights[number] = [1.0];
        Self(weights)
    }
}

impl Seen<1> for Corner {
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

impl Surface for Styled<'_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.shading.keeps(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let (draw, _) = self.shading.draws.of(fragment.id);
        let is_surface = draw.primitive.topology == model::Topology::Triangles;
        let is_of_numbers = matches!(self.look, Look::Depth { .. } | Look::Ids);
        if draw.role != Role::Surface || !(is_surface || is_of_numbers) {
            return self.shading.shade(fragment);
        }
        let facing = self.shading.facing(draw, &draw.items(&[fragment.id], true), fragment);
        match self.look {
            Look::Gouraud => self.gouraud(draw, fragment),
            Look::Clay => {
                let light = self.light(&facing);
                self.developed([0, 1, 2].map(|k: usize| CLAY[k] * light[k]))
            }
            Look::Matcap => solid(self.matcap(&facing)),
            Look::Normals => codes(lane_of(&facing.normals, 0).map(|c| 0.5 * c + 0.5)),
            Look::Depth { near, far } => {
                let depth = self.depth(&facing);
                let share = if far > near { (far - depth) / (far - near) } else { 1.0 };
                codes([0.1 + 0.9 * share.clamp(0.0, 1.0); 3])
            }
            Look::UvChecker => checker(draw, fragment, facing.cosines[0]),
            Look::Ids => codes(part_color(draw.part)),
            Look::Toon => self.toon(draw, fragment, &facing),
            Look::XRay => self.glass(fragment, &facing),
        }
    }
}

impl Styled<'_> {
    /// What a white matt surface sends to the viewer.
    fn light(&self, facing: &Facing<1>) -> [f32; 3] {
        let normal = lane_of(&facing.normals, 0);
        let mut sum = [0.0; 3];
        for light in self.shading.lights {
            let arriving = light.at(&facing.places);
            let cosine = dot(normal, lane_of(&arriving.towards, 0)).max(0.0);
            let lux = lane_of(&arriving.lux, 0);
            let ambient = light.ambient().unwrap_or_default();
            sum = [0, 1, 2].map(|k: usize| sum[k] + (lux[k] * cosine + ambient[k]) / PI);
        }
        if let Some(environment) = self.shading.environment {
            let scattered = lane_of(&environment.scattered(&facing.normals), 0);
            sum = [0, 1, 2].map(|k: usize| sum[k] + scattered[k]);
        }
        sum
    }

    fn developed(&self, color: [f32; 3]) -> [f32; 4] {
        let mut lanes = color.map(|channel| [channel]);
        self.shading.develop.apply(&mut lanes);
        solid(lane_of(&lanes, 0))
    }

    fn gouraud(&self, draw: &Draw<'_>, fragment: &Fragment<'_>) -> [f32; 4] {
        let items = draw.items(&[fragment.id], true);
        let mut light = [0.0; 3];
        for corner in 0..3 {
            let facing = self.shading.facing(draw, &items, &Corner::of(corner));
            let at_corner = self.light(&facing);
            for (sum, light) in light.iter_mut().zip(at_corner) {
                *sum += light * fragment.weights[corner];
            }
        }
        let (base, emitted) = colors(draw, fragment);
        self.developed([0, 1, 2].map(|k: usize| base[k] * light[k] + emitted[k]))
    }

    fn toon(&self, draw: &Draw<'_>, fragment: &Fragment<'_>, facing: &Facing<1>) -> [f32; 4] {
        let [r, g, b] = self.light(facing);
        // Luminance of linear sRGB.
        let light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let tone = TONES.iter().find(|(up_to, _)| light < *up_to).map_or(1.0, |(_, tone)| *tone);
        let (base, emitted) = colors(draw, fragment);
        self.developed([0, 1, 2].map(|k: usize| base[k] * tone + emitted[k]))
    }

    /// A light from the upper left, a highlight and a rim, by the normal in a frame whose z points to the viewer of this pixel.
    fn matcap(&self, facing: &Facing<1>) -> [f32; 3] {
        let (normal, view) = (lane_of(&facing.normals, 0), lane_of(&facing.views, 0));
        let right = unit(cross(self.view[1], view));
        let up = cross(view, right);
        matcap([dot(normal, right), dot(normal, up), dot(normal, view)])
    }

    fn depth(&self, facing: &Facing<1>) -> f32 {
        let place = lane_of(&facing.places, 0);
        -dot(self.view[2], [0, 1, 2].map(|k: usize| place[k] - self.eye[k]))
    }

    fn glass(&self, fragment: &Fragment<'_>, facing: &Facing<1>) -> [f32; 4] {
        if !self.keeps(fragment) {
            return [0.0; 4];
        }
        // Backs of surfaces with one side are seen here too, and their normals point away.
        let cosine = dot(lane_of(&facing.normals, 0), lane_of(&facing.views, 0)).abs();
        let along = 1.0 - cosine.min(1.0);
        let alpha = 0.07 + 0.73 * along * along * along;
        let [r, g, b] = GLASS.map(|channel| channel * alpha);
        [r, g, b, alpha]
    }
}

/// The colour of a ball of glazed clay where its normal is this, z towards the viewer.
fn matcap([x, y, z]: [f32; 3]) -> [f32; 3] {
    let light = [-0.4, 0.64, 0.656];
    let half = unit([light[0], light[1], light[2] + 1.0]);
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
fn colors(draw: &Draw<'_>, fragment: &Fragment<'_>) -> ([f32; 3], [f32; 3]) {
    let corners = draw.corners(&draw.items(&[fragment.id], true));
    let Inputs { base: [r, g, b, _], emitted, .. } = Inputs::<1>::of(draw, &corners, fragment);
    (lane_of(&[r, g, b], 0), lane_of(&emitted, 0))
}

/// A checkerboard, whose squares fade where they are smaller than pixels; grey without texture coordinates.
fn checker(draw: &Draw<'_>, fragment: &Fragment<'_>, cosine: f32) -> [f32; 4] {
    let light = 0.4 + 0.6 * cosine;
    if draw.primitive.uvs.is_empty() {
        return codes([0.35 * light; 3]);
    }
    let uv_map = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let used = TextureUse { texture: 0, uv_set: 0, uv_map };
    let corners = draw.corners(&draw.items(&[fragment.id], true));
    let [[[u], [v]], [[ux], [vx]], [[uy], [vy]]] = draw.uvs(&corners, fragment, &used);
    let odd = ((u * SQUARES).floor() + (v * SQUARES).floor()).rem_euclid(2.0) >= 1.0;
    let step = ux.abs().max(uy.abs()).max(vx.abs()).max(vy.abs()) * SQUARES;
    let contrast = 0.35 * (1.5 - step).clamp(0.0, 1.0);
    let shade = light * if odd { 1.0 - contrast } else { 1.0 };
    let grown = |place: f32| 0.35 + 0.65 * (place - place.floor());
    codes([grown(u) * shade, grown(v) * shade, 0.55 * shade])
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
fn codes(codes: [f32; 3]) -> [f32; 4] {
    solid(codes.map(|code| linear_of(f64::from(code)) as f32))
}

fn solid([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

fn unit(vector: [f32; 3]) -> [f32; 3] {
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
        let bright = matcap([-0.4, 0.64, 0.656]);
        let dark = matcap([0.4, -0.64, 0.656]);
        for k in 0..3 {
            assert!(bright[k] > 2.0 * dark[k], "{bright:?} {dark:?}");
            assert!(bright[k] < 1.0 && dark[k] > 0.0);
        }
    }
}
