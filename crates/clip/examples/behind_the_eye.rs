//! Shows why clipping comes before the divide: a rail runs from in front of the camera to behind
//! it.
//!
//! Run it with `cargo run -p alberti-clip --example behind_the_eye`. It prints both ends of the
//! rail in clip space and draws two pictures: one divides immediately, the other clips first.
#![allow(clippy::print_stdout, reason = "the example prints its pictures")]

use clip::{Volume, clip_segment};
use homog::{Clip, HPoint, Ndc, Point, Projective, View};

/// The width and height of the picture in characters.
const WIDTH: usize = 41;
const HEIGHT: usize = 13;

fn main() {
    // The perspective projection of the textbook (Shirley and Marschner, ch. 8) with w > 0 in front
    // of the eye (PE-3): window [−1, 1]², n = −1, f = −9.
    let view_to_clip = Projective::<View, Clip>::from_rows([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.25, 2.25],
        [0.0, 0.0, -1.0, 0.0],
    ]);

    let ahead = view_to_clip.transform_point(Point::new(-1.0, -0.8, -6.0));
    let behind = view_to_clip.transform_point(Point::new(-1.0, -0.8, 3.0));
    println!("the rail in clip space   {}", show(ahead));
    println!("                      to {}\n", show(behind));

    println!("divided without clipping: the rail appears to rise to the right, above the horizon");
    if let (Some(p), Some(q)) = (ahead.divide(), behind.divide()) {
        draw(p, q);
    }
    println!("clipped first: the rail comes toward the viewer and leaves the picture");
    let Some(visible) = clip_segment(ahead, behind, &Volume::CHAPTER) else {
        println!("nothing is visible");
        return;
    };
    if let (Some(p), Some(q)) = (visible.start.divide(), visible.end.divide()) {
        draw(p, q);
    }
    if let Some(plane) = visible.exit {
        println!(
            "it leaves through the {plane} plane, {:.1}% of the way along",
            visible.t1 * 100.0
        );
    }
}

fn show(point: HPoint<Clip>) -> String {
    format!("({:5.2}, {:5.2}, {:5.2}; w = {:5.2})", point.x(), point.y(), point.z(), point.w())
}

/// Draws a segment in the canonical square in characters; parts outside the square are omitted.
fn draw(p: Point<Ndc>, q: Point<Ndc>) {
    let mut picture = vec![vec![' '; WIDTH]; HEIGHT];
    for step in 0..=400 {
        let point = p.lerp(q, f64::from(step) / 400.0);
        let column = (point.x() + 1.0) / 2.0 * WIDTH as f64;
        let row = (1.0 - point.y()) / 2.0 * HEIGHT as f64;
        let on_picture =
            (0.0..WIDTH as f64).contains(&column) && (0.0..HEIGHT as f64).contains(&row);
        if on_picture {
            picture[row as usize][column as usize] = '*';
        }
    }
    println!("+{}+", "-".repeat(WIDTH));
    for row in picture {
        println!("|{}|", row.into_iter().collect::<String>());
    }
    println!("+{}+\n", "-".repeat(WIDTH));
}
