//! Captions: a strip with a line of text at the bottom of a picture.

use crate::Picture;
use drawing::{Warning, label_warnings, missing_glyph_warning};
use glam::DVec2;
use homog::PixelRect;
use page::palette::ink_on_paper;
use page::{Ink, Label, Layer, MILLIMETERS_PER_PIXEL, TextAlign, draw_layers_over};
use picture::Channel;
use scene::{ImageSpec, Scene};
use shade::color::SrgbEncoder;

/// The height of capital letters, as a fraction of the strip's height.
const LETTER_HEIGHT: f64 = 12.0 / 28.0;
/// The margin at each end of the text, as a fraction of the strip's height.
const TEXT_MARGIN: f64 = 0.25;

/// Returns the caption of a scene as a layer of its page, or `None` if there is no caption.
pub(super) fn caption_layer(scene: &Scene) -> Option<Layer> {
    let text = scene.caption.as_deref().filter(|_| scene.image.caption_height > 0)?;
    let [width, height, strip] =
        [scene.image.width, scene.image.height, scene.image.caption_height]
            .map(|pixels| f64::from(pixels) * MILLIMETERS_PER_PIXEL);
    let letters = LETTER_HEIGHT * strip;
    let middle = DVec2::new(0.5 * width, height - 0.5 * strip);
    let label = Label::new(text, middle, letters).with_align(TextAlign::Middle);
    let label = label.fit_to_width((width - 2.0 * TEXT_MARGIN * strip).max(0.0));
    let label = Label { anchor: middle + DVec2::new(0.0, 0.5 * label.height), ..label };
    let pen = label.pen(ink_on_paper(paper_color(scene.image.background)));
    let mut layer = Layer::new("caption", format!("caption: {text}"), pen);
    layer.groups.push(label.group());
    Some(layer)
}

/// Draws the caption of a scene over a region of its picture: the strip in the background color,
/// with the text on it.
pub(super) fn draw_caption_over<C: Channel>(
    scene: &Scene,
    region: PixelRect,
    picture: &mut Picture<C>,
) {
    let Some(layer) = caption_layer(scene) else { return };
    let image = scene.image;
    let color = SrgbEncoder::shared().encode_pixel(image.background).map(C::from_byte);
    let rows = strip_rect(image).y.saturating_sub(region.y);
    if rows >= region.height {
        return;
    }
    picture.pixels[rows as usize * region.width as usize..].fill(color);
    draw_layers_over(picture, [image.width, image.height], region, &[layer]);
}

/// Returns the rectangle of the picture above the caption strip.
pub(super) const fn view_rect(image: ImageSpec) -> PixelRect {
    PixelRect::from_size(image.width, image.height - image.caption_height)
}

/// Returns the rectangle of the caption strip.
pub(super) const fn strip_rect(image: ImageSpec) -> PixelRect {
    let ImageSpec { width, height, caption_height, .. } = image;
    PixelRect { x: 0, y: height - caption_height, width, height: caption_height }
}

/// Returns warnings about labels outside the picture, and about characters of labels or the caption
/// that have no glyph.
pub(super) fn text_warnings(scene: &Scene) -> Vec<Warning> {
    let mut warnings = label_warnings(&scene.drawing_subject(), &scene.overlays);
    warnings.extend(scene.caption.as_deref().and_then(missing_glyph_warning));
    warnings
}

/// Returns the background as the paper color, or `None` if it is not opaque.
pub(super) fn paper_color(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().encode_pixel(background);
    (alpha == 255).then_some([r, g, b])
}
