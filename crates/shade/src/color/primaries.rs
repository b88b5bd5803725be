//! The color space matrix from CIE XYZ to linear sRGB, and matrix multiplication.

use std::ops::{Add, Mul};

/// CIE XYZ to linear sRGB, with the white point D65 (IEC 61966-2-1; digits by Lindbloom, *RGB/XYZ
/// matrices*).
pub(crate) const XYZ_TO_SRGB: [[f32; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// Multiplies a matrix, given as rows, by one color or by the lanes of several colors.
#[inline(always)]
pub(crate) fn multiply_matrix<T>(matrix: &[[f32; 3]; 3], [x, y, z]: [T; 3]) -> [T; 3]
where
    T: Copy + Mul<f32, Output = T> + Add<Output = T>,
{
    let row = |[a, b, c]: [f32; 3]| x * a + y * b + z * c;
    [row(matrix[0]), row(matrix[1]), row(matrix[2])]
}
