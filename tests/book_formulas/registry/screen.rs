//! Registry entries for viewports, pixel conventions and coverage (VP-1 to VP-4, DP-1, WV-1 to
//! WV-4, RA-1, RA-2).

use super::inputs::{Answer, Inputs, give};
use super::{Entry, Extras};
use homog::{ClipRange, PixelConvention, Point, perspective_weights, remap_interval};
use raster::{SUBPIXELS, ScreenVertex, signed_area};
use std::error::Error;
use viewport::{DepthRange, Limits, PointGrid, Rectangle, Viewport, WindowToViewport};

const SIZE: &str = "n_x n_y";
const WINDOW_X: &str = "x_{wmin} x_{wmax} x_{vmin} x_{vmax}";
const WINDOW: &str = "x_{wmin} x_{wmax} y_{wmin} y_{wmax} x_{vmin} x_{vmax} y_{vmin} y_{vmax}";
const EDGE: &str = "x_0 y_0 x_1 y_1 x y";
const TRIANGLE: &str = "x_0 y_0 x_1 y_1 x_2 y_2";

pub const ENTRIES: &[Entry] = &[
    Entry::new("VP-1", SIZE, |v| give(image(v, PixelConvention::CHAPTER)?.ndc_to_screen())),
    Entry::new("VP-2", SIZE, |v| give(image(v, PixelConvention::CHAPTER_Y_DOWN)?.ndc_to_screen())),
    Entry::new("VP-3", "x_0 y_0 w h d_n d_f", |v| {
        let [x, y, width, height, near, far] = v.numbers()?;
        let depth = DepthRange::new([-1.0, 1.0], [near, far])?;
        let area = Rectangle::new(x, y, width, height)?;
        give(Viewport::new(area, PixelConvention::OPENGL, ClipRange::OPENGL, depth).ndc_to_screen())
    }),
    Entry::new("VP-4", "n_y x y", to_image),
    Entry::new("DP-1.gl", "z", |v| give(DepthRange::ZERO_ONE.ndc_to_depth(v.number("z")?))),
    Entry::new("DP-1.chapter", "z", |v| {
        give(DepthRange::ZERO_ONE_FLIPPED.ndc_to_depth(v.number("z")?))
    }),
    Entry::new("WV-1.ratio", "x_v x_{vmin} x_{vmax}", |v| {
        let [x, low, high] = v.numbers()?;
        give(remap_interval(x, [low, high], [0.0, 1.0])?)
    }),
    Entry::new("WV-2", WINDOW, |v| give(window_map(v)?.homography())).with_extras(|v| -> Extras {
        let [s_x, s_y] = window_map(v)?.scale_factors();
        Ok(vec![("s_x", s_x.into()), ("s_y", s_y.into())])
    }),
    Entry::new("WV-2.s_x", WINDOW_X, |v| give(across_x(v)?.scale_factors()[0])),
    Entry::new("WV-3", "x_s n_x", |v| back_x(v, PixelConvention::CHAPTER)),
    Entry::new("WV-3.half", "x_s n_x", |v| back_x(v, PixelConvention::OPENGL)),
    Entry::new("WV-4.x", "i rows", |v| {
        let [i, rows] = v.numbers()?;
        let grid = PointGrid::new(pixels(rows)? as usize, 2)?;
        give(grid.xz(pixels(i)? as usize, 0).ok_or("i is beyond the last row")?[0])
    }),
    Entry::new("WV-4.z", "j cols", |v| {
        let [j, columns] = v.numbers()?;
        let grid = PointGrid::new(2, pixels(columns)? as usize)?;
        give(grid.xz(0, pixels(j)? as usize).ok_or("j is beyond the last column")?[1])
    }),
    Entry::new("RA-1.edge", EDGE, edge),
    // The rasterizer stores weights as f32; the exact weights are ratios of areas.
    Entry::new("RA-1.weight", "x_0 y_0 x_1 y_1 x_2 y_2 x y", |v| {
        give(edges(v)?.map(|edge| edge / corners(v).map_or(f64::NAN, area)))
    })
    .with_extras(|v| -> Extras {
        let [a, b, c] = edges(v)?;
        Ok(vec![("E_0", a.into()), ("E_1", b.into()), ("E_2", c.into())])
    }),
    // z/w by interpolation in clip space, where z and w are linear.
    Entry::new("RA-2.depth", "\\lambda_0 \\lambda_1 \\lambda_2 z_0 z_1 z_2", |v| {
        let (image_weights, z) =
            (v.these("\\lambda_0 \\lambda_1 \\lambda_2")?, v.these::<3>("z_0 z_1 z_2")?);
        let w = [2.0, 3.0, 5.0];
        let weights = perspective_weights(image_weights, w).ok_or("no weights")?;
        let sum = |value: fn(f64, f64) -> f64| -> f64 {
            (0..3).map(|k| weights[k] * value(z[k], w[k])).sum()
        };
        give(sum(|z, w| z * w) / sum(|_, w| w))
    }),
];

