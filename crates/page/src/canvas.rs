//! Page rasterization: draws anti-aliased strokes and fills into pictures with tiny-skia.
//!
//! Only this module depends on tiny-skia. Faces are never drawn here: adjacent triangles filled
//! with anti-aliased paths would let the background show through their seams, and tiny-skia breaks
//! ties the opposite way (RA-3).
//!
//! ```text
//!   picture  ┌────────┬────────┬───┐   tiles of 4096 × 2048 pixels, from the corner
//!            │        │        │   │
//!            ├────────┼────────┼───┤
//!            │    ████│████    │   │   █ a region
//!            └────────┴────────┴───┘
//! ```
//!
//! A region is drawn tile by tile. Each tile is drawn as a whole, so that pixels do not depend on
//! the requested region.

use crate::{
    Cap, Ink, Join, Layer, MILLIMETERS_PER_PIXEL, Page, Pen, PlacedImage, Polyline, to_millimeters,
};
use homog::PixelRect;
use picture::{Channel, Picture};
use tiny_skia::{
    Color, ColorU8, FillRule, IntSize, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap,
    PremultipliedColorU8, Stroke, StrokeDash, Transform,
};

/// The number of points after which a new path starts. Long paths fill slowly, and every short path
/// costs a call.
const MAX_PATH_POINTS: usize = 256;

/// The maximum side length of a picture, the same as in the surface rasterizer.
const MAX_PICTURE_SIDE: u32 = 16_384;

/// The width and height of the tiles in which a picture is drawn.
///
/// tiny-skia rounds coordinates relative to the corner of its pixmap, so pixels depend on their
/// tile. Tiles are counted from the corner of the whole picture, so they do not depend on the
/// region.
const TILE_SIZE: [u32; 2] = [4096, 2048];

/// Converts a picture to a tiny-skia pixmap for drawing. Opaque pictures are not copied;
/// translucent pixels are premultiplied, as pixmaps require.
///
/// Returns `None` if the picture has no pixels.
///
/// ```
/// use page::{picture_to_pixmap, pixmap_to_picture, tiny_skia};
/// use picture::Picture;
///
/// let mut picture: Picture = Picture::default();
/// picture.resize(4, 3);
/// let mut pixmap = picture_to_pixmap(picture).expect("it has pixels");
/// pixmap.fill(tiny_skia::Color::from_rgba8(255, 0, 0, 255));
/// assert_eq!(pixmap_to_picture(&pixmap).pixel(3, 2), Some([255, 0, 0, 255]));
/// ```
#[must_use]
pub fn picture_to_pixmap(picture: Picture) -> Option<Pixmap> {
    let size = IntSize::from_wh(picture.width, picture.height)?;
    let mut pixels = picture.pixels;
    for pixel in pixels.iter_mut().filter(|pixel| pixel[3] != 255) {
        let [r, g, b, alpha] = *pixel;
        let color = ColorU8::from_rgba(r, g, b, alpha).premultiply();
        *pixel = [color.red(), color.green(), color.blue(), alpha];
    }
    Pixmap::from_vec(pixels.into_flattened(), size)
}

/// Converts a tiny-skia pixmap to a picture. The colors of translucent pixels are divided by alpha
/// and rounded.
#[must_use]
pub fn pixmap_to_picture(pixmap: &Pixmap) -> Picture {
    let (width, height) = (pixmap.width(), pixmap.height());
    let straight = |color: &PremultipliedColorU8| {
        let color = color.demultiply();
        [color.red(), color.green(), color.blue(), color.alpha()]
    };
    Picture { width, height, pixels: pixmap.pixels().iter().map(straight).collect() }
}

impl<W> Page<W> {
    /// Renders the page, stretched to a picture of the given size in pixels. The background is
    /// transparent if the page has no paper. For a resolution in dots per inch, multiply each side
    /// of the page in millimeters by the resolution and divide by 25.4.
    ///
    /// Returns `None` if the picture would have no pixels or a side longer than 16,384.
    #[must_use]
    pub fn to_picture(&self, width: u32, height: u32) -> Option<Picture> {
        let whole = PixelRect::from_size(width, height);
        let has_pixels = |side| (1..=MAX_PICTURE_SIDE).contains(&side);
        (has_pixels(width) && has_pixels(height))
            .then(|| self.to_picture_region([width, height], whole))
    }

