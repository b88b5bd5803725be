//! Tests of the classical projections: what each preserves, that its two forms agree, and that
//! parallel projection is the limit of central projection.

use super::samples::{
    self, axonometric, convention, direction, distance, npoint, oblique, orthographic, point,
    rotation,
};
use glam::DMat4;
use homog::{HPoint, Normal, Plane, Point, Vector, View};
use projection::{
    Axonometric, AxonometricKind, Classical, Convention, NPoint, Oblique, ObliqueKind,
    Orthographic, Planometric, PrincipalPlane, PrincipalView, ProjectionClass, ProjectionError,
    Projector, SheetAngle,
};
use proptest::prelude::*;

/// Generates examples of the leaves of the tree, and random projections with parameters.
fn classical() -> impl Strategy<Value = Classical> {
    let leaves: Vec<_> =
        ProjectionClass::ALL.into_iter().filter_map(ProjectionClass::example).collect();
    prop_oneof![
        prop::sample::select(leaves),
        prop::sample::select(PrincipalView::ALL.to_vec()).prop_map(Classical::from),
        axonometric().prop_map(Classical::from),
        oblique().prop_map(Classical::from),
        npoint().prop_map(Classical::from),
        (-3.0..3.0, 0.1..2.0)
            .prop_map(|(turn, height)| Planometric::new(turn, height).expect("valid").into()),
    ]
}

fn xy<S: homog::Space>(point: HPoint<S>) -> Option<(f64, f64)> {
    Some((point.x() / point.w(), point.y() / point.w())).filter(|_| point.w() != 0.0)
}

fn close(a: (f64, f64), b: (f64, f64)) -> bool {
    let size = 1.0 + a.0.abs() + a.1.abs();
    (a.0 - b.0).abs() < 1e-9 * size && (a.1 - b.1).abs() < 1e-9 * size
}

