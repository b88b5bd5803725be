//! meshopt filters, which expand octahedral vectors, quaternions, exponential floats and YCoCg
//! colors to full width.
//!
//! The specification does not define the result for out-of-range values. Here, they decode to
//! arbitrary values of the output type and never cause a panic.
//!
//! A filter is applied after decompression and widens quantized values to the component type of the
//! accessor:
//!
//! ```text
//!  Octahedral   x, y, 1 in n bits, free   ──► unit vector of 8 or 16 bits, normalized integers
//!  Quaternion   a, b, c, 1 with index     ──► quaternion of 16 bits, normalized integers
//!  Exponential  8-bit exponent, mantissa  ──► 32-bit float
//!  Color        Y, Co, Cg, alpha          ──► RGBA of 8 or 16 bits
//! ```

use super::MeshoptFilter;

impl MeshoptFilter {
    /// Applies the filter to all elements in place.
    ///
    /// `stride` is the element size in bytes, and selects 8 or 16 bits if a filter supports both.
    pub(super) fn apply_filter(self, bytes: &mut [u8], stride: usize) {
        match (self, stride) {
            (Self::None, _) => {}
            (Self::Octahedral, 4) => {
                map_elements(bytes, |v: [i8; 4]| {
                    decode_octahedral(v.map(i16::from), 127.0).map(|x| x as i8)
                });
            }
            (Self::Octahedral, _) => map_elements(bytes, |v| decode_octahedral(v, 32_767.0)),
            (Self::Quaternion, _) => map_elements(bytes, decode_quaternion),
            (Self::Exponential, _) => {
                map_elements(bytes, |[number]: [i32; 1]| [decode_exponential(number)]);
            }
            (Self::Color, 4) => map_elements(bytes, |[y, co, cg, a]: [u8; 4]| {
                let signed = |x: u8| i32::from(x.cast_signed());
                decode_color([i32::from(y), signed(co), signed(cg), i32::from(a)], 255.0)
                    .map(|x| x as u8)
            }),
            (Self::Color, _) => map_elements(bytes, |[y, co, cg, a]: [u16; 4]| {
                let signed = |x: u16| i32::from(x.cast_signed());
                decode_color([i32::from(y), signed(co), signed(cg), i32::from(a)], 65_535.0)
            }),
        }
    }
}

/// Decodes a unit vector from octahedral coordinates (Meyer et al. 2010); `full_scale` represents 1
/// in the result.
///
/// The octahedron |x| + |y| + |z| = 1 is unfolded into a square; `unit` is the value that
/// represents 1 in x and y. The fourth component is not changed.
fn decode_octahedral([x, y, unit, fourth]: [i16; 4], full_scale: f32) -> [i16; 4] {
    let unit_length = f32::from(unit);
    let (x, y) = (f32::from(x) / unit_length, f32::from(y) / unit_length);
    let z = 1.0 - x.abs() - y.abs();
    // The lower half of the octahedron is unfolded over the corners of the square.
    let fold = z.min(0.0);
    let (x, y) = (x - fold.copysign(x), y - fold.copysign(y));
    let scale = full_scale / (x * x + y * y + z * z).sqrt();
    let round_to_i16 = |x: f32| (x * scale).round() as i16;
    [round_to_i16(x), round_to_i16(y), round_to_i16(z), fourth]
}

/// Decodes a rotation from its three smaller components, scaled by √2, and the index of the largest
/// component.
///
/// The largest component follows from the unit length: √(1 − a² − b² − c²). It is positive, because
/// q and −q are the same rotation. Its index is in the lowest two bits of the fourth number.
fn decode_quaternion([a, b, c, scale]: [i16; 4]) -> [i16; 4] {
    let step = std::f32::consts::FRAC_1_SQRT_2 / f32::from(scale | 3);
    let [a, b, c] = [a, b, c].map(|x| f32::from(x) * step);
    let largest = (1.0 - a * a - b * b - c * c).max(0.0).sqrt();
    let mut components = [largest, a, b, c].map(|x| (x * 32_767.0).round() as i16);
    components.rotate_right(usize::from(scale.cast_unsigned() & 3));
    components
}

