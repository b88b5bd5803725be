//! The textbook's exercises and remarks about projections (exercises 2 to 9; C14, C23, C39..C45,
//! C48, C55).

use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Point, Vector, View};
use projection::{Convention, Frustum, Oblique, Orthographic, chapter, third_row};

const L: f64 = -2.0;
const R: f64 = 4.0;
const B: f64 = -1.0;
const T: f64 = 2.0;
const N: f64 = -1.0;
const F: f64 = -5.0;

fn rows(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}

fn close(a: DMat4, b: DMat4) -> bool {
    (a - b).to_cols_array().iter().all(|gap| gap.abs() < 1e-12)
}

#[test]
fn exercise_2_viewport_times_ortho_is_one_windowing_step() {
    let (nx, ny) = (640.0, 480.0);
    let viewport = DMat4::from_cols(
        DVec4::new(nx / 2.0, 0.0, 0.0, 0.0),
        DVec4::new(0.0, ny / 2.0, 0.0, 0.0),
        DVec4::Z,
        DVec4::new((nx - 1.0) / 2.0, (ny - 1.0) / 2.0, 0.0, 1.0),
    );
    let product = viewport * chapter::m_orth(L, R, B, T, N, F).expect("valid").raw();
    let one_step = DMat4::from_cols(
        DVec4::new(nx / (R - L), 0.0, 0.0, 0.0),
        DVec4::new(0.0, ny / (T - B), 0.0, 0.0),
        DVec4::new(0.0, 0.0, 2.0 / (N - F), 0.0),
        DVec4::new(-0.5 - L * nx / (R - L), -0.5 - B * ny / (T - B), -(N + F) / (N - F), 1.0),
    );
    assert!(close(product, one_step));
    assert!((product.w_axis.x - 212.833_333_333_333_34).abs() < 1e-12);
}

#[test]
fn exercise_3_the_third_row_follows_from_two_fixed_planes() {
    let (a, b) = third_row((N, N), (F, F)).expect("two planes");
    assert_eq!((a, b), (N + F, -N * F));
    let p = chapter::p(N, F).expect("valid").raw();
    assert_eq!((p.z_axis.z, p.w_axis.z), (a, b));
}

#[test]
fn exercise_4_depth_order_is_preserved() {
    let p = chapter::p(N, F).expect("valid");
    let z = |z: f64| p.transform_point(Point::new(0.3, -0.2, z)).divide().expect("in front").z();
    let images = [-1.0, -2.0, -3.0, -4.0, -5.0].map(z);
    assert_eq!([images[0], images[4]], [-1.0, -5.0]);
    assert!(images.windows(2).all(|pair| pair[0] > pair[1]), "{images:?}");
    for (&z1, &z2) in [(-1.0, -2.0), (-4.5, -1.1)].iter().map(|(a, b)| (a, b)) {
        let formula = F * N * (z1 - z2) / (z1 * z2);
        assert!((z(z1) - z(z2) - formula).abs() < 1e-14);
    }
}

#[test]
fn exercise_5_affine_maps_commute_with_scaling_the_homogeneous_point() {
    let m = chapter::m_orth(L, R, B, T, N, F).expect("valid");
    let p = HPoint::<View>::new(1.0, -2.0, 3.0, 1.0);
    let (image, image_of_scaled) = (m.raw() * p.raw(), m.raw() * (p.raw() * 4.0));
    assert_eq!(image * 4.0, image_of_scaled);
    assert_eq!(image_of_scaled.w, 4.0);
}

/// C25: tests both forms of the inverse.
#[test]
fn exercise_6_the_inverse_up_to_the_factor_nf() {
    let (p, scaled) =
        (chapter::p(N, F).expect("valid"), chapter::p_inverse_scaled(N, F).expect("valid"));
    assert_eq!(p.then(scaled).raw(), DMat4::from_diagonal(DVec4::splat(N * F)));
    let inverse = chapter::p_inverse(N, F).expect("valid");
    assert!(close(p.then(inverse).raw(), DMat4::IDENTITY));
    let place = Point::new(1.0, 2.0, -3.0);
    let back = p.then(scaled).transform_point(place).divide();
    assert_eq!(back, Some(place), "for a projective map, the factor does not matter");
}

/// C27: M_per = M_orth P.
#[test]
fn exercise_7_m_per_maps_near_corners_to_corners_of_the_cube() {
    let per = chapter::m_per(L, R, B, T, N, F).expect("valid");
    assert_eq!(per.transform_point(Point::new(R, T, N)), HPoint::new(N, N, N, N));
    assert_eq!(per.transform_point(Point::new(R, T, N)).divide(), Some(Point::new(1.0, 1.0, 1.0)));
    assert_eq!(
        per.transform_point(Point::new(L, B, N)).divide(),
        Some(Point::new(-1.0, -1.0, 1.0))
    );
    assert_eq!(per.transform_point(Point::new(0.0, 0.0, F)).divide().map(Point::z), Some(-1.0));
    let product =
        chapter::p(N, F).expect("valid").then(chapter::m_orth(L, R, B, T, N, F).expect("valid"));
    assert!(close(product.raw(), per.raw()));
}

#[test]
fn exercise_8_and_9_n_1_f_2() {
    let p = chapter::p(1.0, 2.0).expect("valid");
    let due =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, 1.0, 0.0]];
    assert_eq!(rows(p.raw()), due);
    for [x, y, z] in [[1.0, 2.0, 4.0], [3.0, -1.0, 0.5], [0.5, 0.25, 2.0]] {
        let image = p.transform_point(Point::new(x, y, z));
        assert_eq!(image, HPoint::new(x, y, 3.0 * z - 2.0, z));
        assert_eq!(image.divide(), Some(Point::new(x / z, y / z, 3.0 - 2.0 / z)));
    }
}

