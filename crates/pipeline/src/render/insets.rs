//! Views within a picture: drawn on their own, and put into their places.

use crate::scene::{Inset, Scene};
use crate::{Channel, Picture};
use homog::PixelRect;

impl Scene {
    /// Whether every pixel of its picture is sure to be opaque, by the backgrounds alone.
    #[must_use]
    pub fn has_opaque_background(&self) -> bool {
        let is_opaque = |scene: &Self| scene.image.background[3] >= 1.0;
        is_opaque(self) && self.insets.iter().all(|view| is_opaque(&view.scene))
    }
}

impl Inset {
    /// The part of the view that lies in a region of the picture: in the picture, and in the view.
    pub(super) fn visible_rects(&self, region: PixelRect) -> Option<[PixelRect; 2]> {
        let visible_rect = self.rect.intersection(region)?;
        let own = PixelRect {
            x: visible_rect.x - self.rect.x,
            y: visible_rect.y - self.rect.y,
            ..visible_rect
        };
        Some([visible_rect, own])
    }

    /// Whether nothing of a region of the picture is seen beside views, as far as is easily told: one fills it, or all do that lie
    /// beside each other.
    pub(super) fn covers_region(views: &[Self], region: PixelRect) -> bool {
        let opaque_insets = views.iter().filter(|view| !view.cyan_only);
        let opaque_insets: Vec<PixelRect> =
            opaque_insets.filter_map(|view| view.rect.intersection(region)).collect();
        let (mut disjoint, mut filled): (Vec<PixelRect>, usize) = (Vec::new(), 0);
        for part in opaque_insets {
            if disjoint.iter().all(|other| other.intersection(part).is_none()) {
                disjoint.push(part);
                filled += part.area();
            }
        }
        filled == region.area()
            || views
                .iter()
                .any(|view| view.rect.intersection(region) == Some(region) && !view.cyan_only)
    }

    /// Puts pixels of the view that are `shown` in the picture into a region of it.
    pub(super) fn composite_into<C: Channel>(
        &self,
        part: &Picture<C>,
        shown: PixelRect,
        region: PixelRect,
        picture: &mut Picture<C>,
    ) {
        let [left, top] = [shown.x - region.x, shown.y - region.y].map(|at| at as usize);
        let (region_width, width) = (region.width as usize, shown.width as usize);
        let rows = picture.pixels.chunks_exact_mut(region_width).skip(top);
        for (y, (row, pixels)) in (shown.y..).zip(rows.zip(part.pixels.chunks_exact(width))) {
            let row = &mut row[left..left + width];
            for (x, (place, pixel)) in (shown.x..).zip(row.iter_mut().zip(pixels)) {
                *place = match self.border_color_at(x, y) {
                    Some([r, g, b]) => [r, g, b, 255].map(C::from_byte),
                    None if self.cyan_only => {
                        let [_, green, blue, alpha] = *pixel;
                        let covers = place[3].to_byte() >= alpha.to_byte();
                        [place[0], green, blue, if covers { place[3] } else { alpha }]
                    }
                    None => *pixel,
                };
            }
        }
    }

    /// The colour of the border in a pixel of the picture, if the border is there.
    fn border_color_at(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        let (ink, width) = self.border?;
        let is_on_border = |at: u32, from: u32, side: u32| {
            let distance = at - from;
            distance < width || side - 1 - distance < width
        };
        let PixelRect { x: left, y: top, width: across, height: down } = self.rect;
        (is_on_border(x, left, across) || is_on_border(y, top, down)).then_some(ink)
    }
}
