//! Draws a house in every planar projection of the textbooks, as text.
//!
//! ```text
//! cargo run -p alberti-projection --example gallery
//! ```
//!
//! The program walks the classification tree and draws the edges of a small house in a typical
//! projection for each leaf. Questions to consider: In which pictures do parallel edges stay
//! parallel? Which edges keep their length? How many vanishing points are there?

#![allow(clippy::print_stdout, reason = "the example prints its results")]

use homog::Point;
use projection::{
    Classical, Convention, Orthographic, ProjectionClass, ProjectionError,
    principal_vanishing_points,
};

/// The corners of the house, with x to the right, y up and z toward the viewer. The ridge runs
/// along z.
const CORNERS: [[f64; 3]; 10] = [
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 0.5, 1.0],
    [0.0, 1.3, 1.0],
    [-1.0, 0.5, 1.0],
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 0.5, -1.0],
    [0.0, 1.3, -1.0],
    [-1.0, 0.5, -1.0],
];

const WIDTH: usize = 64;
const HEIGHT: usize = 24;

fn main() -> Result<(), ProjectionError> {
    for class in ProjectionClass::ALL {
        let depth = class.ancestors().count() - 1;
        let Some(example) = class.example() else {
            println!("{:indent$}{}", "", class.name(), indent = 2 * depth);
            continue;
        };
        let count = principal_vanishing_points(example.depth_preserving())?.count();
        println!("{:indent$}{}, {count} vanishing points", "", class.name(), indent = 2 * depth);
        println!("{}", draw(example)?);
    }
    Ok(())
}

/// Draws the picture: maps view space to clip space, divides, and converts to rows and columns.
fn draw(projection: Classical) -> Result<String, ProjectionError> {
    let volume = Orthographic::new(-3.3, 3.3, -2.2, 2.75, -4.0, 4.0)?;
    let view_to_clip = projection.view_to_clip(volume, Convention::CHAPTER)?;
    let screen = CORNERS.map(|corner| {
        let ndc =
            view_to_clip.transform_point(Point::from(corner)).divide().unwrap_or(Point::ORIGIN);
        ((ndc.x() + 1.0) / 2.0 * WIDTH as f64, (1.0 - ndc.y()) / 2.0 * HEIGHT as f64)
    });
    let mut canvas = vec![vec![' '; WIDTH]; HEIGHT];
    for i in 0..5 {
        let next = (i + 1) % 5;
        line(&mut canvas, screen[i + 5], screen[next + 5], '.'); // the back wall
        line(&mut canvas, screen[i], screen[i + 5], 'o'); // along z
        line(&mut canvas, screen[i], screen[next], '#'); // the front wall
    }
    Ok(canvas.into_iter().map(|row| row.into_iter().collect::<String>() + "\n").collect())
}

/// Draws characters along the straight line between two points.
fn line(canvas: &mut [Vec<char>], start: (f64, f64), end: (f64, f64), letter: char) {
    const STEPS: u32 = 200;
    for i in 0..=STEPS {
        let t = f64::from(i) / f64::from(STEPS);
        let (x, y) = (start.0 + (end.0 - start.0) * t, start.1 + (end.1 - start.1) * t);
        let (column, row) = (x.floor() as usize, y.floor() as usize);
        if let Some(place) = canvas.get_mut(row).and_then(|row| row.get_mut(column)) {
            *place = letter;
        }
    }
}
