//! Colormaps, which map numbers such as vertex temperatures or pixel depths to colors.
//!
//! Viridis and Inferno are by van der Walt and Smith (2015, matplotlib), Turbo is by Mikhailov
//! (2019, Google), and the cool-warm map is by Moreland (2009, *Diverging Color Maps for Scientific
//! Visualization*). From each published table of 256 colors, we store the control points from which
//! linear interpolation best reproduces the rest. No channel is off by more than 3 of 255 codes in
//! Turbo, or 1.5 in the other maps.

/// A colormap: a color for each number from 0 to 1.
///
/// ```
/// use model::Colormap;
/// assert_eq!(Colormap::Viridis.srgb_at(0.0), [68, 1, 84].map(|code| code as f32 / 255.0));
/// assert_eq!(Colormap::Grayscale.srgb_at(0.5), [0.5; 3]);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum Colormap {
    /// From dark violet through green to yellow, perceptually uniform (van der Walt and Smith
    /// 2015).
    #[default]
    Viridis,
    /// A rainbow from dark blue through green to dark red, without false bands (Mikhailov 2019).
    Turbo,
    /// From black through red to light yellow, perceptually uniform (van der Walt and Smith 2015).
    Inferno,
    /// From black to white.
    Grayscale,
    /// From blue through light gray to red, for values on both sides of a midpoint (Moreland 2009).
    CoolWarm,
}

/// A control point of a colormap; colors between control points are interpolated.
#[derive(Clone, Copy)]
struct ControlPoint {
    /// The index in a table of 256 colors.
    index: u8,
    /// The 8-bit sRGB codes of red, green and blue.
    codes: [u8; 3],
}

impl Colormap {
    /// Returns the color of a number as red, green and blue: sRGB-encoded values from 0 to 1, not
    /// linear ones.
    ///
    /// `t` is clamped to [0, 1]; NaN becomes 0.
    #[must_use]
    pub fn srgb_at(self, t: f32) -> [f32; 3] {
        let points = self.control_points();
        // For NaN the comparison is false.
        let index = if t > 0.0 { t.min(1.0) * 255.0 } else { 0.0 };
        let above = points.iter().position(|point| f32::from(point.index) >= index);
        let above = above.unwrap_or(points.len() - 1).max(1);
        let [low, high] = [points[above - 1], points[above]];
        let [start, end] = [low.index, high.index].map(f32::from);
        let fraction = (index - start) / (end - start);
        std::array::from_fn(|channel| {
            let [from, to] = [low, high].map(|point| f32::from(point.codes[channel]));
            (from + (to - from) * fraction) / 255.0
        })
    }

    /// Returns the control points, at least two, from index 0 to 255.
    const fn control_points(self) -> &'static [ControlPoint] {
        match self {
            Self::Viridis => &VIRIDIS,
            Self::Turbo => &TURBO,
            Self::Inferno => &INFERNO,
            Self::Grayscale => &GRAYSCALE,
            Self::CoolWarm => &COOL_WARM,
        }
    }
}

/// Returns a control point from its index and codes.
const fn point(index: u8, codes: [u8; 3]) -> ControlPoint {
    ControlPoint { index, codes }
}

/// Viridis, by Stéfan van der Walt and Nathaniel Smith (2015).
const VIRIDIS: [ControlPoint; 17] = [
    point(0, [68, 1, 84]),
    point(17, [72, 26, 108]),
    point(34, [71, 47, 125]),
    point(52, [64, 69, 136]),
    point(82, [50, 101, 142]),
    point(120, [35, 137, 142]),
    point(141, [30, 157, 137]),
    point(153, [34, 168, 132]),
    point(166, [47, 180, 124]),
    point(180, [70, 192, 111]),
    point(192, [94, 201, 98]),
    point(209, [134, 213, 73]),
    point(236, [205, 225, 29]),
    point(243, [223, 227, 24]),
    point(248, [236, 229, 27]),
    point(253, [248, 230, 33]),
    point(255, [253, 231, 37]),
];

/// Turbo, by Anton Mikhailov (2019).
const TURBO: [ControlPoint; 17] = [
    point(0, [48, 18, 59]),
    point(12, [61, 53, 139]),
    point(24, [68, 86, 199]),
    point(36, [71, 118, 238]),
    point(47, [67, 145, 254]),
    point(58, [51, 173, 247]),
    point(76, [25, 213, 205]),
    point(86, [28, 230, 180]),
    point(98, [56, 244, 145]),
    point(121, [143, 255, 73]),
    point(133, [177, 249, 54]),
    point(155, [229, 217, 56]),
    point(171, [251, 184, 56]),
    point(190, [252, 132, 35]),
    point(213, [228, 69, 10]),
    point(235, [183, 29, 2]),
    point(255, [122, 4, 3]),
];

