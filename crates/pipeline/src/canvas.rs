//! The canvas: pages as pictures, their strokes and fills through tiny-skia, which nothing else in the workspace names.
//!
//! Surfaces never come here. Filling neighbouring triangles with anti-aliased paths would let the background shine
//! through their seams, and tiny-skia breaks ties the other way round (RA-3).

use crate::Picture;
use crate::drawing::{
    Cap, Ink, Join, Layer, MILLIMETRES_PER_PIXEL, Page, Pasted, Pen, Polyline, millimetres,
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
        for pasted in &self.pictures {
            canvas.paste(pasted, scale);
        }
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
        let pixels = 0.5 * (scale[0] + scale[1]);
        let whole = stroke(&layer.pen, &[], pixels);
        for group in &layer.groups {
            let (dashed, lines): (Vec<_>, Vec<_>) = group
                .strokes
                .iter()
                .map(|line| (line, layer.pen.fitted_dashes(line)))
                .partition(|(_, dashes)| !dashes.is_empty());
            for path in paths(lines.into_iter().map(|(line, _)| line), scale, POINTS) {
                self.pixmap.stroke_path(&path, &paint, &whole, Transform::identity(), None);
            }
            for (line, dashes) in dashed {
                let stroke = stroke(&layer.pen, &dashes, pixels);
                for path in paths([line], scale, POINTS) {
                    self.pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
                }
            }
            // Holes must be in the path of what they are holes of.
            for path in paths(&group.fills, scale, usize::MAX) {
                let rule = FillRule::EvenOdd;
                self.pixmap.fill_path(&path, &paint, rule, Transform::identity(), None);
            }
        }
    }

    /// Puts a picture under all lines: each pixel is the mean of what it covers.
    fn paste(&mut self, pasted: &Pasted, scale: [f64; 2]) {
        let Pasted { corner, size, picture, .. } = pasted;
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        let span = |axis: usize, side: u32, sides: u32| {
            // Pixels of the pasted picture for one of the canvas, and where the canvas begins in it.
            let pixels = f64::from(side) / (f64::from(size[axis]) / 1000.0 * scale[axis]);
            let start = -f64::from(corner[axis]) / 1000.0 * scale[axis] * pixels;
            (0..sides).map(move |at| {
                let from = start + f64::from(at) * pixels;
                [from, from + pixels].map(|edge| edge.clamp(0.0, f64::from(side)))
            })
        };
        let columns: Vec<[f64; 2]> = span(0, picture.width, width).collect();
        let rows = span(1, picture.height, height);
        let places = self.pixmap.pixels_mut().chunks_exact_mut(width as usize);
        for (row, places) in rows.zip(places) {
            for (column, place) in columns.iter().zip(places) {
                let below = place.demultiply();
                let below = [below.red(), below.green(), below.blue(), below.alpha()];
                let [r, g, b, alpha] = over(mean(picture, *column, row), below);
                *place = ColorU8::from_rgba(r, g, b, alpha).premultiply();
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

fn stroke(pen: &Pen, dashes: &[f64], scale: f64) -> Stroke {
    let dashes = dashes.iter().map(|dash| (dash * scale) as f32).collect::<Vec<_>>();
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

/// The mean of an area of a picture: red, green and blue times alpha, and alpha, from 0 to 255; nothing beside the picture.
fn mean(picture: &Picture, columns: [f64; 2], rows: [f64; 2]) -> [f64; 4] {
    let cells = |[from, to]: [f64; 2]| {
        let first = from as u32;
        (first..libm::ceil(to) as u32)
            .map(move |at| (at, to.min(f64::from(at) + 1.0) - from.max(f64::from(at))))
    };
    let area = (columns[1] - columns[0]) * (rows[1] - rows[0]);
    let mut sum = [0.0; 4];
    if area <= 0.0 {
        return sum;
    }
    for (y, height) in cells(rows) {
        for (x, width) in cells(columns) {
            let Some([r, g, b, alpha]) = picture.pixel(x, y) else { continue };
            let share = width * height / area;
            let alpha = f64::from(alpha) * share;
            let color = [r, g, b].map(|channel| f64::from(channel) * alpha / 255.0);
            let part = [color[0], color[1], color[2], alpha];
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
    }
    sum
}

/// A colour times its alpha over a straight one, as a straight one.
fn over([r, g, b, alpha]: [f64; 4], below: [u8; 4]) -> [u8; 4] {
    let rest = f64::from(below[3]) * (1.0 - alpha / 255.0);
    let whole = alpha + rest;
    if whole <= 0.0 {
        return [0; 4];
    }
    let mixed = |above: f64, below: u8| {
        libm::round((above * 255.0 + f64::from(below) * rest) / whole) as u8
    };
    [mixed(r, below[0]), mixed(g, below[1]), mixed(b, below[2]), libm::round(whole) as u8]
}

/// The lines as paths of about so many points, in pixels.
fn paths<'a>(
    lines: impl IntoIterator<Item = &'a Polyline>,
    scale: [f64; 2],
    most: usize,
) -> Vec<Path> {
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
