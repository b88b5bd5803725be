//! The canvas: pages as pictures, their strokes and fills through tiny-skia, which nothing else in the workspace names.
//!
//! Surfaces never come here. Filling neighbouring triangles with anti-aliased paths would let the background shine
//! through their seams, and tiny-skia breaks ties the other way round (RA-3).

use crate::drawing::{
    Cap, Ink, Join, Layer, MILLIMETRES_PER_PIXEL, Page, Pen, Polyline, millimetres,
};
use crate::render::Region;
use crate::{Channel, Picture};
use tiny_skia::{
    Color, ColorU8, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap,
    PremultipliedColorU8, Stroke, StrokeDash, Transform,
};

/// How many points a path may have before another is begun: long ones are slow to fill, and short ones cost a call each.
const POINTS: usize = 256;

/// The largest piece of a picture that is drawn on at once. Coordinates are rounded from its corner on, so pixels depend on which piece
/// they are in; as pieces are counted from the corner of the whole picture, they do not depend on the region that is wanted.
const PIECE: [u32; 2] = [4096, 2048];

impl Page {
    /// The page as a picture of this size in pixels, stretched to fill it; transparent where there is no paper. `None` if it
    /// would have no pixels, or more than memory holds.
    #[must_use]
    pub fn to_picture(&self, width: u32, height: u32) -> Option<Picture> {
        let whole = Region { x: 0, y: 0, width, height };
        if !(1..=raster::MAX_SIDE).contains(&width) || !(1..=raster::MAX_SIDE).contains(&height) {
            return None;
        }
        Some(self.to_region([width, height], whole))
    }

    /// A region of the picture of this size in pixels.
    pub(crate) fn to_region<C: Channel>(&self, size: [u32; 2], region: Region) -> Picture<C> {
        let [width, height] = size.map(f64::from);
        let mut picture = Picture::default();
        picture.resize(region.width, region.height);
        let [r, g, b] = self.paper.unwrap_or_default();
        let alpha = if self.paper.is_some() { 255 } else { 0 };
        picture.pixels.fill([r, g, b, alpha].map(C::of_byte));
        picture.draw(size, region, &self.layers, [width / self.size.x, height / self.size.y]);
        picture
    }
}

impl<C: Channel> Picture<C> {
    /// Draws layers of a page of 96 pixels to the inch over what is a region of a picture of this size.
    pub(crate) fn draw_over(&mut self, size: [u32; 2], region: Region, layers: &[Layer]) {
        self.draw(size, region, layers, [1.0 / MILLIMETRES_PER_PIXEL; 2]);
    }

    /// Draws layers over a region, with this many pixels for a millimetre.
    fn draw(&mut self, size: [u32; 2], region: Region, layers: &[Layer], scale: [f64; 2]) {
        if layers.is_empty() {
            return;
        }
        let first = [region.x / PIECE[0], region.y / PIECE[1]];
        let last = [region.x + region.width - 1, region.y + region.height - 1];
        let last = [last[0] / PIECE[0], last[1] / PIECE[1]];
        for row in first[1]..=last[1] {
            for column in first[0]..=last[0] {
                let (x, y) = (column * PIECE[0], row * PIECE[1]);
                let width = PIECE[0].min(size[0] - x);
                let height = PIECE[1].min(size[1] - y);
                self.draw_piece(region, Region { x, y, width, height }, layers, scale);
            }
        }
    }

    /// Draws layers over what a region has of a piece. Also what is not wanted of the piece is drawn: lines are cut at its borders, and
    /// cut elsewhere they could be rounded to other pixels.
    fn draw_piece(&mut self, region: Region, piece: Region, layers: &[Layer], scale: [f64; 2]) {
        let Some(shown) = piece.and(region) else { return };
        let Some(pixmap) = Pixmap::new(piece.width, piece.height) else { return };
        let mut canvas = Canvas { pixmap, corner: [piece.x, piece.y] };
        self.copy(region, shown, &mut canvas, |pixel, place| *place = C::laid_down(*pixel));
        layers.iter().for_each(|layer| canvas.layer(layer, scale));
        self.copy(region, shown, &mut canvas, |pixel, place| {
            *pixel = C::taken_up(*pixel, *place);
        });
    }

