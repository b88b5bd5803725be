//! Shadow maps: the picture that a light has of the scene, and whether a place in the world is in it.
//!
//! ```text
//!      light ── depth ──►   texel: depth and slope of the nearest triangle's plane
//!        ╲        ▟▛  caster
//!         ╲      ▟▛
//!   ───────●────▟▛──── receiver: its own plane, by the normal
//! ```
//!
//! A texel holds the plane of what is nearest and not only its depth, and the receiver is a plane too. Both are compared at the
//! texel's centre and at the receiver's own place, and shade only if they do so at both: a surface then never shades itself
//! however flatly light falls on it, with a bias of a hundredth of a texel and no gap where a thing stands on another.
//!
//! The penumbra grows with the distance of what casts the shadow (Fernando, *Percentage-closer soft shadows*, 2005), by a fixed
//! pattern of places, so that pictures have no noise and always the same bytes.

use glam::{DMat4, DVec3, DVec4};
use raster::SurfaceDepth;
use std::sync::LazyLock;

/// What a light's shadows are like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shadow {
    /// The texels of the longer side of the shadow map.
    pub resolution: u32,
    /// How large the light looks from where its light falls, in radians across; 0 for sharp borders.
    pub softness: f32,
}

/// The greatest radius in texels within which shadows are looked for and blurred.
const MAX_FILTER_RADIUS: f32 = 64.0;
/// What of a step of depth per texel is put down to the places of vertices, which lie on a grid of 1/256 texel.
const SLOPE_BIAS: f32 = 1.0 / 96.0;
/// What of the depth of the whole scene is put down to rounding.
const DEPTH_BIAS: f32 = 2e-6;
/// A receiver's plane no steeper than this in depth per texel: light that falls so flatly does not count.
const MAX_PLANE_SLOPE: f32 = 4.0;

/// Places in a disc of radius 1, as even as seeds in a sunflower's head (Vogel 1979).
static VOGEL_DISC: LazyLock<[[f32; 2]; 48]> = LazyLock::new(|| {
    std::array::from_fn(|at| {
        let (radius, angle) =
            (((at as f64 + 0.5) / 48.0).sqrt(), at as f64 * 2.399_963_229_728_653);
        [(radius * libm::cos(angle)) as f32, (radius * libm::sin(angle)) as f32]
    })
});

/// The way from the world to the texels of a shadow map.
#[derive(Clone, Copy, Debug, Default)]
struct WorldToShadowMap {
    /// Where places are counted from: the middle of the scene.
    origin: [f32; 3],
    /// The rows of the map from places to (x·w, y·w, depth·w, w), with x and y in texels.
    rows: [[f32; 4]; 4],
    /// The rows of the map from planes to the first three numbers of their images.
    plane_rows: [[f32; 4]; 3],
}

/// What a light sees of the scene.
#[derive(Clone, Debug, Default)]
pub struct ShadowMap {
    /// Texels of a row, and rows.
    size: [u32; 2],
    world_to_map: WorldToShadowMap,
    /// What depth is at infinite distance, in perspective: 1/w is a multiple of the depth without it. `None` in parallel light.
    depth_at_infinity: Option<f32>,
    /// The radius of the penumbra in texels, per difference of depth in parallel light, else per difference of distances over the nearer.
    penumbra_scale: f32,
    /// The nearest surface of each texel.
    pub texels: Vec<SurfaceDepth>,
}

/// Where a surface meets a shadow map: texels, depth, and what depth grows by per texel on the surface's plane.
#[derive(Clone, Copy, Debug)]
struct ReceiverPlane {
    x: f32,
    y: f32,
    depth: f32,
    slope: [f32; 2],
    bias: f32,
}

impl ShadowMap {
    /// Makes it the map of a light that sees the world by this matrix, to texels and depth, with what it casts shadows by. There is
    /// nothing in it yet.
    pub fn reset(&mut self, world_to_map: DMat4, size: [u32; 2], origin: DVec3) {
        let moved = world_to_map * DMat4::from_translation(origin.as_vec3().as_dvec3());
        let to_f32 = |row: DVec4| row.as_vec4().to_array();
        // Planes go by the inverse transposed.
        let back = moved.inverse().transpose();
        self.world_to_map = WorldToShadowMap {
            origin: origin.as_vec3().to_array(),
            rows: [0, 1, 2, 3].map(|k| to_f32(moved.row(k))),
            plane_rows: [0, 1, 2].map(|k| to_f32(back.row(k))),
        };
        self.size = size;
        self.texels.clear();
        self.texels.resize(size[0] as usize * size[1] as usize, SurfaceDepth::EMPTY);
    }

