//! Exercises from the chapter and misprints in the sources that concern viewports: the printed form
//! fails, and the correct form passes.

use glam::{DMat3, DMat4, DVec2, DVec4};
use homog::{
    Affine, ClipRange, HPoint2, Homography, Ndc, PixelConvention, Point, Projective, Vector, View,
};
use viewport::{
    DepthRange, Limits, PointGrid, Rectangle, Viewport, ViewportError, WindowToViewport,
};

fn rows(rows: [[f64; 4]; 4]) -> DMat4 {
    DMat4::from_cols_array_2d(&rows).transpose()
}

/// Returns the chapter's M_orth (OR-1).
fn orthographic([l, r]: [f64; 2], [b, t]: [f64; 2], [n, f]: [f64; 2]) -> Affine<View, Ndc> {
    let axis = |low: f64, high: f64| (2.0 / (high - low), -(high + low) / (high - low));
    let ((sx, dx), (sy, dy), (sz, dz)) = (axis(l, r), axis(b, t), axis(f, n));
    let (x, y, z) = (Vector::X * sx, Vector::Y * sy, Vector::Z * sz);
    Affine::from_frame(x, y, z, Point::new(dx, dy, dz))
}

/// C38, VP-2: the matrix for pixels that are counted from the top row.
#[test]
fn exercise_1_y_counts_from_the_top() {
    let image = Viewport::chapter(640, 480).expect("has pixels");
    let down = image.with_convention(PixelConvention::CHAPTER_Y_DOWN).ndc_to_screen();
    let expected = rows([
        [320.0, 0.0, 0.0, 319.5],
        [0.0, -240.0, 0.0, 239.5],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]);
    assert_eq!(down.raw(), expected);
    assert_eq!(down.transform_point(Point::new(0.0, 1.0, 0.0)).y(), -0.5);
    assert_eq!(down.transform_point(Point::new(0.0, -1.0, 0.0)).y(), 479.5);
}

/// C39: an orthographic projection followed by a viewport is a single windowing map from the view
/// volume to the image.
#[test]
fn exercise_2_viewport_and_box_make_one_windowing() {
    let (nx, ny) = (640.0, 480.0);
    let ([l, r], [b, t], [n, f]) = ([-2.0, 4.0], [-1.0, 2.0], [-1.0, -5.0]);
    let image = Viewport::chapter(640, 480).expect("has pixels");
    let product = orthographic([l, r], [b, t], [n, f]).then(image.ndc_to_screen());
    let expected = rows([
        [nx / (r - l), 0.0, 0.0, -0.5 - l * nx / (r - l)],
        [0.0, ny / (t - b), 0.0, -0.5 - b * ny / (t - b)],
        [0.0, 0.0, 2.0 / (n - f), -(n + f) / (n - f)],
        [0.0, 0.0, 0.0, 1.0],
    ]);
    assert!(product.raw().abs_diff_eq(expected, 1e-12), "{}", product.raw());
}

/// M18, WV-2: with +yw min in the first translation, the lower border of the window does not map to
/// the lower border of the viewport.
#[test]
fn misprint_m18_both_signs_of_the_first_translation_are_negative() {
    let window = Limits { x: [-1.0, 3.0], y: [2.0, 4.0] };
    let map =
        WindowToViewport::new(window, Limits { x: [0.0, 8.0], y: [0.0, 4.0] }).expect("not empty");
    let corner = HPoint2::from_xy(-1.0, 2.0);
    assert_eq!(map.homography().transform_point(corner).divide(), Some([0.0, 0.0]));
    let [_, scale, to_place] = map.factor_chain();
    let printed = Homography::from_raw(DMat3::from_translation(DVec2::new(1.0, 2.0)));
    assert_ne!(
        printed.then(scale).then(to_place).transform_point(corner).divide(),
        Some([0.0, 0.0])
    );
}

/// M21: gluOrtho2D has four parameters, the limits of a window; glOrtho has six, the limits of a
/// box. Changing near and far from −1 and 1 to other values changes only the depth.
#[test]
fn misprint_m21_four_borders_make_a_window_and_six_a_box() {
    let flat = orthographic([-2.0, 4.0], [-1.0, 2.0], [1.0, -1.0]);
    let deep = orthographic([-2.0, 4.0], [-1.0, 2.0], [-1.0, -5.0]);
    let p = Point::new(0.5, 0.75, -2.0);
    assert_eq!(
        (flat.transform_point(p).x(), flat.transform_point(p).y()),
        (deep.transform_point(p).x(), deep.transform_point(p).y())
    );
    assert_eq!(flat.transform_point(p).z(), p.z());
    assert_ne!(deep.transform_point(p).z(), p.z());
}

/// M22, C100, DP-1: (1 − Z)/2 maps the chapter's near plane (+1) to 0. It maps OpenGL's near plane
/// (−1) to 1, so (1 + Z)/2 is correct there.
#[test]
fn misprint_m22_the_depth_formula_depends_on_the_near_plane() {
    let (chapter_near, opengl_near) = (1.0, -1.0);
    assert_eq!(DepthRange::ZERO_ONE_FLIPPED.ndc_to_depth(chapter_near), 0.0);
    assert_eq!(
        DepthRange::ZERO_ONE_FLIPPED.ndc_to_depth(opengl_near),
        1.0,
        "near and far are swapped"
    );
    assert_eq!(DepthRange::ZERO_ONE.ndc_to_depth(opengl_near), 0.0);
    let negate = DepthRange::NEGATED.ndc_to_depth(chapter_near);
    assert_eq!(
        DepthRange::ZERO_ONE.ndc_to_depth(negate),
        DepthRange::ZERO_ONE_FLIPPED.ndc_to_depth(chapter_near)
    );
}