    /// Renders a region of a picture of `size` pixels.
    #[must_use]
    pub fn to_picture_region<C: Channel>(&self, size: [u32; 2], region: PixelRect) -> Picture<C> {
        let [width, height] = size.map(f64::from);
        let mut picture = Picture::default();
        picture.resize(region.width, region.height);
        let [r, g, b] = self.paper.unwrap_or_default();
        let alpha = if self.paper.is_some() { 255 } else { 0 };
        picture.pixels.fill([r, g, b, alpha].map(C::from_byte));
        let scale = [width / self.size.x, height / self.size.y];
        RegionCanvas { picture: &mut picture, region }.draw_tiles(
            size,
            &self.images,
            &self.layers,
            scale,
        );
        picture
    }
}

/// Draws layers of a page at 96 pixels per inch over a region of a picture of `size` pixels.
pub fn draw_layers_over<C: Channel>(
    picture: &mut Picture<C>,
    size: [u32; 2],
    region: PixelRect,
    layers: &[Layer],
) {
    RegionCanvas { picture, region }.draw_tiles(
        size,
        &[],
        layers,
        [1.0 / MILLIMETERS_PER_PIXEL; 2],
    );
}

/// A region of a picture to draw on.
struct RegionCanvas<'a, C> {
    picture: &'a mut Picture<C>,
    /// The position and size of the region in the whole picture.
    region: PixelRect,
}

impl<C: Channel> RegionCanvas<'_, C> {
    /// Draws images and layers over the region, with `scale` pixels per millimeter in x and y.
    fn draw_tiles(
        &mut self,
        size: [u32; 2],
        pictures: &[PlacedImage],
        layers: &[Layer],
        scale: [f64; 2],
    ) {
        if layers.is_empty() && pictures.is_empty() {
            return;
        }
        let region = self.region;
        let first = [region.x / TILE_SIZE[0], region.y / TILE_SIZE[1]];
        let last = [region.x + region.width - 1, region.y + region.height - 1];
        let last = [last[0] / TILE_SIZE[0], last[1] / TILE_SIZE[1]];
        for row in first[1]..=last[1] {
            for column in first[0]..=last[0] {
                let (x, y) = (column * TILE_SIZE[0], row * TILE_SIZE[1]);
                let width = TILE_SIZE[0].min(size[0] - x);
                let height = TILE_SIZE[1].min(size[1] - y);
                let tile = PixelRect { x, y, width, height };
                self.draw_tile(tile, |canvas| {
                    pictures.iter().for_each(|pasted| canvas.draw_image(pasted, scale));
                    layers.iter().for_each(|layer| canvas.draw_layer(layer, scale));
                });
            }
        }
    }

    /// Draws on the part of the region that is in one tile.
    ///
    /// The whole tile is drawn, even outside the region, because lines are clipped at the borders
    /// of the tile. Clipping them elsewhere could round them to other pixels.
    fn draw_tile(&mut self, tile: PixelRect, draw: impl FnOnce(&mut Canvas)) {
        let Some(shown) = tile.intersection(self.region) else { return };
        let Some(pixmap) = Pixmap::new(tile.width, tile.height) else { return };
        let mut canvas = Canvas { pixmap, corner: [tile.x, tile.y] };
        self.for_each_shared_pixel(shown, &mut canvas, |pixel, canvas_pixel| {
            *canvas_pixel = C::to_canvas(*pixel);
        });
        draw(&mut canvas);
        self.for_each_shared_pixel(shown, &mut canvas, |pixel, canvas_pixel| {
            *pixel = C::from_canvas(*pixel, *canvas_pixel);
        });
    }

    /// Calls `each` with each pair of pixels shared by the region and a canvas, row by row.
    fn for_each_shared_pixel(
        &mut self,
        shown: PixelRect,
        canvas: &mut Canvas,
        each: impl Fn(&mut [C; 4], &mut PremultipliedColorU8),
    ) {
        let region = self.region;
        let (across, width) = (region.width as usize, canvas.pixmap.width() as usize);
        let within = |from: [u32; 2]| [(shown.x - from[0]) as usize, (shown.y - from[1]) as usize];
        let ([left, top], [first, skipped]) = (within([region.x, region.y]), within(canvas.corner));
        let (count, high) = (shown.width as usize, shown.height as usize);
        let rows = self.picture.pixels.chunks_exact_mut(across).skip(top).take(high);
        let canvas_pixels = canvas.pixmap.pixels_mut().chunks_exact_mut(width).skip(skipped);
        for (row, canvas_pixels) in rows.zip(canvas_pixels) {
            let canvas_pixels = &mut canvas_pixels[first..first + count];
            for (pixel, canvas_pixel) in row[left..left + count].iter_mut().zip(canvas_pixels) {
                each(pixel, canvas_pixel);
            }
        }
    }
}