proptest! {
    #![proptest_config(samples::cases(128))]

    /// C76, AX-1.
    #[test]
    fn squares_of_foreshortening_sum_to_two(a in axonometric()) {
        let sum: f64 = a.foreshortening().iter().map(|ratio| ratio * ratio).sum();
        prop_assert!((sum - 2.0).abs() < 1e-12);
    }

    #[test]
    fn foreshortening_is_the_length_of_the_axes_images(a in axonometric()) {
        let images =
            [Vector::X, Vector::Y, Vector::Z].map(|axis| a.onto_plane().transform_vector(axis).length());
        for (image, ratio) in images.iter().zip(a.foreshortening()) {
            prop_assert!((image - ratio).abs() < 1e-14);
        }
    }

    /// C76: tests the construction from foreshortening ratios.
    #[test]
    fn any_possible_ratios_are_achieved(x in 0.1..1.0, y in 0.1..1.0, z in 0.1..1.0) {
        let (a, b, c) = (x * x, y * y, z * z);
        match Axonometric::by_foreshortening(x, y, z) {
            Ok(made) => {
                let [fx, fy, fz] = made.foreshortening();
                prop_assert!((fx * y - fy * x).abs() < 1e-7 && (fy * z - fz * y).abs() < 1e-7);
            }
            Err(_) => prop_assert!(a > b + c || b > a + c || c > a + b),
        }
    }

    /// C76: tests the construction from the normal of the plane.
    #[test]
    fn the_normal_is_rotated_to_the_viewer(normal in direction()) {
        let made = Axonometric::by_normal(Normal::from_raw(normal.raw())).expect("a direction");
        let turned = made.depth_preserving().transform_vector(normal);
        prop_assert!((turned - Vector::Z * normal.length()).length() < 1e-12);
        prop_assert!(made.depth_preserving().transform_vector(Vector::Y).x().abs() < 1e-12, "y stays vertical");
    }

    #[test]
    fn projecting_twice_is_projecting_once(c in classical(), p in point()) {
        if let Classical::Oblique(o) = c {
            let flat = o.onto_plane();
            prop_assert!((flat.transform_point(flat.transform_point(p)) - flat.transform_point(p)).length() < 1e-12);
        }
        prop_assert_eq!(c.onto_plane().inverse(), None);
        let inverse = c.depth_preserving().then(c.depth_preserving_inverse()).raw();
        prop_assert!(distance(inverse, DMat4::IDENTITY) < 1e-13);
    }

    #[test]
    fn preserving_depth_does_not_change_the_picture(c in classical(), p in point()) {
        let (flat, kept) = (c.onto_plane().transform_point(p), c.depth_preserving().transform_point(p));
        prop_assert_eq!(flat.w(), kept.w());
        if flat.w().abs() > 1e-9 {
            prop_assert!(close(xy(flat).expect("w"), xy(kept).expect("w")));
        }
    }

    #[test]
    fn every_classical_projection_can_be_rendered(
        c in classical(),
        volume in orthographic(),
        k in convention(),
        p in point(),
    ) {
        let Ok(view_to_clip) = c.view_to_clip(volume, k) else {
            prop_assert!(matches!(c, Classical::NPoint(_)), "only a volume behind an eye can fail");
            return Ok(());
        };
        let inverse = c.clip_to_view(volume, k).expect("invertible like the map");
        prop_assert!(distance(view_to_clip.then(inverse).raw(), DMat4::IDENTITY) < 1e-9);
        let seen = Point::new(p.x(), p.y(), -k.ahead() * p.z());
        let (ndc, picture) = (view_to_clip.transform_point(seen), c.onto_plane().transform_point(p));
        if picture.w() > 0.05 {
            let (x, y) = xy(picture).expect("w");
            let w = volume.window();
            let fit = |at: f64, low: f64, high: f64| ((at - low) / (high - low)) * 2.0 - 1.0;
            let due = (fit(x, w.left(), w.right()), k.top() * fit(y, w.bottom(), w.top()));
            prop_assert!(close(xy(ndc).expect("w"), due), "{:?} is not {due:?}", xy(ndc));
        }
    }

    #[test]
    fn near_and_far_of_a_rendered_picture_are_at_the_requested_distances(
        c in classical(),
        k in convention(),
        near in -3.0..3.0,
        far in -3.0..3.0,
    ) {
        prop_assume!(f64::abs(near - far) > 0.1);
        let volume = Orthographic::new(-1.0, 1.0, -1.0, 1.0, near, far).expect("valid");
        let view_to_clip = c.view_to_clip(volume, k).expect("the eye is at least 5 away");
        for (at, depth) in [(near, k.near_depth()), (far, k.far_depth())] {
            let on_axis = match c {
                Classical::NPoint(_) => Point::new(0.0, 0.0, -at),
                _ => c
                    .depth_preserving_inverse()
                    .transform_point(Point::new(0.0, 0.0, -at))
                    .divide()
                    .expect("affine"),
            };
            let turned = Point::new(on_axis.x(), on_axis.y(), -k.ahead() * on_axis.z());
            let ndc = view_to_clip.transform_point(turned).divide().expect("in front of the eye");
            prop_assert!((ndc.z() - depth).abs() < 1e-9);
        }
    }

    /// C77, C78, C79: tests length, angle and direction.
    #[test]
    fn slants_can_be_specified_in_three_ways(length in 0.0..3.0, phi in -3.0..3.0, z in -2.0..2.0) {
        let by_length = Oblique::new(length, phi).expect("valid");
        let by_angle = Oblique::by_angle(by_length.alpha(), phi).expect("valid");
        let by_direction = Oblique::by_direction(by_length.direction() * -2.5, 0.0).expect("valid");
        for other in [by_angle, by_direction] {
            prop_assert!(distance(other.onto_plane().raw(), by_length.onto_plane().raw()) < 1e-12);
        }
        let moved = Oblique::by_direction(by_length.direction(), z).expect("valid");
        let on_plane = Point::new(0.3, -0.2, z);
        prop_assert!((moved.onto_plane().transform_point(on_plane) - on_plane).length() < 1e-14);
    }

    /// C72, C75, C78, C82: a plane and a center or a direction determine each projection.
    #[test]
    fn first_principles_give_the_textbook_matrices(d in 0.5..9.0, o in oblique()) {
        let picture = Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, 1.0));
        let central = Projector::from_eye(Point::new(0.0, 0.0, d), picture).expect("above");
        let one = NPoint::from_eye(d).expect("valid");
        prop_assert!(distance(central.onto_plane().raw(), one.onto_plane().raw()) < 1e-13);
        prop_assert!(distance(central.depth_preserving().raw(), one.depth_preserving().raw()) < 1e-13);
        let slanted = Projector::along(o.direction(), picture).expect("slanted");
        prop_assert!(distance(slanted.onto_plane().raw(), o.onto_plane().raw()) < 1e-12);
        for plane in PrincipalPlane::ALL {
            let drop = plane.onto_plane::<View>();
            let normal = Vector::new(1.0, 1.0, 1.0) - drop.transform_vector(Vector::new(1.0, 1.0, 1.0));
            let onto = Plane::through(Point::ORIGIN, Normal::from_raw(normal.raw()));
            let across = Projector::along(normal, onto).expect("perpendicular");
            prop_assert_eq!(across.onto_plane().raw(), drop.raw());
        }
    }

    #[test]
    fn images_are_in_the_plane_and_on_the_projector(
        eye in point(),
        p in point(),
        normal in direction(),
        q in point(),
    ) {
        let plane = Plane::through(q, Normal::from_raw(normal.raw()));
        prop_assume!(plane.evaluate(eye).abs() > 0.05 && (p - eye).length() > 0.1);
        let Some(image) =
            Projector::from_eye(eye, plane).expect("beside").onto_plane().transform_point(p).divide()
        else {
            return Ok(());
        };
        let size = 1.0 + (image - eye).length();
        prop_assert!(plane.evaluate(image).abs() < 1e-9 * size * size);
        prop_assert!((image - eye).cross(p - eye).length() < 1e-9 * size * size);
    }

    /// C72, PR-1: the error decreases as the reciprocal of the eye's distance.
    #[test]
    fn parallel_projection_is_the_limit_of_an_eye_going_to_infinity(
        o in oblique(),
        turn in rotation(),
        p in point(),
    ) {
        let normal = turn.transform_vector(Vector::Z);
        let plane = Plane::through(Point::ORIGIN, Normal::from_raw(normal.raw()));
        let towards = turn.transform_vector(o.direction());
        let limit = Projector::along(towards, plane)
            .expect("slanted")
            .onto_plane()
            .transform_point(p)
            .divide()
            .expect("affine");
        let mut last = f64::INFINITY;
        for far in [1e2, 1e4, 1e6] {
            let eye = Point::ORIGIN - towards * far;
            let image = Projector::from_eye(eye, plane)
                .expect("far")
                .onto_plane()
                .transform_point(p)
                .divide()
                .expect("in front");
            let error = (image - limit).length();
            prop_assert!(error < 1e3 / far && error <= last, "{error} at {far}");
            last = error;
        }
    }

    /// C74.
    #[test]
    fn parallel_lines_stay_parallel_in_parallel_projections(
        o in oblique(),
        p in point(),
        q in point(),
        d in direction(),
    ) {
        let flat = o.onto_plane();
        let along = |start: Point<View>| flat.transform_point(start + d) - flat.transform_point(start);
        prop_assert!((along(p) - along(q)).length() < 1e-12);
    }

    /// C82: the picture plane is fixed, and z = d has no image.
    #[test]
    fn only_the_plane_of_the_eye_has_no_image(d in 0.5..9.0, p in point()) {
        let eye = NPoint::from_eye(d).expect("valid");
        let beside = Point::new(p.x(), p.y(), d);
        prop_assert!(eye.onto_plane().transform_point(beside).w().abs() < 1e-15);
        prop_assert!(eye.preserves_picture_plane());
        let on_picture = Point::new(p.x(), p.y(), 0.0);
        prop_assert_eq!(eye.depth_preserving().transform_point(on_picture).divide(), Some(on_picture));
    }
}

