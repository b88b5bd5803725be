//! Items from the sources that the laws do not cover, each compared with its formula.

use glam::DMat4;
use homog::{ClipRange, Ndc, PixelConvention, Point};
use viewport::{DepthRange, Rectangle, Viewport};

/// VP-1, entry by entry: scale n/2, center (n − 1)/2, z unchanged.
#[test]
fn c6_the_viewport_matrix_keeps_z() {
    let (nx, ny) = (640.0, 480.0);
    let rows = [
        [nx / 2.0, 0.0, 0.0, (nx - 1.0) / 2.0],
        [0.0, ny / 2.0, 0.0, (ny - 1.0) / 2.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let ours = Viewport::chapter(640, 480).expect("has pixels").ndc_to_screen().raw();
    assert_eq!(ours, DMat4::from_cols_array_2d(&rows).transpose());
}

/// The square is nx pixels wide. The centers of the first and the last pixel are at 0 and nx − 1,
/// half a pixel from the image's borders.
#[test]
fn c5_pixels_have_their_centers_at_integers() {
    for nx in [1_u32, 2, 7, 1920] {
        let map = Viewport::chapter(nx, 3).expect("has pixels").ndc_to_screen();
        let x = |ndc: f64| map.transform_point(Point::<Ndc>::new(ndc, 0.0, 0.0)).x();
        let (width, half_a_pixel) = (f64::from(nx), 1.0 / f64::from(nx));
        assert_eq!((x(-1.0), x(1.0)), (-0.5, width - 0.5));
        assert!(x(-1.0 + half_a_pixel).abs() < 1e-12);
        assert!((x(1.0 - half_a_pixel) - (width - 1.0)).abs() < 1e-12);
    }
}

/// A window twice as wide as high is squeezed into the square. An image of the same aspect ratio
/// stretches it back; in any other image, circles become ellipses.
#[test]
fn c59_an_image_of_the_windows_aspect_undoes_the_squeeze() {
    let window = [2.0, 1.0];
    let stretch = |nx: u32, ny: u32| {
        let map =
            Viewport::image_for(nx, ny, ClipRange::CHAPTER).expect("has pixels").ndc_to_screen();
        let at =
            |x: f64, y: f64| map.transform_point(Point::new(x / window[0], y / window[1], 0.0));
        let (right, up) = (at(0.5, 0.0) - at(0.0, 0.0), at(0.0, 0.5) - at(0.0, 0.0));
        right.length() / up.length()
    };
    assert!((stretch(800, 400) - 1.0).abs() < 1e-15);
    assert!((stretch(800, 800) - 0.5).abs() < 1e-15);
}

/// Third-angle projection: the top view is above the front view and the right view is beside it,
/// all at one scale, so edges line up across the views.
#[test]
fn c75_front_top_and_side_line_up_on_a_sheet() {
    let sheet = Rectangle::from_size(900.0, 900.0).expect("a sheet");
    let cells: Vec<Rectangle> = sheet.split_grid(2, 2, 20.0).expect("room").collect();
    let [top, _, front, side] = cells.as_slice() else { panic!("four cells") };
    let drawn = |cell: &Rectangle, x: f64, y: f64| {
        let view =
            Viewport::new(*cell, PixelConvention::IMAGE, ClipRange::CHAPTER, DepthRange::KEEP);
        view.ndc_to_screen().transform_point(Point::<Ndc>::new(x, y, 0.0))
    };
    let (width, height, depth) = (0.4, 0.7, -0.3);
    let front = drawn(front, width, height);
    assert_eq!(drawn(top, width, -depth).x(), front.x(), "top and front do not line up");
    assert_eq!(drawn(side, -depth, height).y(), front.y(), "front and side do not line up");
    assert!(drawn(top, 0.0, 0.0).y() < front.y(), "y must point down in an image");
}