/// Converts pixels to and from the 8-bit canvas.
///
/// Drawing works directly on 8-bit pixels. 16-bit pixels would lose precision, so they keep their
/// values and the drawing is composited over them.
trait CanvasChannel: Channel {
    /// Returns the canvas pixel to draw on.
    fn to_canvas(pixel: [Self; 4]) -> PremultipliedColorU8;
    /// Returns the picture pixel with the drawing on it.
    fn from_canvas(pixel: [Self; 4], canvas_pixel: PremultipliedColorU8) -> [Self; 4];
}

impl<C: Channel> CanvasChannel for C {
    fn to_canvas(pixel: [C; 4]) -> PremultipliedColorU8 {
        if C::BITS > 8 {
            return PremultipliedColorU8::TRANSPARENT;
        }
        let [r, g, b, alpha] = pixel.map(C::to_byte);
        ColorU8::from_rgba(r, g, b, alpha).premultiply()
    }

    fn from_canvas(pixel: [C; 4], canvas_pixel: PremultipliedColorU8) -> [C; 4] {
        if C::BITS > 8 {
            let over = [
                canvas_pixel.red(),
                canvas_pixel.green(),
                canvas_pixel.blue(),
                canvas_pixel.alpha(),
            ];
            return C::composite_under(pixel, over);
        }
        let straight = canvas_pixel.demultiply();
        [straight.red(), straight.green(), straight.blue(), straight.alpha()].map(C::from_byte)
    }
}

/// One tile as a pixmap.
struct Canvas {
    pixmap: Pixmap,
    /// The position of the tile's upper left corner in the picture.
    corner: [u32; 2],
}

impl Canvas {
    /// Draws the strokes and fills of a layer.
    ///
    /// Continuous strokes share paths. Each dashed stroke needs its own path and pattern.
    fn draw_layer(&mut self, layer: &Layer, scale: [f64; 2]) {
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(skia_color(layer.pen.ink));
        let pixels = 0.5 * (scale[0] + scale[1]);
        let whole = skia_stroke(&layer.pen, &[], pixels);
        for group in &layer.groups {
            let (dashed, lines): (Vec<_>, Vec<_>) = group
                .strokes
                .iter()
                .map(|line| (line, layer.pen.fitted_dashes(line)))
                .partition(|(_, dashes)| !dashes.is_empty());
            let (corner, lines) = (self.corner, lines.into_iter().map(|(line, _)| line));
            for path in skia_paths(lines, scale, corner, MAX_PATH_POINTS) {
                self.pixmap.stroke_path(&path, &paint, &whole, Transform::identity(), None);
            }
            for (line, dashes) in dashed {
                let stroke = skia_stroke(&layer.pen, &dashes, pixels);
                for path in skia_paths([line], scale, corner, MAX_PATH_POINTS) {
                    self.pixmap.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
                }
            }
            // The even-odd rule applies within a path, so holes must share the path of their
            // outline.
            for path in skia_paths(&group.fills, scale, self.corner, usize::MAX) {
                let rule = FillRule::EvenOdd;
                self.pixmap.fill_path(&path, &paint, rule, Transform::identity(), None);
            }
        }
    }

