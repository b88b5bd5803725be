//! Decoder for Radiance `.hdr` images (RGBE), in which three mantissas share an exponent.
//!
//! Source: G. Ward, *Real Pixels*, Graphics Gems II, 1991, and the file format description in the
//! Radiance manual. Both scanline encodings (flat with old-style runs, and run-length encoded
//! channels) are supported, but only the orientation `-Y … +X …`. Sizes are checked against the
//! file length before anything is allocated. Sixteen bytes can encode a row of 16,384 texels, so a
//! file of a hundred kilobytes could expand to 800 MB. Rows are therefore halved as they arrive.
//!
//! ```text
//!  value = (mantissa + ½) · 2^(exponent − 136)     0 if the exponent is 0
//! ```

/// The maximum number of texels per side of an image.
const MAX_HDR_SIDE: usize = 16384;
/// The maximum number of texels in an image.
const MAX_HDR_TEXELS: usize = 64 << 20;

/// An equirectangular environment image in linear RGB, with longitude along the rows and latitude
/// from the zenith down.
#[derive(Clone, PartialEq, Debug)]
pub struct Panorama {
    /// The number of texels per row, which covers 360° of longitude.
    width: usize,
    /// The number of rows, which cover 180° of latitude.
    height: usize,
    /// Linear red, green and blue, row by row from the top.
    texels: Vec<[f32; 3]>,
}

impl Panorama {
    /// Decodes a Radiance file and halves the image until it is at most `most` texels wide.
    ///
    /// Environment lighting is filtered to a far lower resolution, so a width of 1024 is enough for
    /// it. Backgrounds need more. Memory use depends on the rows actually in the file, not on the
    /// size in the header.
    ///
    /// # Errors
    /// Returns a description of the first error in the file.
    pub fn decode_hdr(bytes: &[u8], most: usize) -> Result<Self, String> {
        let (width, height, data) = parse_hdr_header(bytes)?;
        let fits = |side: usize| (1..=MAX_HDR_SIDE).contains(&side);
        if !fits(width) || !fits(height) || width * height > MAX_HDR_TEXELS {
            return Err(format!(
                "invalid size {width} x {height}; at most {MAX_HDR_SIDE} texels per side and {MAX_HDR_TEXELS} in total are allowed"
            ));
        }
        // Every row takes at least four bytes. A run-length encoded row takes four bytes plus two
        // for each 127 texels of a channel.
        if data.len() / 4 < height {
            return Err("the file is truncated".to_owned());
        }
        let mut rows = HalvedRows::new(width, height, most);
        let mut rest = data;
        let mut row = vec![[0; 4]; width];
        for _ in 0..height {
            rest = read_scanline(rest, &mut row).ok_or("the file is truncated")?;
            rows.push_row(0, row.iter().map(|&texel| decode_rgbe(texel)).collect());
        }
        Ok(Self {
            width: width >> rows.pending.len(),
            height: height >> rows.pending.len(),
            texels: rows.texels,
        })
    }

    /// Looks up the radiance from a direction, which is a unit vector, with bilinear interpolation.
    ///
    /// u = ½ + atan2(z, x)/2π and v = acos(y)/π: +x is at the center of the image, and +z is a
    /// quarter of its width to the right. Columns wrap around, and rows are clamped at the poles.
    #[must_use]
    #[inline]
    pub fn sample_direction(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        use std::f32::consts::PI;
        let u = 0.5 + libm::atan2f(z, x) / (2.0 * PI);
        let v = libm::acosf(y.clamp(-1.0, 1.0)) / PI;
        let (left, s) = split_floor(u * self.width as f32 - 0.5);
        let (top, t) = split_floor(v * self.height as f32 - 0.5);
        let texel = |dx: i64, dy: i64| {
            let column = (left + dx).rem_euclid(self.width as i64) as usize;
            let row = (top + dy).clamp(0, self.height as i64 - 1) as usize;
            self.texels[row * self.width + column]
        };
        let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
        [0, 1, 2].map(|k: usize| {
            let (upper, lower) = (a[k] + (b[k] - a[k]) * s, c[k] + (d[k] - c[k]) * s);
            upper + (lower - upper) * t
        })
    }
}

/// Image rows, halved by 2 × 2 box filters until they are narrow enough. Each halving drops an odd
/// last row or column.
struct HalvedRows {
    /// The upper row of the next pair for each halving, if it has arrived.
    pending: Vec<Option<Vec<[f32; 3]>>>,
    /// The fully halved rows.
    texels: Vec<[f32; 3]>,
}

impl HalvedRows {
    fn new(width: usize, height: usize, most: usize) -> Self {
        let (mut width, mut height, mut pending) = (width, height, Vec::new());
        while width > most && height > 1 {
            (width, height) = (width / 2, height / 2);
            pending.push(None);
        }
        Self { pending, texels: Vec::new() }
    }

