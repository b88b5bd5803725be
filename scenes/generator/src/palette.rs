//! The palette of the scenes: fourteen muted colors, in sRGB in the source and in linear light in
//! the files.

/// An sRGB color with eight bits per channel: red, green, blue.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Color(pub u8, pub u8, pub u8);

/// Almost white: walls, cloth.
pub const PAPER: Color = Color(0xf4, 0xf1, 0xea);
/// A pale warm yellow.
pub const CREAM: Color = Color(0xf3, 0xe3, 0xc3);
/// A light brown.
pub const SAND: Color = Color(0xdc, 0xc7, 0xa1);
/// A dark yellow.
pub const OCHRE: Color = Color(0xd9, 0x9f, 0x3d);
/// An orange red.
pub const CLAY: Color = Color(0xc8, 0x66, 0x4a);
/// A dark red: chimneys, roofs.
pub const BRICK: Color = Color(0x9c, 0x44, 0x38);
/// A dark purple.
pub const PLUM: Color = Color(0x6d, 0x46, 0x6b);
/// A medium brown: furniture.
pub const WOOD: Color = Color(0xa8, 0x74, 0x4a);
/// A dark brown.
pub const BARK: Color = Color(0x6b, 0x47, 0x2f);
/// A gray green.
pub const SAGE: Color = Color(0x86, 0xa5, 0x86);
/// A dark blue green.
pub const TEAL: Color = Color(0x2c, 0x7d, 0x85);
/// A light blue: window panes.
pub const SKY: Color = Color(0x9f, 0xc3, 0xd6);
/// A dark blue gray: metal, roofs.
pub const SLATE: Color = Color(0x4a, 0x62, 0x74);
/// Almost black: outlines.
pub const INK: Color = Color(0x22, 0x31, 0x3f);

impl Color {
    /// Returns the channels in linear light, 0 to 1, by the sRGB transfer function (IEC 61966-2-1).
    /// They are rounded to four digits, which suffice for eight bits and keep the files short.
    pub fn linear(self) -> [f64; 3] {
        [self.0, self.1, self.2].map(|channel| {
            let encoded = f64::from(channel) / 255.0;
            let light = if encoded <= 0.04045 {
                encoded / 12.92
            } else {
                libm::pow((encoded + 0.055) / 1.055, 2.4)
            };
            libm::round(light * 1e4) / 1e4
        })
    }

    /// Returns the sRGB code values, 0 to 255.
    pub fn srgb(self) -> [f64; 3] {
        [self.0, self.1, self.2].map(f64::from)
    }
}

/// Evaluates a piecewise linear color ramp: `stops` are evenly spaced over 0 to 1, and `t` is
/// clamped to that range.
///
/// # Panics
/// Panics if there are no stops.
pub fn color_ramp(stops: &[[f64; 3]], t: f64) -> [f64; 3] {
    let last = stops.len() - 1;
    let position = t.clamp(0.0, 1.0) * last as f64;
    let below = (position as usize).min(last.saturating_sub(1));
    mix_colors(stops[below], stops[(below + 1).min(last)], position - below as f64)
}

/// Interpolates linearly from `a` at 0 to `b` at 1.
pub fn mix_colors(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_light_keeps_black_and_white_and_darkens_mid_gray() {
        assert_eq!(Color(0, 0, 0).linear(), [0.0; 3]);
        assert_eq!(Color(255, 255, 255).linear(), [1.0; 3]);
        assert_eq!(Color(188, 188, 188).linear(), [0.5029; 3]);
    }

    #[test]
    fn a_ramp_passes_through_its_stops() {
        let stops = [[0.0; 3], [1.0; 3], [3.0; 3]];
        assert_eq!(color_ramp(&stops, 0.5), [1.0; 3]);
        assert_eq!(color_ramp(&stops, 0.75), [2.0; 3]);
        assert_eq!(color_ramp(&stops, 7.0), [3.0; 3]);
    }
}
