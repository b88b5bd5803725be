//! Gray fill: paints visible faces in tints of the ink, by the luminance of their materials.
//!
//! Exact outlines of the visible parts of faces would have to be assembled from lines whose
//! endpoints depend on tolerances. Instead, a z-buffer finds the visible parts, as for a flat fill,
//! and their borders are traced. The traced borders are off by about one pixel of a fine image, but
//! the lines over them are wider.

use super::Drawing;
use super::color_areas::{PixelCorner, trace_color_areas};
use super::layout::Placement;
use super::line_style::{FaceFill, LineStyle};
use glam::DVec2;
use page::{Group, Ink, Layer, Pen, Polyline};
use shade::color::SrgbEncoder;

/// The number of gray levels, from black to white.
const LEVELS: u8 = 32;

/// The fraction of ink in the fill for a white and for a black material. Lines must be visible on
/// both, and a white part must differ from the paper.
const TINTS: [f64; 2] = [0.06, 0.55];

/// Encodes the gray of a material as a pixel of the fill image, transparent if it has no color.
///
/// The luminance of the base color (Rec. 709) is sRGB-encoded, so that level steps look nearly
/// equal.
pub(super) fn gray_pixel(color: Option<[f32; 3]>) -> [u8; 4] {
    let Some([r, g, b]) = color else { return [0; 4] };
    let luminance = r * 0.2126 + g * 0.7152 + b * 0.0722;
    let [code, ..] = SrgbEncoder::shared().encode_pixel([luminance, luminance, luminance, 1.0]);
    let level = (u32::from(code) * u32::from(LEVELS - 1) + 127) / 255;
    [level as u8, level as u8, level as u8, 255]
}

/// Returns the color of a gray level: a mix of paper and ink.
fn tint(level: u8, [ink, paper]: [Ink; 2]) -> Ink {
    let [least, most] = TINTS;
    let part = most - (most - least) * f64::from(level) / f64::from(LEVELS - 1);
    let mixed = |k: usize| {
        let (ink, paper) = (f64::from(ink[k]), f64::from(paper[k]));
        libm::round(paper + (ink - paper) * part) as u8
    };
    [0, 1, 2].map(mixed)
}

impl Drawing {
    /// Returns the layers of a [gray](FaceFill::Gray) fill, one for each gray level, to be placed
    /// under the lines. Other fills have none.
    ///
    /// `inks` are the ink and the paper color, which are mixed for each gray. `prefix` is prepended
    /// to the layer ids, as in [`to_layers`](Self::to_layers).
    #[must_use]
    pub fn face_fill_layers(
        &self,
        style: &LineStyle,
        placement: Placement,
        prefix: &str,
        inks: [Ink; 2],
    ) -> Vec<Layer> {
        let Some(picture) = self.face_fill.as_ref().filter(|_| style.face_fill == FaceFill::Gray)
        else {
            return Vec::new();
        };
        let pixel = self.size / DVec2::new(f64::from(picture.width), f64::from(picture.height));
        let on_page = |corner: &PixelCorner| {
            placement.pixels_to_page(DVec2::from(corner.map(f64::from)) * pixel)
        };
        let areas = trace_color_areas(picture).into_iter();
        let layer = |([level, ..], outlines): ([u8; 4], Vec<Vec<PixelCorner>>)| {
            let [_, narrow] = style.line_widths.wide_and_narrow();
            let percent = u32::from(level) * 100 / u32::from(LEVELS - 1);
            let pen = Pen::solid(narrow, tint(level, inks));
            let title = format!("face fill, {percent}% bright");
            let mut layer = Layer::new(format!("{prefix}gray-{level}"), title, pen);
            let fill = |outline: &Vec<PixelCorner>| {
                let points: Vec<DVec2> = outline.iter().map(on_page).collect();
                Polyline::through_points(&points, true).filter(|line| line.points.len() >= 3)
            };
            let fills: Vec<Polyline> = outlines.iter().filter_map(fill).collect();
            if !fills.is_empty() {
                layer.groups.push(Group { fills, ..Group::default() });
            }
            layer
        };
        areas.map(layer).filter(|layer| !layer.groups.is_empty()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grays_are_between_ink_and_paper() {
        let (black, white) = ([0; 3], [255; 3]);
        let gray = |color: [f32; 3]| tint(gray_pixel(Some(color))[0], [black, white])[0];
        assert_eq!([gray([0.0; 3]), gray([1.0; 3])], [115, 240]);
        // Blue is darker than green of the same intensity.
        assert!(gray([0.0, 0.0, 1.0]) < gray([0.0, 1.0, 0.0]));
        assert_eq!(gray_pixel(None)[3], 0);
        // With white ink on blue paper, dark materials come out lighter, as in a negative.
        assert!(tint(0, [white, [0, 0, 128]])[0] > tint(31, [white, [0, 0, 128]])[0]);
    }
}
