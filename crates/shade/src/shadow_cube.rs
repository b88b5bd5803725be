//! Cube shadow maps: the shadows of a point light in six maps of 90° each.
//!
//! ```text
//!        ┌────┐              a receiver is looked up in the face of its largest coordinate;
//!        │ +y │              ╲ │ ╱   the filter's disc is perpendicular to the direction
//!   ┌────┼────┼────┬────┐     ╲│╱    from the light on every face
//!   │ −x │ +z │ +x │ −z │   ───●───
//!   └────┼────┼────┴────┘     ╱│╲
//!        │ −y │              ╱ │ ╲   faces overlap by the maximum radius of the disc
//!        └────┘
//! ```
//!
//! A disc of texels would be an ellipse of directions, with a different shape beyond the border of
//! a face. The disc is therefore defined in directions, in a frame that varies continuously with
//! them, and is projected onto the face. Distances are measured along the direction of the
//! receiver, not along the axis of the face. These two choices make both sides of a border agree.
//! Depth planes, biases and the growth of the penumbra work as in [`ShadowMap`].

use super::lanes::Vec3Lanes;
use super::shadow_map::{ShadowMap, VOGEL_DISC};
use super::vector::{dot, subtract};

/// The shadow maps of a point light.
#[derive(Clone, Debug)]
pub struct ShadowCube {
    /// The position of the light in the world.
    pub position: [f32; 3],
    /// The maps along +x, −x, +y, −y, +z and −z, with `None` where nothing casts a shadow.
    ///
    /// Each map must extend beyond its 90° by a disc of radius
    /// [`MAX_PENUMBRA`](Self::MAX_PENUMBRA).
    pub faces: [Option<ShadowMap>; 6],
    /// The tangent of half the angle that the light subtends, or 0 for hard shadow edges.
    pub spread: f32,
    /// A distance from the light, greater than 0, within which nothing casts a shadow.
    pub nearest: f32,
    /// The side length of a texel at distance 1 along the axis of a face.
    pub texel: f32,
}

/// A disc of directions around a receiver's direction, projected onto a face.
///
/// Texel coordinates are homogeneous, (x·w, y·w, w), so they are linear in offsets on the disc.
struct ProjectedDisc {
    center: [f32; 3],
    along: [f32; 3],
    across: [f32; 3],
}

impl ProjectedDisc {
    /// Creates the disc of radius 1 at distance 1, perpendicular to the unit vector `direction`.
    #[inline(always)]
    fn new(map: &ShadowMap, direction: [f32; 3]) -> Self {
        let [along, across] = perpendicular_frame(direction);
        Self {
            center: map.project_direction(direction),
            along: map.project_direction(along),
            across: map.project_direction(across),
        }
    }

    /// Computes the texel coordinates x and y of a position on the disc, and its w.
    #[inline(always)]
    fn texel_at(&self, [dx, dy]: [f32; 2]) -> ([f32; 2], f32) {
        let [x, y, w] =
            [0, 1, 2].map(|k: usize| self.center[k] + dx * self.along[k] + dy * self.across[k]);
        ([x / w, y / w], w)
    }
}

impl ShadowCube {
    /// The maximum radius of a penumbra at distance 1, as seen from the light.
    ///
    /// Wider penumbras are clamped, because the filter positions would be too far apart, and faces
    /// would have to overlap by more.
    pub const MAX_PENUMBRA: f32 = 1.0 / 16.0;