    /// How soft its shadows are: see the fields.
    pub fn set_penumbra(&mut self, spread: f64, at_infinity: Option<f64>) {
        self.penumbra_scale = spread as f32;
        self.depth_at_infinity = at_infinity.map(|depth| depth as f32);
    }

    /// The share of light, from 0 to 1, that arrives at a place in the world with this unit normal.
    #[inline(never)]
    pub(super) fn visibility(&self, place: [f32; 3], normal: [f32; 3]) -> f32 {
        let Some(receiver) = self.project_receiver(place, normal) else { return 1.0 };
        if self.penumbra_scale <= 0.0 {
            return self.filter_bilinear(&receiver);
        }
        let reach = self.penumbra_radius(receiver.depth, 1.0).clamp(1.5, MAX_FILTER_RADIUS);
        let (mut sum, mut blockers) = (0.0, 0.0);
        for [dx, dy] in VOGEL_DISC.iter().step_by(2) {
            let at = [receiver.x + dx * reach, receiver.y + dy * reach];
            if let Some(depth) = self.find_blocker(&receiver, at) {
                sum += depth;
                blockers += 1.0;
            }
        }
        if blockers == 0.0 {
            return self.filter_bilinear(&receiver);
        }
        let radius = self.penumbra_radius(receiver.depth, sum / blockers).min(MAX_FILTER_RADIUS);
        if radius <= 1.0 {
            return self.filter_bilinear(&receiver);
        }
        let mut lit = 0.0;
        for [dx, dy] in VOGEL_DISC.iter() {
            let at = [receiver.x + dx * radius, receiver.y + dy * radius];
            lit += if self.find_blocker(&receiver, at).is_none() { 1.0 } else { 0.0 };
        }
        lit / VOGEL_DISC.len() as f32
    }