/// Decodes a float from a signed 8-bit exponent and a signed 24-bit mantissa.
///
/// The value is mantissa · 2^exponent. The power is composed from its bits in double precision,
/// which covers all 256 exponents without rounding.
fn decode_exponential(number: i32) -> f32 {
    let (exponent, mantissa) = (number >> 24, number << 8 >> 8);
    let power = f64::from_bits(((1023 + i64::from(exponent)).cast_unsigned()) << 52);
    (power * f64::from(mantissa)) as f32
}

/// Decodes RGBA from YCoCg and alpha. The highest set bit of alpha gives the bit depth of all four
/// components.
///
/// YCoCg decorrelates colors using only additions: R = Y + Co − Cg, G = Y + Cg, B = Y − Co − Cg.
fn decode_color([y, co, cg, alpha]: [i32; 4], full_scale: f32) -> [u16; 4] {
    let all = match alpha {
        ..=0 => 1,
        _ => (2i32 << alpha.ilog2()) - 1,
    };
    let alpha = alpha & (all >> 1);
    let alpha = alpha << 1 | (alpha & 1);
    let scale = full_scale / all as f32;
    [y + co - cg, y + cg, y - co - cg, alpha]
        .map(|x| (x as f32 * scale).round().min(full_scale) as u16)
}

/// Replaces each group of `N` numbers in a byte slice.
///
/// Incomplete groups at the end are left unchanged. `[A; N]` and `[B; N]` must have the same
/// size in bytes.
fn map_elements<const N: usize, A: Number, B: Number>(
    bytes: &mut [u8],
    filter: impl Fn([A; N]) -> [B; N],
) {
    for element in bytes.chunks_exact_mut(N * A::SIZE) {
        let numbers = std::array::from_fn(|at| A::read(&element[at * A::SIZE..]));
        for (at, number) in filter(numbers).into_iter().enumerate() {
            number.write(&mut element[at * A::SIZE..]);
        }
    }
}

/// A number as stored in a buffer, little-endian.
trait Number: Copy {
    /// The size in bytes.
    const SIZE: usize;
    /// Decodes a number from the first bytes of a slice.
    fn read(bytes: &[u8]) -> Self;
    /// Encodes the number into the first bytes of a slice.
    fn write(self, bytes: &mut [u8]);
}

macro_rules! number {
    ($($number:ty)*) => {$(
        impl Number for $number {
            const SIZE: usize = size_of::<$number>();
            fn read(bytes: &[u8]) -> Self {
                let mut word = [0; size_of::<$number>()];
                word.copy_from_slice(&bytes[..Self::SIZE]);
                Self::from_le_bytes(word)
            }
            fn write(self, bytes: &mut [u8]) {
                bytes[..Self::SIZE].copy_from_slice(&self.to_le_bytes());
            }
        }
    )*};
}

number!(i8 u8 i16 u16 i32 f32);

#[cfg(test)]
mod tests {
    use super::*;

    fn filtered(filter: MeshoptFilter, stride: usize, numbers: &[i16]) -> Vec<i16> {
        let mut bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        filter.apply_filter(&mut bytes, stride);
        bytes.as_chunks().0.iter().map(|word| i16::from_le_bytes(*word)).collect()
    }

    #[test]
    fn octahedral_vectors_have_unit_length() {
        const ONE: i16 = 32_767;
        for (stored, expected) in [
            ([0, 0, 511, 9], [0, 0, ONE, 9]),
            ([511, 0, 511, 9], [ONE, 0, 0, 9]),
            ([0, -511, 511, -9], [0, -ONE, 0, -9]),
            ([511, 511, 511, 9], [0, 0, -ONE, 9]),
            ([-511, 511, 511, 9], [0, 0, -ONE, 9]),
            ([ONE, 0, ONE, 0], [ONE, 0, 0, 0]),
            // (−0.8, 0.4) is in the lower half and folds back to (−0.6, 0.2), with z = −0.2.
            ([-800, 400, 1000, 0], [-29_639, 9_880, -9_880, 0]),
        ] {
            assert_eq!(filtered(MeshoptFilter::Octahedral, 8, &stored), expected, "{stored:?}");
        }
        let mut bytes = [0x81, 0, 0x7F, 5, 0, 1, 3, 6];
        MeshoptFilter::Octahedral.apply_filter(&mut bytes, 4);
        assert_eq!(bytes, [0x81, 0, 0, 5, 0, 57, 114, 6]);
    }

