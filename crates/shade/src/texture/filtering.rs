//! Reading textures, in all lanes at once.

use super::MipChain;
use super::addressing::TexelQuads;
use super::footprint::Tap;

impl MipChain<'_> {
    /// The texture's colours, linear with straight alpha, at `uvs[0]`; `uvs[1]` and `uvs[2]` are the derivatives by the
    /// pixel's column and row, which say what a pixel covers: it is read at up to `most` places along the longer axis of that.
    /// Alpha is 1 if it does not count.
    #[inline(always)]
    pub(crate) fn sample<const N: usize>(
        &self,
        uvs: &[[[f32; N]; 2]; 3],
        alpha_counts: bool,
        most: u32,
    ) -> [[f32; N]; 4] {
        let footprint = self.addressing.footprint(uvs, most);
        let mut sums = [[0.0; N]; 4];
        for number in 0..footprint.max_tap_count() {
            self.accumulate_tap(&footprint.tap(&self.addressing, number), alpha_counts, &mut sums);
        }
        sums
    }

    /// Adds what is read at one place of a footprint.
    #[inline(always)]
    pub(crate) fn accumulate_tap<const N: usize>(
        &self,
        tap: &Tap<N>,
        alpha_counts: bool,
        sums: &mut [[f32; N]; 4],
    ) {
        let mut colors = [[0.0; N]; 4];
        for level in 0..tap.level_count {
            lerp_channels(
                &mut colors,
                &self.filter_texels(&tap.cells[level], alpha_counts),
                &tap.level_weights[level],
            );
        }
        for channel in 0..4 {
            for lane in 0..N {
                sums[channel][lane] += colors[channel][lane] * tap.tap_weights[lane];
            }
        }
    }

    /// The colours between the texels of some cells.
    #[inline(always)]
    fn filter_texels<const N: usize>(
        &self,
        cells: &TexelQuads<N>,
        alpha_counts: bool,
    ) -> [[f32; N]; 4] {
        let codes = self.fetch_texels(cells);
        let mut colors = [[1.0; N]; 4];
        for channel in 0..3 {
            colors[channel] = match self.srgb_table {
                Some(table) => {
                    let mut four = [[0.0; N]; 4];
                    for corner in 0..4 {
                        for lane in 0..N {
                            let code = codes[corner][lane] >> (8 * channel) & 255;
                            four[corner][lane] = table[code as usize];
                        }
                    }
                    bilinear(&four, cells)
                }
                None => filter_linear_channel(&codes, channel, cells),
            };
        }
        if alpha_counts {
            colors[3] = filter_linear_channel(&codes, 3, cells);
        }
        colors
    }

    /// The texels of some cells, red in the lowest byte.
    #[inline(always)]
    fn fetch_texels<const N: usize>(&self, cells: &TexelQuads<N>) -> [[u32; N]; 4] {
        let mut codes = [[0; N]; 4];
        for lane in 0..N {
            let texels: &[[u8; 4]] = &self.levels[cells.levels[lane] as usize].texels;
            for corner in 0..4 {
                let texel = texels[cells.texels[corner][lane] as usize];
                codes[corner][lane] = u32::from_le_bytes(texel);
            }
        }
        codes
    }
}

/// One channel of linear texels, from 0 to 1.
#[inline(always)]
fn filter_linear_channel<const N: usize>(
    codes: &[[u32; N]; 4],
    channel: usize,
    cells: &TexelQuads<N>,
) -> [f32; N] {
    let mut four = [[0.0; N]; 4];
    for corner in 0..4 {
        for lane in 0..N {
            let code = codes[corner][lane] >> (8 * channel) & 255;
            four[corner][lane] = code as i32 as f32;
        }
    }
    let mut units = bilinear(&four, cells);
    for unit in &mut units {
        *unit /= 255.0;
    }
    units
}

/// What lies between four texels.
#[inline(always)]
fn bilinear<const N: usize>([a, b, c, d]: &[[f32; N]; 4], cells: &TexelQuads<N>) -> [f32; N] {
    let mut between = *a;
    if cells.are_nearest {
        return between;
    }
    for lane in 0..N {
        let upper = a[lane] + (b[lane] - a[lane]) * cells.column_fractions[lane];
        let lower = c[lane] + (d[lane] - c[lane]) * cells.column_fractions[lane];
        between[lane] = upper + (lower - upper) * cells.row_fractions[lane];
    }
    between
}

/// Moves colours by a share of the way to others.
#[inline(always)]
fn lerp_channels<const N: usize>(from: &mut [[f32; N]; 4], to: &[[f32; N]; 4], share: &[f32; N]) {
    for (from, to) in from.iter_mut().zip(to) {
        for lane in 0..N {
            from[lane] += (to[lane] - from[lane]) * share[lane];
        }
    }
}