    /// Where a place is on the map; `None` where it is beside the map or behind the light.
    #[inline(always)]
    fn project_receiver(&self, place: [f32; 3], n: [f32; 3]) -> Option<ReceiverPlane> {
        let WorldToShadowMap { origin, rows, plane_rows } = &self.world_to_map;
        let p = [place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]];
        let image = |row: &[f32; 4]| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        let w = image(&rows[3]);
        let [x, y, depth] = [image(&rows[0]) / w, image(&rows[1]) / w, image(&rows[2]) / w];
        let inside = |at: f32, side: u32| at > 0.0 && at < side as f32;
        if !(w > 0.0 && inside(x, self.size[0]) && inside(y, self.size[1]) && depth.is_finite()) {
            return None;
        }
        let offset = -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
        let plane =
            |row: &[f32; 4]| row[0] * n[0] + row[1] * n[1] + row[2] * n[2] + row[3] * offset;
        let along = plane(&plane_rows[2]);
        let slope = [0, 1].map(|axis: usize| {
            let slope = -plane(&plane_rows[axis]) / along;
            if slope.is_finite() { slope.clamp(-MAX_PLANE_SLOPE, MAX_PLANE_SLOPE) } else { 0.0 }
        });
        // Rounding moves places by a share of the scene's size; near a spot that is more of its depth.
        let near = self.depth_at_infinity.map_or(1.0, |none| (depth - none).max(0.0));
        let bias = DEPTH_BIAS * near.max(0.1) + SLOPE_BIAS * (slope[0].abs() + slope[1].abs());
        Some(ReceiverPlane { x, y, depth, slope, bias })
    }

    /// The radius in texels of the penumbra at one depth that something at another casts.
    #[inline(always)]
    fn penumbra_radius(&self, receiver: f32, caster: f32) -> f32 {
        let apart = match self.depth_at_infinity {
            None => caster - receiver,
            Some(none) => (caster - none) / (receiver - none).max(1e-12) - 1.0,
        };
        self.penumbra_scale * apart
    }

    /// The depth of what shades the receiver's plane at a place on the map.
    #[inline(always)]
    fn find_blocker(&self, receiver: &ReceiverPlane, [x, y]: [f32; 2]) -> Option<f32> {
        let (column, row) = (x.floor(), y.floor());
        let texel = self.texel_at(column as i32, row as i32)?;
        let plane = |x: f32, y: f32| {
            receiver.depth
                + receiver.slope[0] * (x - receiver.x)
                + receiver.slope[1] * (y - receiver.y)
        };
        let (dx, dy) = (x - column - 0.5, y - row - 0.5);
        let bias = receiver.bias + SLOPE_BIAS * (texel.dx.abs() + texel.dy.abs());
        let at_center = texel.depth - plane(column + 0.5, row + 0.5);
        let here = texel.depth + texel.dx * dx + texel.dy * dy - plane(x, y);
        (at_center > bias && here > bias).then_some(texel.depth)
    }

    /// The share of light by the four nearest texels, each with its plane carried on to the receiver.
    #[inline(always)]
    fn filter_bilinear(&self, receiver: &ReceiverPlane) -> f32 {
        let (left, top) = ((receiver.x - 0.5).floor(), (receiver.y - 0.5).floor());
        let (fx, fy) = (receiver.x - 0.5 - left, receiver.y - 0.5 - top);
        let mut lit = 0.0;
        for (column, across) in [(0.0, 1.0 - fx), (1.0, fx)] {
            for (row, down) in [(0.0, 1.0 - fy), (1.0, fy)] {
                let texel = self.texel_at((left + column) as i32, (top + row) as i32);
                let (dx, dy) = (fx - column, fy - row);
                let shades = texel.is_some_and(|texel| {
                    let bias = receiver.bias + SLOPE_BIAS * (texel.dx.abs() + texel.dy.abs());
                    let above = texel.depth - receiver.depth;
                    let at_center = above + receiver.slope[0] * dx + receiver.slope[1] * dy;
                    at_center > bias && above + texel.dx * dx + texel.dy * dy > bias
                });
                lit += if shades { 0.0 } else { across * down };
            }
        }
        lit
    }

    #[inline(always)]
    fn texel_at(&self, column: i32, row: i32) -> Option<&SurfaceDepth> {
        let [width, height] = self.size;
        let (column, row) = (u32::try_from(column).ok()?, u32::try_from(row).ok()?);
        let inside = column < width && row < height;
        self.texels.get(row as usize * width as usize + column as usize).filter(|_| inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of 100 × 100 texels of side 0.01 seen from above: x to the right, y is depth, z downwards. Left of x = 0.6 there is
    /// something at a height.
    fn map(height: f32, spread: f64) -> ShadowMap {
        let mut map = ShadowMap::default();
        let world_to_map = DMat4::from_cols(
            DVec4::new(100.0, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 1.0, 0.0),
            DVec4::new(0.0, 100.0, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, 1.0),
        );
        map.reset(world_to_map, [100, 100], DVec3::new(0.5, 0.0, 0.5));
        map.set_penumbra(spread, None);
        for (at, texel) in map.texels.iter_mut().enumerate() {
            if at % 100 < 60 {
                *texel = SurfaceDepth { depth: height, dx: 0.0, dy: 0.0 };
            }
        }
        map
    }

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn what_is_above_shades_and_what_is_below_does_not() {
        let map = map(0.5, 0.0);
        for (x, y, due) in [(0.2, 0.1, 0.0), (0.2, 0.499, 0.0), (0.2, 0.501, 1.0), (0.7, 0.1, 1.0)]
        {
            assert_eq!(map.visibility([x, y, 0.5], UP), due, "{x} {y}");
        }
        assert_eq!(map.visibility([-0.1, 0.1, 0.5], UP), 1.0, "beside the map there is light");
        assert!((map.visibility([0.6, 0.1, 0.5], UP) - 0.5).abs() < 0.01, "half at the border");
    }

    #[test]
    fn penumbras_grow_with_the_distance_of_the_caster() {
        // 40 texels per unit of depth: at 0.5 below the caster the penumbra is 40 texels wide, at 0.05 it is 4.
        let map = map(0.5, 40.0);
        for y in [0.0_f32, 0.25, 0.45] {
            let radius = (0.5 - y) * 0.4;
            let at = |share: f32| map.visibility([0.6 + share * radius, y, 0.5], UP);
            assert!((at(0.0) - 0.5).abs() < 0.06, "{y} {}", at(0.0));
            assert_eq!((at(-1.3), at(1.3)), (0.0, 1.0), "{y}");
            // The share of a disc that a straight border leaves, at half of its radius: 0.8045.
            assert!((at(0.5) - 0.8045).abs() < 0.06, "{y} {}", at(0.5));
        }
    }

    #[test]
    fn a_slope_does_not_shade_itself() {
        let mut map = map(0.5, 30.0);
        for slope in [0.001_f32, 0.05, 0.9] {
            for (at, texel) in map.texels.iter_mut().enumerate() {
                let x = (at % 100) as f32 + 0.5;
                *texel = SurfaceDepth { depth: slope * (x - 50.0), dx: slope, dy: 0.0 };
            }
            // Depth grows by `slope` per texel: the plane is y = 100 slope (x − 0.5).
            let length = (1.0 + 1e4 * slope * slope).sqrt();
            let normal = [-100.0 * slope / length, 1.0 / length, 0.0];
            for step in 0..500 {
                let x = 0.25 + step as f32 * 0.001;
                let place = [x, 100.0 * slope * (x - 0.5), 0.5];
                assert_eq!(map.visibility(place, normal), 1.0, "{slope} {x}");
            }
        }
    }
}