/// C76, C77: tests isometric, dimetric, cavalier and cabinet projections.
#[test]
fn named_projections_have_their_textbook_angles() {
    let degrees = |radians: Option<f64>| radians.expect("seen").to_degrees();
    let iso = Axonometric::isometric().drawn_angles();
    assert!((degrees(iso[0]) + 30.0).abs() < 1e-12 && (degrees(iso[2]) + 150.0).abs() < 1e-12);
    assert!((degrees(iso[1]) - 90.0).abs() < 1e-12);
    let dimetric = Axonometric::dimetric_42_7();
    let [x, _, z] = dimetric.drawn_angles();
    assert!((degrees(x) + 7.18).abs() < 5e-3 && (degrees(z) + 180.0 - 41.41).abs() < 5e-3);
    let [fx, fy, fz] = dimetric.foreshortening();
    assert!((fx - fy).abs() < 1e-15 && (fz / fx - 0.5).abs() < 1e-15);
    let by_ratio = Axonometric::by_foreshortening(2.0, 2.0, 1.0).expect("possible");
    assert!(distance(by_ratio.onto_plane().raw(), dimetric.onto_plane().raw()) < 1e-15);
    assert_eq!(by_ratio.kind(), AxonometricKind::Dimetric);
    assert_eq!(
        Axonometric::by_angles(0.3, 0.5).expect("finite").kind(),
        AxonometricKind::Trimetric
    );
    assert_eq!(
        Axonometric::by_angles(0.0, 0.0).expect("finite").kind(),
        AxonometricKind::Multiview
    );
    assert!((Oblique::cavalier(0.0).expect("finite").alpha().to_degrees() - 45.0).abs() < 1e-12);
    let cabinet = Oblique::cabinet(0.5).expect("finite");
    assert!(
        (libm::tan(cabinet.alpha()) - 2.0).abs() < 1e-12 && cabinet.kind() == ObliqueKind::Cabinet
    );
    assert!((cabinet.alpha().to_degrees() - 63.43).abs() < 5e-3);
}