/// C55: x' = −N x/z, y' = −N y/z. M1: the formula must contain the point's y.
#[test]
fn c14_size_is_proportional_to_the_reciprocal_of_the_distance() {
    let p = chapter::p(-1.0, -9.0).expect("valid");
    let height =
        |z: f64| p.transform_point(Point::new(0.0, 3.0, z)).divide().expect("in front").y();
    assert!((height(-2.0) - 1.5).abs() < 1e-15 && (height(-4.0) - 0.75).abs() < 1e-15);
    assert!((height(-6.0) - 0.5).abs() < 1e-15);
}

#[test]
fn c22_and_m3_p_fixes_every_point_of_the_near_plane_but_only_z_on_the_far_plane() {
    let p = chapter::p(N, F).expect("valid");
    let on_near = Point::new(0.7, -0.3, N);
    assert_eq!(p.transform_point(on_near).divide(), Some(on_near));
    let on_far = p.transform_point(Point::new(1.0, 2.0, F)).divide().expect("in front");
    assert!(
        (on_far - Point::new(N / F, 2.0 * N / F, F)).length() < 1e-15,
        "the point moves within its plane"
    );
}

#[test]
fn c23_lines_through_the_eye_become_parallel_to_z() {
    let p = chapter::p(N, F).expect("valid");
    let ray = Vector::<View>::new(0.4, -0.7, -1.0);
    let images = [1.0, 2.0, 4.5]
        .map(|s| p.transform_point(Point::ORIGIN + ray * s).divide().expect("in front"));
    for image in images {
        assert!((image.x() - 0.4).abs() < 1e-15 && (image.y() + 0.7).abs() < 1e-15);
    }
}

#[test]
fn c36_across_the_eye_plane_depth_jumps_between_infinities() {
    let p = chapter::p(N, F).expect("valid");
    let z = |z: f64| p.transform_point(Point::new(0.0, 0.0, z)).divide().map(Point::z);
    assert!(z(-1e-9).expect("in front") > 1e8 && z(1e-9).expect("behind") < -1e8);
    assert_eq!(z(0.0), None);
}

#[test]
fn c48_the_middle_moves_away_from_the_eye() {
    let p = chapter::p(-1.0, -3.0).expect("valid");
    assert_eq!(p.transform_point(Point::new(0.0, 0.0, -2.0)).divide().map(Point::z), Some(-2.5));
}

#[test]
fn c57_the_derivation_reaches_m_opengl_step_by_step() {
    // First project onto the near plane, −N x/z, then map [l, r] to [−1, 1].
    let (l, r, near, far) = (-1.0, 3.0, 2.0, 6.0);
    let frustum = Frustum::new(l, r, -1.0, 1.0, near, far).expect("valid");
    let point = Point::<View>::new(1.3, 0.4, -3.7);
    let on_near = -near * point.x() / point.z();
    let remapped = -1.0 + (on_near - l) * 2.0 / (r - l);
    let ndc =
        frustum.view_to_clip(Convention::OPENGL).transform_point(point).divide().expect("in front");
    assert!((ndc.x() - remapped).abs() < 1e-15);
}

#[test]
fn c69_perspective_from_frustum_and_back() {
    let frustum = Frustum::new(-2.0, 2.0, -1.0, 1.0, 1.0, 10.0).expect("valid");
    let lens = projection::Perspective::try_from(frustum).expect("centered");
    assert_eq!(lens.to_frustum(), frustum);
    assert_eq!(lens.aspect(), 2.0);
}

#[test]
fn c79_length_and_direction_describe_the_same_slant() {
    let by_length = Oblique::new(0.8, 0.6).expect("valid");
    let (a, b, c) = (-0.8 * libm::cos(0.6), -0.8 * libm::sin(0.6), 1.0);
    let by_direction = Oblique::by_direction(Vector::new(a, b, c), 0.0).expect("valid");
    assert!(close(by_length.onto_plane().raw(), by_direction.onto_plane().raw()));
}

/// C87: a shear, a scale and a depth row are enough.
#[test]
fn c88_the_frustum_becomes_a_box_and_order_is_preserved() {
    let frustum = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0).expect("valid");
    let factors = frustum.factors(Convention::OPENGL);
    let sheared = factors.shear.then(factors.scale);
    let corner = sheared.transform_point(Point::new(9.0, 3.0, -6.0));
    assert!((corner - Point::new(6.0, 6.0, -6.0)).length() < 1e-14, "x = y = D");
    assert!(close(factors.view_to_clip().raw(), frustum.view_to_clip(Convention::OPENGL).raw()));
    let unit = frustum.view_to_canonical_frustum(Convention::OPENGL).expect("a far plane");
    assert!(
        (unit.transform_point(Point::new(9.0, 3.0, -6.0)) - Point::new(1.0, 1.0, -1.0)).length()
            < 1e-14
    );
}

#[test]
fn c102_classical_projections_are_singular_but_depth_preserving_ones_are_not() {
    let oblique = Oblique::cabinet(0.5).expect("valid");
    assert_eq!(oblique.onto_plane().inverse(), None);
    let volume = Orthographic::new(-1.0, 1.0, -1.0, 1.0, 0.0, 9.0).expect("valid");
    let computer = oblique.view_to_clip(volume, Convention::OPENGL);
    assert!(computer.inverse().is_some());
    assert_eq!(computer.raw().row(3), DVec4::W, "the matrix is affine");
    let _: Affine<View, Clip> = chapter::m_orth(L, R, B, T, N, F).expect("affine by type");
}
