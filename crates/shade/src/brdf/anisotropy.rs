//! Anisotropic GGX: highlights stretched in one direction, as on brushed metal
//! (KHR_materials_anisotropy).
//!
//! ```text
//!  D = 1 / (π αt αb ((t·h / αt)² + (b·h / αb)² + (n·h)²)²)                Burley 2012
//!  V = ½ / (n·l Λ(v) + n·v Λ(l)),  Λ(w)² = (αt t·w)² + (αb b·w)² + (n·w)²  Heitz 2014
//! ```
//!
//! The α along the bitangent is αb = α, the same as for isotropic GGX. The α along the tangent is
//! αt = α + (1 − α) · strength², as defined by KHR_materials_anisotropy. With strength 0, both
//! formulas reduce to isotropic GGX.

use super::microfacet::ShadingAngles;
use crate::lanes::{Lanes, Vec3Lanes};
use crate::material_inputs::MaterialInputs;
use crate::surface_geometry::{SurfaceGeometry, TangentLanes};
use std::f32::consts::FRAC_1_PI;

/// The anisotropy frames of `N` fragments, and the α along their tangents.
///
/// The tangent, bitangent and normal are orthonormal if the mesh has tangents.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anisotropy<const N: usize> {
    /// Unit vectors along which highlights are stretched, or 0 if the surface has no tangent.
    tangents: Vec3Lanes<N>,
    /// Unit vectors perpendicular to the tangent and the normal.
    bitangents: Vec3Lanes<N>,
    /// The GGX α along the tangents, not less than the α along the bitangents.
    tangent_alpha: Lanes<N>,
    /// The strength of the anisotropy, from 0 to 1, or 0 if the surface has no tangent.
    strength: Lanes<N>,
}

impl<const N: usize> Anisotropy<N> {
    /// Creates the frame of a surface with these tangents, rotated by the material's angle in
    /// radians and by the direction in its texture.
    #[inline(always)]
    pub(super) fn new(
        inputs: &MaterialInputs<N>,
        geometry: &SurfaceGeometry<N>,
        tangents: &TangentLanes<N>,
        rotation: f32,
        alpha: Lanes<N>,
    ) -> Self {
        let n = geometry.normals;
        // Gram-Schmidt: make the tangent perpendicular to the normal from the normal map.
        let t = tangents.vectors - n * n.dot(tangents.vectors);
        let inv_length =
            t.dot(t).map(|square| if square > 1e-12 { 1.0 / square.sqrt() } else { 0.0 });
        let t = t * inv_length;
        // The bitangent, with the handedness stored in the tangent's w.
        let b = n.cross(t) * tangents.handedness();
        // The direction in the tangent plane: the texture, then the rotation.
        let (sin, cos) = (libm::sinf(rotation), libm::cosf(rotation));
        let Vec3Lanes { x, y, z: strength } = inputs.layers.anisotropy;
        let length = (x * x + y * y).sqrt().max(1e-6);
        let (x, y) = ((cos * x - sin * y) / length, (sin * x + cos * y) / length);
        let strength = strength.clamp(0.0, 1.0).select(&inv_length.is_above(0.0), Lanes::ZERO);
        Self {
            tangents: t * x + b * y,
            bitangents: b * x - t * y,
            tangent_alpha: alpha.lerp(Lanes::ONE, strength * strength),
            strength,
        }
    }

    /// Computes the bent normals for environment reflections at a perceptual roughness.
    ///
    /// A stretched lobe reflects a fan of directions, but the prefiltered environment has only
    /// round lobes. So the normal is bent toward the plane of the bitangent and the view, in which
    /// the lobe is narrow: `n' ∝ mix((b × v) × b, n, (1 − strength (1 − roughness))⁴)`
    /// (KHR_materials_anisotropy, after Revie 2012).
    #[inline(always)]
    pub(super) fn bent_normals(
        &self,
        normals: Vec3Lanes<N>,
        views: Vec3Lanes<N>,
        roughness: Lanes<N>,
    ) -> Vec3Lanes<N> {
        let across = self.bitangents.cross(views).cross(self.bitangents);
        let kept = 1.0 - self.strength * (1.0 - roughness);
        let kept = kept * kept * kept * kept;
        let bent = across + (normals - across) * kept;
        bent * (1.0 / bent.dot(bent).max(1e-12).sqrt())
    }