/// C76: the circle in the top face is drawn as an ellipse with axes 1 and 1/√3.
#[test]
fn circles_become_ellipses_under_isometric_projection() {
    let iso = Axonometric::isometric().onto_plane();
    let radii = (0..360).map(|degree| {
        let (sin, cos) = libm::sincos(f64::from(degree).to_radians());
        iso.transform_vector(Vector::new(cos, 0.0, sin)).length()
    });
    let (least, most) = radii.fold((f64::MAX, 0.0), |(a, b): (f64, f64), r| (a.min(r), b.max(r)));
    assert!((most - 1.0).abs() < 1e-12 && (least - 1.0 / 3_f64.sqrt()).abs() < 1e-12);
}

/// C75, MV-1 to MV-3.
#[test]
fn principal_views_look_along_their_axis_and_preserve_right_and_up() {
    let part = Point::<View>::new(1.0, 2.0, 3.0);
    let drawn = |view: PrincipalView| {
        let p = view.depth_preserving().transform_point(part);
        (p.x(), p.y())
    };
    assert_eq!(drawn(PrincipalView::Front), (1.0, 2.0));
    assert_eq!(drawn(PrincipalView::Back), (-1.0, 2.0));
    assert_eq!(drawn(PrincipalView::Right), (-3.0, 2.0));
    assert_eq!(drawn(PrincipalView::Left), (3.0, 2.0));
    assert_eq!(drawn(PrincipalView::Top), (1.0, -3.0));
    assert_eq!(drawn(PrincipalView::Bottom), (1.0, 3.0));
    for view in PrincipalView::ALL {
        assert_eq!(view.depth_preserving().determinant(), 1.0, "{view:?} is a rotation");
        // The plane drops the axis along which the viewer looks.
        let towards =
            view.depth_preserving().inverse().expect("a turn").transform_vector(Vector::Z);
        assert_eq!(view.plane().onto_plane::<View>().transform_vector(towards), Vector::ZERO);
    }
}

