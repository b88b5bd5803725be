//! Refraction by Snell's law, dispersion, and blur by roughness: the positions in the transmission
//! framebuffer that a surface reads to show the objects behind it.
//!
//! ```text
//!   v ╲  │ n            sin θᵢ = ior · sin θₜ
//!      ╲θᵢ
//!  ─────╳──────         surface
//!       │╲    thickness along the refracted ray
//!       │θₜ ●           exit: looked up where it appears on the screen
//! ```
//!
//! As in the Khronos sample viewer, there is a single refraction, at the entry, and the material's
//! thickness is the length of the path inside.

use crate::Draw;
use crate::lanes::{Lanes, Vec3Lanes};
use crate::surface_geometry::SurfaceGeometry;

/// Returns the indices of refraction for red, green and blue (KHR_materials_dispersion).
///
/// Dispersion is 20 divided by the Abbe number; blue is refracted most.
#[inline(always)]
pub(super) fn channel_iors(draw: &Draw<'_>) -> [f32; 3] {
    let extensions = &draw.material.extensions;
    let half_spread = (extensions.ior - 1.0) * 0.025 * extensions.dispersion;
    [extensions.ior - half_spread, extensions.ior, extensions.ior + half_spread]
}

/// Computes the world positions where refracted rays of these lengths end.
#[inline(always)]
pub(super) fn refracted_exits<const N: usize>(
    geometry: &SurfaceGeometry<N>,
    ior: f32,
    lengths: Lanes<N>,
) -> Vec3Lanes<N> {
    let SurfaceGeometry { positions, views, normals, n_dot_v, .. } = *geometry;
    // Snell's law in vector form. There is no total reflection, because the index is raised to at
    // least 1; dispersion may have reduced it below that.
    let eta = 1.0 / ior.max(1.0);
    let cos_squared = (1.0 - eta * eta * (1.0 - n_dot_v * n_dot_v)).max(0.0);
    let rays = normals * (eta * n_dot_v - cos_squared.sqrt()) - views * eta;
    // Normals that point away from the viewer produce rays that are not quite unit vectors.
    positions + rays * (lengths / rays.dot(rays).sqrt().max(1e-6))
}

/// The side length of the Khronos sample viewer's framebuffer in texels.
const REFERENCE_SIDE: f32 = 1024.0;
/// The base-2 logarithm of that side length, which the viewer multiplies by the roughness.
const REFERENCE_LEVELS: f32 = 10.0;

/// Computes the mip levels that give the blur for these roughnesses. `longer_side` is the number of
/// texels along the framebuffer's longer side.
///
/// The Khronos sample viewer uses the level log₂(size) · roughness in a framebuffer of 1024 texels.
/// At other sizes this would blur by a different fraction of the picture, so the width of the
/// filter is scaled. At 1024 texels the levels equal the viewer's, and a roughness of 0 is level 0
/// at any size. Roughness is reduced as the index of refraction approaches 1, because a surface
/// with index 1 does not scatter light.
#[inline(always)]
pub(super) fn blur_levels<const N: usize>(
    roughness: Lanes<N>,
    ior: f32,
    longer_side: f32,
) -> Lanes<N> {
    let damping = (ior * 2.0 - 2.0).clamp(0.0, 1.0);
    roughness.map_expensive(|roughness| {
        let width = libm::exp2f(REFERENCE_LEVELS * roughness.clamp(0.0, 1.0) * damping);
        libm::log2f(1.0 + (width - 1.0) * (longer_side / REFERENCE_SIDE))
    })
}