    /// Goes through the pixels of a region that are on a canvas.
    fn copy(
        &mut self,
        region: Region,
        shown: Region,
        canvas: &mut Canvas,
        each: impl Fn(&mut [C; 4], &mut PremultipliedColorU8),
    ) {
        let (across, width) = (region.width as usize, canvas.pixmap.width() as usize);
        let within = |from: [u32; 2]| [(shown.x - from[0]) as usize, (shown.y - from[1]) as usize];
        let ([left, top], [first, skipped]) = (within([region.x, region.y]), within(canvas.corner));
        let (count, high) = (shown.width as usize, shown.height as usize);
        let rows = self.pixels.chunks_exact_mut(across).skip(top).take(high);
        let places = canvas.pixmap.pixels_mut().chunks_exact_mut(width).skip(skipped);
        for (row, places) in rows.zip(places) {
            let places = &mut places[first..first + count];
            for (pixel, place) in row[left..left + count].iter_mut().zip(places) {
                each(pixel, place);
            }
        }
    }
}

/// How pixels come onto a canvas and off it. Those of 8 bits are drawn on; those of 16 stay where they are, and the drawing is laid
/// over them.
trait OnCanvas: Channel {
    fn laid_down(pixel: [Self; 4]) -> PremultipliedColorU8;
    fn taken_up(pixel: [Self; 4], place: PremultipliedColorU8) -> [Self; 4];
}

impl<C: Channel> OnCanvas for C {
    fn laid_down(pixel: [C; 4]) -> PremultipliedColorU8 {
        if C::BITS > 8 {
            return PremultipliedColorU8::TRANSPARENT;
        }
        let [r, g, b, alpha] = pixel.map(C::to_byte);
        ColorU8::from_rgba(r, g, b, alpha).premultiply()
    }

    fn taken_up(pixel: [C; 4], place: PremultipliedColorU8) -> [C; 4] {
        if C::BITS > 8 {
            let over = [place.red(), place.green(), place.blue(), place.alpha()];
            return C::under(pixel, over);
        }
        let straight = place.demultiply();
        [straight.red(), straight.green(), straight.blue(), straight.alpha()].map(C::of_byte)
    }
}

/// A picture to draw pages on.
struct Canvas {
    pixmap: Pixmap,
    /// Where its corner is in the picture.
    corner: [u32; 2],
}

impl Canvas {
    /// Draws a layer over what is there, with this many pixels for a millimetre.
    fn layer(&mut self, layer: &Layer, scale: [f64; 2]) {
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(color(layer.pen.ink));
        let stroke = stroke(&layer.pen, 0.5 * (scale[0] + scale[1]));
        for group in &layer.groups {
            for path in paths(&group.strokes, scale, self.corner, POINTS) {
                self.pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
            }
            // Holes must be in the path of what they are holes of.
            for path in paths(&group.fills, scale, self.corner, usize::MAX) {
                let rule = FillRule::EvenOdd;
                self.pixmap.fill_path(&path, &paint, rule, Transform::identity(), None);
            }
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
fn paths(lines: &[Polyline], scale: [f64; 2], corner: [u32; 2], most: usize) -> Vec<Path> {
    let mut paths = Vec::new();
    let mut path = PathBuilder::new();
    for line in lines {
        if path.len() >= most {
            paths.extend(std::mem::take(&mut path).finish());
        }
        for (at, point) in line.points.iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| {
                (millimetres(*point)[axis] * scale[axis] - f64::from(corner[axis])) as f32
            });
            if at == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if line.closed {
            path.close();
        }
    }
    paths.extend(path.finish());
    paths
}
