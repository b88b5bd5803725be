//! Misprints of projection matrices: the printed form fails, the correct form passes, and
//! recognition identifies both.

use super::samples::{self, convention, distance, frustum, orthographic, perspective};
use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, View, World};
use projection::{
    ApexMovedFrustum, Axonometric, Convention, DepthCurve, Fov, Frustum, NPoint, Oblique,
    Orthographic, Perspective, ProjectionError, Window, api, chapter, principal_vanishing_points,
};
use proptest::prelude::*;
use recognition::{IntendedProjection, Misprint, SuspicionStrength, misprint_of, recognize};

const LEFT: f64 = -1.0;
const RIGHT: f64 = 3.0;
const BOTTOM: f64 = -2.0;
const TOP: f64 = 1.0;
const NEAR: f64 = 2.0;
const FAR: f64 = 6.0;

fn wanted_frustum() -> IntendedProjection {
    IntendedProjection::Frustum(Frustum::new(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR).expect("valid"))
}

fn wanted_box() -> IntendedProjection {
    IntendedProjection::Orthographic(
        Orthographic::new(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR).expect("valid"),
    )
}

fn lens(fovy: f64) -> IntendedProjection {
    IntendedProjection::Perspective(
        Perspective::new(Fov::Vertical(fovy), 2.0, NEAR, FAR).expect("valid"),
    )
}

/// Returns the image of a view-space point.
fn image(matrix: DMat4, x: f64, y: f64, z: f64) -> Option<Point<Ndc>> {
    Projective::<View, Clip>::from_raw(matrix).transform_point(Point::new(x, y, z)).divide()
}

/// Whether the two corners that define the volume map to opposite corners of the cube.
fn fits(matrix: DMat4, far_scale: f64) -> bool {
    let ends =
        [(LEFT, BOTTOM, -NEAR, [-1.0; 3]), (RIGHT * far_scale, TOP * far_scale, -FAR, [1.0; 3])];
    ends.into_iter().all(|(x, y, z, due)| {
        image(matrix, x, y, z).is_some_and(|ndc| (ndc - Point::from(due)).length() < 1e-12)
    })
}

fn printed(misprint: Misprint, wanted: IntendedProjection) -> DMat4 {
    let matrix = misprint.misprinted_matrix(wanted).expect("the misprint applies");
    assert_eq!(misprint_of(matrix, wanted), Some(misprint));
    assert_eq!(
        misprint_of(wanted.correct_matrix(), wanted),
        None,
        "the correct matrix has a misprint"
    );
    matrix.raw()
}

/// Asserts that the misprint is recognized from the numbers and that its remedy is the intended
/// matrix.
fn cured(matrix: DMat4, misprint: Misprint, wanted: DMat4) {
    let told = recognize(rows_of(matrix)).suspicions;
    let found = told.iter().find(|found| found.misprint == misprint).expect("recognized");
    let remedied = found.remedied.expect("a remedy");
    let remedied = DMat4::from_cols_array_2d(&remedied).transpose();
    assert!(distance(remedied, wanted) < 1e-9, "{remedied}");
}

#[test]
fn m4_without_p_nothing_is_foreshortened() {
    let slip = printed(Misprint::PerspectiveLeftOut, wanted_frustum());
    assert!(!fits(slip, FAR / NEAR) && fits(wanted_frustum().correct_matrix().raw(), FAR / NEAR));
    let (near, far) = (image(slip, 1.0, 0.0, -2.0), image(slip, 1.0, 0.0, -6.0));
    assert_eq!(near.map(Point::x), far.map(Point::x), "near and far must have the same size");
}

/// C29, C100.
#[test]
fn m8_opengl_has_the_same_box_but_the_opposite_depth() {
    let per = chapter::m_per(LEFT, RIGHT, BOTTOM, TOP, -NEAR, -FAR).expect("valid").raw();
    let gl = wanted_frustum().correct_matrix().raw();
    let flip = DMat4::from_diagonal(DVec4::new(1.0, 1.0, -1.0, 1.0));
    assert!(distance(flip * -per, gl) < 1e-14, "M_OpenGL = diag(1, 1, −1, 1)(−M_per)");
    let depth = |matrix| image(matrix, 0.0, 0.0, -NEAR).expect("in front").z();
    assert!((depth(per) - 1.0).abs() < 1e-14 && (depth(gl) + 1.0).abs() < 1e-14);
    assert!(!fits(printed(Misprint::DepthReversed, wanted_frustum()), FAR / NEAR));
}

