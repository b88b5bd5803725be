//! The canvas: lines and flat colours through tiny-skia, which nothing else in the workspace names.
//!
//! Surfaces never come here. Filling neighbouring triangles with anti-aliased paths would let the background shine
//! through their seams, and tiny-skia breaks ties the other way round (RA-3).

mod page;

use crate::Picture;
use crate::color::SrgbEncoder;
use tiny_skia::{Color, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// A picture to draw lines on.
#[derive(Debug)]
pub(crate) struct Canvas {
    pixmap: Pixmap,
}

impl Canvas {
    /// A canvas of one colour (linear, multiplied by alpha). `None` if it would have no pixels or more than memory holds;
    /// the scene's limits keep well below.
    #[must_use]
    pub(crate) fn new(width: u32, height: u32, background: [f32; 4]) -> Option<Self> {
        let mut pixmap = Pixmap::new(width, height)?;
        pixmap.fill(skia_color(background));
        Some(Self { pixmap })
    }

    /// Draws straight lines between points of the screen (pixels, y down), all with one colour (linear, multiplied by
    /// alpha) and width. Where lines cross, the colour is laid on once for each.
    ///
    /// The ends should lie within the picture and a margin of a few of its sizes, as clipped lines do.
    pub(crate) fn lines(&mut self, segments: &[[(f32, f32); 2]], width: f32, color: [f32; 4]) {
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(skia_color(color));
        let stroke = Stroke {
            width,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        // Many lines in one path make its outline slow to fill; few make each call's own cost count.
        for group in segments.chunks(64) {
            let mut path = PathBuilder::new();
            for [start, end] in group {
                path.move_to(start.0, start.1);
                path.line_to(end.0, end.1);
            }
            if let Some(path) = path.finish() {
                self.pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
            }
        }
    }

    /// The canvas as a picture, its alpha no longer multiplied in.
    #[must_use]
    pub(crate) fn into_picture(self) -> Picture {
        let pixels = self.pixmap.pixels().iter().map(|pixel| {
            let straight = pixel.demultiply();
            [straight.red(), straight.green(), straight.blue(), straight.alpha()]
        });
        Picture {
            width: self.pixmap.width(),
            height: self.pixmap.height(),
            pixels: pixels.collect(),
        }
    }
}

fn skia_color(linear: [f32; 4]) -> Color {
    let [r, g, b, alpha] = SrgbEncoder::shared().pixel(linear);
    Color::from_rgba8(r, g, b, alpha)
}