    /// Adds a row that has been halved `level` times, and halves it further if its pair is
    /// complete.
    fn push_row(&mut self, level: usize, row: Vec<[f32; 3]>) {
        let Some(pending) = self.pending.get_mut(level) else {
            return self.texels.extend(row);
        };
        let Some(upper) = pending.take() else {
            *pending = Some(row);
            return;
        };
        let half = |at: usize| {
            let four = [upper[2 * at], upper[2 * at + 1], row[2 * at], row[2 * at + 1]];
            [0, 1, 2].map(|k: usize| four.iter().map(|texel| texel[k]).sum::<f32>() * 0.25)
        };
        let halved = (0..row.len() / 2).map(half).collect();
        self.push_row(level + 1, halved);
    }
}

/// Splits a coordinate into its floor and the fraction above it, for bilinear interpolation.
fn split_floor(place: f32) -> (i64, f32) {
    (place.floor() as i64, place - place.floor())
}

/// Decodes an RGBE texel (three 8-bit mantissas and an exponent with bias 128) to linear RGB.
///
/// The value is in the middle of the mantissa's step, as in Ward's own decoder. It is clamped to
/// 65504, the largest half-precision number, because an unclamped sun would cause noise.
fn decode_rgbe([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = libm::ldexpf(1.0, i32::from(exponent) - 136);
    [r, g, b].map(|mantissa| ((f32::from(mantissa) + 0.5) * unit).min(65504.0))
}

/// Parses the header and returns the width, the height, and the bytes after the header.
///
/// The header starts with `#?` in the first line. Then come variables up to an empty line, and then
/// the resolution. Lines are limited to 4096 bytes, and at most 1000 lines are read. Exposure is
/// ignored.
fn parse_hdr_header(bytes: &[u8]) -> Result<(usize, usize, &[u8]), String> {
    let mut rest = bytes;
    let mut next = || -> Option<&[u8]> {
        let end = rest.iter().take(4096).position(|&byte| byte == b'\n')?;
        let line = &rest[..end];
        rest = &rest[end + 1..];
        Some(line)
    };
    let no_header = "it does not begin with a valid Radiance header";
    let first = next().ok_or(no_header)?;
    if !first.starts_with(b"#?") {
        return Err(no_header.to_owned());
    }
    for _ in 0..1000 {
        let line = next().ok_or(no_header)?;
        if line.starts_with(b"FORMAT=") && line != b"FORMAT=32-bit_rle_rgbe" {
            return Err("unsupported texel format; only 32-bit_rle_rgbe is supported".to_owned());
        }
        if line.is_empty() {
            break;
        }
    }
    let size = next().and_then(|line| std::str::from_utf8(line).ok()).ok_or(no_header)?;
    match *size.split_whitespace().collect::<Vec<_>>() {
        ["-Y", height, "+X", width] => {
            let side = |text: &str| text.parse::<usize>().map_err(|_| no_header.to_owned());
            Ok((side(width)?, side(height)?, rest))
        }
        _ => Err(format!("unsupported row order `{size}`; only -Y … +X … is supported")),
    }
}

/// Decodes a scanline and returns the bytes after it. Returns `None` if the data ends early or a
/// run exceeds the row.
///
/// ```text
///  2 2 hi lo   width < 32768, followed by the four channels in turn:
///    128 + n, v      n copies of v
///    n, v₁ … vₙ      n values
/// ```
/// Anything else is a flat scanline.
fn read_scanline<'a>(bytes: &'a [u8], row: &mut [[u8; 4]]) -> Option<&'a [u8]> {
    let width = row.len();
    let (&start, rest) = bytes.split_first_chunk::<4>()?;
    let is_runs = start[0] == 2 && start[1] == 2 && start[2] < 128;
    if !(8..32768).contains(&width) || !is_runs {
        return read_flat_scanline(bytes, row);
    }
    if usize::from(start[2]) << 8 | usize::from(start[3]) != width {
        return None;
    }
    let mut rest = rest;
    for channel in 0..4 {
        let mut x = 0;
        while x < width {
            let (&count, after) = rest.split_first()?;
            let (count, is_run) = if count > 128 {
                (usize::from(count) - 128, true)
            } else {
                (usize::from(count), false)
            };
            if count == 0 || count > width - x {
                return None;
            }
            let (codes, after) = after.split_at_checked(if is_run { 1 } else { count })?;
            for (at, texel) in row[x..x + count].iter_mut().enumerate() {
                texel[channel] = codes[if is_run { 0 } else { at }];
            }
            x += count;
            rest = after;
        }
    }
    Some(rest)
}

