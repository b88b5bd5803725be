//! A railroad in perspective: parallel rails meet, and the ties crowd together toward the horizon.
//!
//! Run it with `cargo run -p alberti-homog --example railway`.
#![allow(clippy::print_stdout, reason = "the example prints its results")]

use homog::{Clip, Foreshortening, HPoint, Point, Projective, Vector, View};

fn main() {
    // The eye is at the origin, 1.5 above the rails, looking along −z; w = −z is the distance in
    // front of it. Depth runs from +1 at distance 2 to −1 at distance 32.
    let view_to_clip = Projective::<View, Clip>::from_rows([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 17.0 / 15.0, 64.0 / 15.0],
        [0.0, 0.0, -1.0, 0.0],
    ]);
    println!("The map, {}:\n{}\n", view_to_clip.classify(), view_to_clip.display());

    let rail = |x: f64, distance: f64| Point::<View>::new(x, -1.5, -distance);
    println!("Ties, each twice as far away as the one before:");
    for distance in [2.0, 4.0, 8.0, 16.0, 32.0] {
        let ends = [rail(-0.75, distance), rail(0.75, distance)];
        let [left, right] = ends.map(|end| view_to_clip.transform_point(end).divide());
        if let (Some(left), Some(right)) = (left, right) {
            println!("  {distance:>2} ahead: from {left:.3} to {right:.3}");
        }
    }

    let meeting = view_to_clip.vanishing_point(-Vector::Z, 0.0);
    println!(
        "\nThe rails meet at {meeting:.3}. The ties are perpendicular to the gaze and never meet:"
    );
    println!("  their vanishing point is {}", view_to_clip.vanishing_point(Vector::X, 0.0));

    let [near, far]: [HPoint<Clip>; 2] =
        [2.0, 32.0].map(|d| view_to_clip.transform_point(rail(0.75, d)));
    match Foreshortening::from_endpoints(near, far) {
        Ok(f) => println!(
            "\nThe midpoint of the rail appears at fraction {:.3} of its image.",
            f.image_parameter(0.5).unwrap_or(0.5)
        ),
        Err(torn) => println!("\n{torn}"),
    }
}