/// Converts a number to a count of pixels or rows.
pub fn pixels(number: f64) -> Result<u32, String> {
    let whole = (0..=16384).find(|&whole: &u32| f64::from(whole) == number);
    whole.ok_or_else(|| format!("{number} is not a valid number of pixels"))
}

fn image(v: &Inputs<'_>, convention: PixelConvention) -> Result<Viewport, Box<dyn Error>> {
    let [n_x, n_y] = v.these(SIZE)?;
    sized(n_x, n_y, convention)
}

fn sized(n_x: f64, n_y: f64, convention: PixelConvention) -> Result<Viewport, Box<dyn Error>> {
    Ok(Viewport::chapter(pixels(n_x)?, pixels(n_y)?)?.with_convention(convention))
}

fn back_x(v: &Inputs<'_>, convention: PixelConvention) -> Answer {
    let [x, n_x] = v.numbers()?;
    give(sized(n_x, 1.0, convention)?.screen_to_ndc().transform_point(Point::new(x, 0.0, 0.0)).x())
}

fn to_image(v: &Inputs<'_>) -> Answer {
    let [n_y, x, y] = v.numbers()?;
    let map = PixelConvention::CHAPTER.convert_to(PixelConvention::IMAGE, n_y)?;
    let place = map.transform_point(Point::new(x, y, 0.0));
    give([place.x(), place.y()])
}

fn window_map(v: &Inputs<'_>) -> Result<WindowToViewport, Box<dyn Error>> {
    let [x0, x1, y0, y1, to_x0, to_x1, to_y0, to_y1] = v.these(WINDOW)?;
    let window = Limits { x: [x0, x1], y: [y0, y1] };
    Ok(WindowToViewport::new(window, Limits { x: [to_x0, to_x1], y: [to_y0, to_y1] })?)
}

fn across_x(v: &Inputs<'_>) -> Result<WindowToViewport, Box<dyn Error>> {
    let ([x0, x1, to_x0, to_x1], y) = (v.these(WINDOW_X)?, [0.0, 1.0]);
    Ok(WindowToViewport::new(Limits { x: [x0, x1], y }, Limits { x: [to_x0, to_x1], y })?)
}

fn vertex(x: f64, y: f64) -> Result<ScreenVertex, String> {
    let snapped = ScreenVertex::snap(Point::new(x, y, 0.5), 1.0);
    let is_same = |vertex: &ScreenVertex| {
        let steps = f64::from(SUBPIXELS);
        f64::from(vertex.x()) / steps == x && f64::from(vertex.y()) / steps == y
    };
    snapped
        .filter(is_same)
        .ok_or_else(|| format!("({x}, {y}) is not on the grid of 1/{SUBPIXELS} pixel"))
}

/// Returns twice the signed area of a triangle, in square pixels.
fn area(triangle: [ScreenVertex; 3]) -> f64 {
    let steps = f64::from(SUBPIXELS);
    signed_area(triangle) as f64 / (steps * steps)
}

fn edge(v: &Inputs<'_>) -> Answer {
    let [x_0, y_0, x_1, y_1, x, y] = v.numbers()?;
    give(area([vertex(x_0, y_0)?, vertex(x_1, y_1)?, vertex(x, y)?]))
}

fn corners(v: &Inputs<'_>) -> Result<[ScreenVertex; 3], Box<dyn Error>> {
    let [x_0, y_0, x_1, y_1, x_2, y_2] = v.these(TRIANGLE)?;
    Ok([vertex(x_0, y_0)?, vertex(x_1, y_1)?, vertex(x_2, y_2)?])
}

/// Returns the edge functions at (x, y), each for the edge opposite its vertex.
fn edges(v: &Inputs<'_>) -> Result<[f64; 3], Box<dyn Error>> {
    let ([a, b, c], [x, y]) = (corners(v)?, v.these("x y")?);
    let sample = vertex(x, y)?;
    Ok([area([b, c, sample]), area([c, a, sample]), area([a, b, sample])])
}