#[test]
fn m8_the_raw_sign_of_w_is_the_same_map_but_fails_the_clip_test() {
    let per = chapter::m_per(LEFT, RIGHT, BOTTOM, TOP, -NEAR, -FAR).expect("valid");
    let positive = chapter::m_per_positive(LEFT, RIGHT, BOTTOM, TOP, -NEAR, -FAR).expect("valid");
    let p = Point::new(0.5, 0.5, -3.0);
    let (raw, turned) = (per.transform_point(p), positive.transform_point(p));
    assert_eq!(raw.divide(), turned.divide());
    let inside =
        |p: HPoint<Clip>| p.x().abs() <= p.w() && p.y().abs() <= p.w() && p.z().abs() <= p.w();
    assert!(!inside(raw) && inside(turned));
    let found = recognize(per.rows());
    assert!(
        found.first().factor < 0.0 && found.misprint().is_none(),
        "only the sign convention differs"
    );
}

#[test]
fn m9_and_exercise_8_p_allows_positive_n_and_f_but_m_per_does_not() {
    let p = chapter::p(1.0, 2.0).expect("one side of the eye").raw();
    let rows =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, 1.0, 0.0]];
    assert_eq!(p.transpose().to_cols_array_2d(), rows);
    assert!(matches!(
        chapter::m_per(LEFT, RIGHT, BOTTOM, TOP, 1.0, 2.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(chapter::p(1.0, -2.0), Err(ProjectionError::OutOfRange { .. })));
}

#[test]
fn m11_the_flat_third_row_gives_every_point_the_same_depth() {
    let mut printed = DMat4::from_translation(glam::DVec3::new(-1.0, -2.0, -3.0));
    let right = printed;
    printed.z_axis.z = 0.0;
    let z = |m: DMat4, z: f64| (m * DVec4::new(0.0, 0.0, z, 1.0)).z;
    assert_eq!(z(printed, 5.0), z(printed, -7.0));
    assert_eq!(z(right, 5.0) - z(right, -7.0), 12.0);
    cured(printed, Misprint::ThirdRowFlat, right);
    let turn = Affine::<World, View>::rotation_y(0.7).raw();
    cured(turn * printed, Misprint::ThirdRowFlat, turn * right);
}

/// C63, C66; the product of the lesson's steps is the same matrix.
#[test]
fn m12_the_lessons_frustum_is_another_projection() {
    let lesson = ApexMovedFrustum::new(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR).expect("valid");
    let slip = printed(Misprint::ApexMoved, wanted_frustum());
    assert_eq!(slip, lesson.view_to_clip(Convention::OPENGL).raw());
    assert!(!fits(slip, FAR / NEAR));
    let gl = wanted_frustum().correct_matrix().raw();
    let near = |m| image(m, 0.3, -0.4, -NEAR).expect("in front");
    assert!((near(slip) - near(gl)).length() < 1e-14, "they must agree on the near plane");
    cured(slip, Misprint::ApexMoved, gl);
    let steps = lesson.steps(Convention::OPENGL);
    let product =
        steps.move_apex.then_project(steps.map_depth).then(steps.project).then(steps.scale_window);
    assert!(distance(product.raw(), slip) < 1e-14, "Eq6 · Eq3 · Eq7' · Eq2");
}

#[test]
fn m14_a_one_in_the_bottom_row_makes_w_the_distance_plus_one() {
    let slip = printed(Misprint::BottomRowOne, lens(1.0));
    assert!(
        (image(slip, 0.0, 0.0, -NEAR).expect("w = 3").z() + 2.0 / 3.0).abs() < 1e-12,
        "n = 2 must map to −0.667"
    );
    assert!(
        (image(lens(1.0).correct_matrix().raw(), 0.0, 0.0, -NEAR).expect("w = 2").z() + 1.0).abs()
            < 1e-12
    );
    cured(slip, Misprint::BottomRowOne, lens(1.0).correct_matrix().raw());
}

#[test]
fn m15_the_wrong_sign_sends_near_and_far_out_of_the_cube() {
    let slip = printed(Misprint::OrthoOffsetSign, wanted_box());
    assert_eq!(image(slip, 0.0, 0.0, -NEAR).map(Point::z), Some(3.0));
    assert!(!fits(slip, 1.0) && fits(wanted_box().correct_matrix().raw(), 1.0));
    cured(slip, Misprint::OrthoOffsetSign, wanted_box().correct_matrix().raw());
}

#[test]
fn m16_a_difference_instead_of_a_sum_misplaces_the_window() {
    let slip = printed(Misprint::FrustumOffsetOne, wanted_frustum());
    assert!(!fits(slip, FAR / NEAR) && fits(wanted_frustum().correct_matrix().raw(), FAR / NEAR));
    let told = recognize(rows_of(slip)).suspicions;
    assert!(told.iter().any(|found| found.misprint == Misprint::FrustumOffsetOne));
}

#[test]
fn m17_half_of_the_tangent_is_not_the_tangent_of_the_half() {
    let wanted = lens(60_f64.to_radians());
    let slip = printed(Misprint::HalfOfTangent, wanted);
    assert!(
        (slip.y_axis.y - 1.155).abs() < 5e-4
            && (wanted.correct_matrix().raw().y_axis.y - 1.732).abs() < 5e-4
    );
    let top = NEAR * libm::tan(30_f64.to_radians());
    assert!(
        (image(wanted.correct_matrix().raw(), 0.0, top, -NEAR).expect("in front").y() - 1.0).abs()
            < 1e-12
    );
    assert!((image(slip, 0.0, top, -NEAR).expect("in front").y() - 1.0).abs() > 0.3);
}

#[test]
fn m19_forty_five_degrees_are_not_forty_five_radians() {
    assert!(
        matches!(
            Perspective::new(Fov::Vertical(45.0), 2.0, NEAR, FAR),
            Err(ProjectionError::OutOfRange { .. })
        ),
        "outside (0, π)"
    );
    let wanted = lens(45_f64.to_radians());
    let slip = printed(Misprint::Degrees, wanted);
    assert!(
        (slip.y_axis.y - 1.79).abs() < 5e-3
            && (wanted.correct_matrix().raw().y_axis.y - 2.41).abs() < 5e-3
    );
    cured(slip, Misprint::Degrees, wanted.correct_matrix().raw());
}

#[test]
fn m20_the_factor_u_exceeds_one_between_plane_and_eye() {
    let (d, eye) = (5.0, NPoint::from_eye(5.0).expect("valid"));
    let u = |z: f64| {
        let image = eye
            .onto_plane()
            .transform_point(Point::new(1.0, 0.0, z))
            .divide()
            .expect("not in the eye's plane");
        assert!((image.x() - d / (d - z)).abs() < 1e-15);
        image.x()
    };
    assert!(u(-3.0) > 0.0 && u(-3.0) < 1.0);
    assert_eq!(u(0.0), 1.0);
    assert!(u(2.5) > 1.0);
    assert!(u(7.0) < 0.0, "behind the eye");
}

#[test]
fn m21_ortho_takes_six_numbers_and_printed_47_checks_them() {
    assert!(api::ortho_gl(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0).is_ok());
    assert!(matches!(
        api::perspective_gl(0.0, 1.0, 1.0, 2.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(
        api::perspective_gl(1.0, 0.0, 1.0, 2.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(
        api::perspective_gl(1.0, 1.0, 2.0, 2.0),
        Err(ProjectionError::EmptyDepth { .. })
    ));
    assert!(matches!(
        api::perspective_gl(1.0, 1.0, 0.0, 2.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
}

#[test]
fn m24_the_canonical_cube_has_side_two() {
    let inverse = Frustum::new(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR)
        .expect("valid")
        .clip_to_view(Convention::OPENGL);
    let corner =
        |s: f64| inverse.transform_hpoint(HPoint::new(s, s, -1.0, 1.0)).divide().expect("finite");
    assert!((corner(1.0) - Point::new(RIGHT, TOP, -NEAR)).length() < 1e-14);
    assert!((corner(0.5) - Point::new(RIGHT, TOP, -NEAR)).length() > 0.1, "the side must not be ½");
}

#[test]
fn m25_foot_and_oblique_image_are_different_points() {
    let p = Point::<View>::new(1.0, 2.0, 3.0);
    let foot = Oblique::new(0.0, 0.0).expect("valid").onto_plane().transform_point(p);
    let image = Oblique::cavalier(0.0).expect("valid").onto_plane().transform_point(p);
    assert_eq!((foot.x(), image.x()), (1.0, 4.0));
}

#[test]
fn printed_29_half_of_the_depth_range_ends_at_80_over_21() {
    let curve = DepthCurve::perspective(2.0, 40.0, Convention::OPENGL).expect("valid");
    assert_eq!(curve.half_range_distance(), 80.0 / 21.0);
    assert!((curve.depth(3.8).expect("in front") + 1.0 / 361.0).abs() < 1e-14);
}

/// M14c.
#[test]
fn printed_31_only_symmetric_frusta_are_perspectives() {
    let centered = Frustum::new(-1.0, 1.0, -0.5, 0.5, 1.0, 2.0).expect("valid");
    assert!(Perspective::try_from(centered).is_ok());
    let aside = Frustum::new(LEFT, RIGHT, BOTTOM, TOP, NEAR, FAR).expect("valid");
    assert!(
        matches!(Perspective::try_from(aside), Err(ProjectionError::OffCenter)),
        "an error is expected"
    );
}

#[test]
fn printed_39_and_40_q_and_r_belong_to_y_and_z() {
    let two = NPoint::new(0.0, 0.2, 0.1).expect("p may be 0");
    let found = principal_vanishing_points(two.depth_preserving())
        .expect("finite")
        .axes
        .map(|axis| axis.point().is_some());
    assert_eq!(found, [false, true, true]);
    assert!(
        matches!(NPoint::new(0.0, 0.0, 0.0), Err(ProjectionError::NoVanishingPoint)),
        "all three are 0"
    );
}

#[test]
fn printed_49_near_and_far_map_to_zero_and_one_instead_of_being_set_to_them() {
    assert!(matches!(
        Frustum::new(LEFT, RIGHT, BOTTOM, TOP, 0.0, 1.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    let curve = DepthCurve::perspective(NEAR, FAR, Convention::WEBGPU).expect("valid");
    assert_eq!((curve.depth(NEAR), curve.depth(FAR)), (Some(0.0), Some(1.0)));
}

#[test]
fn matrices_for_row_vectors_are_recognized() {
    for wanted in [wanted_frustum(), lens(1.0), wanted_box()] {
        cured(
            printed(Misprint::Transposed, wanted),
            Misprint::Transposed,
            wanted.correct_matrix().raw(),
        );
    }
}

#[test]
fn every_misprint_has_a_description_and_a_remedy() {
    for misprint in Misprint::ALL {
        assert!(misprint.description().len() > 10 && misprint.remedy().len() > 10);
    }
    assert_eq!(Misprint::HalfOfTangent.id(), Some("M17"));
}

proptest! {
    #![proptest_config(samples::cases(64))]

    #[test]
    fn correct_matrices_are_not_misprints(p in perspective(), o in orthographic()) {
        let bounded = Perspective::new(Fov::Vertical(p.fov_y()), p.aspect(), p.near(), p.far())
            .expect("valid");
        let likely = |matrix: DMat4| {
            let found = recognize(rows_of(matrix)).suspicions;
            found.iter().any(|slip| slip.strength == SuspicionStrength::Likely)
        };
        prop_assert!(!likely(bounded.view_to_clip(Convention::OPENGL).raw()));
        // A mirrored window is less likely than a wrong sign.
        let w = o.window();
        let (x, y) = ([w.left(), w.right()], [w.bottom(), w.top()]);
        let [[l, r], [b, t]] = [x, y].map(|[a, b]| [a.min(b), a.max(b)]);
        let w = Window::new(l, r, b, t).expect("valid");
        let ahead = Orthographic::from_window(w, 0.0, (o.far() - o.near()).abs()).expect("valid");
        prop_assert!(!likely(ahead.view_to_clip(Convention::OPENGL).raw()));
        prop_assert!(!likely(Axonometric::isometric().depth_preserving().raw()));
    }

    #[test]
    fn each_misprint_is_distinguished_from_the_others(
        f in frustum(),
        p in perspective(),
        o in orthographic(),
        factor in 0.1..9.0,
    ) {
        for wanted in [IntendedProjection::Frustum(f), IntendedProjection::Perspective(p), IntendedProjection::Orthographic(o)] {
            let right = Projective::from_raw(wanted.correct_matrix().raw() * factor);
            prop_assert_eq!(misprint_of(right, wanted), None);
            for misprint in Misprint::ALL {
                let Some(slip) = misprint.misprinted_matrix(wanted) else { continue };
                let slip = slip.raw();
                // If the misprint changes nothing or equals another misprint, as for centered
                // windows, any name is accepted.
                if let Some(found) = misprint_of(Projective::from_raw(slip * factor), wanted) {
                    let same =
                        found.misprinted_matrix(wanted).is_some_and(|other| distance(other.raw(), slip) < 1e-5);
                    prop_assert!(found == misprint || same, "{misprint:?} is read as {found:?}");
                }
            }
        }
    }

    #[test]
    fn recognition_never_panics(
        entries in prop::array::uniform16(-2.0_f64..2.0),
        c in convention(),
    ) {
        let snapped = entries.map(|entry| if entry.abs() < 1.0 { 0.0 } else { entry.round() });
        for matrix in [entries, snapped, entries.map(|entry| 1.0 / (entry - entry))] {
            let matrix = DMat4::from_cols_array(&matrix);
            let _ = (recognize(rows_of(matrix)).readings.len(), projection::decompose(Projective::from_raw(matrix), c));
        }
    }
}

fn rows_of(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}