/// C75.
#[test]
fn sheets_are_laid_out_in_first_and_third_angle() {
    assert_eq!(PrincipalView::Top.sheet_position(SheetAngle::Third), (0, 1));
    assert_eq!(PrincipalView::Top.sheet_position(SheetAngle::First), (0, -1));
    assert_eq!(PrincipalView::Left.sheet_position(SheetAngle::Third), (-1, 0));
    assert_eq!(PrincipalView::Left.sheet_position(SheetAngle::First), (1, 0));
}

/// C73.
#[test]
fn the_tree_has_one_root_and_every_leaf_has_a_builder() {
    let roots = ProjectionClass::ALL.into_iter().filter(|class| class.parent().is_none()).count();
    assert_eq!(roots, 1);
    for class in ProjectionClass::ALL {
        assert_eq!(class.ancestors().last(), Some(ProjectionClass::Planar), "{class:?}");
        assert_eq!(class.is_leaf(), class.builder().is_some(), "{class:?}");
        assert_eq!(class.is_leaf(), class.example().is_some(), "{class:?}");
        if let Some(example) = class.example() {
            assert_eq!(example.class(), class);
        }
    }
    let below: Vec<_> = ProjectionClass::Axonometric.children().collect();
    assert_eq!(
        below,
        [ProjectionClass::Isometric, ProjectionClass::Dimetric, ProjectionClass::Trimetric]
    );
}

#[test]
fn impossible_parameters_are_rejected() {
    let nan = f64::NAN;
    assert!(matches!(
        Axonometric::by_foreshortening(1.0, 0.1, 0.1),
        Err(ProjectionError::ImpossibleForeshortening { .. })
    ));
    assert!(matches!(
        Axonometric::by_foreshortening(0.0, 1.0, 1.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(Axonometric::by_angles(nan, 0.0), Err(ProjectionError::NotFinite { .. })));
    assert!(matches!(
        Axonometric::isometric().about(Point::new(nan, 0.0, 0.0)),
        Err(ProjectionError::NotFinite { .. })
    ));
    assert!(matches!(Oblique::new(-1.0, 0.0), Err(ProjectionError::OutOfRange { .. })));
    assert!(matches!(Planometric::new(0.0, nan), Err(ProjectionError::NotFinite { .. })));
    assert!(matches!(
        NPoint::by_vanishing_points(Some(0.0), None, None),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(
        NPoint::by_vanishing_points(None, None, None),
        Err(ProjectionError::NoVanishingPoint)
    ));
    let plane = Plane::<View>::through(Point::ORIGIN, Normal::new(0.0, 1.0, 0.0));
    assert!(matches!(
        Projector::from_eye(Point::new(3.0, 0.0, 1.0), plane),
        Err(ProjectionError::CenterOnPlane)
    ));
    assert!(matches!(Projector::along(Vector::X, plane), Err(ProjectionError::ParallelToPlane)));
    assert!(matches!(
        Projector::along(Vector::ZERO, plane),
        Err(ProjectionError::ZeroVector { .. })
    ));
    let behind = Orthographic::new(-1.0, 1.0, -1.0, 1.0, -6.0, 5.0).expect("valid");
    let eye_at_5 = Classical::from(NPoint::from_eye(5.0).expect("valid"));
    assert!(matches!(
        eye_at_5.view_to_clip(behind, Convention::CHAPTER),
        Err(ProjectionError::OutOfRange { .. })
    ));
}