/// Decodes a flat scanline of RGBE texels. A texel (1, 1, 1, n) repeats the previous texel n times
/// (old run-length encoding).
///
/// The counts of consecutive repeat texels form a base-256 number, least significant digit first.
fn read_flat_scanline<'a>(bytes: &'a [u8], row: &mut [[u8; 4]]) -> Option<&'a [u8]> {
    let mut rest = bytes;
    let (mut x, mut shift) = (0, 0);
    while x < row.len() {
        let (&texel, after) = rest.split_first_chunk::<4>()?;
        rest = after;
        if texel[..3] == [1, 1, 1] {
            let count = usize::from(texel[3]).checked_shl(shift)?;
            let last = *row.get(x.checked_sub(1)?)?;
            row.get_mut(x..x + count)?.fill(last);
            x += count;
            shift += 8;
            if shift > 16 {
                return None;
            }
        } else {
            row[x] = texel;
            x += 1;
            shift = 0;
        }
    }
    Some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(size: &str, data: &[u8]) -> Vec<u8> {
        let header = format!("#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n{size}\n");
        [header.as_bytes(), data].concat()
    }

    #[test]
    fn flat_and_run_length_encoded_rows_are_decoded() {
        let plain =
            Panorama::decode_hdr(&file("-Y 1 +X 2", &[128, 0, 64, 129, 1, 1, 1, 1]), 1024).unwrap();
        let due = [128.5, 0.5, 64.5].map(|mantissa| mantissa / 128.0);
        assert_eq!(plain.texels, [due, due]);
        let mut runs = vec![2, 2, 0, 8];
        for channel in [10, 20, 30] {
            runs.extend([128 + 5, channel, 3, channel, 1, 2]);
        }
        runs.extend([128 + 8, 128]);
        let found = Panorama::decode_hdr(&file("-Y 1 +X 8", &runs), 1024).unwrap();
        assert_eq!(found.texels[0], [10.5, 20.5, 30.5].map(|c| c / 256.0));
        assert_eq!(found.texels[7], [2.5 / 256.0; 3]);
    }

    /// Encodes a row of 2048 equal texels in twelve bytes, with old-style runs.
    fn equal_row(mantissa: u8) -> [u8; 12] {
        [mantissa, 0, 0, 136, 1, 1, 1, 255, 1, 1, 1, 7]
    }

    #[test]
    fn wide_rows_are_averaged_and_an_odd_last_row_is_dropped() {
        let data = [equal_row(10), equal_row(30), equal_row(90)].concat();
        let found = Panorama::decode_hdr(&file("-Y 3 +X 2048", &data), 1024).unwrap();
        assert_eq!((found.width, found.height), (1024, 1));
        assert_eq!(found.texels, vec![[20.5, 0.5, 0.5]; 1024]);
        let single = Panorama::decode_hdr(&file("-Y 1 +X 2048", &equal_row(10)), 1024).unwrap();
        assert_eq!((single.width, single.height, single.texels.len()), (2048, 1, 2048));
    }

    #[test]
    fn invalid_files_are_rejected() {
        for wrong in [
            Vec::new(),
            b"#?RADIANCE\n".to_vec(),
            b"P6 1 1 255\n".to_vec(),
            file("-Y 1 +X 2", &[1, 2, 3]),
            file("-Y 0 +X 2", &[0; 8]),
            file("-Y 99999 +X 99999", &[0; 8]),
            file("-Y 16384 +X 16384", &[0; 8]),
            file("+X 2 -Y 1", &[0; 8]),
            file("-Y 1 +X 8", &[2, 2, 0, 8, 255, 1]),
            file("-Y 1 +X 8", &[2, 2, 0, 9, 128 + 8, 1]),
            file("-Y 1 +X 3", &[1, 1, 1, 2, 0, 0, 0, 0]),
        ] {
            assert!(Panorama::decode_hdr(&wrong, 1024).is_err());
        }
    }

    #[test]
    fn directions_map_to_their_texels() {
        let texel = |x: usize, y: usize| [x as f32, y as f32, 0.0];
        let texels = (0..32).map(|n| texel(n % 8, n / 8)).collect();
        let panorama = Panorama { width: 8, height: 4, texels };
        let [column, row, _] = panorama.sample_direction([1.0, 0.0, 0.0]);
        assert!((column - 3.5).abs() < 1e-5 && (row - 1.5).abs() < 1e-5, "{column} {row}");
        assert!((panorama.sample_direction([0.0, 0.0, 1.0])[0] - 5.5).abs() < 1e-5);
        assert_eq!(panorama.sample_direction([0.0, 1.0, 0.0])[1], 0.0);
        assert_eq!(panorama.sample_direction([0.0, -1.0, 0.0])[1], 3.0);
    }
}