/// M23, C98, WV-4: the row index is divided by rows − 1 and the column index by columns − 1. The
/// last index is one less than the count.
#[test]
fn misprint_m23_row_and_column_counts_are_not_swapped() {
    let (rows, columns) = (3, 5);
    let grid = PointGrid::new(rows, columns).expect("at least two");
    assert_eq!(grid.xz(rows - 1, columns - 1), Some([1.0, 1.0]));
    assert_eq!(grid.xz(rows, columns), None);
    let crosswise = 2.0 * (rows - 1) as f64 / (columns - 1) as f64 - 1.0;
    assert_ne!(crosswise, 1.0);
    assert_eq!(grid.points().count(), rows * columns);
    assert_eq!(grid.points().nth(columns), grid.xz(1, 0));
}

/// C99: two viewports on one image, each with its own origin and size.
#[test]
fn several_viewports_on_one_image() {
    let page = Rectangle::from_size(800.0, 300.0).expect("a page");
    let cells: Vec<Rectangle> = page.split_grid(2, 1, 0.0).expect("room").collect();
    let right_edge = |area| {
        let view =
            Viewport::new(area, PixelConvention::OPENGL, ClipRange::OPENGL, DepthRange::ZERO_ONE);
        view.ndc_to_screen().transform_point(Point::new(1.0, -1.0, -1.0))
    };
    assert_eq!(
        cells.into_iter().map(right_edge).collect::<Vec<_>>(),
        [Point::new(400.0, 0.0, 0.0), Point::new(800.0, 0.0, 0.0)]
    );
}

/// A parallel projection has its center at infinity: all rays start on the near plane and have the
/// same direction.
#[test]
fn rays_of_a_parallel_projection_are_parallel() {
    let to_ndc = orthographic([-2.0, 4.0], [-1.0, 2.0], [-1.0, -5.0]).raw();
    let clip_to_view = Projective::from_raw(to_ndc).inverse().expect("regular");
    let back = Viewport::image_for(640, 480, ClipRange::CHAPTER)
        .expect("has pixels")
        .unprojector::<View>(clip_to_view);
    assert_eq!(back.center_of_projection().w(), 0.0);
    for pixel in [[0.0, 0.0], [320.0, 240.0], [640.0, 480.0]] {
        let pick = back.pick_ray(pixel).expect("a ray exists");
        assert_eq!(pick.ray.direction, -Vector::Z);
        assert_eq!(pick.ray.origin, pick.near);
        assert_eq!(pick.near.z(), -1.0);
    }
}

/// If the far plane is at infinity, the far point is a direction, and the ray still exists.
#[test]
fn rays_reach_to_infinity() {
    // The reversed infinite projection (IF-3): depth 1 at the near plane, 0 at infinity.
    let raw = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::NEG_W, DVec4::new(0.0, 0.0, 0.5, 0.0));
    let back = Viewport::new(
        Rectangle::from_size(100.0, 100.0).expect("positive"),
        PixelConvention::IMAGE,
        ClipRange::ZERO_ONE.reversed(),
        DepthRange::KEEP,
    )
    .unprojector::<View>(Projective::from_raw(raw).inverse().expect("regular"));
    let pick = back.pick_ray([50.0, 50.0]).expect("a ray exists");
    assert_eq!(pick.far.w(), 0.0);
    let expected = (-Vector::Z, Point::ORIGIN, -0.5);
    assert_eq!((pick.ray.direction, pick.ray.origin, pick.near.z()), expected);
    assert_eq!(back.pick_ray([f64::NAN, 0.0]), None);
    assert_eq!(back.pick_ray([0.0, f64::INFINITY]), None);
}

#[test]
fn invalid_sizes_are_rejected_by_name() {
    let message = |error: ViewportError| error.to_string();
    assert_eq!(
        Viewport::chapter(0, 5).map_err(message).unwrap_err(),
        "nx = 0 is not allowed: it must be greater than 0"
    );
    assert!(matches!(
        Rectangle::new(0.0, 0.0, f64::NAN, 1.0),
        Err(ViewportError::NotFinite { .. })
    ));
    assert!(matches!(
        Rectangle::new(0.0, f64::INFINITY, 1.0, 1.0),
        Err(ViewportError::NotFinite { .. })
    ));
    assert!(matches!(DepthRange::new([0.5, 0.5], [0.0, 1.0]), Err(ViewportError::Empty { .. })));
    assert!(matches!(
        DepthRange::new([0.0, 1.0], [0.0, f64::NAN]),
        Err(ViewportError::NotFinite { .. })
    ));
    assert!(PixelConvention::IMAGE.convert_to(PixelConvention::CHAPTER, 0.0).is_err());
    let unit = Limits { x: [0.0, 1.0], y: [0.0, 1.0] };
    let flat = Limits { x: [0.0, 1.0], y: [2.0, 2.0] };
    let error = WindowToViewport::new(flat, unit).map_err(message).unwrap_err();
    assert_eq!(error, "window's y is empty: both ends are 2");
    let tiny = Rectangle::from_size(1e-100, 1.0).expect("allowed");
    assert!(matches!(
        Viewport::image_for(4, 4, ClipRange::CHAPTER).expect("has pixels").pick_matrix(tiny),
        Err(ViewportError::NotFinite { .. })
    ));
}
