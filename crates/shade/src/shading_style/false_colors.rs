//! The colors of styles: matcap, checkerboard, part colors, colormaps, and numbers as sRGB codes.

use crate::Draw;
use crate::approximations::{exp2_approx, floor_to_int, log2_approx};
use crate::attributes::VertexIndices;
use crate::fragment_lanes::FragmentLanes;
use crate::kernel_part::kernel_part;
use crate::lanes::{Lanes, Rgb, Vec3Lanes};
use crate::vector::normalize_or_zero;
use model::{Colormap, TextureInfo};

/// The number of checkerboard squares per unit of texture coordinates.
const CHECKER_SQUARES: f32 = 8.0;

/// Computes the color of a glazed clay ball at normals with z toward the viewer, with light from
/// the upper left, a highlight and a rim.
#[inline(always)]
pub(super) fn matcap_ball_color<const N: usize>(normals: Vec3Lanes<N>) -> Rgb<N> {
    let light = [-0.4, 0.64, 0.656];
    // Half Lambert: the cosine, mapped to [0, 1] and squared.
    let wrapped = 0.5 + 0.5 * normals.dot(Vec3Lanes::splat(light));
    let diffuse = 0.06 + 0.94 * wrapped * wrapped;
    // Blinn-Phong highlight.
    let half = normalize_or_zero([light[0], light[1], light[2] + 1.0]);
    let fourth = |c: Lanes<N>| c * c * c * c;
    let gloss = 0.4 * fourth(fourth(normals.dot(Vec3Lanes::splat(half)).max(0.0)));
    // Rim light.
    let away = 1.0 - normals.z.clamp(0.0, 1.0);
    let rim = 0.25 * away * away * away;
    let color = |base: f32, rim_color: f32| base * diffuse + gloss + rim * rim_color;
    Rgb { r: color(0.5, 0.5), g: color(0.24, 0.7), b: color(0.16, 1.0) }
}

/// Computes a checkerboard whose squares fade if they are smaller than pixels. It is gray without
/// texture coordinates.
#[inline(always)]
pub(super) fn checker_color<const N: usize>(
    draw: &Draw<'_>,
    vertices: &VertexIndices<N>,
    fragments: &impl FragmentLanes<N>,
    n_dot_v: Lanes<N>,
) -> Rgb<N> {
    let light = 0.4 + 0.6 * n_dot_v;
    if draw.primitive.uvs.is_empty() {
        return decode_codes(Rgb::splat([0.35; 3]) * light);
    }
    let info = TextureInfo { texture: 0, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
    let uvs = draw.texture_coordinates(vertices, fragments, &info);
    let [u, v] = uvs.uv;
    // In odd squares, the integer parts add up to an odd number.
    let squares = whole_part(u * CHECKER_SQUARES) + whole_part(v * CHECKER_SQUARES);
    let is_even = (squares - 2.0 * whole_part(squares * 0.5)).is_below(1.0);
    // The number of squares per pixel, for fading the contrast.
    let [dx, dy] = [uvs.dx, uvs.dy].map(|[du, dv]| du.abs().max_lanes(dv.abs()));
    let step = dx.max_lanes(dy) * CHECKER_SQUARES;
    let contrast = 0.35 * (1.5 - step).clamp(0.0, 1.0);
    let shade = light.select(&is_even, light * (1.0 - contrast));
    let ramp = |coordinate: Lanes<N>| 0.35 + 0.65 * (coordinate - whole_part(coordinate));
    decode_codes(Rgb { r: ramp(u) * shade, g: ramp(v) * shade, b: 0.55 * shade })
}

/// Rounds numbers down to integers.
#[inline(always)]
fn whole_part<const N: usize>(numbers: Lanes<N>) -> Lanes<N> {
    numbers.map(|x| floor_to_int(x) as f32)
}

/// Returns clearly different colors for consecutive parts, with hues at multiples of the golden
/// ratio.
pub(super) fn part_color(part: u32) -> [f32; 3] {
    // 2³² over the golden ratio; the low 32 bits of a product are its fractional part.
    let hue = (part.wrapping_add(1).wrapping_mul(2_654_435_769) >> 8) as f32 / 16_777_216.0;
    let [low, high] = if part.is_multiple_of(2) { [0.35, 0.95] } else { [0.2, 0.75] };
    // HSV to RGB.
    [0.0, 2.0, 4.0].map(|shift| {
        let sextant = (hue * 6.0 + shift) % 6.0;
        low + (high - low) * ((sextant - 3.0).abs() - 1.0).clamp(0.0, 1.0)
    })
}

/// Maps numbers from 0 to 1 to the colors of a colormap, as sRGB codes scaled to [0, 1].
#[inline(always)]
pub(super) fn map_colors<const N: usize>(colormap: Colormap, numbers: Lanes<N>) -> Rgb<N> {
    let mut colors = Rgb::ZERO;
    for lane in 0..N {
        let [r, g, b] = colormap.srgb_at(numbers[lane]);
        (colors.r[lane], colors.g[lane], colors.b[lane]) = (r, g, b);
    }
    colors
}

/// Decodes sRGB codes, scaled to [0, 1], to linear colors.
#[inline(always)]
pub(super) fn decode_codes<const N: usize>(codes: Rgb<N>) -> Rgb<N> {
    kernel_part!(N, decode_curve(codes))
}

/// Decodes numbers with the sRGB curve.
#[inline(always)]
fn decode_curve<const N: usize>(codes: Rgb<N>) -> Rgb<N> {
    codes.map(|code| {
        let base = (code + 0.055) / 1.055;
        let curve = base.max(f32::MIN_POSITIVE).map(|base| exp2_approx(2.4 * log2_approx(base)));
        (code / 12.92).select(&code.is_below(0.040_45), curve)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn consecutive_parts_have_distinct_colors() {
        for part in 0..200 {
            for next in 1..5 {
                let [a, b] = [part_color(part), part_color(part + next)];
                let difference = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
                assert!(difference > 0.06, "parts {part} and {part} + {next}: {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_matcap_is_bright_toward_its_light_and_at_most_white() {
        let color = |normal| matcap_ball_color(Vec3Lanes::<1>::splat(normal)).lane(0);
        let bright = color([-0.4, 0.64, 0.656]);
        let dark = color([0.4, -0.64, 0.656]);
        for k in 0..3 {
            assert!(bright[k] > 2.0 * dark[k], "{bright:?} {dark:?}");
            assert!(bright[k] < 1.0 && dark[k] > 0.0);
        }
    }

    #[test]
    fn decoded_codes_survive_encoding() {
        let encoder = crate::color::SrgbEncoder::shared();
        for code in 0..=255_u8 {
            let value = f32::from(code) / 255.0;
            let [r, ..] = decode_codes(Rgb::<1>::splat([value; 3])).lane(0);
            assert_eq!(encoder.encode(r), code);
            let exact = crate::color::srgb_to_linear(f64::from(value));
            assert!((f64::from(r) - exact).abs() < 2e-5 * exact + 1e-7, "{code}");
        }
    }
}