    /// Draws an image under all lines: each pixel is the mean of the area it covers (box filter).
    ///
    /// ```text
    ///   canvas pixel ─► image columns [from, to) as real numbers, clamped to the image
    /// ```
    ///
    /// The mean is weighted by area and alpha and composited over the canvas, so the edges of the
    /// image are anti-aliased.
    fn draw_image(&mut self, pasted: &PlacedImage, scale: [f64; 2]) {
        let PlacedImage { corner, size, picture, .. } = pasted;
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        let first = self.corner;
        let span = |axis: usize, side: u32, sides: u32| {
            // Image pixels per canvas pixel, and the position of the canvas in the image.
            let pixels = f64::from(side) / (f64::from(size[axis]) / 1000.0 * scale[axis]);
            let start = -f64::from(corner[axis]) / 1000.0 * scale[axis] * pixels;
            (first[axis]..first[axis] + sides).map(move |at| {
                let from = start + f64::from(at) * pixels;
                [from, from + pixels].map(|edge| edge.clamp(0.0, f64::from(side)))
            })
        };
        let columns: Vec<[f64; 2]> = span(0, picture.width, width).collect();
        let rows = span(1, picture.height, height);
        let canvas_pixels = self.pixmap.pixels_mut().chunks_exact_mut(width as usize);
        for (row, canvas_pixels) in rows.zip(canvas_pixels) {
            for (column, canvas_pixel) in columns.iter().zip(canvas_pixels) {
                let below = canvas_pixel.demultiply();
                let below = [below.red(), below.green(), below.blue(), below.alpha()];
                let [r, g, b, alpha] = composite_over(area_mean(picture, *column, row), below);
                *canvas_pixel = ColorU8::from_rgba(r, g, b, alpha).premultiply();
            }
        }
    }
}

/// Converts an ink to an opaque tiny-skia color.
fn skia_color([r, g, b]: Ink) -> Color {
    Color::from_rgba8(r, g, b, 255)
}

/// Converts a pen to a tiny-skia stroke, with lengths in pixels.
fn skia_stroke(pen: &Pen, dashes: &[f64], scale: f64) -> Stroke {
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
        // `None` for an empty pattern, which means a continuous stroke.
        dash: StrokeDash::new(dashes, 0.0),
    }
}

/// Returns the mean of an area of a picture as premultiplied red, green and blue, and alpha, each
/// from 0 to 255. The outside of the picture is transparent.
///
/// Each image pixel is weighted by the area it shares with the rectangle. Colors are also weighted
/// by alpha, so that the color of transparent pixels does not bleed into the edges.
fn area_mean(picture: &Picture, columns: [f64; 2], rows: [f64; 2]) -> [f64; 4] {
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
            let weight = width * height / area;
            let alpha = f64::from(alpha) * weight;
            let color = [r, g, b].map(|channel| f64::from(channel) * alpha / 255.0);
            let part = [color[0], color[1], color[2], alpha];
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
    }
    sum
}

/// Composites a premultiplied color over a straight color and returns a straight color (Porter–Duff
/// *over*).
///
/// ```text
///   α = αₐ + α_b (1 − αₐ)        c = (cₐ + c_b α_b (1 − αₐ)) / α
/// ```
fn composite_over([r, g, b, alpha]: [f64; 4], below: [u8; 4]) -> [u8; 4] {
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

/// Converts lines to paths of about `most` points, in canvas pixels.
///
/// The corner of the tile is subtracted in f64 before coordinates are rounded to the f32 of
/// tiny-skia, because far from the origin of a large picture f32 has no subpixel bits left.
fn skia_paths<'a>(
    lines: impl IntoIterator<Item = &'a Polyline>,
    scale: [f64; 2],
    corner: [u32; 2],
    most: usize,
) -> Vec<Path> {
    let mut paths = Vec::new();
    let mut path = PathBuilder::new();
    for line in lines {
        if path.len() >= most {
            paths.extend(std::mem::take(&mut path).finish());
        }
        for (at, point) in line.points.iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| {
                (to_millimeters(*point)[axis] * scale[axis] - f64::from(corner[axis])) as f32
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
