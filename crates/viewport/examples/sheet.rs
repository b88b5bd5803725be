//! Lays out a drawing sheet: three views of a house to scale on A4, with their viewports in pixels.
//!
//! Run it with `cargo run -p alberti-viewport --example sheet`.
#![allow(clippy::print_stdout, reason = "examples write to standard output")]

use homog::{ClipRange, PixelConvention, Point};
use viewport::{
    DepthRange, DrawingScale, FitPolicy, Paper, Rectangle, Resolution, Viewport, ViewportError,
};

/// The width and height of the house in each view, in millimeters.
const VIEWS: [(&str, [f64; 2]); 3] =
    [("front", [9_000.0, 6_500.0]), ("side", [12_000.0, 6_500.0]), ("top", [9_000.0, 12_000.0])];

fn main() -> Result<(), ViewportError> {
    let print = Resolution::dots_per_inch(150.0)?;
    let sheet = Paper::A4.rotated();
    let cells: Vec<Rectangle> = sheet.to_rectangle().shrink(10.0)?.split_grid(3, 1, 5.0)?.collect();
    println!("A4 landscape, {} by {} mm", sheet.width(), sheet.height());
    if let Some([width, height]) = sheet.pixel_size(print) {
        println!("at 150 dots per inch: {width} by {height} pixels\n");
    }

    // All views get the same scale: the smallest of the scales that fit.
    let fitting = VIEWS.iter().zip(&cells).filter_map(|((_, size), cell)| {
        DrawingScale::largest_standard(*size, [cell.width(), cell.height()])
    });
    let Some(scale) = fitting.min_by(|a, b| a.ratio().total_cmp(&b.ratio())) else {
        println!("the house is too large for the sheet");
        return Ok(());
    };
    println!(
        "scale {scale}: the front, 9 m wide, measures {} mm on paper\n",
        scale.to_paper_length(9_000.0)
    );

    for ((name, size), cell) in VIEWS.iter().zip(cells) {
        // Compute the window that fills the cell at this scale, and its viewport.
        let window = [scale.to_object_length(cell.width()), scale.to_object_length(cell.height())];
        let on_paper = size.map(|length| scale.to_paper_length(length));
        let place = FitPolicy::Contain.place_picture(window, cell, [0.5, 0.5])?;
        let pixels = print.to_pixel_rectangle(place)?.snap_to_pixels()?;
        let view =
            Viewport::new(pixels, PixelConvention::IMAGE, ClipRange::CHAPTER, DepthRange::ZERO_ONE);
        let corner = view.ndc_to_screen().transform_point(Point::new(-1.0, 1.0, 0.0));
        println!(
            "{name:>6}: {:5.1} by {:5.1} mm in a cell of {:5.1} by {:5.1} mm,",
            on_paper[0],
            on_paper[1],
            cell.width(),
            cell.height()
        );
        println!(
            "        window of {:.1} by {:.1} m with its upper left corner at pixel ({}, {})",
            window[0] / 1e3,
            window[1] / 1e3,
            corner.x(),
            corner.y()
        );
    }
    Ok(())
}