    /// Computes the visibility of the light, 0 to 1, from a position in the world with this unit
    /// normal.
    #[inline(never)]
    pub(super) fn visibility(&self, position: [f32; 3], normal: [f32; 3]) -> f32 {
        let from_light = subtract(position, self.position);
        let Some(map) = &self.faces[face_index(from_light)] else { return 1.0 };
        let planes =
            map.project_receivers::<1>(Vec3Lanes::splat(position), Vec3Lanes::splat(normal));
        if !planes.is_on_map[0] {
            return 1.0;
        }
        let receiver = planes.lane(0);
        if self.spread <= 0.0 {
            return map.filter_bilinear(&planes)[0];
        }
        let distance = dot(from_light, from_light).sqrt();
        let disc = ProjectedDisc::new(map, from_light.map(|c| c / distance));
        // Blocker search within the penumbra of the nearest possible caster.
        let search_radius = (self.spread * (distance / self.nearest - 1.0))
            .clamp(1.5 * self.texel, Self::MAX_PENUMBRA);
        let (mut nearness_sum, mut blockers) = (0.0, 0.0);
        for offset in VOGEL_DISC.iter().step_by(2) {
            let (texel, w) = disc.texel_at(offset.map(|c| c * search_radius));
            if let Some(depth) = map.find_blocker(&receiver, texel) {
                // 1 / distance along the receiver's direction, up to a factor.
                nearness_sum += map.nearness(depth) * w;
                blockers += 1.0;
            }
        }
        if blockers == 0.0 {
            return map.filter_bilinear(&planes)[0];
        }
        // The penumbra of the mean blocker, by similar triangles (PCSS, Fernando 2005).
        let receiver_nearness = map.nearness(receiver.depth) * disc.center[2];
        let ratio = nearness_sum / (blockers * receiver_nearness.max(1e-12));
        let radius = (self.spread * (ratio - 1.0)).min(Self::MAX_PENUMBRA);
        if radius <= self.texel {
            return map.filter_bilinear(&planes)[0];
        }
        // Percentage-closer filtering over the penumbra.
        let mut visible = 0.0;
        for offset in VOGEL_DISC.iter() {
            let (texel, _) = disc.texel_at(offset.map(|c| c * radius));
            visible += if map.find_blocker(&receiver, texel).is_none() { 1.0 } else { 0.0 };
        }
        visible / VOGEL_DISC.len() as f32
    }
}

/// Returns the face that a direction from the light intersects, which depends on its largest
/// coordinate.
#[inline(always)]
fn face_index([x, y, z]: [f32; 3]) -> usize {
    let (axis, along) = match [x.abs(), y.abs(), z.abs()] {
        [x_length, y_length, z_length] if x_length >= y_length && x_length >= z_length => (0, x),
        [_, y_length, z_length] if y_length >= z_length => (1, y),
        _ => (2, z),
    };
    2 * axis + usize::from(along < 0.0)
}

/// Returns two unit vectors perpendicular to a unit vector and to each other (Frisvad, *Building an
/// orthonormal basis from a 3D unit vector without normalization*, 2012).
///
/// They vary continuously except at +y, directly above the light, where shadows are least visible.
#[inline(always)]
fn perpendicular_frame([x, y, z]: [f32; 3]) -> [[f32; 3]; 2] {
    if y > 0.999_999 {
        return [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let a = 1.0 / (1.0 - y);
    let mixed = -x * z * a;
    [[1.0 - x * x * a, x, mixed], [mixed, z, 1.0 - z * z * a]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_in_all_directions() {
        for step in 0..1000 {
            let height = (step as f32 + 0.5) / 500.0 - 1.0;
            let (ring, angle) = ((1.0 - height * height).sqrt(), step as f32 * 2.4);
            let direction = [ring * libm::cosf(angle), height, ring * libm::sinf(angle)];
            let [along, across] = perpendicular_frame(direction);
            let products = [
                dot(along, along) - 1.0,
                dot(across, across) - 1.0,
                dot(along, across),
                dot(along, direction),
                dot(across, direction),
            ];
            assert!(products.iter().all(|c| c.abs() < 1e-4), "{direction:?} {products:?}");
        }
    }

    #[test]
    fn the_largest_coordinate_selects_the_face() {
        let directions = [
            [3.0, -1.0, 2.0],
            [-3.0, -1.0, 2.0],
            [1.0, 2.0, -1.5],
            [1.0, -2.0, -1.5],
            [-1.0, 2.0, 2.5],
            [-1.0, 2.0, -2.5],
        ];
        assert_eq!(directions.map(face_index), [0, 1, 2, 3, 4, 5]);
    }
}