    /// Computes the anisotropic GGX lobe with the cosine factor but without Fresnel: `D · V · n·l`,
    /// with `alpha` along the bitangent.
    ///
    /// The isotropic lobe is `ShadingAngles::ggx_lobe` in `microfacet.rs`.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(super) fn ggx_lobe(
        &self,
        angles: &ShadingAngles<N>,
        alpha: Lanes<N>,
        v: Vec3Lanes<N>,
        l: Vec3Lanes<N>,
    ) -> Lanes<N> {
        let (t, b) = (self.tangents, self.bitangents);
        let (alpha_t, alpha_b) = (self.tangent_alpha, alpha);
        let ShadingAngles { n_dot_l, n_dot_v, n_dot_h, .. } = *angles;
        // Anisotropic GGX distribution, Burley 2012: the half vector's components in the frame,
        // divided by αt and αb.
        let sum = l + v;
        let inv_length = 1.0 / sum.dot(sum).max(1e-12).sqrt();
        let t_dot_h = t.dot(sum) * inv_length / alpha_t;
        let b_dot_h = b.dot(sum) * inv_length / alpha_b;
        let spread = (t_dot_h * t_dot_h + b_dot_h * b_dot_h + n_dot_h * n_dot_h).max(1e-9);
        let distribution = FRAC_1_PI / (alpha_t * alpha_b * spread * spread);
        // Smith height-correlated visibility, Heitz 2014.
        let lambda = |direction: Vec3Lanes<N>, cosine: Lanes<N>| {
            let (along, across) = (alpha_t * t.dot(direction), alpha_b * b.dot(direction));
            (along * along + across * across + cosine * cosine).sqrt()
        };
        let masking = n_dot_l * lambda(v, n_dot_v) + n_dot_v * lambda(l, n_dot_l);
        distribution * (0.5 * n_dot_l) / masking.max(1e-6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a frame whose lobe is stretched along x with this strength.
    fn frame(strength: f32) -> Anisotropy<1> {
        Anisotropy {
            tangents: Vec3Lanes::splat([1.0, 0.0, 0.0]),
            bitangents: Vec3Lanes::splat([0.0, 1.0, 0.0]),
            tangent_alpha: Lanes::ONE,
            strength: Lanes::splat(strength),
        }
    }

    /// Bends the normal +z for an oblique view, at this strength and perceptual roughness.
    fn bent_normal(strength: f32, roughness: f32) -> [f32; 3] {
        let normal = Vec3Lanes::splat([0.0, 0.0, 1.0]);
        let view = Vec3Lanes::splat([0.6, 0.48, 0.64]);
        frame(strength).bent_normals(normal, view, Lanes::splat(roughness)).lane(0)
    }

    #[test]
    fn environment_reflections_use_bent_normals() {
        // When fully bent, the normal is the view without its component along the bitangent,
        // normalized.
        let [x, y, z] = bent_normal(1.0, 0.0);
        let length = (0.6_f32 * 0.6 + 0.64 * 0.64).sqrt();
        assert!((x - 0.6 / length).abs() < 1e-6 && y.abs() < 1e-6, "{x} {y} {z}");
        assert!((z - 0.64 / length).abs() < 1e-6, "{z}");
        // In between, the normal bends toward the view along x, and less for rougher surfaces.
        assert!(bent_normal(0.5, 0.2)[0] > bent_normal(0.5, 0.6)[0]);
        assert!(bent_normal(0.5, 0.2)[0] > bent_normal(0.3, 0.2)[0]);
    }

    #[test]
    fn normals_do_not_bend_without_anisotropy_or_smoothness() {
        for (strength, roughness) in [(0.0, 0.0), (0.0, 0.7), (1.0, 1.0)] {
            let [x, y, z] = bent_normal(strength, roughness);
            assert!(x.abs() < 1e-6 && y.abs() < 1e-6 && (z - 1.0).abs() < 1e-6, "{strength}");
        }
    }
}
