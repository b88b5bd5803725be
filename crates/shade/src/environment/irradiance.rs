//! Spherical harmonics: scattered light of an environment in nine numbers a channel.
//!
//! Ramamoorthi and Hanrahan, *An efficient representation for irradiance environment maps*, 2001: a matt surface sees its
//! surroundings so blurred that harmonics beyond the second degree count less than three per cent.

use super::octahedral_map::{OctahedralMap, decode_octahedral, node_coordinate, normalize};
use std::f64::consts::PI;

/// What a convolution with a cosine leaves of each degree, over π.
const COSINE_CONVOLUTION: [f64; 3] = [1.0, 2.0 / 3.0, 0.25];

/// Irradiance over π by direction: for each channel the factors of the nine products of coordinates.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct IrradianceHarmonics {
    coefficients: [[f32; 9]; 3],
}

/// The nine functions without their factors, and the squares of those.
fn basis_functions([x, y, z]: [f64; 3]) -> [f64; 9] {
    [1.0, x, y, z, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

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

impl IrradianceHarmonics {
    /// Those of a picture of all directions.
    pub(super) fn project(map: &OctahedralMap) -> Self {
        let (mut sums, mut whole) = ([[0.0; 9]; 3], 0.0);
        for (n, texel) in map.texels.iter().enumerate() {
            let (column, row) = (n % map.side, n / map.side);
            let flat = decode_octahedral(
                node_coordinate(column, map.side),
                node_coordinate(row, map.side),
            )
            .map(f64::from);
            // How much of the sphere a node stands for: the octahedron's faces are at 1/√3 and seen aslant.
            let length = (flat[0] * flat[0] + flat[1] * flat[1] + flat[2] * flat[2]).sqrt();
            let is_last = |at: usize| at == 0 || at == map.side - 1;
            let half = |last: bool| if last { 0.5 } else { 1.0 };
            let solid = half(is_last(column)) * half(is_last(row)) / (length * length * length);
            let way = normalize(flat.map(|c| c as f32)).map(f64::from);
            whole += solid;
            for (sums, light) in sums.iter_mut().zip(texel) {
                for (sum, value) in sums.iter_mut().zip(basis_functions(way)) {
                    *sum += value * f64::from(*light) * solid;
                }
            }
        }
        let factor = |sums: [f64; 9]| {
            std::array::from_fn(|k| {
                let degree = usize::from(k > 0) + usize::from(k > 3);
                (sums[k] * (4.0 * PI / whole) * BASIS_NORMALIZATION[k] * COSINE_CONVOLUTION[degree])
                    as f32
            })
        };
        Self { coefficients: sums.map(factor) }
    }

    /// Irradiance over π for unit normals; never below 0.
    #[inline(always)]
    pub(super) fn irradiance_over_pi<const N: usize>(
        &self,
        normals: &[[f32; N]; 3],
    ) -> [[f32; N]; 3] {
        let mut light = [[0.0; N]; 3];
        for channel in 0..3 {
            let f = &self.coefficients[channel];
            for lane in 0..N {
                let (x, y, z) = (normals[0][lane], normals[1][lane], normals[2][lane]);
                let first = f[0] + f[1] * x + f[2] * y + f[3] * z;
                let mixed = f[4] * x * y + f[5] * y * z + f[7] * x * z;
                let squares = f[6] * (3.0 * z * z - 1.0) + f[8] * (x * x - y * y);
                light[channel][lane] = (first + mixed + squares).max(0.0);
            }
        }
        light
    }
}
