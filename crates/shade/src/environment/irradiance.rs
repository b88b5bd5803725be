//! Irradiance as spherical harmonics: the diffuse light of an environment in nine numbers per
//! channel.
//!
//! Ramamoorthi and Hanrahan, *An efficient representation for irradiance environment maps*, 2001. A
//! Lambert surface convolves its environment with a cosine, which multiplies each degree of the
//! harmonics by a constant; the degrees beyond the second contribute less than three percent.
//!
//! ```text
//!  E(n) / π = Σ Aₗ / π · Lₗₘ · Yₗₘ(n)        Aₗ / π = 1, 2/3, 1/4
//! ```

use super::octahedral_map::{OctahedralMap, decode_octahedral, node_coordinate};
use crate::lanes::{Lanes, Rgb, Vec3Lanes};
use crate::vector::normalize;
use std::f64::consts::PI;

/// The factors of the degrees under convolution with a clamped cosine, divided by π.
const COSINE_CONVOLUTION: [f64; 3] = [1.0, 2.0 / 3.0, 0.25];

/// The squares of the factors that make [`basis_functions`] orthonormal.
const BASIS_NORMALIZATION: [f64; 9] = [
    0.25 / PI,
    0.75 / PI,
    0.75 / PI,
    0.75 / PI,
    3.75 / PI,
    3.75 / PI,
    0.3125 / PI,
    3.75 / PI,
    0.9375 / PI,
];

/// Computes the nine real spherical harmonics up to the second degree, without their factors.
fn basis_functions([x, y, z]: [f64; 3]) -> [f64; 9] {
    [1.0, x, y, z, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

/// Irradiance over π by direction, as the coefficients of the nine functions for each channel.
///
/// The coefficients include the factors of projection, convolution and reconstruction, so that a
/// lookup is a polynomial in the normal with 15 multiplications per channel.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct IrradianceHarmonics {
    coefficients: [[f32; 9]; 3],
}

impl IrradianceHarmonics {
    /// Projects an environment onto the harmonics and convolves it with the cosine.
    pub(super) fn project(map: &OctahedralMap) -> Self {
        let (mut sums, mut sphere) = ([[0.0; 9]; 3], 0.0);
        for (node, texel) in map.texels.iter().enumerate() {
            let (column, row) = (node % map.side, node / map.side);
            let [u, v] = [column, row].map(|index| node_coordinate(index, map.side));
            let point = decode_octahedral(u, v).map(f64::from);
            // The solid angle of a node: the octahedron's faces are at distance 1/√3 and seen at an
            // angle.
            let square = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
            let length = square.sqrt();
            let is_border = |index: usize| index == 0 || index == map.side - 1;
            let half = |is_border: bool| if is_border { 0.5 } else { 1.0 };
            let solid_angle =
                half(is_border(column)) * half(is_border(row)) / (length * length * length);
            // Projection is the integral of radiance times each basis function.
            let direction = normalize(point.map(|c| c as f32)).map(f64::from);
            sphere += solid_angle;
            for (sums, radiance) in sums.iter_mut().zip(texel) {
                for (sum, value) in sums.iter_mut().zip(basis_functions(direction)) {
                    *sum += value * f64::from(*radiance) * solid_angle;
                }
            }
        }
        let coefficients = |sums: [f64; 9]| {
            std::array::from_fn(|k| {
                // Degree 0 has one function, degree 1 has three, and degree 2 has five.
                let degree = usize::from(k > 0) + usize::from(k > 3);
                // Normalize over the sphere, then convolve with the clamped cosine.
                let projection = sums[k] * (4.0 * PI / sphere) * BASIS_NORMALIZATION[k];
                (projection * COSINE_CONVOLUTION[degree]) as f32
            })
        };
        Self { coefficients: sums.map(coefficients) }
    }

    /// Computes the irradiance over π for unit normals. It is never below 0, despite the ringing of
    /// the truncated series.
    #[inline(always)]
    pub(super) fn irradiance_over_pi<const N: usize>(&self, normals: Vec3Lanes<N>) -> Rgb<N> {
        let [r, g, b] = &self.coefficients;
        Rgb {
            r: sum_harmonics(r, normals),
            g: sum_harmonics(g, normals),
            b: sum_harmonics(b, normals),
        }
    }
}

/// Computes the sum of the nine functions with these coefficients, at least 0.
#[inline(always)]
fn sum_harmonics<const N: usize>(f: &[f32; 9], normals: Vec3Lanes<N>) -> Lanes<N> {
    let Vec3Lanes { x, y, z } = normals;
    // Degrees 0 and 1, then the five functions of degree 2.
    let linear = f[0] + f[1] * x + f[2] * y + f[3] * z;
    let mixed = f[4] * x * y + f[5] * y * z + f[7] * x * z;
    let squares = f[6] * (3.0 * z * z - 1.0) + f[8] * (x * x - y * y);
    (linear + mixed + squares).max(0.0)
}