    #[test]
    fn quaternions_recover_their_largest_component() {
        let half = 16_384;
        // (½, ½, ½, ½) with eleven bits: 1/2 · √2 · 1023 = 723.4.
        for largest in 0..4i16 {
            let stored = [723, 723, 723, 1020 | largest];
            let actual = filtered(MeshoptFilter::Quaternion, 8, &stored);
            assert!(actual.iter().all(|x| (x - half).abs() < 32), "{largest}: {actual:?}");
            let axis = filtered(MeshoptFilter::Quaternion, 8, &[0, 0, 0, 1020 | largest]);
            assert_eq!(axis[usize::from(largest.cast_unsigned())], 32_767);
        }
        // The others follow the largest in cyclic order.
        let actual = filtered(MeshoptFilter::Quaternion, 8, &[100, 0, 0, 1022]);
        assert_eq!((actual[3], actual[0], actual[1]), (2265, 0, 0));
    }

    #[test]
    fn exponential_floats_are_exact() {
        for (mantissa, exponent, value) in [
            (0, 0, 0.0),
            (1, 0, 1.0),
            (-3, -1, -1.5),
            (-8_388_608, 100, -8_388_608.0 * power_of_two(100)),
            (5, -100, 5.0 * power_of_two(-100)),
        ] {
            let number: i32 = exponent << 24 | mantissa & 0xFF_FFFF;
            assert_eq!(f64::from(decode_exponential(number)), value, "{mantissa} · 2^{exponent}");
        }
    }

    fn power_of_two(exponent: i32) -> f64 {
        let power = (0..exponent.abs()).fold(1.0, |product, _| 2.0 * product);
        if exponent < 0 { 1.0 / power } else { power }
    }

    #[test]
    fn colors_of_every_width_are_decoded() {
        // Red, green, blue, white and gray with seven bits: 127 represents 1, and alpha has six
        // bits below the marker.
        for ([r, g, b], alpha) in [
            ([127, 0, 0], 0x7F),
            ([0, 127, 0], 0x7F),
            ([0, 0, 127], 0x40),
            ([127, 127, 127], 0x60),
            ([64, 32, 16], 0x41),
        ] {
            // The encoder's forward transform, in integer lifting steps.
            let co = (r - b) / 2;
            let t = b + co;
            let cg = (g - t) / 2;
            let y = t + cg;
            let stored = [y, co, cg, alpha].map(|x: i32| x as u8);
            let mut bytes = stored;
            MeshoptFilter::Color.apply_filter(&mut bytes, 4);
            for (actual, expected) in bytes.iter().zip([r, g, b]) {
                let expected = f64::from(expected) * 255.0 / 127.0;
                assert!(
                    (f64::from(*actual) - expected).abs() < 4.5,
                    "{stored:x?}: expected {expected}, found {actual}"
                );
            }
            let expected = f64::from((alpha & 0x3F) << 1 | alpha & 1) * 255.0 / 127.0;
            assert!((f64::from(bytes[3]) - expected).abs() <= 0.5);
        }
        let white = filtered(MeshoptFilter::Color, 8, &[1023, 0, 0, 1023]);
        assert_eq!(white, [-1; 4]);
    }

    #[test]
    fn invalid_filter_input_does_not_panic() {
        let words = [0, 1, 2, 3, -1, -2, i16::MAX, i16::MIN];
        for (filter, stride) in [
            (MeshoptFilter::Octahedral, 4),
            (MeshoptFilter::Octahedral, 8),
            (MeshoptFilter::Quaternion, 8),
            (MeshoptFilter::Exponential, 4),
            (MeshoptFilter::Color, 4),
            (MeshoptFilter::Color, 8),
        ] {
            for a in words {
                for b in words {
                    for c in words {
                        filtered(filter, stride, &[a, b, a, c]);
                        filtered(filter, stride, &[a, b, c, b]);
                    }
                }
            }
        }
    }
}
