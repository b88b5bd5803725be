//! Insets: pictures from other cameras, composited into rectangles of a picture.
//!
//! ```text
//!  ┌──────────────┐   Insets are rendered like separate pictures and composited over the
//!  │   picture  ┌─┤   picture in scene order: opaque, with an optional border inside the
//!  │            │2│   rectangle, or in cyan for the right eye of a red-cyan anaglyph.
//!  │       ┌──┐ └─┤
//!  └───────┤1 ├───┘   If only a region is rendered, it includes only the parts of insets in it.
//!          └──┘
//! ```

use crate::Picture;
use homog::PixelRect;
use picture::Channel;
use scene::Inset;

/// Returns the intersection of an inset with a region of the picture, in pixels of the picture and
/// in pixels of the inset, or `None` if they are disjoint.
pub(super) fn visible_rects(inset: &Inset, region: PixelRect) -> Option<[PixelRect; 2]> {
    let in_picture = inset.rect.intersection(region)?;
    let (x, y) = (in_picture.x - inset.rect.x, in_picture.y - inset.rect.y);
    Some([in_picture, PixelRect { x, y, ..in_picture }])
}

/// Whether insets hide a region completely, so that the picture below does not have to be rendered.
///
/// The test is conservative: a single inset must cover the region, or disjoint insets must cover it
/// together. A cyan inset of an anaglyph leaves the red channel of the picture below visible.
pub(super) fn covers_region(insets: &[Inset], region: PixelRect) -> bool {
    let opaque = || {
        let opaque = insets.iter().filter(|inset| !inset.cyan_only);
        opaque.filter_map(|inset| inset.rect.intersection(region))
    };
    let (mut disjoint, mut covered): (Vec<PixelRect>, usize) = (Vec::new(), 0);
    for rect in opaque() {
        if disjoint.iter().all(|other| other.intersection(rect).is_none()) {
            disjoint.push(rect);
            covered += rect.area();
        }
    }
    covered == region.area() || opaque().any(|rect| rect == region)
}

/// Composites the pixels of an inset into a region of the picture. `rect` is the covered part of
/// the picture.
///
/// The border replaces pixels at the inset's edge. A cyan inset replaces green and blue and keeps
/// red (anaglyph). The result then has the larger alpha of the two pixels.
pub(super) fn composite_into<C: Channel>(
    inset: &Inset,
    pixels: &Picture<C>,
    rect: PixelRect,
    region: PixelRect,
    picture: &mut Picture<C>,
) {
    let [left, top] = [rect.x - region.x, rect.y - region.y].map(|at| at as usize);
    let (region_width, width) = (region.width as usize, rect.width as usize);
    let rows = picture.pixels.chunks_exact_mut(region_width).skip(top);
    for (y, (row, pixels)) in (rect.y..).zip(rows.zip(pixels.pixels.chunks_exact(width))) {
        let row = &mut row[left..left + width];
        for (x, (target, pixel)) in (rect.x..).zip(row.iter_mut().zip(pixels)) {
            *target = match border_color_at(inset, x, y) {
                Some([r, g, b]) => [r, g, b, 255].map(C::from_byte),
                None if inset.cyan_only => {
                    let [_, green, blue, alpha] = *pixel;
                    let keeps_alpha = target[3].to_byte() >= alpha.to_byte();
                    [target[0], green, blue, if keeps_alpha { target[3] } else { alpha }]
                }
                None => *pixel,
            };
        }
    }
}

/// Returns the color of the border at a pixel of the picture, or `None` if the pixel is not on the
/// border.
fn border_color_at(inset: &Inset, x: u32, y: u32) -> Option<[u8; 3]> {
    let (color, border) = inset.border?;
    let is_on_border = |at: u32, start: u32, side: u32| {
        let distance = at - start;
        distance < border || side - 1 - distance < border
    };
    let PixelRect { x: left, y: top, width, height } = inset.rect;
    (is_on_border(x, left, width) || is_on_border(y, top, height)).then_some(color)
}
