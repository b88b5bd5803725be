//! Tests of each builder in every convention: corners map to corners, inverses undo the map, and
//! conventions can be converted.

use super::samples::{self, convention, conventions, distance, frustum, orthographic, perspective};
use glam::DMat4;
use homog::{Clip, Point, Projective, View};
use projection::{
    Convention, Fov, Frustum, Orthographic, Perspective, ProjectionError, SensorSize,
};
use proptest::prelude::*;

/// Returns the view-space point at (x, y), `distance` in front of the eye.
fn ahead(convention: Convention, x: f64, y: f64, distance: f64) -> Point<View> {
    Point::new(x, y, convention.ahead() * distance)
}

fn assert_maps(map: Projective<View, Clip>, from: Point<View>, to: [f64; 3]) {
    let image = map.transform_point(from);
    assert!(image.w() > 0.0, "{from:?} has w = {}", image.w());
    let ndc = <[f64; 3]>::from(image.divide().expect("w > 0"));
    for (ours, due) in ndc.iter().zip(to) {
        assert!((ours - due).abs() < 1e-9, "{from:?} maps to {ndc:?}, not {to:?}");
    }
}

proptest! {
    #![proptest_config(samples::cases(128))]

    /// C4, C91: tests the near and far corners in every convention.
    #[test]
    fn frustum_corners_map_to_corners_of_the_canonical_volume(
        f in frustum(),
        c in convention(),
    ) {
        let (map, window) = (f.view_to_clip(c), f.window());
        let far = if f.far() == f64::INFINITY { 1e12 * f.near() } else { f.far() };
        for (distance, depth) in [(f.near(), c.near_depth()), (far, c.far_depth())] {
            let k = distance / f.near();
            let low = ahead(c, window.left() * k, window.bottom() * k, distance);
            let high = ahead(c, window.right() * k, window.top() * k, distance);
            assert_maps(map, low, [-1.0, -c.top(), depth]);
            assert_maps(map, high, [1.0, c.top(), depth]);
        }
    }

    /// C4, C7: tests the box between any two planes.
    #[test]
    fn box_corners_map_to_corners_of_the_canonical_volume(
        o in orthographic(),
        c in convention(),
    ) {
        let (map, window) = (o.view_to_clip(c), o.window());
        let low = ahead(c, window.left(), window.bottom(), o.near());
        let high = ahead(c, window.right(), window.top(), o.far());
        assert_maps(map, low, [-1.0, -c.top(), c.near_depth()]);
        assert_maps(map, high, [1.0, c.top(), c.far_depth()]);
    }

    /// IV-1, C8, C26: tests the maps from clip space back to view space.
    #[test]
    fn closed_form_inverses_undo_the_map(
        f in frustum(),
        p in perspective(),
        o in orthographic(),
        c in convention(),
    ) {
        for (map, inverse) in [
            (f.view_to_clip(c), f.clip_to_view(c)),
            (p.view_to_clip(c), p.clip_to_view(c)),
            (o.view_to_clip(c), o.clip_to_view(c)),
        ] {
            let product = map.then(inverse).raw();
            prop_assert!(distance(product, DMat4::IDENTITY) < 1e-9, "{product}");
        }
    }

    /// C30, C100: also tests handedness and the flips of y and z.
    #[test]
    fn any_convention_converts_to_any_other(
        f in frustum(),
        o in orthographic(),
        p in perspective(),
        from in convention(),
    ) {
        for to in conventions() {
            for (here, there) in [
                (f.view_to_clip(from), f.view_to_clip(to)),
                (p.view_to_clip(from), p.view_to_clip(to)),
                (o.view_to_clip(from), o.view_to_clip(to)),
            ] {
                prop_assert!(distance(from.convert(to, here).raw(), there.raw()) < 1e-11);
                let back = to.convert(from, from.convert(to, here));
                prop_assert!(distance(back.raw(), here.raw()) < 1e-11);
            }
        }
    }

    /// C69, C92, M14c: an off-center window is an error, not an empty result.
    #[test]
    fn a_perspective_is_the_frustum_through_its_window(p in perspective(), c in convention()) {
        let through = p.to_frustum();
        prop_assert!(distance(through.view_to_clip(c).raw(), p.view_to_clip(c).raw()) < 1e-13);
        let back = Perspective::try_from(through).expect("centered");
        prop_assert!((back.fov_y() - p.fov_y()).abs() < 1e-12);
        let moved = Frustum::new(-1.0, 2.0, -1.0, 1.0, 1.0, 2.0).expect("valid");
        prop_assert!(Perspective::try_from(moved).is_err());
    }

    /// C33, C60: tests height, width, diagonal and focal length.
    #[test]
    fn every_form_of_the_field_of_view_gives_the_same_lens(
        fov in 0.05..3.0,
        aspect in 0.2..5.0,
    ) {
        let lens = Perspective::new(Fov::Vertical(fov), aspect, 1.0, 10.0).expect("valid");
        let half = lens.half_slopes();
        let film = |size: f64| size * 35.0 * 2.0;
        let same = [
            Fov::Horizontal(lens.fov_x()),
            Fov::Diagonal(lens.fov_diagonal()),
            Fov::FocalLength { focal: 35.0, film: SensorSize::Height(film(half.y)) },
            Fov::FocalLength { focal: 35.0, film: SensorSize::Width(film(half.x)) },
            Fov::FocalLength {
                focal: 35.0,
                film: SensorSize::Diagonal(film(libm::hypot(half.x, half.y))),
            },
        ];
        for way in same {
            let other = Perspective::new(way, aspect, 1.0, 10.0).expect("valid").half_slopes();
            prop_assert!(
                (other.x / half.x - 1.0).abs() < 1e-11 && (other.y / half.y - 1.0).abs() < 1e-11
            );
        }
    }
}

