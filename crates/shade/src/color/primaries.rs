//! Color spaces by matrices: CIE XYZ and linear sRGB.

/// CIE XYZ to linear sRGB, with the white point D65 (IEC 61966-2-1; digits by Lindbloom, *RGB/XYZ
/// matrices*).
pub(crate) const XYZ_TO_SRGB: [[f32; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// A color times a matrix of rows.
#[inline(always)]
pub(crate) fn multiply_matrix(matrix: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|row: usize| matrix[row][0] * x + matrix[row][1] * y + matrix[row][2] * z)
}