/// Inferno, by Stéfan van der Walt and Nathaniel Smith (2015).
const INFERNO: [ControlPoint; 17] = [
    point(0, [0, 0, 4]),
    point(9, [4, 3, 20]),
    point(27, [25, 12, 62]),
    point(40, [47, 10, 91]),
    point(51, [66, 10, 104]),
    point(69, [95, 19, 110]),
    point(94, [135, 33, 107]),
    point(123, [180, 51, 89]),
    point(149, [216, 76, 62]),
    point(172, [239, 108, 35]),
    point(194, [250, 146, 7]),
    point(201, [252, 159, 7]),
    point(211, [252, 178, 22]),
    point(226, [248, 207, 58]),
    point(237, [243, 229, 93]),
    point(246, [242, 244, 130]),
    point(255, [252, 255, 164]),
];

/// The smooth cool-warm map, by Kenneth Moreland (2009).
const COOL_WARM: [ControlPoint; 17] = [
    point(0, [59, 76, 192]),
    point(20, [83, 110, 221]),
    point(37, [104, 138, 239]),
    point(57, [132, 167, 252]),
    point(77, [159, 191, 255]),
    point(94, [182, 206, 250]),
    point(110, [202, 216, 239]),
    point(127, [220, 221, 221]),
    point(141, [234, 213, 201]),
    point(160, [245, 196, 172]),
    point(177, [247, 175, 145]),
    point(190, [245, 156, 125]),
    point(208, [235, 125, 98]),
    point(225, [220, 93, 74]),
    point(242, [199, 54, 53]),
    point(247, [192, 40, 47]),
    point(255, [180, 4, 38]),
];

/// Grayscale, from black to white.
const GRAYSCALE: [ControlPoint; 2] = [point(0, [0; 3]), point(255, [255; 3])];

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Colormap; 5] = [
        Colormap::Viridis,
        Colormap::Turbo,
        Colormap::Inferno,
        Colormap::Grayscale,
        Colormap::CoolWarm,
    ];

    /// Compares published colors that are not control points, each given by its index in the table
    /// of 256 colors and its codes.
    #[test]
    fn interpolated_colors_match_the_published_colors() {
        let table = [
            (Colormap::Viridis, 64, [59, 82, 139]),
            (Colormap::Viridis, 128, [33, 145, 140]),
            (Colormap::Inferno, 64, [87, 16, 110]),
            (Colormap::Inferno, 128, [188, 55, 84]),
            (Colormap::Inferno, 192, [249, 142, 9]),
            (Colormap::Turbo, 64, [40, 188, 235]),
            (Colormap::Turbo, 128, [164, 252, 60]),
            (Colormap::Turbo, 192, [251, 126, 33]),
            (Colormap::CoolWarm, 64, [141, 176, 254]),
            (Colormap::CoolWarm, 192, [244, 152, 122]),
        ];
        for (colormap, index, expected) in table {
            let color = colormap.srgb_at(index as f32 / 255.0).map(|fraction| fraction * 255.0);
            for (channel, code) in color.iter().zip(expected) {
                assert!((channel - code as f32).abs() < 3.5, "{colormap:?} {index}: {color:?}");
            }
        }
    }

    #[test]
    fn control_points_cover_the_range_and_numbers_are_clamped() {
        for colormap in ALL {
            let points = colormap.control_points();
            assert_eq!((points[0].index, points[points.len() - 1].index), (0, 255));
            assert!(points.windows(2).all(|pair| pair[0].index < pair[1].index), "{colormap:?}");
            for point in points {
                let color = colormap.srgb_at(f32::from(point.index) / 255.0);
                let expected = point.codes.map(|code| f32::from(code) / 255.0);
                let is_close = |pair: (&f32, &f32)| (pair.0 - pair.1).abs() < 1e-5;
                assert!(color.iter().zip(&expected).all(is_close), "{colormap:?} {}", point.index);
            }
            let [low, high] = [0.0, 1.0].map(|end| colormap.srgb_at(end));
            for (t, end) in [(-1.0, low), (f32::NAN, low), (f32::INFINITY, high), (7.0, high)] {
                assert_eq!(colormap.srgb_at(t), end, "{colormap:?} {t}");
            }
        }
    }

    /// Checks that the perceptually uniform maps and the grayscale become brighter throughout.
    #[test]
    fn sequential_maps_become_brighter() {
        for colormap in [Colormap::Viridis, Colormap::Inferno, Colormap::Grayscale] {
            let luma = |index: u16| {
                let [r, g, b] = colormap.srgb_at(f32::from(index) / 255.0);
                0.299 * r + 0.587 * g + 0.114 * b
            };
            assert!((1..256).all(|index| luma(index) > luma(index - 1)), "{colormap:?}");
        }
    }
}