/// C61, C90: tests coinciding edges, wrong signs, and numbers that are not finite.
#[test]
fn invalid_parameters_are_rejected_by_name() {
    let nan = f64::NAN;
    let message = |e: Result<Frustum, ProjectionError>| e.expect_err("bad").to_string();
    assert!(message(Frustum::new(nan, 1.0, 0.0, 1.0, 1.0, 2.0)).contains("`left` is NaN"));
    assert!(message(Frustum::new(1.0, 1.0, 0.0, 1.0, 1.0, 2.0)).contains("`left` and `right`"));
    assert!(message(Frustum::new(0.0, 1.0, 2.0, 2.0, 1.0, 2.0)).contains("`bottom` and `top`"));
    assert!(message(Frustum::new(0.0, 1.0, 0.0, 1.0, 0.0, 2.0)).contains("`near` is 0"));
    assert!(message(Frustum::new(0.0, 1.0, 0.0, 1.0, 2.0, 1.0)).contains("beyond"));
    assert!(message(Frustum::new(0.0, 1.0, 0.0, 1.0, 1.0, nan)).contains("`far` is NaN"));
    assert!(message(Frustum::new(0.0, 1e-300, 0.0, 1.0, 1e300, 2e300)).contains("too extreme"));
    let is_out_of_range = |fov: Fov, aspect: f64| {
        matches!(
            Perspective::new(fov, aspect, 1.0, 2.0),
            Err(ProjectionError::NotFinite { .. } | ProjectionError::OutOfRange { .. })
        )
    };
    for angle in [0.0, -1.0, core::f64::consts::PI, 4.0, nan, f64::INFINITY] {
        assert!(is_out_of_range(Fov::Vertical(angle), 1.0), "{angle}");
        assert!(is_out_of_range(Fov::Diagonal(angle), 1.0), "{angle}");
    }
    for bad in [0.0, -1.0, nan, f64::INFINITY] {
        assert!(is_out_of_range(Fov::Vertical(1.0), bad), "{bad}");
        assert!(is_out_of_range(Fov::equivalent_35mm(bad), 1.0), "{bad}");
    }
    assert!(matches!(
        Orthographic::new(-1.0, 1.0, -1.0, 1.0, 0.0, f64::INFINITY),
        Err(ProjectionError::NotFinite { .. })
    ));
    assert!(matches!(
        Orthographic::new(-1.0, 1.0, -1.0, 1.0, 3.0, 3.0),
        Err(ProjectionError::EmptyDepth { .. })
    ));
    assert!(matches!(
        Convention::OPENGL.with_depths(0.5, 0.5),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(
        Convention::OPENGL.with_depths(nan, 0.5),
        Err(ProjectionError::NotFinite { .. })
    ));
    assert!(matches!(
        Convention::OPENGL.with_depths(0.0, 2.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
}
