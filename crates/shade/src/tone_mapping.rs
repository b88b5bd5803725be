//! Development: from light to the colours of a picture, by exposure and a curve.
//!
//! Each fragment is developed by itself, before the samples of a pixel are put together: edges against bright light stay
//! smooth, backgrounds keep their colours, and a transparent picture laid over a colour is the opaque one over that colour.

/// The curve that brings light beyond 1 into the range of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ToneMapping {
    /// None: light beyond 1 is cut off.
    #[default]
    None,
    /// Khronos PBR Neutral: colours below 0.8 stay as they are, highlights fade to white (Khronos 2024).
    Neutral,
    /// The fit of the ACES reference transforms by Hill (2016).
    Aces,
    /// The AgX of Sobotka (2022), with the fit of its curve by Wrensch (2023).
    AgX,
}

/// How light becomes colours.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ToneMapper {
    /// What light is multiplied by: 2 to the power of the exposure value.
    pub exposure: f32,
    /// The curve.
    pub curve: ToneMapping,
}

impl Default for ToneMapper {
    fn default() -> Self {
        Self { exposure: 1.0, curve: ToneMapping::None }
    }
}

impl ToneMapper {
    /// The development with an exposure correction in stops.
    #[must_use]
    pub fn new(exposure_ev: f64, curve: ToneMapping) -> Self {
        Self { exposure: libm::exp2(exposure_ev) as f32, curve }
    }

    /// Develops colours in place.
    #[inline(always)]
    pub(super) fn map_colors<const N: usize>(&self, colors: &mut [[f32; N]; 3]) {
        if self.exposure != 1.0 {
            for channel in &mut *colors {
                for light in channel {
                    *light *= self.exposure;
                }
            }
        }
        if self.curve == ToneMapping::None {
            return;
        }
        for lane in 0..N {
            let light = [colors[0][lane], colors[1][lane], colors[2][lane]].map(|c| c.max(0.0));
            let color = match self.curve {
                ToneMapping::None => light,
                ToneMapping::Neutral => khronos_neutral(light),
                ToneMapping::Aces => aces_filmic(light),
                ToneMapping::AgX => agx_tone_map(light),
            };
            for channel in 0..3 {
                colors[channel][lane] = color[channel];
            }
        }
    }
}

/// Khronos PBR Neutral, as its specification has it.
#[inline(always)]
fn khronos_neutral(light: [f32; 3]) -> [f32; 3] {
    const START: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    let least = light[0].min(light[1]).min(light[2]);
    let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let color = light.map(|c| c - offset);
    let peak = color[0].max(color[1]).max(color[2]);
    let room = 1.0 - START;
    let pressed = 1.0 - room * room / (peak + room - START);
    let fade = 1.0 - 1.0 / (DESATURATION * (peak - pressed) + 1.0);
    let per_peak = pressed / peak.max(START);
    color.map(|c| if peak < START { c } else { c * per_peak * (1.0 - fade) + pressed * fade })
}

#[inline(always)]
fn multiply_matrix(matrix: &[[f32; 3]; 3], [r, g, b]: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|row: usize| matrix[row][0] * r + matrix[row][1] * g + matrix[row][2] * b)
}

/// sRGB to the primaries of ACES, and back.
const SRGB_TO_ACES: [[f32; 3]; 3] =
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
const ACES_TO_SRGB: [[f32; 3]; 3] =
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

#[inline(always)]
fn aces_filmic(light: [f32; 3]) -> [f32; 3] {
    let curve = |x: f32| {
        let above = x * (x + 0.024_578_6) - 0.000_090_537;
        above / (x * (0.983_729 * x + 0.432_951) + 0.238_081)
    };
    let bent = multiply_matrix(&SRGB_TO_ACES, light).map(|x| curve(x.min(1e9)));
    multiply_matrix(&ACES_TO_SRGB, bent).map(|c| c.clamp(0.0, 1.0))
}

/// sRGB to AgX's inset primaries, and back.
const SRGB_TO_AGX: [[f32; 3]; 3] = [
    [0.842_479_1, 0.078_433_6, 0.079_223_8],
    [0.042_328_3, 0.878_468_6, 0.079_166_1],
    [0.042_375_7, 0.078_433_6, 0.879_143],
];
const AGX_TO_SRGB: [[f32; 3]; 3] = [
    [1.196_879, -0.098_020_9, -0.099_029_7],
    [-0.052_896_9, 1.151_903_1, -0.098_961_2],
    [-0.052_971_6, -0.098_043_5, 1.151_073_7],
];

fn agx_tone_map(light: [f32; 3]) -> [f32; 3] {
    const LEAST: f32 = -12.473_93;
    const MOST: f32 = 4.026_069;
    let curve = |x: f32| {
        let stops = libm::log2f(x.max(1e-10)).clamp(LEAST, MOST);
        let x = (stops - LEAST) / (MOST - LEAST);
        let square = x * x;
        let fourth = square * square;
        15.5 * fourth * square - 40.14 * fourth * x + 31.96 * fourth - 6.868 * square * x
            + 0.4298 * square
            + 0.1191 * x
            - 0.002_32
    };
    let bent = multiply_matrix(&SRGB_TO_AGX, light).map(curve);
    // The curve ends in codes of a display; a picture wants light.
    multiply_matrix(&AGX_TO_SRGB, bent).map(|code| libm::powf(code.clamp(0.0, 1.0), 2.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn developed(curve: ToneMapping, light: [f32; 3]) -> [f32; 3] {
        let mut colors = light.map(|c| [c]);
        ToneMapper { exposure: 1.0, curve }.map_colors(&mut colors);
        colors.map(|[c]| c)
    }

    #[test]
    fn neutral_keeps_colours_but_for_the_reflection_of_dielectrics() {
        for light in [[0.5, 0.3, 0.2], [0.7, 0.7, 0.7], [0.2, 0.09, 0.5]] {
            let found = developed(ToneMapping::Neutral, light);
            assert!((0..3).all(|k| (found[k] - (light[k] - 0.04)).abs() < 1e-6), "{found:?}");
        }
    }

    #[test]
    fn curves_rise_and_stay_in_range() {
        for curve in [ToneMapping::Neutral, ToneMapping::Aces, ToneMapping::AgX] {
            assert!(developed(curve, [0.0; 3]).iter().all(|c| *c < 0.01), "{curve:?}");
            let mut last = 0.0;
            for step in 0..400 {
                let light = 0.001 * libm::exp2f(step as f32 * 0.05);
                let [r, g, b] = developed(curve, [light; 3]);
                assert!(r <= 1.0 && r >= last - 1e-4 && (r - g).abs() + (g - b).abs() < 0.02);
                last = r;
            }
            assert!(last > 0.95, "{curve:?} {last}");
            for odd in [1e30, f32::INFINITY, f32::NAN, -1.0] {
                let found = developed(curve, [odd, 0.5, 0.0]);
                assert!(
                    found.iter().all(|c| c.is_nan() || *c <= 1.001),
                    "{curve:?} {odd} {found:?}"
                );
            }
        }
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        let mut colors = [[0.25], [0.5], [1.0]];
        ToneMapper::new(-1.0, ToneMapping::None).map_colors(&mut colors);
        assert_eq!(colors, [[0.125], [0.25], [0.5]]);
    }
}
