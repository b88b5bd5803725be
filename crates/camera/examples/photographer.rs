//! Follows a photographer who walks around a house, keeps all of it in the picture, and finally
//! takes a stereo pair.
//!
//! Run it with `cargo run -p alberti-camera --example photographer`.
#![allow(clippy::print_stdout, reason = "the example prints its results")]

use camera::{FramingError, NamedView, Slopes, StereoRig, frame_parallel, frame_perspective};
use homog::Point;

/// A house: four walls and a ridge, in meters.
const HOUSE: [[f64; 3]; 10] = [
    [-4.0, 0.0, -6.0],
    [4.0, 0.0, -6.0],
    [4.0, 0.0, 6.0],
    [-4.0, 0.0, 6.0],
    [-4.0, 5.0, -6.0],
    [4.0, 5.0, -6.0],
    [4.0, 5.0, 6.0],
    [-4.0, 5.0, 6.0],
    [0.0, 8.0, -6.0],
    [0.0, 8.0, 6.0],
];

fn main() -> Result<(), FramingError> {
    let house = HOUSE.map(Point::from);
    let lens = Slopes::vertical_angle(40_f64.to_radians(), 3.0 / 2.0)?;

    println!(
        "Where to stand so that the house fills the picture with a 5 percent margin on each side:"
    );
    for view in NamedView::ALL {
        let view_projection = frame_perspective(house, view.basis(), lens, 0.05)?;
        let (eye, near, far) =
            (view_projection.camera.eye(), view_projection.near, view_projection.far);
        println!(
            "  {view:<13} {eye:.1}  from {near:.1} to {far:.1} m away, limited by {:?}",
            view_projection.constraint
        );
    }

    println!("\nSheet width at a scale of 1:100, in cm:");
    for view in NamedView::PRINCIPAL {
        let sheet = frame_parallel(house, view.basis(), 1.0, 0.0)?;
        println!("  {view:<13} {:.1}", sheet.right - sheet.left);
    }

    let view_projection = frame_perspective(house, NamedView::ThreeQuarter.basis(), lens, 0.05)?;
    let rig = StereoRig {
        interocular: 0.5,
        zero_parallax: (view_projection.near + view_projection.far) / 2.0,
    };
    let pair =
        rig.off_axis_pair(view_projection.camera, lens.at_distance(view_projection.near)?)?;
    println!("\nA stereo pair with zero parallax in the middle of the house:");
    for (name, eye) in [("left", pair.left), ("right", pair.right)] {
        let window = eye.window;
        println!(
            "  {name:<6} eye {:.2}, window x {:.3} to {:.3}",
            eye.camera.eye(),
            window.left,
            window.right
        );
    }
    Ok(())
}
