//! Normal mapping: shading normals from a texture in tangent space (glTF 2.0 §3.9.3).
//!
//! ```text
//!            n  blue          n' = normalize(red · t + green · b + blue · n)
//!            │ ╱ n'           b  = w · n × t, where w = ±1 is the handedness of the tangent frame
//!            │╱
//!            ●────── t  red
//!           ╱
//!          b  green
//! ```

use crate::lanes::{Lanes, Vec3Lanes};

/// The interpolated tangents of `N` fragments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TangentLanes<const N: usize> {
    /// The direction of increasing u on the surface, of any length; zero if unknown.
    pub(crate) vectors: Vec3Lanes<N>,
    /// The fourth component, whose sign is the handedness of the frame.
    pub(crate) w: Lanes<N>,
}

impl<const N: usize> TangentLanes<N> {
    /// The tangents for a mesh without tangents.
    pub(crate) const NONE: Self = Self { vectors: Vec3Lanes::ZERO, w: Lanes::ZERO };

    /// Returns 1 if the bitangent is n × t, or −1 if it is opposite.
    #[inline(always)]
    pub(crate) fn handedness(&self) -> Lanes<N> {
        self.w.map(|w| if w < 0.0 { -1.0 } else { 1.0 })
    }
}

/// Transforms the normals of a normal map from tangent space to world space.
///
/// The frame consists of unit vectors, as MikkTSpace requires, but is not orthogonalized. The
/// surface normal is returned unchanged if there is no tangent or the sum has no direction.
#[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
#[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
pub(super) fn apply_normal_map<const N: usize>(
    normals: Vec3Lanes<N>,
    tangents: &TangentLanes<N>,
    tangent_normals: Vec3Lanes<N>,
) -> Vec3Lanes<N> {
    let tangent = tangents.vectors;
    let bitangent = normals.cross(tangent);
    let bitangent_square = bitangent.dot(bitangent);
    // Red is along the unit tangent, and green is along the unit bitangent.
    let u = tangent_normals.x / tangent.dot(tangent).sqrt();
    let v = tangents.handedness() * tangent_normals.y / bitangent_square.sqrt();
    let sum = tangent * u + bitangent * v + normals * tangent_normals.z;
    let square = sum.dot(sum);
    let mapped = sum * (1.0 / square.sqrt());
    let mut has_direction = [false; N];
    for (lane, has_direction) in has_direction.iter_mut().enumerate() {
        let is_finite = square[lane] > 1e-12 && square[lane] < f32::INFINITY;
        *has_direction = bitangent_square[lane] > 0.0 && is_finite;
    }
    mapped.select(&has_direction, normals)
}
