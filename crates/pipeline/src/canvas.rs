//! The canvas: pages as pictures, their strokes and fills through tiny-skia, which nothing else in the workspace names.
//!
//! Surfaces never come here. Filling neighbouring triangles with anti-aliased paths would let the background shine
//! through their seams, and tiny-skia breaks ties the other way round (RA-3).

use crate::Picture;
use crate::drawing::{
    Cap, Ink, Join, Layer, MILLIMETRES_PER_PIXEL, Page, Pen, Polyline, millimetres,
};
use tiny_skia::{
    Color, ColorU8, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke,
    StrokeDash, Transform,
};

/// How many points a path may have before another is begun: long ones are slow to fill, and short ones cost a call each.
const POINTS: usize = 256;

impl Page {
    /// The page as a picture of this size in pixels, stretched to fill it; transparent where there is no paper. `None` if it
    /// would have no pixels, or more than memory holds.
    #[must_use]
    pub fn to_picture(&self, width: u32, height: u32) -> Option<Picture> {
        let mut pixmap = Pixmap::new(width, height)?;
        if let Some(paper) = self.paper {
            pixmap.fill(color(paper));
        }
        let mut canvas = Canvas { pixmap };
        let scale = [f64::from(width) / self.size.x, f64::from(height) / self.size.y];
        for layer in &self.layers {
            canvas.layer(layer, scale);
        }
        Some(canvas.into_picture())
    }
}

impl Picture {
    /// The picture with layers of a page of 96 pixels to the inch drawn over it.
    pub(crate) fn under(self, layers: &[Layer]) -> Self {
        let pixmap = Pixmap::new(self.width, self.height);
        let Some(mut pixmap) = pixmap.filter(|_| !layers.is_empty()) else { return self };
        for (place, [r, g, b, alpha]) in pixmap.pixels_mut().iter_mut().zip(&self.pixels) {
            *place = ColorU8::from_rgba(*r, *g, *b, *alpha).premultiply();
        }
        let mut canvas = Canvas { pixmap };
        layers.iter().for_each(|layer| canvas.layer(layer, [1.0 / MILLIMETRES_PER_PIXEL; 2]));
        canvas.into_picture()
    }
}

/// A picture to draw pages on.
struct Canvas {
    pixmap: Pixmap,
}

impl Canvas {
    /// Draws a layer over what is there, with this many pixels for a millimetre.
    fn layer(&mut self, layer: &Layer, scale: [f64; 2]) {
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(color(layer.pen.ink));
        let stroke = stroke(&layer.pen, 0.5 * (scale[0] + scale[1]));
        for group in &layer.groups {
            for path in paths(&group.strokes, scale, POINTS) {
                self.pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
            }
            // Holes must be in the path of what they are holes of.
            for path in paths(&group.fills, scale, usize::MAX) {
                let rule = FillRule::EvenOdd;
                self.pixmap.fill_path(&path, &paint, rule, Transform::identity(), None);
            }
        }
    }

    /// The canvas as a picture, its alpha no longer multiplied in.
    fn into_picture(self) -> Picture {
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

fn color([r, g, b]: Ink) -> Color {
    Color::from_rgba8(r, g, b, 255)
}

fn stroke(pen: &Pen, scale: f64) -> Stroke {
    let dashes = pen.dashes.iter().map(|dash| (dash * scale) as f32).collect::<Vec<_>>();
    Stroke {
        width: (pen.width * scale) as f32,
        miter_limit: 4.0,
        line_cap: match pen.cap {
            Cap::Butt => LineCap::Butt,
            Cap::Round => LineCap::Round,
            Cap::Square => LineCap::Square,
        },
        line_join: match pen.join {
            Join::Miter => LineJoin::Miter,
            Join::Round => LineJoin::Round,
            Join::Bevel => LineJoin::Bevel,
        },
        // None for no dashes.
        dash: StrokeDash::new(dashes, 0.0),
    }
}

/// The lines as paths of about so many points, in pixels.
fn paths(lines: &[Polyline], scale: [f64; 2], most: usize) -> Vec<Path> {
    let mut paths = Vec::new();
    let mut path = PathBuilder::new();
    for line in lines {
        if path.len() >= most {
            paths.extend(std::mem::take(&mut path).finish());
        }
        for (at, point) in line.points.iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| (millimetres(*point)[axis] * scale[axis]) as f32);
            if at == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if line.closed {
            path.close();
        }
    }
    paths.extend(path.finish());
    paths
}
